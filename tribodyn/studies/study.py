"""How a study ends."""

from pathlib import Path
from typing import Any, NamedTuple


class RunResult(NamedTuple):
    """How a run ended: the record's path, "complete" or "failed", why, and its figures."""

    path: Path
    status: str
    message: str
    summary: dict[str, Any]
