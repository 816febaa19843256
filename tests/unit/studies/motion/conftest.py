"""The case of a reducer, changed as a test needs it."""

from pathlib import Path
from typing import Any

import pytest
import tomli_w

from tests.support.train_scenarios import REDUCER, train_case
from tribodyn.studies.motion.case import Gearbox


@pytest.fixture
def reduced(tmp_path: Path):
    """Make the case of the reducer with other tables or keys: dotted keys to values."""

    def made(overrides: dict[str, Any] | None = None, **tables: Any) -> Gearbox:
        path = tmp_path / "reducer.toml"
        path.write_text(tomli_w.dumps(REDUCER | tables), encoding="utf-8")
        return train_case(path, overrides)

    return made
