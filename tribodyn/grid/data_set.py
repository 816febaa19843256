"""What a data set says of its cases beside their signals: varied keys, labels, drives, training and test."""

from collections.abc import Mapping
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from tribodyn import __version__
from tribodyn.errors import InputError
from tribodyn.grid.grid import Grid
from tribodyn.input import units
from tribodyn.input.units import NotAQuantity, to_si, to_si_at
from tribodyn.numerics.parameter import Variable
from tribodyn.record.sweep_schema import CASE, Listed, SweepLayout
from tribodyn.studies.protocol.batch import RUN_IN, SignalRequest

#: Tables of a scenario that labels are made of, and the label of a case that has none.
DAMAGE, SOUND = "damage", "none"
#: Keys of a damage that say how large it is, the first that it has; keys of a drive, where no seed draws it.
_SIZES = ("depth", "diameter", "length", "width")
_OF_A_DRIVE = (
    *("drive.", "bearings.", "gears.", "gear.", "shaft.", "mesh."),
    *("stage.", "body.", "link.", "housing."),
)
_DURATION = units.positive(units.TIME)._replace(example="1 s")
TRAIN, TEST = "train", "test"
#: Share of the drives that are left for the test.
TEST_SHARE = 0.25
LICENCE = (
    f"computed with tribodyn {__version__} (Apache-2.0), which claims no rights in what it computes; the "
    "licence of this data set is for its author to state"
)


class DataSet(NamedTuple):
    """A data set that is asked of a sweep."""

    signals: SignalRequest
    test: float = TEST_SHARE  # share of the drives that are left for the test
    licence: str = LICENCE


def data_set_of(
    duration: Any, run_in: float = RUN_IN, seed: int = 0, test: float = TEST_SHARE, licence: str = LICENCE
) -> DataSet | None:
    """The data set of signals as long as `duration`, a time with its unit; None of none.

    Raises InputError for what no data set can be made of.
    """
    if duration is None:
        return None
    seconds = to_si_at("--signals", duration, _DURATION)
    if not 0.0 <= run_in < np.inf:
        raise InputError("--run-in", f"{run_in:g}", "turns cannot be negative", "write 3")
    if not 0.0 <= test < 1.0:
        raise InputError("--test", f"{test:g}", "a share lies from 0 to below 1", "write 0.25")
    if seed < 0:
        raise InputError("--seed", seed, "a seed cannot be negative", "write 0")
    return DataSet(SignalRequest(seconds, float(run_in), int(seed)), float(test), licence)


def listed_of(grid: Grid, asked: DataSet, layout: SweepLayout) -> dict[str, Listed]:
    """What is told of every case: its number over the grid is that in the list."""
    places = [np.ravel(axis) for axis in np.indices(grid.shape)]
    columns: dict[str, Listed] = {}
    for axis, place in zip(grid.axes, places, strict=True):
        values = np.asarray(axis.values)[place]
        variable = Variable((CASE,), axis.units or "1", f"varied parameter {axis.key}")
        columns[axis.name] = Listed(variable, values, axis.key)
    drive = drives_of(grid, places)
    rows = [labels(grid.data(place)) for place in zip(*places, strict=True)]
    kind, gear, tooth, size = (list(column) for column in zip(*rows, strict=True))
    told = {
        "label": (np.array(kind), "1", f"kind of the damage; {SOUND}: the gears are sound"),
        "damage_gear": (np.array(gear), "1", "gear with the damaged tooth; empty: none"),
        "damage_tooth": (np.array(tooth), "1", "number of the damaged tooth, from 1 on; 0: none"),
        "damage_size": (
            np.array(size),
            "m",
            f"{', else '.join(_SIZES)} of the damage; 0: none, NaN: no such size",
        ),
        "drive": (drive, "1", "number of the drive: cases of one drive are the same gears"),
        "split": (split_of(drive, asked), "1", f"{TRAIN} or {TEST}; all cases of a drive on one side"),
    }
    for name, (values, unit, about) in told.items():
        columns[name] = Listed(Variable((CASE,), unit, about), values)
    for name in chain(layout.variables, layout.scales):
        if name in columns:
            rule = f"the data set has {name} of its own"
            raise InputError("sensor", f'"{name}"', rule, "give the sensor another name")
    return columns


def labels(data: Mapping[str, Any]) -> tuple[str, str, int, float]:
    """Kind, gear, tooth and size (m) of the damage of a scenario; of several all kinds, and the first."""
    damage = [table for table in data.get(DAMAGE, ()) if isinstance(table, Mapping)]
    if not damage:
        return SOUND, "", 0, 0.0
    first = damage[0]
    size = next((_length(first[key]) for key in _SIZES if key in first), float("nan"))
    kinds = dict.fromkeys(str(table.get("kind", "")) for table in damage)
    return "+".join(kinds), str(first.get("gear", "")), int(first["tooth"]), size


def _length(value: Any) -> float:
    try:
        return to_si(value, units.LENGTH)
    except NotAQuantity:  # the scenario's own message is better
        return float("nan")


def drives_of(grid: Grid, places: list[np.ndarray]) -> np.ndarray:
    """Number of the drive of every case.

    Drives differ by what is drawn with a seed; where nothing is, by keys of gears, bearings and mesh.
    """
    drawn_axes = [i for i, axis in enumerate(grid.axes) if axis.drawn]
    drive_axes = [i for i, axis in enumerate(grid.axes) if axis.key.startswith(_OF_A_DRIVE)]
    chosen = drawn_axes or drive_axes
    if not chosen:
        return np.zeros(len(places[0]), dtype="<i8")
    shape = tuple(grid.shape[i] for i in chosen)
    return np.ravel_multi_index(tuple(places[i] for i in chosen), shape).astype("<i8")


def split_of(drive: np.ndarray, asked: DataSet) -> np.ndarray:
    """The side of every case: so many of the drives, drawn by the seed, are left for the test."""
    every = np.unique(drive)
    count = min(len(every) - 1, max(1, round(asked.test * len(every)))) if asked.test else 0
    left = np.random.default_rng(asked.signals.seed).permutation(every)[:count]
    return np.where(np.isin(drive, left), TEST, TRAIN)
