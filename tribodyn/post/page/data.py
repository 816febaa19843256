"""What a page shows of a record: series along its axis, maps over the face, profiles at the cursor.

All in engineers' units; a series has few enough points, and its extremes are kept.
"""

import base64
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.post.cycles import stretches
from tribodyn.record.reader import Record

#: Samples of a series above which it is thinned: two of every bucket stay, its minimum and its maximum.
MOST_SAMPLES = 8000
#: Points of all series of a page, about: a number takes eleven bytes in the file.
MOST_POINTS = 500_000
#: Datasets that only add up another one: rotation, works.
INTEGRALS = ("pinion_angle", "reference_angle", "mesh_phase", "angle", "work_")
#: Axes of what is recorded of the pairs of several meshes.
OF_PAIRS = ("mesh", "pair")
#: Intervals that are shaded, at most.
MOST_INTERVALS = 300
#: Datasets by the flag that says where the law behind them is inside its range.
FLAGS = {
    "closure_in_range": ("central_film_thickness", "film_parameter", "asperity_load_ratio"),
    "friction_in_range": ("friction_coefficient", "friction_force"),
}
#: SI unit -> units to choose from, with the factor from SI; the first whose largest value is at least 1.
_UNITS: dict[str, tuple[tuple[str, float], ...]] = {
    "m": (("mm", 1e3), ("µm", 1e6), ("nm", 1e9)),
    "Pa": (("GPa", 1e-9), ("MPa", 1e-6), ("Pa", 1.0)),
    "N": (("N", 1.0), ("mN", 1e3)),
    "N/m": (("N/µm", 1e-6), ("N/mm", 1e-3), ("N/m", 1.0)),
    "W": (("kW", 1e-3), ("W", 1.0), ("mW", 1e3)),
    "rad": (("°", 180.0 / np.pi),),
    "s": (("s", 1.0), ("ms", 1e3), ("µs", 1e6)),
    "1": (("", 1.0),),
}


class Curve(NamedTuple):
    """One curve: what tells it from others of its dataset, places among the samples, values."""

    label: str
    places: np.ndarray
    values: np.ndarray


class Series(NamedTuple):
    """A dataset along the axis of a record."""

    name: str
    title: str
    unit: str
    curves: tuple[Curve, ...]


def in_engineers_units(values: np.ndarray, unit: str) -> tuple[np.ndarray, str]:
    """Values in the unit in which their maximum reads best, and that unit."""
    choices = _UNITS.get(unit, ((unit, 1.0),))
    finite = np.abs(values[np.isfinite(values)])
    largest = float(finite.max()) if finite.size else 0.0
    for name, factor in choices:
        if largest * factor >= 1.0:
            return values * factor, name
    name, factor = choices[-1 if largest else 0]
    return values * factor, name


def with_unit(text: str, unit: str) -> str:
    """A text and its unit in brackets; of a number without a unit the text alone."""
    return f"{text} ({unit})" if unit else text


def series_of(record: Record, records: int = 1) -> list[Series]:
    """Datasets of numbers along a record's axis, but for the axis: one curve, or one per pair, mesh or body.

    Without those of several units at once, and without those that are integrals of others (`INTEGRALS`). So
    many `records` share the page, and the points that it may have.
    """
    names = [
        name
        for name in record
        if name != record.axis
        and (len(record.dims_of(name)) <= 2 or record.dims_of(name)[1:] == OF_PAIRS)
        and record.dims_of(name)[:1] == (record.axis,)
        and record.units(name)
        and " or " not in record.units(name)
        and not name.startswith(INTEGRALS)
        and np.asarray(record[name]).dtype.kind == "f"
    ]
    count = sum(int(np.prod(np.shape(record[name])[1:])) for name in names)
    most = min(MOST_SAMPLES, max(1000, MOST_POINTS // max(1, count * records)))
    series = []
    for name in names:
        dims = record.dims_of(name)
        values, unit = in_engineers_units(np.asarray(record[name]), record.units(name))
        if values.ndim == 1:
            curves = [Curve("", *thinned(values, most))]
        elif dims[1:] == OF_PAIRS:
            curves = _of_pairs(record, values, most)
        else:
            labels = _labels(record, dims[1], values.shape[1])
            curves = [
                Curve(label, *thinned(column, most)) for label, column in zip(labels, values.T, strict=True)
            ]
            if dims[1] == "pair":
                curves.reverse()  # the one that entered last comes first
        series.append(Series(name, _title(record, name), unit, tuple(curves)))
    return series


def _labels(record: Record, across: str, count: int) -> list[str]:
    """Names along an axis, of numbers with what they count."""
    labels = np.asarray(record[across] if across in record else np.arange(count))
    word = f"{across.replace('_', ' ')} " if labels.dtype.kind in "iu" else ""
    return [f"{word}{label}" for label in labels]


def _of_pairs(record: Record, values: np.ndarray, most: int) -> list[Curve]:
    """Curves of the pairs of several meshes, mesh after mesh; those that a mesh has, the newest first."""
    meshes, pairs = (_labels(record, dim, size) for dim, size in zip(OF_PAIRS, values.shape[1:], strict=True))
    carries = np.any(np.isfinite(record["normal_load"]), axis=0) if "normal_load" in record else None
    return [
        Curve(f"{mesh}, {pairs[q]}", *thinned(values[:, m, q], most))
        for m, mesh in enumerate(meshes)
        for q in reversed(range(len(pairs)))
        if carries is None or carries[m, q]
    ]


def _title(record: Record, name: str) -> str:
    title = record.long_name(name)
    return title[:1].upper() + title[1:]


def extrapolated(record: Record) -> dict[str, list[list[int]]]:
    """First and last sample of intervals in which a law is outside its range, by dataset that rests on it.

    Where there are more than `MOST_INTERVALS`, the shortest gaps between them are closed.
    """
    intervals = {}
    for flag, names in FLAGS.items():
        if flag not in record or "normal_load" not in record:
            continue
        flags, loaded = record[flag] == 0, record["normal_load"] > 0.0
        over_face = loaded.shape + (1,) * (flags.ndim - loaded.ndim)
        outside = np.any(flags & loaded.reshape(over_face), axis=tuple(range(1, flags.ndim)))
        starts, ends = (stretches(outside) - (0, 1)).T
        if len(starts) > MOST_INTERVALS:
            gaps = starts[1:] - ends[:-1]
            kept = np.sort(np.argsort(-gaps, kind="stable")[: MOST_INTERVALS - 1])
            starts = np.concatenate([starts[:1], starts[1:][kept]])
            ends = np.concatenate([ends[:-1][kept], ends[-1:]])
        if len(starts):
            intervals |= dict.fromkeys(names, np.stack([starts, ends], axis=1).tolist())
    return intervals


def thinned(values: np.ndarray, most: int = MOST_SAMPLES) -> tuple[np.ndarray, np.ndarray]:
    """Places and values of a series of at most about `most` samples; extremes of every bucket stay."""
    count = len(values)
    if count <= most:
        return np.arange(count), values
    size = -(-2 * count // most)
    full = count // size * size
    buckets = values[:full].reshape(-1, size)
    empty = np.all(np.isnan(buckets), axis=1)
    lowest = np.where(empty, 0, np.argmin(np.where(np.isnan(buckets), np.inf, buckets), axis=1))
    highest = np.where(empty, 0, np.argmax(np.where(np.isnan(buckets), -np.inf, buckets), axis=1))
    first = np.arange(len(buckets)) * size
    gaps = first + np.argmax(np.isnan(buckets), axis=1)  # where contact ends, a curve has to break
    places = np.concatenate([first + lowest, first + highest, gaps, np.arange(full, count), [0, count - 1]])
    index = np.unique(places)
    return index, values[index]


def packed(values: np.ndarray, kind: str = "<f4") -> str:
    """An array as text: its bytes in base 64; what single precision cannot hold is infinite, a gap."""
    with np.errstate(over="ignore"):
        numbers = np.ascontiguousarray(values, dtype=kind)
    return base64.b64encode(numbers.tobytes()).decode("ascii")


def series_data(series: Series) -> dict[str, Any]:
    """A series as the page reads it; `whole` where no sample is left out."""
    curves = []
    for label, places, values in series.curves:
        whole = len(places) == int(places[-1]) + 1 if len(places) else True
        index = None if whole else packed(places, "<u4")
        curves.append({"label": label, "y": packed(values), "i": index})
    short = series.name.replace("_", " ")
    return {"name": series.name, "title": series.title, "unit": series.unit, "curves": curves, "short": short}


class PageMap(NamedTuple):
    """A map as a study describes it."""

    name: str  # of the dataset
    roll: np.ndarray  # (positions,); roll angle of the pair from the pitch point, rad
    face: np.ndarray  # (slices,); place on the face from its middle, m
    values: np.ndarray  # (positions, slices); SI; NaN: left blank
    top: float = 100.0  # percentile of the values at the top of the scale of colours
    title: str = ""  # default: the dataset's, of one pair


def map_data(record: Record, page_map: PageMap) -> dict[str, Any]:
    """A map as the page reads it, in engineers' units."""
    values, unit = in_engineers_units(page_map.values, record.units(page_map.name))
    return {
        "name": page_map.name,
        "title": page_map.title or f"{_title(record, page_map.name)}, of one pair from entry to exit",
        "unit": unit,
        "x": packed(np.degrees(page_map.roll)),
        "y": packed(page_map.face * 1e3),
        "z": packed(values.T),
        "top": float(np.nanpercentile(values, page_map.top)) if np.any(np.isfinite(values)) else 0.0,
    }


class Profile(NamedTuple):
    """A quantity that a page shows over a place, as a study describes it."""

    name: str  # of the dataset, over the record's axis and the place
    top: float | None = None  # upper end of its axis, SI; None: its maximum


class Profiles(NamedTuple):
    """What a page shows at the sample under the cursor."""

    title: str  # heading of the section
    #: place, label: scale that the profiles are over, and what is said of it at the axis
    place: str
    label: str
    rows: Sequence[Profile]


def profiles_data(record: Record, shown: Profiles) -> dict[str, Any]:
    """Profiles as the page reads them, in engineers' units; samples × places, row after row."""
    rows = []
    for profile in shown.rows:
        values, unit = in_engineers_units(np.asarray(record[profile.name]), record.units(profile.name))
        finite = values[np.isfinite(values)]
        top = float(finite.max()) if finite.size else 1.0
        if profile.top is not None and top > 0.0:
            top *= profile.top / float(np.nanmax(record[profile.name]))
        rows.append(
            {
                "name": profile.name,
                "title": _title(record, profile.name),
                "unit": unit,
                "low": min(float(finite.min()), 0.0) if finite.size else 0.0,
                "high": top,
                "y": packed(values),
            }
        )
    return {"title": shown.title, "label": shown.label, "x": packed(record[shown.place]), "rows": rows}
