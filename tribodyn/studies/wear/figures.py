"""Figures of wear studies: worn flanks, loads along the path, transmission error, what changes with time."""

from collections.abc import Callable, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import Drawing, drawing, finished, six_panels
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.wear.case import BODIES

ROLL = "Roll angle from the pitch point (°)"
REVOLUTIONS = "Revolutions of the pinion (millions)"
#: Curves of one record, from new to worn.
_SHOWN = 6


def _curves(records: Sequence[Record]) -> list[tuple[Record, int, Any, str]]:
    """Record, row, colour and label of every curve: rows of one record evenly, of several the last ones."""
    if len(records) > 1:
        return [
            (record, -1, PALETTE[number % len(PALETTE)], record_label(record))
            for number, record in enumerate(records)
        ]
    (record,) = records
    places = np.linspace(0, record.samples - 1, min(_SHOWN, record.samples))
    rows = sorted({round(place) for place in places})
    shades = matplotlib.colormaps["viridis_r"](np.linspace(0.1, 1.0, len(rows)))
    labels = [f"{1e-6 * record['revolutions'][row]:.4g} million" for row in rows]
    return [(record, *curve) for curve in zip(rows, shades, labels, strict=True)]


def draw_over_roll(
    axes: Axes, records: Sequence[Record], name: str, factor: float, label: str, body: int | None = None
) -> None:
    """Draw a dataset over the roll angle, mean of the face: of one record its rows, of several the last."""
    for record, row, color, text in _curves(records):
        roll, values = np.degrees(record["roll"]), record[name][row]
        values = values if body is None else values[body]
        mean = factor * np.nanmean(values, axis=-1) if np.any(np.isfinite(values)) else 0 * roll
        axes.plot(roll, mean, color=color, label=text)
    axes.set(xlabel=ROLL, ylabel=label)
    axes.set_ylim(bottom=0.0)


def draw_errors(axes: Axes, records: Sequence[Record]) -> None:
    """Draw the loaded error less its mean: of one record over its rows, of several at the end."""
    for record, row, color, text in _curves(records):
        error = record["loaded_transmission_error"][row, 0]
        closed = 1e6 * (np.append(error, error[0]) - np.mean(error))
        axes.plot(np.append(record["phase"], 1.0), closed, color=color, label=text)
    axes.set(xlabel="Phase (mesh cycles)", ylabel="Loaded error less its mean (µm)")


def _draw_over_revolutions(
    axes: Axes, records: Sequence[Record], name: str, factor: float, label: str
) -> None:
    """Draw a dataset over the revolutions, of both gears where it has them."""
    for number, record in enumerate(records):
        values = factor * record[name]
        curves = values.T if values.ndim > 1 else [values]
        for place, curve in enumerate(curves):
            color = PALETTE[(number if len(records) > 1 else place) % len(PALETTE)]
            names = record_label(record) * (len(records) > 1), BODIES[place] * (len(curves) > 1)
            style: dict[str, Any] = {"color": color, "linestyle": ("-", "--")[place]}
            axes.plot(1e-6 * record["revolutions"], curve, label=" ".join(filter(None, names)), **style)
    axes.set(xlabel=REVOLUTIONS, ylabel=label)
    axes.set_ylim(bottom=0.0)


def _legend(axes: Axes, records: Sequence[Record]) -> None:
    """Name the curves, right of the panel: they fill it."""
    title = "Revolutions" if len(records) == 1 else None
    axes.legend(title=title, fontsize=6.5, title_fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))


#: Panels over the roll angle: title, and what `draw_over_roll` takes.
_DEPTHS = tuple(
    (f"Flank of the {body}, from new to worn", ("worn_depth", 1e6, "Depth worn off (µm)", place))
    for place, body in enumerate(BODIES)
)
_LOAD = "Line load of a pair along its path", ("line_load", 1e-3, "Line load (N/mm)")
_PRESSURE = "Hertz pressure", ("hertz_pressure", 1e-6, "Hertz pressure (MPa)")


def _over_roll(panels: Sequence[tuple[str, tuple[Any, ...]]], records: Sequence[Record]) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    rows = figure.subplots(2, 1, sharex=True)
    for axes, (_, what) in zip(rows, panels, strict=True):
        draw_over_roll(axes, records, *what)
    rows[0].set_xlabel("")
    _legend(rows[0], records)
    return finished(figure, rows, [title for title, _ in panels], records, None)


def _flanks(records: Sequence[Record], _view: View) -> Figure:
    return _over_roll([(f"{title}; mean over the face", what) for title, what in _DEPTHS], records)


def _loads(records: Sequence[Record], _view: View) -> Figure:
    return _over_roll([(f"{_LOAD[0]}, from new to worn", _LOAD[1]), _PRESSURE], records)


def _flank_map(records: Sequence[Record], _view: View) -> Figure:
    record = records[0]
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    panels = figure.subplots(2, 1, sharex=True)
    depth = 1e6 * record["worn_depth"][-1]
    style: dict[str, Any] = {"vmin": 0.0, "vmax": float(np.max(depth)) or 1.0, "cmap": "viridis"}
    roll, face = np.degrees(record["roll"]), 1e3 * record["slice"]
    meshes = [
        axes.pcolormesh(roll, face, values.T, shading="nearest", rasterized=True, **style)
        for axes, values in zip(panels, depth, strict=True)
    ]
    for axes in panels:
        axes.grid(visible=False)
        axes.set_ylabel("Place on the face (mm)")
    panels[-1].set_xlabel(ROLL)
    figure.colorbar(meshes[0], ax=list(panels), label="Depth (µm)", pad=0.02)
    return finished(figure, panels, [f"Depth worn off the {body}" for body in BODIES], records, None)


#: Panels over the revolutions: dataset, factor to the unit, label of the axis, title.
_MASS = ("worn_mass", 1e6, "Mass (mg)", "Mass worn off")
_SWING = ("transmission_error_peak_to_peak", 1e6, "Peak to peak (µm)", "Transmission error under load")
_HISTORY = (
    _MASS,
    ("debris_rate", 3.6e9, "Debris (mg/h)", "Debris of both gears"),
    _SWING,
    ("hertz_pressure_max", 1e-6, "Pressure (MPa)", "Maximum Hertz pressure"),
    ("power_friction", 1.0, "Loss (W)", "Mean loss to friction"),
    ("film_min", 1e6, "Film (µm)", "Minimum film"),
)


def _errors(records: Sequence[Record], _view: View) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    panels = figure.subplots(2, 1)
    draw_errors(panels[0], records)
    _legend(panels[0], records)
    _draw_over_revolutions(panels[1], records, *_SWING[:3])
    titles = "Transmission error under load over the mesh cycle, from new to worn", "Its peak to peak"
    return finished(figure, panels, titles, records, None)


def _history(records: Sequence[Record], _view: View) -> Figure:
    shown = [column for column in _HISTORY if all(column[0] in record for record in records)]
    figure = new_figure(WIDTH, (len(shown) + 1) // 2 * PANEL_HEIGHT)
    panels = figure.subplots((len(shown) + 1) // 2, 2, sharex=True, squeeze=False).ravel()
    for axes in panels[len(shown) :]:
        axes.remove()
    for axes, column in zip(panels, shown, strict=False):
        _draw_over_revolutions(axes, records, *column[:3])
    panels[0].legend(fontsize=6.5)
    return finished(figure, panels, [title for *_, title in shown], records, None)


def _overview(records: Sequence[Record], _view: View) -> Figure:
    first = records[:1]

    def first_depth(axes: Axes) -> None:
        draw_over_roll(axes, first, *_DEPTHS[0][1])
        _legend(axes, first)

    def mass(axes: Axes) -> None:
        _draw_over_revolutions(axes, first, *_MASS[:2], "Mass worn off (mg)")
        axes.legend()

    panels = (
        (_DEPTHS[0][0], first_depth),
        (_DEPTHS[1][0], lambda axes: draw_over_roll(axes, first, *_DEPTHS[1][1])),
        (_LOAD[0], lambda axes: draw_over_roll(axes, first, *_LOAD[1])),
        (_SWING[3], lambda axes: draw_errors(axes, first)),
        ("Its peak to peak", lambda axes: _draw_over_revolutions(axes, first, *_SWING[:3])),
        (_MASS[3], mass),
    )
    return six_panels(record_title(records[0]), panels)


def _in_slices(record: Record) -> bool:
    return record.samples > 0 and len(record["slice"]) > 1


def _of(about: str, draw: Callable[[Sequence[Record], View], Figure], **more: Any) -> Drawing:
    return drawing(about, draw, timeless="a worn flank", **more)


DRAWINGS: dict[str, Drawing] = {
    "overview": _of("flanks, loads, transmission error and mass worn off, from new to worn", _overview),
    "worn-flanks": _of("depth worn off both flanks over the roll angle", _flanks),
    "worn-map": _of(
        "depth worn off both flanks over roll angle and face",
        _flank_map,
        fits=_in_slices,
        missing=("worn-map", "{path} has a face in one piece", "give mesh.slices"),
    ),
    "worn-loads": _of("line load and pressure of a pair along its path, from new to worn", _loads),
    "worn-error": _of("transmission error under load, from new to worn", _errors),
    "wear-history": _of("mass, debris, error, pressure, loss and film over the revolutions", _history),
}
