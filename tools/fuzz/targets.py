"""What takes an input, and what may come of it: it is taken, or refused with an `InputError` of one line."""

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from typer.testing import CliRunner

from tools.fuzz.inputs import CURVE, Input, mutated
from tools.fuzz.records import exchange, record_of
from tribodyn.cli.app import app
from tribodyn.cli.options import overrides
from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.errors import InputError, InputErrors, SimulationError
from tribodyn.grid.data_set import data_set_of
from tribodyn.grid.grid import Grid
from tribodyn.kernels.native.arguments import Compiled, Target
from tribodyn.kernels.native.store import compiled_in, content_of
from tribodyn.numerics.files.cache import arrays_kept_or_made, kept_or_made, trusted_folder
from tribodyn.post.sweep_report import sweep_as_json
from tribodyn.record.sweep_reader import SweepRecord, open_any
from tribodyn.studies import STUDIES
from tribodyn.studies.pages import summary_json, summary_table, sweep_table
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.ehl.table import ContactTable

TAKEN, REFUSED = "taken", "refused"
#: Kinds that are also checked, and words of scenarios that are not: finite elements and solved contacts.
CHECKED = ("gear-pair", "gear-train", "efficiency", "ehl", "irefc", "backlash-oscillator")
LONG = '"fem"', '"solved"', "helix_angle", "internal = true"
#: Characters that a message has at most: whoever reads it sees what is wrong, and not a file.
LONGEST = 4000


class Fault(Exception):
    """What must not happen, and is no exception of its own."""


@cache
def warm_up() -> None:
    """Import, before processes are forked, what all of them would import on first use."""
    names = "crc-23-47 efficiency-involute-18-36 load-contact-18-36 ehl-crc-23-47 design-shift-23-47"
    for name in (*names.split(), "irefc", "backlash-oscillator"):
        load_scenario(name)
    Grid("crc-23-47", ["operating.pinion_speed=1,2 rad/s"], {})


def outcome(given: Input, folder: Path) -> str:
    """`TAKEN` or `REFUSED`; whatever else is raised is a fault. The folder is empty, the cache beside it."""
    try:
        _TARGETS[given.target](given, folder)
    except InputErrors as error:
        for part in error.errors:
            _readable(part)
        return REFUSED
    except InputError as error:
        _readable(error)
        return REFUSED
    return TAKEN


def _readable(error: InputError) -> None:
    text = str(error)
    if not error.key or not error.rule:
        raise Fault(f"a message without key or rule: {text[:200]}")
    _one_line(text)


def _one_line(text: str) -> None:
    if len(text.splitlines()) != 1 or len(text) > LONGEST:
        raise Fault(f"a message of {len(text.splitlines())} lines, {len(text)} characters: {text[:200]}")


def _toml(given: Input, folder: Path) -> None:
    path = folder / "case.toml"
    path.write_bytes(given.content)
    load_scenario(path)


def _set(given: Input, folder: Path) -> None:
    load_scenario(given.base, overrides([os.fsdecode(given.content)]))


def _key(given: Input, folder: Path) -> None:
    path = folder / "case.toml"
    path.write_bytes(given.content)
    case = load_scenario(path)
    if case.kind in CHECKED and not any(word in case.toml for word in LONG):
        try:
            STUDIES[case.kind].check(case)
        except SimulationError:
            return


def _curve(given: Input, folder: Path) -> None:
    scenario, _, curve = given.content.partition(CURVE)
    (folder / "curve.csv").write_bytes(curve)
    path = folder / "case.toml"
    path.write_bytes(scenario)
    load_scenario(path)


def _vary(given: Input, folder: Path) -> None:
    Grid(given.base, [os.fsdecode(given.content)], {})


def _signals(given: Input, folder: Path) -> None:
    asked = data_set_of(os.fsdecode(given.content), 3.0, 0, 0.25, "none")
    if asked:
        Grid(given.base, ["operating.gear_torque=100,200N*m"], {}).hearing(asked.signals)


def _run(given: Input, folder: Path) -> None:
    """A verb that reads a record whose parts were exchanged."""
    random, path = Random(given.content), folder / "run.h5"
    path.write_bytes(record_of(given.base))
    exchange(random, path)
    verb = random.choice(
        (["show"], ["show", "--json"], ["report"], ["listen"], ["signals", "--wav"], ["compare"])
    )
    words = [verb[0], *[str(path)] * (1 + (verb[0] == "compare")), *verb[1:]]
    ended = CliRunner().invoke(app, words)
    if ended.exit_code not in (0, 2):
        raise Fault(f"{' '.join(verb)}: status {ended.exit_code}, {ended.exception!r} {ended.output[-200:]}")
    if ended.exit_code == 2:
        _one_line(ended.stderr.strip())
        raise InputError("record", None, "refused")


def _record(given: Input, folder: Path) -> None:
    path = folder / "run.h5"
    path.write_bytes(given.content)
    with open_any(path) as record:
        if isinstance(record, SweepRecord):
            sweep_table(record)
            sweep_as_json(record)
        else:
            summary_table(record, full=True)
            summary_json(record)
            for name in record:
                _ = record[name]


def _cache(given: Input, folder: Path) -> None:
    """A file of the cache that somebody changed: it is as it was written, or made again."""
    random = Random(given.content)
    _look_up(given.base)
    trusted = trusted_folder("fuzz")
    if trusted is None:
        raise Fault("the cache is not used")
    file = trusted / given.base
    whole = file.read_bytes()
    file.write_bytes(mutated(random, whole, [b"[" * 5000, b"\x93NUMPY\x01\x00", b"(1e9,)"]))
    if not _look_up(given.base) or file.read_bytes() != whole:
        raise Fault(f"a changed {given.base} was taken, or not made again")


_CODE = Compiled("f", "i8", True, [], Target("generic", "", "3 1 0"), bytes(range(200)))
_ARRAYS: dict[str, Callable[[], dict[str, Any]]] = {
    "gear": lambda: {
        name: np.arange(12.0) for name in GearCompliance._fields if name not in ("lead", "ends")
    },
    "table": lambda: {name: np.arange(float(n)) for n, name in enumerate(ContactTable._fields)},
}


def _look_up(base: str) -> bool:
    """Whether the cache gives a kernel, a solved gear or a table of solved contacts as it was made."""
    if base == "kernel":
        return kept_or_made("fuzz", base, compiled_in, lambda: (_CODE, content_of(_CODE))) == _CODE
    arrays = arrays_kept_or_made("fuzz", base, _ARRAYS[base])
    return all(np.array_equal(arrays[name], array) for name, array in _ARRAYS[base]().items())


_TARGETS = {
    "toml": _toml,
    "set": _set,
    "curve": _curve,
    "vary": _vary,
    "key": _key,
    "signals": _signals,
    "run": _run,
    "record": _record,
    "cache": _cache,
}
