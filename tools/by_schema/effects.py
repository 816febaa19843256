"""Whether a key changes anything: two scenarios that differ in it alone have other results."""

import copy
import dataclasses
import re
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from tools.by_schema.changes import Change, at, put, taken
from tools.by_schema.keys import SchemaKey
from tools.by_schema.values import Surroundings, drawn_value, names_in
from tribodyn.errors import InputError, SimulationError
from tribodyn.input.schema import inner_tables
from tribodyn.numerics.parameter import Parameter
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_data
from tribodyn.studies.protocol.run import run

#: Processor time after which a run is given up, s.
LONGEST = 15
#: What a case has of its own text, and a summary of its file and of the clock.
_TEXT = ("toml", "sha256", "title", "name", "scenario_file")
_CLOCK = ("wall_time", "title", "name", "files", "scenario", "compile_time", "processor_time")


Look = Callable[[Any], Any]
"""What is seen of a case: `of_case`, or `of_run`."""

#: Pattern of a key that may leave a result as it is -> why.
SILENT = {
    r"(^|\.)(title|name|source|assumptions|kind)$": "says what the scenario is, and is not compared",
    r"(^|\.)duty\.\*\.share$": "weighs the duties of an assessment; other studies run one of them",
    r"\.(span_teeth|pin_diameter)$": "choose the dimension that the gear's sheet prints",
    r"(^|\.)quality_edition$": "of tolerances, which need a quality",
    r"\.centre_distance_grade$": "limits that the gear's sheet prints",
    r"(gear\.\*|\.pinion|\.gear)\.quality$": "tolerances of a pair need those of both gears",
}


class TooLong(Exception):
    """A run takes more time than is worth waiting for."""


def of_case(case: Any) -> str:
    """A case as text, without that of its file."""
    return repr(_plain(case))


def of_run(case: Any) -> dict[str, Any]:
    """What the record of a case's run holds: datasets and summary; the reason of a run that was stopped."""
    with TemporaryDirectory() as folder, limited(LONGEST):
        try:
            result = run(case, Path(folder) / "run.h5")
        except (InputError, SimulationError) as error:
            return {"stopped": str(error)}
        with Record(result.path) as record:
            found = {name: record[name].tobytes() for name in record}
            found |= {
                f"summary {key}": repr(_plain(value))
                for key, value in record.summary.items()
                if key not in _CLOCK
            }
        return found | {"message": result.message}


def acts(random: Random, base: dict[str, Any], key: SchemaKey, look: Look, draws: int = 3) -> bool | None:
    """Whether another value of a key is seen by `look`; None where no two values were taken."""
    compared = None
    for _ in range(draws):
        change = taken(random, base, key)
        if change is not None and (found := differ(random, change, key, look)) is not None:
            compared = found
        if compared:
            break
    return compared


def differ(random: Random, change: Change, key: SchemaKey, look: Look) -> bool | None:
    """Whether `look` sees another value of a changed key, or that it is missing; None: no other is taken."""
    seen = compared = None
    for other, value in _others(random, change.data, change.key, key):
        try:
            seen = look(change.case) if seen is None else seen
            if look(other) != seen:
                return True
        except TooLong:
            break
        if value is not None and not _same(value, change.value):
            compared = False
    return compared


def is_table(key: SchemaKey) -> bool:
    """Whether a key holds others."""
    return not isinstance(key.field, Parameter) and any(inner_tables(key.field.annotation))


def silent(key: SchemaKey) -> bool:
    """Whether a key need not change a result, for a reason that `SILENT` has."""
    return any(re.search(pattern, ".".join(key.pattern)) for pattern in SILENT)


def _others(random: Random, data: dict[str, Any], dotted: str, key: SchemaKey) -> Iterator[tuple[Any, Any]]:
    """Go through cases without a key (None), and with other values of it; at most two of these."""
    value, found = at(data, dotted), 0
    without = copy.deepcopy(data)
    above, _, last = dotted.rpartition(".")
    (at(without, above) if above else without).pop(last)
    around = Surroundings(tuple(sorted(names_in(data))), value)
    for number in range(8):
        changed = without if number == 0 else copy.deepcopy(data)
        other = drawn_value(random, key, around) if number else None
        if number:
            put(changed, dotted, other)
        if found < 2 and other != value:
            try:
                yield load_data(changed, "drawn").case, other
            except InputError:
                continue
            found += number > 0


def _same(one: Any, other: Any) -> bool:
    """Whether two values are the same number, however it is written."""
    words = [str(value).split(maxsplit=1) for value in (one, other)]
    try:
        return float(words[0][0]) == float(words[1][0]) and words[0][1:] == words[1][1:]
    except (ValueError, IndexError):
        return one == other


def _plain(value: Any) -> Any:
    """A case as plain data."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [field.name for field in dataclasses.fields(value) if field.name not in _TEXT]
        return {name: _plain(getattr(value, name)) for name in names}
    if isinstance(value, dict):
        return {name: _plain(each) for name, each in value.items() if name not in _TEXT}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise TooLong where the block takes so much processor time."""

    def hangs(_number: int, _frame: Any) -> None:
        raise TooLong(f"still running after {seconds} s")

    before = signal.signal(signal.SIGPROF, hangs)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
