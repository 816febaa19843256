"""Quantities of a study by name, and of its cases without a record: for sweeps, searches and Python.

Parts of such cases, as of an assessment, that do not change from case to case stay in a folder that is kept:
they are taken up (see `tasks.results`), all others are computed again.
"""

from collections.abc import Hashable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.cost import Estimate, variable_bytes
from tribodyn.errors import InputError, SimulationError
from tribodyn.quantities.catalogue import GROUPS, QUANTITIES
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.sweep_schema import DONE, FAILED, SweepLayout
from tribodyn.record.trust import TRUST, number
from tribodyn.record.withheld_efficiency import remarked, remarks, warned
from tribodyn.studies.protocol.batch import Batch, Chunk, SignalRequest
from tribodyn.studies.protocol.study import Study

CONTACT_RATIO = "contact_ratio"
#: Cases side by side, such as duties, of which each has a folder that is kept: of more there is no room.
MOST = 8
_folder: ContextVar[Path | None] = ContextVar("folder", default=None)


@contextmanager
def kept_in(folder: Path | None) -> Iterator[None]:
    """Keep the parts of the cases inside the block in a folder; None: of none."""
    token = _folder.set(folder)
    try:
        yield
    finally:
        _folder.reset(token)


@contextmanager
def within(number: int) -> Iterator[None]:
    """Take the block for one of several cases, which come again in the same order."""
    folder = _folder.get()
    with kept_in(folder / str(number) if folder and number < MOST else None):
        yield


@contextmanager
def scratch() -> Iterator[Path]:
    """Give a folder for the parts of a case: the one that is kept, or a temporary one."""
    if folder := _folder.get():
        folder.mkdir(parents=True, exist_ok=True)
        yield folder
        return
    with TemporaryDirectory(prefix="tribodyn-") as temporary:
        yield Path(temporary)


def evaluated_quantities(study: Study) -> dict[str, Quantity]:
    """Quantities of a study's cases without a record: those that a sweep keeps, and those of its summary.

    Of studies with a `batch` the former alone. Of gears the contact ratio and the distances from the limits
    of existence too. None, where a study cannot be swept.
    """
    quantities = dict(study.swept())
    if not quantities:
        return quantities
    if study.has_gears:
        quantities.setdefault(CONTACT_RATIO, QUANTITIES[CONTACT_RATIO])
        quantities |= {limit.name: limit for limit in GROUPS["limits"]}
    if not study.batch():
        for heading, some in study.reported().items():
            for quantity in some if heading != "Solver" else ():
                quantities.setdefault(quantity.name, quantity)
    return quantities


def evaluated(
    study: Study,
    cases: Sequence[Any],
    workers: int | None = None,
    *,
    marched: int = 0,
    arrays: Sequence[str] = (),
) -> list[dict[str, Any] | str]:
    """Work out the quantities of cases without a record; a text instead where one fails: why.

    A text among the cases is why one could not even be made. Cases of a study with a `batch` are steady
    states, or so many mesh cycles that are marched, evaluated by so many threads, default: one per core;
    `arrays` are datasets of its rows that are kept, too.
    """
    if batch := study.batch():
        results = _together(study, batch, cases, workers, marched or None, arrays)
    else:
        results = [alone(study, case, number) for number, case in enumerate(cases)]
    return [
        result if isinstance(result, str) else case.without_run() | result
        for case, result in zip(cases, results, strict=True)
    ]


def alone(study: Study, case: Any, number: int = 0) -> dict[str, Any] | str:
    """Quantities of one case, of a number among several, of a study without a `batch`.

    A text instead where it fails: why.
    """
    try:
        with within(number):
            return case if isinstance(case, str) else study.quantities_of(case)
    except InputError as error:
        return str(error)
    except SimulationError as error:
        return error.reason


def _together(
    study: Study,
    batch: Batch,
    cases: Sequence[Any],
    workers: int | None,
    marched: int | None,
    arrays: Sequence[str],
) -> list[dict[str, Any] | str]:
    valid = [case for case in cases if not isinstance(case, str)]
    if not valid:
        return list(cases)
    settings = batch.settings(valid, marched, "native")
    rows = batch.evaluate(Chunk(np.arange(len(cases)), tuple(cases)), settings, workers)
    none = np.full(len(cases), np.nan)  # of what these cases do not have
    return [
        {name: float(rows.get(name, none)[i]) for name in study.swept()}
        | {name: rows[name][i] for name in arrays}
        if status == DONE
        else str(rows["message"][i])
        for i, status in enumerate(rows["status"])
    ]


class NoSettings(NamedTuple):
    """Nothing can be chosen."""


class OneByOne:
    """Cases of a study without a `batch`, one after the other; see `protocol.batch.Batch`."""

    states = 0

    def __init__(self, study: Study) -> None:
        if not study.swept():
            rule, remedy = "such a study cannot be swept", "run its cases one by one"
            raise InputError("kind", f'"{study.kind}"', rule, remedy)
        self.study = study

    def settings(self, cases: Sequence[Any], transient: int | None, engine: str) -> NoSettings:
        """Nothing to choose; marching and JAX belong to motions."""
        if transient is not None:
            rule = f"{self.study.about}: its cases have no mesh cycles to march"
            raise InputError("--transient", transient, rule, "omit it")
        if engine == "jax":
            raise InputError("--engine", "jax", f"{self.study.about}: JAX integrates motions only", "omit it")
        return NoSettings()

    def following(self, settings: NoSettings, unstable: bool) -> NoSettings:
        """The same: such cases do not go on from each other."""
        return settings

    def hearing(self, request: SignalRequest) -> Batch:
        """Refused: sensors belong to motions."""
        rule = f"{self.study.about}: its cases have no sensors"
        raise InputError("--signals", None, rule, "omit it")

    def layout(self, settings: NoSettings) -> SweepLayout:
        """The quantities that the study names."""
        swept = self.study.swept()
        return SweepLayout({name: quantity.variable() for name, quantity in swept.items()})

    def size_of_chunk(self, settings: NoSettings, total: int, width: int) -> int:
        """One: each is recorded as soon as it is done."""
        return 1

    def estimate(self, case: Any, settings: NoSettings, total: int, width: int) -> Estimate:
        """What the study says of a run; the record holds its quantities."""
        row = variable_bytes(self.layout(settings).variables.values(), {})
        return self.study.estimate(case)._replace(record=row)

    def sharing(self, case: Any) -> Hashable:
        """Nothing is known to be shared."""
        return None

    def check(self, case: Any, settings: NoSettings) -> None:
        """Check a case as `tribodyn check` does."""
        self.study.check(case)

    def evaluate(self, chunk: Chunk, settings: NoSettings, workers: int | None) -> dict[str, np.ndarray]:
        """Work out the quantities of every case."""
        layout = self.layout(settings)
        rows = layout.empty_rows(len(chunk.cases))
        for i, case in enumerate(chunk.cases):
            result = alone(self.study, case)
            if isinstance(result, str):
                rows["message"][i], rows["status"][i] = result, FAILED
                continue
            for name in layout.quantities:
                if result.get(name) is not None:
                    rows[name][i] = result[name]
            rows["message"][i] = remarked(*map(warned, [*remarks(result), *case.remarks_in_brief()]))
            rows[TRUST][i] = number(result)
            rows["status"][i] = DONE
        return rows
