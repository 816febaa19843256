"""Records of load contact as curves over phase or roll angle, and as maps over roll angle and face."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.numerics.shapes import Array, Float
from tribodyn.post.figures.panel import record_label, record_title
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record


class FaceMap(NamedTuple):
    """A quantity of one pair over its roll angle and the face."""

    #: (positions,); roll angle of the pair, 0 at the pitch point, increasing, rad
    roll: Float[Array, " position"]
    face: Float[Array, " slice"]  # (slices,); middles of the slices from the middle of the face, m
    values: Float[Array, "position slice"]  # (positions, slices)

    def to_edges(self, record: Record) -> tuple[Float[Array, " place"], Float[Array, "position place"]]:
        """Places and values to the edges of the face, with the values of the outermost slices there."""
        first, *_, last = face_edges(record)
        return np.array([first, *self.face, last]), np.pad(self.values, ((0, 0), (1, 1)), mode="edge")


def over_phase(record: Record, name: str) -> tuple[Float[Array, " position"], Float[Array, "position ..."]]:
    """Give phase and a quantity over it; a study of a single mesh cycle is given twice, for it repeats."""
    phase, values = record["phase"], record[name]
    period = _cycles(record)
    copies = 2 if period == 1 else 1
    x = np.concatenate([phase + copy * period for copy in range(copies)] + [[copies * period]])
    return x, np.concatenate([values] * copies + [values[:1]])


def pair_over_phase(
    record: Record, name: str, pair: int
) -> tuple[Float[Array, " position"], Float[Array, " position"]]:
    """Give a pair's quantity over the phase as `over_phase` does, broken where the number passes on.

    At the end of a cycle the teeth that were pair 1 become pair 0: a piece's last point is taken there.
    """
    x, values = over_phase(record, name)
    slot = record.pairs.index(pair)
    older = values[:, slot - 1] if slot > 0 else np.full(len(x), np.nan)
    begins = np.flatnonzero(np.diff(np.floor(x + 1e-9), prepend=-1.0))
    pieces_x, pieces_y = [], []
    for start, end in pairwise(begins):
        pieces_x += [x[start : end + 1], [np.nan]]
        pieces_y += [values[start:end, slot], [older[end], np.nan]]
    return np.concatenate(pieces_x), np.concatenate(pieces_y)


def over_roll(
    record: Record, values: Float[Array, "sample pair ..."]
) -> tuple[Float[Array, " position"], Float[Array, "position ..."]]:
    """Give roll angle (rad, increasing) and values (…) of one pair through its life, of (phase, pair, …).

    In a study of one cycle all pairs are alike, and each number covers another part of it. Where teeth differ
    and there are cycles enough, it is the first pair whose beginning is recorded.
    """
    cycle = np.floor(record["phase"] + 1e-9).astype(int)
    pairs = len(record.pairs)
    enough = _cycles(record) >= pairs
    parts = [(np.flatnonzero(cycle == (pairs - 1 - slot if enough else 0)), slot) for slot in range(pairs)]
    roll = np.concatenate([record["roll_angle"][rows, slot] for rows, slot in parts])
    order = np.argsort(roll, kind="stable")
    return roll[order], np.concatenate([values[rows, slot] for rows, slot in parts])[order]


def face_map(record: Record, name: str) -> FaceMap:
    """Give a quantity over (phase, pair, slice) as a map of one pair, where the pair carries load."""
    roll, load = over_roll(record, record["normal_load"])
    _, values = over_roll(record, record[name])
    carrying = np.flatnonzero(load > 0.0)
    part = slice(max(carrying[0] - 1, 0), carrying[-1] + 2) if carrying.size else slice(None)
    return FaceMap(roll[part], record["slice"], values[part])


def face_edges(record: Record) -> Float[Array, " edge"]:
    """Edges of the slices (slices + 1,), m from the middle of the face."""
    width = float(record.mesh_cycle["face_width"])
    return np.linspace(-width / 2, width / 2, len(record["slice"]) + 1)


def late(record: Record) -> float:
    """Pinion angle by which places along the face are late, rad/m; 0 of spur gears."""
    numbers = record.mesh_cycle
    return float(numbers.get("pitch_slope", 0.0)) / float(numbers["pinion_pitch_radius"])


def at_pitch_point(record: Record, name: str) -> Float[Array, " slice"]:
    """Give a quantity over the face (slices,) where a pair is nearest to the pitch point."""
    roll = np.abs(record["roll_angle"])
    position, pair = np.unravel_index(np.argmin(roll), roll.shape)
    return record[name][position, pair]


def _cycles(record: Record) -> int:
    """Mesh cycles in the record."""
    return max(1, int(np.floor(record["phase"][-1] + 1e-9)) + 1)


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
    tops = [np.nanpercentile(other[quantity.dataset], quantity.top) for other in records]
    top = float(max(tops)) * quantity.factor
    face_values = face_map(record, quantity.dataset)
    roll, values = np.degrees(face_values.roll), face_values.values * quantity.factor
    across, shown = face_values.to_edges(record)
    mesh = axes.pcolormesh(
        roll,
        across * 1e3,
        np.ma.masked_invalid(shown.T * quantity.factor),
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
    pitch_line = np.degrees(late(record) * across)
    axes.plot(pitch_line, across * 1e3, color="white", linewidth=0.7, linestyle=":", scalex=False)
    axes.grid(visible=False)
    axes.margins(0)
    axes.set_xlabel("Roll angle from the pitch point (°)")
    axes.set_ylabel("Place on the face (mm)")
    if len(records) == 1:
        bar = axes.figure.colorbar(mesh, ax=axes, label=quantity.label, pad=0.02)
        bar.outline.set_visible(False)
    return mesh


def _grid(maps: int) -> tuple[int, int]:
    """Rows and columns of maps: up to three beside each other, four in a square."""
    columns = 2 if maps == 4 else min(maps, 3)
    return -(-maps // columns), columns


def line_load_figure(records: Sequence[Record]) -> Figure:
    """Draw maps of the line load, and below them its course over the face at the pitch point."""
    rows, _ = _grid(len(records))
    figure = new_figure(WIDTH, (rows + 1) * PANEL_HEIGHT + 0.4)
    parts: Any = figure.subfigures(2, 1, height_ratios=[rows, 1])
    upper, lower = parts
    _maps(upper, records, LINE_LOAD)
    below = lower.subplots()
    for number, record in enumerate(records):
        values, color = at_pitch_point(record, LINE_LOAD.dataset), PALETTE[number % len(PALETTE)]
        edges, label = face_edges(record) * 1e3, record_label(record)
        below.stairs(values * LINE_LOAD.factor, edges, baseline=None, color=color, label=label)
    below.set(xlabel="Place on the face, from its middle (mm)", ylabel=LINE_LOAD.label)
    below.set_ylim(bottom=0)
    mark_panel(below, "abcdefgh"[len(records)], "Line load over the face, the pair at the pitch point")
    if len(records) > 1:
        below.legend(loc="lower center", ncols=min(3, len(records)))
    _head(figure, records, LINE_LOAD)
    return figure


def face_map_figure(records: Sequence[Record], quantity: OverFace) -> Figure:
    """Draw maps of a quantity, on one scale."""
    figure = new_figure(WIDTH, _grid(len(records))[0] * PANEL_HEIGHT + 0.6)
    _maps(figure, records, quantity)
    _head(figure, records, quantity)
    return figure


def _head(figure: Figure, records: Sequence[Record], quantity: OverFace) -> None:
    about = f"{quantity.title}." if len(records) > 1 else record_title(records[0])
    figure.suptitle(f"{about}\n{quantity.explained}", x=0.01, ha="left", fontsize=9)


def _maps(part: Any, records: Sequence[Record], quantity: OverFace) -> None:
    """Fill a figure or a part of one with one map per record."""
    rows, columns = _grid(len(records))
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
