"""What varies along the face: line load and Hertz pressure as maps over roll angle and face width."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.panel import record_label, record_title
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.load_contact.rolled import at_pitch_point, face_edges, face_map

# Spread over the face, of the maximum value, below which no place on it is marked.
_EVEN = 1e-6


class OverFace(NamedTuple):
    """A quantity over the face and how engineers read it: dataset, factor from SI, label, title of a map.

    `worst` finds the value that a cross marks; `top` is the percentile of the values at the scale's top;
    `explained` says what is drawn into a map.
    """

    dataset: str
    factor: float
    label: str
    title: str
    worst: Any = np.nanargmax
    top: float = 100.0
    explained: str = "Cross: maximum.  Dotted line: pitch point.  Dark: no load."


LINE_LOAD = OverFace("line_load", 1e-3, "Line load (N/mm)", "Line load of one pair from entry to exit")
PRESSURE = OverFace(
    "hertz_pressure", 1e-9, "Hertz pressure (GPa)", "Hertz pressure of one pair from entry to exit"
)
FILM = OverFace(
    "central_film_thickness",
    1e6,
    "Film thickness (µm)",
    "Film of one pair from entry to exit",
    np.nanargmin,
    98.0,
    "Cross: minimum.  Dotted line: pitch point.  Blank: no load.",
)


def draw_map(axes: Axes, records: Sequence[Record], record: Record, quantity: OverFace) -> Any:
    """Draw a quantity of one pair over roll angle and face, coloured on a scale for all the records.

    A cross marks the worst value, unless it is the same all along the face.
    """
    tops = [np.nanpercentile(one[quantity.dataset], quantity.top) for one in records]
    top = float(max(tops)) * quantity.factor
    face_values = face_map(record, quantity.dataset)
    roll, values = np.degrees(face_values.roll), face_values.values * quantity.factor
    across = face_values.face * 1e3
    edges = face_edges(record)[[0, -1]] * 1e3
    # to the edges of the face with the values of the outermost slices
    mesh = axes.pcolormesh(
        roll,
        np.concatenate([edges[:1], across, edges[1:]]),
        np.ma.masked_invalid(np.concatenate([values[:, :1], values, values[:, -1:]], axis=1).T),
        vmin=0.0,
        vmax=top,
        cmap="viridis",
        shading="gouraud",
        rasterized=True,
    )
    at = np.unravel_index(quantity.worst(values), values.shape)
    if np.nanmax(values[at[0]]) - np.nanmin(values[at[0]]) > _EVEN * top:
        for color, width in (("white", 2.4), (INK, 1.0)):
            place = roll[at[0]], face_values.face[at[1]] * 1e3
            axes.plot(*place, "x", color=color, markersize=6, markeredgewidth=width)
    axes.axvline(0.0, color="white", linewidth=0.7, linestyle=":")
    axes.grid(visible=False)
    axes.margins(0)
    axes.set_xlabel("Roll angle from the pitch point (°)")
    axes.set_ylabel("Place on the face (mm)")
    if len(records) == 1:
        bar = axes.figure.colorbar(mesh, ax=axes, label=quantity.label, pad=0.02)
        bar.outline.set_visible(False)
    return mesh


def draw_across_face(axes: Axes, record: Record, quantity: OverFace, color: str) -> None:
    """Draw a quantity over the face where a pair is at the pitch point, each slice as a step."""
    values = at_pitch_point(record, quantity.dataset) * quantity.factor
    axes.stairs(values, face_edges(record) * 1e3, baseline=None, color=color, label=record_label(record))
    axes.set_xlabel("Place on the face, from its middle (mm)")
    axes.set_ylabel(quantity.label)


def _columns(maps: int) -> int:
    """Maps beside each other: up to three, four in a square."""
    return 2 if maps == 4 else min(maps, 3)


def line_load_figure(records: Sequence[Record]) -> Figure:
    """Draw maps of the line load, and below them its course over the face at the pitch point."""
    rows = -(-len(records) // _columns(len(records)))
    drawn = new_figure(WIDTH, (rows + 1) * PANEL_HEIGHT + 0.4)
    parts: Any = drawn.subfigures(2, 1, height_ratios=[rows, 1])
    upper, lower = parts
    _maps(upper, records, LINE_LOAD)
    below = lower.subplots()
    for number, record in enumerate(records):
        draw_across_face(below, record, LINE_LOAD, PALETTE[number % len(PALETTE)])
    below.set_ylim(bottom=0)
    mark_panel(below, "abcdefgh"[len(records)], "Line load over the face, the pair at the pitch point")
    if len(records) > 1:
        below.legend(loc="lower center", ncols=min(3, len(records)))
    _head(drawn, records, LINE_LOAD)
    return drawn


def face_map_figure(records: Sequence[Record], quantity: OverFace) -> Figure:
    """Draw maps of a quantity, on one scale."""
    rows = -(-len(records) // _columns(len(records)))
    drawn = new_figure(WIDTH, rows * PANEL_HEIGHT + 0.6)
    _maps(drawn, records, quantity)
    _head(drawn, records, quantity)
    return drawn


def _head(drawn: Figure, records: Sequence[Record], quantity: OverFace) -> None:
    about = f"{quantity.title}." if len(records) > 1 else record_title(records[0])
    drawn.suptitle(f"{about}\n{quantity.explained}", x=0.01, ha="left", fontsize=9)


def _maps(part: Any, records: Sequence[Record], quantity: OverFace) -> None:
    """Fill a figure or a part of one with one map per record."""
    columns = _columns(len(records))
    rows = -(-len(records) // columns)
    grid = part.subplots(rows, columns, squeeze=False, sharey=True, sharex=True)
    for axes in grid.ravel()[len(records) :]:
        axes.remove()
    mesh = None
    for number, (axes, record) in enumerate(zip(grid.ravel(), records, strict=False)):
        mesh = draw_map(axes, records, record, quantity)
        mark_panel(axes, "abcdefgh"[number], quantity.title if len(records) == 1 else record_label(record))
        if number % columns:
            axes.set_ylabel("")
        if columns > 2:
            axes.set_xlabel("Roll angle (°)")
        below = number + columns < len(records)
        axes.tick_params(labelbottom=not below)
        if below:
            axes.set_xlabel("")
    if len(records) > 1:
        bar = part.colorbar(mesh, ax=list(grid.ravel()[: len(records)]), label=quantity.label, pad=0.02)
        bar.outline.set_visible(False)
