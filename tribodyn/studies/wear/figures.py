"""Figures of wear studies: worn flanks, loads along the path, transmission error, what changes with time."""

from collections.abc import Callable, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import Drawing, drawing
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.wear.case import BODIES

ROLL = "Roll angle from the pitch point (°)"
REVOLUTIONS = "Revolutions of the pinion (millions)"
#: Curves of one record, from new to worn.
_SHOWN = 6


def _rows(record: Record) -> list[int]:
    """Rows of a record that are drawn: evenly from the first to the last."""
    count = min(_SHOWN, record.samples)
    return sorted({round(place) for place in np.linspace(0, record.samples - 1, count)})


def draw_over_roll(
    axes: Axes, records: Sequence[Record], name: str, factor: float, body: int | None = None
) -> None:
    """Draw a dataset over the roll angle, mean of the face: of one record its rows, of several the last."""
    for number, record in enumerate(records):
        rows = _rows(record) if len(records) == 1 else [-1]
        shades = matplotlib.colormaps["viridis_r"](np.linspace(0.1, 1.0, len(rows)))
        roll = np.degrees(record["roll"])
        for row, shade in zip(rows, shades, strict=True):
            values = record[name][row] if body is None else record[name][row, body]
            label = f"{1e-6 * record['revolutions'][row]:.4g} million"
            color = shade if len(records) == 1 else PALETTE[number % len(PALETTE)]
            label = label if len(records) == 1 else record_label(record)
            axes.plot(
                roll,
                factor * np.nanmean(values, axis=-1) if np.any(np.isfinite(values)) else 0 * roll,
                color=color,
                label=label,
            )
    axes.set_xlabel(ROLL)
    axes.set_ylim(bottom=0.0)


def _legend(axes: Axes, records: Sequence[Record]) -> None:
    """Name the curves, right of the panel: they fill it."""
    title = "Revolutions" if len(records) == 1 else None
    axes.legend(title=title, fontsize=6.5, title_fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))


def _over_revolutions(axes: Axes, records: Sequence[Record], name: str, factor: float, label: str) -> None:
    for number, record in enumerate(records):
        values = factor * record[name]
        many = values.ndim > 1
        for place in range(values.shape[1] if many else 1):
            color = PALETTE[(number if len(records) > 1 else place) % len(PALETTE)]
            of = f"{BODIES[place]}" if many else ""
            text = " ".join(filter(None, (record_label(record) if len(records) > 1 else "", of)))
            axes.plot(
                1e-6 * record["revolutions"],
                values[:, place] if many else values,
                color=color,
                linestyle=("-", "--")[place],
                label=text,
            )
    axes.set(xlabel=REVOLUTIONS, ylabel=label)
    axes.set_ylim(bottom=0.0)


def _flanks(records: Sequence[Record], _view: View) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    panels = figure.subplots(2, 1, sharex=True)
    for place, axes in enumerate(panels):
        draw_over_roll(axes, records, "worn_depth", 1e6, place)
        axes.set_ylabel("Depth worn off (µm)")
        mark_panel(axes, "ab"[place], f"Flank of the {BODIES[place]}, from new to worn; mean over the face")
    panels[0].set_xlabel("")
    _legend(panels[0], records)
    return _titled(figure, records)


def _flank_map(records: Sequence[Record], _view: View) -> Figure:
    record = records[0]
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    panels = figure.subplots(2, 1, sharex=True)
    depth, top = 1e6 * record["worn_depth"][-1], 1e6 * float(np.max(record["worn_depth"][-1]))
    drawings = [
        axes.pcolormesh(
            np.degrees(record["roll"]),
            1e3 * record["slice"],
            depth[place].T,
            vmin=0.0,
            vmax=top or 1.0,
            cmap="viridis",
            shading="nearest",
            rasterized=True,
        )
        for place, axes in enumerate(panels)
    ]
    for place, axes in enumerate(panels):
        axes.grid(visible=False)
        axes.set_ylabel("Place on the face (mm)")
        mark_panel(axes, "ab"[place], f"Depth worn off the {BODIES[place]}")
    panels[-1].set_xlabel(ROLL)
    figure.colorbar(drawings[0], ax=list(panels), label="Depth (µm)", pad=0.02)
    return _titled(figure, records)


def _loads(records: Sequence[Record], _view: View) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    panels = figure.subplots(2, 1, sharex=True)
    for axes, name, factor, label, title in (
        (
            panels[0],
            "line_load",
            1e-3,
            "Line load (N/mm)",
            "Line load of a pair along its path, from new to worn",
        ),
        (panels[1], "hertz_pressure", 1e-6, "Hertz pressure (MPa)", "Hertz pressure"),
    ):
        draw_over_roll(axes, records, name, factor)
        axes.set_ylabel(label)
        mark_panel(axes, "ab"[axes is panels[1]], title)
    panels[0].set_xlabel("")
    _legend(panels[0], records)
    return _titled(figure, records)


def draw_errors(axes: Axes, records: Sequence[Record]) -> None:
    """Draw the loaded error less its mean: of one record over its rows, of several at the end."""
    for number, record in enumerate(records):
        rows = _rows(record) if len(records) == 1 else [-1]
        shades = matplotlib.colormaps["viridis_r"](np.linspace(0.1, 1.0, len(rows)))
        phase = np.append(record["phase"], 1.0)
        for row, shade in zip(rows, shades, strict=True):
            error = record["loaded_transmission_error"][row, 0]
            closed = np.append(error, error[0])
            color = shade if len(records) == 1 else PALETTE[number % len(PALETTE)]
            label = f"{1e-6 * record['revolutions'][row]:.4g} million"
            axes.plot(
                phase,
                1e6 * (closed - np.mean(error)),
                color=color,
                label=label if len(records) == 1 else record_label(record),
            )
    axes.set(xlabel="Phase (mesh cycles)", ylabel="Loaded error less its mean (µm)")


def _errors(records: Sequence[Record], _view: View) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    panels = figure.subplots(2, 1)
    draw_errors(panels[0], records)
    _legend(panels[0], records)
    _over_revolutions(panels[1], records, "transmission_error_peak_to_peak", 1e6, "Peak to peak (µm)")
    mark_panel(panels[0], "a", "Transmission error under load over the mesh cycle, from new to worn")
    mark_panel(panels[1], "b", "Its peak to peak")
    return _titled(figure, records)


def _history(records: Sequence[Record], _view: View) -> Figure:
    shown = [column for column in _HISTORY if all(column[0] in record for record in records)]
    figure = new_figure(WIDTH, (len(shown) + 1) // 2 * PANEL_HEIGHT)
    panels = figure.subplots((len(shown) + 1) // 2, 2, sharex=True, squeeze=False).ravel()
    for axes in panels[len(shown) :]:
        axes.remove()
    for letter, axes, (name, factor, label, title) in zip("abcdef", panels, shown, strict=False):
        _over_revolutions(axes, records, name, factor, label)
        mark_panel(axes, letter, title)
    panels[0].legend(fontsize=6.5)
    return _titled(figure, records)


_HISTORY = (
    ("worn_mass", 1e6, "Mass (mg)", "Mass worn off"),
    ("debris_rate", 3.6e9, "Debris (mg/h)", "Debris of both gears"),
    ("transmission_error_peak_to_peak", 1e6, "Peak to peak (µm)", "Transmission error under load"),
    ("hertz_pressure_max", 1e-6, "Pressure (MPa)", "Maximum Hertz pressure"),
    ("power_friction", 1.0, "Loss (W)", "Mean loss to friction"),
    ("film_min", 1e6, "Film (µm)", "Minimum film"),
)


def _overview(records: Sequence[Record], _view: View) -> Figure:
    record = records[0]
    figure = new_figure(11.0, 6.2)
    panels = figure.subplots(2, 3).ravel()
    for place in (0, 1):
        draw_over_roll(panels[place], [record], "worn_depth", 1e6, place)
        panels[place].set_ylabel("Depth worn off (µm)")
    _legend(panels[0], [record])
    draw_over_roll(panels[2], [record], "line_load", 1e-3)
    panels[2].set_ylabel("Line load (N/mm)")
    draw_errors(panels[3], [record])
    _over_revolutions(panels[4], [record], "transmission_error_peak_to_peak", 1e6, "Peak to peak (µm)")
    _over_revolutions(panels[5], [record], "worn_mass", 1e6, "Mass worn off (mg)")
    panels[5].legend()
    titles = (
        *(f"Flank of the {body}, from new to worn" for body in BODIES),
        "Line load of a pair along its path",
        "Transmission error under load",
        "Its peak to peak",
        "Mass worn off",
    )
    for letter, axes, title in zip("abcdef", panels, titles, strict=True):
        mark_panel(axes, letter, title)
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=11)
    return figure


def _titled(figure: Figure, records: Sequence[Record]) -> Figure:
    figure.align_ylabels()
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure


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
