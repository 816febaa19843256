"""A case's head, its record, and what its run and its check end in."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from tribodyn.errors import InputError

if TYPE_CHECKING:  # `tribodyn --help` imports this file
    from tribodyn.record.reader import Record
    from tribodyn.record.schema import Layout
    from tribodyn.record.writer import RecordWriter


Progress = Callable[[float], None]
"""Called with the share done, 0 … 1."""


@dataclass(frozen=True)
class CaseHead:
    """What every case begins with."""

    title: str  # what it shows
    name: str  # stem of the scenario's file; names the record
    kind: str  # kind of the study
    #: the scenario as TOML with everything written out (references replaced by their content, units kept,
    #: overrides applied); loading it gives this case again
    toml: str
    sha256: str  # digest of `toml`
    #: of a record that is named after its scenario: the scenario's file, see `record.target.Origin`
    scenario_file: str = field(default="", kw_only=True, compare=False)

    @property
    def pair(self) -> Any:
        """The pair of gears that the case is of: itself; of a gearbox the pair of its first mesh."""
        return self

    def chosen(self) -> dict[str, tuple[str, str]]:
        """What the scenario left open: key -> what was taken, and why."""
        return {}

    def without_run(self) -> dict[str, float]:
        """Quantities by name that need no run."""
        return {}

    def remarks_in_brief(self) -> list[str]:
        """Remarks on the case where it is one of many: without values, so that equal ones are counted."""
        return []

    def laws(self) -> dict[str, Any]:
        """Film and friction law with their ratios to solved contacts of gears, as in a summary, if any."""
        return {}


class RunResult(NamedTuple):
    """How a run ended: the record's path, "complete" or "failed", why, and its summary."""

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
    warnings: Sequence[str] = ()  # values that are more often a slip than meant, a sentence each
    details: Sequence[TextTable] = ()  # tables of single parts, printed where they are asked for

    @property
    def every(self) -> list[TextTable]:
        """All tables, those of single parts behind the others."""
        return [*self.tables, *self.details]


def record_path(case: CaseHead, output: str | Path | None) -> Path:
    """Where a case's record goes."""
    return Path(output) if output is not None else Path(f"{case.name}.h5")


def target(case: CaseHead, output: str | Path | None, force: bool, resumed: bool = False) -> Path:
    """Where a case's record goes; InputError, before any work, where it cannot be written there.

    A complete record beside what is `resumed` is kept as the previous one.
    """
    from tribodyn.record.target import Origin, keep_previous
    from tribodyn.record.writer import check_target

    path, origin = record_path(case, output), Origin(case.kind, case.scenario_file)
    check_target(path, force or resumed, origin)
    if resumed and not force:
        keep_previous(path, origin)
    return path


@contextmanager
def left_over(
    case: CaseHead, path: Path, same: Callable[["Record"], bool], code: str = "", *, complete: bool = False
) -> "Iterator[Record | None]":
    """Give the record that an unfinished run left, or also a `complete` one; None where there is none.

    Raises InputError for one of another kind or not the `same` scenario, or of other code than that of this
    digest.
    """
    from tribodyn.record.reader import Record
    from tribodyn.record.schema import partial_path, require_same_code
    from tribodyn.record.writer import check_target

    partial = partial_path(path)
    file = path if complete and not partial.exists() else partial
    if not file.exists():
        yield None
        return
    check_target(path, force=True)
    with Record(file) as record:
        if record.kind != case.kind or not same(record):
            remedy = "move it away, or --force to begin anew"
            raise InputError("--resume", str(file), "made from another scenario", remedy)
        require_same_code(record.attrs, file, code)
        yield record


def writer(
    case: CaseHead, path: Path, layout: "Layout", samples: int, *, force: bool = False, **more: Any
) -> "RecordWriter":
    """The writer of a case's record; `more`, such as groups and scales, as `record.layout.Head` takes it."""
    from datetime import UTC, datetime

    from tribodyn.record.layout import Head
    from tribodyn.record.writer import RecordWriter

    more["scenario_file"] = case.scenario_file
    head = Head(case.kind, layout, case.toml, case.sha256, datetime.now(UTC), **more)
    return RecordWriter(path, head, samples, force=force)
