"""How a run ends, and what a check says."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple


class RunResult(NamedTuple):
    """How a run ended: the record's path, "complete" or "failed", why, and its figures."""

    path: Path
    status: str
    message: str
    summary: dict[str, Any]

    @property
    def trust(self) -> str:
        """Whether the result lies within its model: "inside the model", "outside the model", or ""."""
        from tribodyn.record import trust

        return trust.verdict(self.summary)

    @property
    def reasons(self) -> list[str]:
        """What lies outside the model, in words; the numbers are in ``summary["trust_reasons"]``."""
        from tribodyn.record import trust

        return trust.reasons(self.summary)


class TextTable(NamedTuple):
    """A table as `check` prints it."""

    title: str
    columns: tuple[str, ...]
    rows: Sequence[Sequence[str]]


class CheckResult(NamedTuple):
    """What `check` says of a sound case: data for programs, tables and remarks for people."""

    data: dict[str, Any]
    tables: Sequence[TextTable]
    remarks: Sequence[str] = ()
