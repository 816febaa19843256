"""Records that are mutated: those that older versions wrote, and short runs of every kind by this one."""

import os
from functools import cache
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import h5py
import numpy as np

from tests.support.short_studies import short_case
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

ROOT = Path(__file__).parents[2]
#: Name -> the record that an older version wrote.
FIXTURES = {path.stem: path for path in sorted((ROOT / "tests" / "fixtures").glob("records-*/*.h5"))}
#: Kept for the next time.
FOLDER = ROOT / ".fuzz"
#: Runs: with sensors, and of every kind.
SENSORS = "sensors-18-36"
RUNS = (SENSORS, *STUDIES)
#: Of these the runs take no more than seconds.
QUICK = (SENSORS, "efficiency", "irefc", "backlash-oscillator")
_SHORT = {"solver.revolutions": 2, "output.window": [0.0, 2.0], "output.samples_per_cycle": 100}


@cache
def record_of(name: str) -> bytes:
    """The record of a short run; of a sweep, a data set and of every kind."""
    path = FOLDER / f"{name}-{computing_digest()[:12]}.h5"
    if not path.is_file():
        FOLDER.mkdir(exist_ok=True)
        with TemporaryDirectory(dir=FOLDER) as scratch:
            folder = Path(scratch)
            case = load_scenario(name, _SHORT) if name == SENSORS else short_case(name, folder)
            os.replace(run(case, folder / "run.h5").path, path)
    return path.read_bytes()


def exchange(random: Random, path: Path) -> None:
    """Change a few parts of a record: what they hold, their type and shape, attributes; or leave them out."""
    with h5py.File(path, "r+") as file:
        names: list[str] = []
        file.visit(names.append)
        for _ in range(random.choice((1, 1, 1, 2, 5))):
            name = random.choice(names)
            if name in file:
                _exchanged(random, file, name)


def _exchanged(random: Random, file: Any, name: str) -> None:
    place = file[name]
    holder = random.choice((file, place))
    if random.random() < 0.3 and len(holder.attrs):
        holder.attrs[random.choice(list(holder.attrs))] = random.choice(_VALUES)
        return
    if not isinstance(place, h5py.Dataset) or random.random() < 0.15:
        del file[name]
        return
    way, shape, attributes = random.randrange(6), place.shape, dict(place.attrs)
    if way == 0 and place.size and place.dtype.kind in "fi":
        place[...] = (
            random.choice((np.nan, np.inf, -1.0, 0.0, 1e300, 1e-300)) if place.dtype.kind == "f" else -1
        )
        return
    if way == 1 and place.size and place.dtype.kind == "f":
        values = place[...].ravel()
        values[random.randrange(values.size)] = random.choice((np.nan, np.inf, -1e300, 1e12))
        place[...] = values.reshape(shape)
        return
    del file[name]
    kinds = (
        np.dtype("S4"),
        np.dtype([("a", "f8"), ("b", "S4")]),
        np.dtype("i1"),
        h5py.string_dtype(),
        np.dtype("f2"),
    )
    if way in (2, 3):
        made = file.create_dataset(name, shape, random.choice(kinds))
    else:
        others = ((), (0,), (3,), (*shape, 2), (2, *shape), shape[:-1], (10**9, 10**9))
        shape = random.choice(others)
        made = file.create_dataset(
            name, shape, "f8", chunks=(1, 1000) if len(shape) == 2 and shape[0] > 10**8 else None
        )
    for key, value in attributes.items():
        if key not in ("DIMENSION_LIST", "REFERENCE_LIST") or random.random() < 0.5:
            made.attrs[key] = value


_VALUES = (
    0,
    -1,
    1e300,
    np.nan,
    np.inf,
    "",
    "x" * 10_000,
    "{",
    "[1e999]",
    np.zeros(3),
    b"\xff",
    2**62,
    '{"a": NaN}',
)
