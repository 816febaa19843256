from functools import cache

import pytest

from tribodyn.validation import validate
from tribodyn.validation.rows import Row


@pytest.fixture(scope="session")
def validated(tmp_path_factory: pytest.TempPathFactory):
    """Rows of a paper by name, computed once."""

    @cache
    def rows(paper: str) -> dict[str, Row]:
        return {row.id: row for row in validate(paper, folder=tmp_path_factory.mktemp(paper))}

    return rows
