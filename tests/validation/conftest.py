from functools import cache

import pytest

from tests.support.once_per_session import OncePerSession
from tribodyn.validation import validate
from tribodyn.validation.rows import Row


@pytest.fixture(scope="session")
def validated(tmp_path_factory: pytest.TempPathFactory):
    """Rows of a paper by name, computed once."""
    rows: OncePerSession[dict[str, Row]] = OncePerSession(
        tmp_path_factory,
        "validated",
        lambda paper, folder: {row.id: row for row in validate(paper, folder=folder)},
    )
    return cache(rows.__call__)
