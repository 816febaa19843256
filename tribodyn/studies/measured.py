"""Measured curves beside those of records: read from a CSV file or a mapping, and laid over each other."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.errors import InputError, near_name, quoted, unknown_name
from tribodyn.input.csv_files import read_curve
from tribodyn.input.units import ANGULAR_SPEED, Kind, NotAQuantity, factor_to_si
from tribodyn.post.style import (
    INK,
    PALETTE,
    PANEL_HEIGHT,
    WIDTH,
    house_style,
    literal,
    mark_panel,
    new_figure,
)
from tribodyn.record.reader import Record, mesh_views

#: What a first column may be, besides the axis of the record.
TIME, PHASE, ANGLE = "time", "mesh_phase", "pinion_angle"
#: Between the name of a column and that of its mesh, in a train of several.
OF_MESH = " of "
ALIGN = ("given", "mean", "fit")
#: Fewest points that are compared, and most columns that a figure has room for.
FEWEST, MOST_COLUMNS = 4, 6
#: Shifts that a fit tries, over one mesh cycle.
SHIFTS = 401

Source = str | Path | Mapping[str, Any]
"""A CSV file, or its columns: ``{"mesh_phase [1]": …, "transmission_error_rotational [um]": …}``."""


class Measured(NamedTuple):
    """Measured curves, in the units of their source."""

    label: str
    abscissa: str
    values: Mapping[str, np.ndarray]  # name -> (points,); the abscissa, which increases, among them
    units: Mapping[str, str]


class Beside(NamedTuple):
    """A simulated curve moved to lie beside a measured one, in the measured units."""

    x: np.ndarray  # (samples,)
    y: np.ndarray
    #: RMS of the difference where both are, correlation there, and by how much the simulation was moved
    difference: float
    correlation: float
    moved: tuple[float, float]  # along the abscissa, besides whole mesh cycles, and in value


def read_measured(source: Source) -> Measured:
    """Read measured curves; InputError names file, line and column of what cannot be used."""
    if isinstance(source, Mapping):
        columns, label = _columns(source), "measured"
    else:
        columns, label = read_curve(Path(source), "measured"), Path(source).stem
    file = "" if isinstance(source, Mapping) else str(source)
    abscissa, *quantities = columns
    values = {name: np.asarray(column["values"], dtype=float) for name, column in columns.items()}

    def bad(name: str, value: object, rule: str, remedy: str) -> InputError:
        return InputError(f"measured.{name}", value, rule, remedy, file)

    if not 1 <= len(quantities) <= MOST_COLUMNS:
        remedy = "give one column of the abscissa and those that are to be drawn"
        raise bad(abscissa, None, f"1 to {MOST_COLUMNS} quantities beside it, not {len(quantities)}", remedy)
    if len(values[abscissa]) < FEWEST:
        raise bad(abscissa, f"{len(values[abscissa])} points", f"at least {FEWEST}", "measure more")
    for name, column in values.items():
        if not np.all(np.isfinite(column)):
            row = int(np.flatnonzero(~np.isfinite(column))[0]) + 1
            raise bad(name, f"row {row}: {column[row - 1]}", "not a finite number", "leave that row out")
    falls = np.flatnonzero(np.diff(values[abscissa]) <= 0.0)
    if falls.size:
        row = int(falls[0]) + 2
        cell = f"row {row}: {values[abscissa][row - 1]:g}"
        raise bad(abscissa, cell, "does not increase from row to row", "sort the rows by the first column")
    return Measured(
        label, abscissa, values, {name: column["unit"].strip() for name, column in columns.items()}
    )


def _columns(source: Mapping[str, Any]) -> dict[str, Any]:
    """Columns of a mapping, as `read_curve` gives those of a file."""
    columns = {}
    for head, values in source.items():
        name, bracket, unit = str(head).rstrip().removesuffix("]").partition("[")
        if not bracket or np.ndim(values) != 1 or np.asarray(values).dtype.kind not in "fiu":
            raise InputError("measured", quoted(str(head)), 'expected "name [unit]" and numbers', "give such")
        columns[name.strip()] = {"unit": unit, "values": values}
    lengths = {len(column["values"]) for column in columns.values()}
    if len(columns) < 2 or len(lengths) > 1:
        raise InputError("measured", None, "expected columns of one length, two at least", "give such")
    return columns


def beside(record: Record, measured: Measured, name: str, align: str = "given") -> Beside:
    """Lay a record's dataset beside the measured one of that name.

    Of several meshes columns say whose they are, "transmission_error_rotational of second"; phase and angle
    are the first mesh's where they do not. Over both the record is moved by whole mesh cycles, so that its
    last ones lie there; over time it is not. `align` "mean" also moves it to the measured mean, "fit" besides
    along the abscissa, by at most half a mesh cycle, to where the first column correlates best.
    """
    if align not in ALIGN:
        raise InputError("align", quoted(align), "no such way", f"one of {', '.join(ALIGN)}")
    x, cycle, periodic = _abscissa(record, measured)
    to_si = _factor(measured, measured.abscissa, _units_of(record, measured))
    at = measured.values[measured.abscissa] * to_si
    whole = 0.0
    if measured.abscissa.partition(OF_MESH)[0] in (PHASE, ANGLE) and not periodic:
        # a fit leaves half a cycle at both ends where the record is that long
        room = cycle / 2.0 if align == "fit" and np.ptp(x) >= np.ptp(at) + 2.0 * cycle else 0.0
        whole = cycle * np.floor((x[-1] - at[-1] - room) / cycle + 1e-9)
    shift = 0.0
    if align == "fit":
        first = next(column for column in measured.values if column != measured.abscissa)
        y, target = _simulated(record, measured, first), measured.values[first]
        tried = np.linspace(-cycle / 2.0, cycle / 2.0, SHIFTS)
        correlations = [_correlation(_at(at + whole - s, x, y, periodic), target) for s in tried]
        shift = float(tried[int(np.argmax(correlations))]) if np.any(np.isfinite(correlations)) else 0.0
    y, target = _simulated(record, measured, name), measured.values[name]
    there = _at(at + whole - shift, x, y, periodic)
    both = np.isfinite(there)
    if np.sum(both) < FEWEST:
        simulated = f"simulated from {x[0] - whole:.4g} to {x[-1] - whole:.4g}"
        rule = f"measured from {at[0]:.4g} to {at[-1]:.4g}, {simulated} (SI): nothing to compare"
        raise InputError(f"measured.{measured.abscissa}", None, rule, "shift the column, or simulate longer")
    offset = float(np.mean(target[both] - there[both])) if align != "given" else 0.0
    inside = (x - whole + shift >= at[0]) & (x - whole + shift <= at[-1])
    shown = np.linspace(at[0], at[-1], 601) if periodic else x[inside] - whole + shift
    curve = _at(shown + whole - shift, x, y, periodic)
    to_unit = 1.0 / to_si
    difference = float(np.sqrt(np.mean((there[both] + offset - target[both]) ** 2)))
    moved = shift * to_unit, offset
    return Beside(shown * to_unit, curve + offset, difference, _correlation(there, target), moved)


def _at(places: np.ndarray, x: np.ndarray, y: np.ndarray, periodic: bool) -> np.ndarray:
    """A curve at places; NaN outside of it, unless it repeats with period 1."""
    if periodic:
        return np.interp(places, x, y, period=1.0)
    return np.interp(places, x, y, left=np.nan, right=np.nan)


def _correlation(one: np.ndarray, other: np.ndarray) -> float:
    both = np.isfinite(one)
    if np.sum(both) < max(FEWEST, 0.5 * len(one)) or np.ptp(one[both]) == 0.0 or np.ptp(other[both]) == 0.0:
        return np.nan
    return float(np.corrcoef(one[both], other[both])[0, 1])


def _abscissa(record: Record, measured: Measured) -> tuple[np.ndarray, float, bool]:
    """The measured abscissa of a record, SI; the length of a mesh cycle on it; whether it repeats with 1."""
    name, of, mesh = measured.abscissa.partition(OF_MESH)
    views = mesh_views(record)
    if of and mesh not in views:
        raise unknown_name("measured", mesh, views, "mesh of this record")
    record = views[mesh] if of else next(iter(views.values()))
    axis = "phase" if name == PHASE else name
    teeth = record.mesh_cycle.get("pinion_teeth") if "mesh_cycle" in record.groups else None
    if axis == record.axis or (axis == TIME and TIME in record) or (axis == ANGLE and axis in record):
        x = np.asarray(record[axis], dtype=float)
    elif name == PHASE and teeth and ANGLE in record:
        x = record[ANGLE] * (teeth / (2.0 * np.pi))
    else:
        names = [record.axis, *(other for other in (ANGLE,) if other in record)]
        names += [PHASE] if (teeth and ANGLE in record) or record.axis == "phase" else []
        raise unknown_name("measured", name, names, "abscissa of this record: the first column")
    if len(x) < 2:
        raise InputError("record", str(record.path), "holds no samples to draw", "run the scenario again")
    if axis == record.axis == "phase":
        return x, 1.0, True
    if name == PHASE or not teeth:
        return x, 1.0 if name == PHASE else 0.1 * float(np.ptp(x)), False
    pitch = 2.0 * np.pi / float(teeth)
    turned = float(np.ptp(record[ANGLE])) if ANGLE in record else pitch
    return x, pitch if name == ANGLE else float(np.ptp(x)) * pitch / turned, False


def _simulated(record: Record, measured: Measured, name: str) -> np.ndarray:
    """A dataset of the record in the measured unit; InputError where it has none of that name."""
    views, axis = mesh_views(record), record.axis
    curves: dict[str, tuple[Record, str]] = {}
    for mesh, view in views.items():
        for key in view:
            if key in view and key != axis and view.dims_of(key) == (axis,):
                alone = len(views) == 1 or record.dims_of(key) == (axis,)
                curves[key if alone else f"{key}{OF_MESH}{mesh}"] = view, key
    if name not in curves:
        near, heads = near_name(name, list(curves)), (key.partition(OF_MESH) for key in curves)
        names = dict.fromkeys([near] * bool(near) + [f"{key}{of}{of and 'MESH'}" for key, of, _ in heads])
        raise unknown_name("measured", name, list(names), "quantity of this record over its axis")
    view, key = curves[name]
    return np.asarray(view[key], dtype=float) / _factor(measured, name, record.units(key))


def _units_of(record: Record, measured: Measured) -> str:
    name = measured.abscissa.partition(OF_MESH)[0]
    return {PHASE: "1", TIME: "s", ANGLE: "rad"}.get(name) or record.units(name)


def _factor(measured: Measured, name: str, si: str) -> float:
    """From the measured unit to SI; InputError names the column."""
    unit = measured.units[name]
    kind = ANGULAR_SPEED if si == "rad/s" else Kind(name.replace("_", " "), si, f"1 {si}")
    try:
        if si == "K" and unit != "K":  # a rise in °C and a temperature in °C are not told apart
            raise NotAQuantity(f'"{unit}" may have a shifted zero', "give it in K")
        return factor_to_si(unit, kind)
    except NotAQuantity as error:
        raise InputError(f"measured.{name}", f"[{unit}]", error.rule, error.remedy) from None


#: More points than these are drawn as a line.
MOST_DOTS = 200
#: Units as a file spells them -> as a figure shows them.
SPELLED = {"um": "µm", "deg": "°", "N*m": "N m", "1": ""}


def measured_figure(records: Sequence[Record], source: Source, align: str = "given") -> Figure:
    """Draw measured curves and those of records over the measured abscissa, a panel for each quantity."""
    measured = read_measured(source)
    names = [name for name in measured.values if name != measured.abscissa]
    try:
        fits = {name: [beside(record, measured, name, align) for record in records] for name in names}
    except InputError as error:
        file = "" if isinstance(source, Mapping) else str(source)
        raise error.moved(lambda place: place or file) from None
    with house_style():
        return _drawn(records, measured, fits)


def _drawn(records: Sequence[Record], measured: Measured, fits: Mapping[str, Sequence[Beside]]) -> Figure:
    x, label = measured.values[measured.abscissa], literal(f"measured: {measured.label}")
    figure = new_figure(WIDTH, len(fits) * (PANEL_HEIGHT + 0.2) + 0.4)
    rows = figure.subplots(len(fits), 1, sharex=True, squeeze=False)[:, 0]
    dots = {"marker": ".", "markersize": 4, "linestyle": "none"}
    marks = dots if len(x) <= MOST_DOTS else {"linewidth": 1.0}
    for letter, axes, (name, curves) in zip("abcdef", rows, fits.items(), strict=False):
        axes.plot(x, measured.values[name], color=INK, label=label, zorder=3, **marks)
        lines = [name.replace("_", " ").capitalize()]
        for number, (record, curve) in enumerate(zip(records, curves, strict=True)):
            color, text = PALETTE[number % len(PALETTE)], _said(curve, measured, name)
            axes.plot(curve.x, curve.y, color=color, label=literal(record.label), linewidth=1.2)
            lines.append(f"{record.label}: {text}" if len(records) > 1 else text)
        axes.set_ylabel(literal(_spelled(measured, name)))
        mark_panel(axes, letter if len(fits) > 1 else "", "\n".join(map(literal, lines)))
        axes.margins(x=0.01)
    along = _spelled(measured, measured.abscissa)
    title = measured.abscissa.replace("_", " ").capitalize()
    rows[-1].set_xlabel(literal(f"{title} ({along})" if along else title))
    handles, labels = rows[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=min(3, len(labels)))
    return figure


def _said(fit: Beside, measured: Measured, name: str) -> str:
    """How far apart the two are, and how the simulation was moved."""
    unit, along = _spelled(measured, name), _spelled(measured, measured.abscissa)
    text = f"difference {fit.difference:.3g} {unit}".rstrip() + f" RMS, correlation {fit.correlation:.3f}"
    shift, offset = fit.moved
    moves = [f"{shift:+.3g} {along}"] * (shift != 0.0) + [f"{offset:+.3g} {unit}".rstrip()] * (offset != 0.0)
    return text + (f"; simulation moved by {' and '.join(moves)}" if moves else "")


def _spelled(measured: Measured, name: str) -> str:
    """Unit of a column as a figure shows it; the phase of the mesh is counted in mesh cycles."""
    shown = SPELLED.get(measured.units[name], measured.units[name])
    return shown or ("mesh cycles" if name.startswith(PHASE) else "")
