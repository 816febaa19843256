"""The train as a picture: its gears in their true positions, and the teeth in every mesh."""

from collections.abc import Sequence
from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path

from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures.gears_in_mesh import GEAR_FILL, MILLIMETRE, PINION_FILL
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.carried_sets import mesh_labels, place_of, sets_of
from tribodyn.studies.motion.drivetrain.gear_positions import (
    GearOutline,
    axes_of,
    contacts,
    gear_outlines,
    gear_poses,
    mesh_reach,
    mesh_turns,
)

#: Fill and edge of bodies that turn as the first one does, and of those that turn the other way.
_COLORS = {True: (PINION_FILL, PALETTE[0]), False: (GEAR_FILL, PALETTE[1])}
#: Length of the arrow of the largest load, as a share of half the height of the picture of a mesh.
_ARROW = 0.55
#: Meshes beside each other, and the most that have a picture of their own.
_ACROSS, _MOST = 3, 12


def draw_train(axes: Axes, record: Record, sample: int, mesh: int | None = None) -> None:
    """Draw all gears at a sample, outlines and pitch circles, with the names of the bodies at their axes.

    Of a `mesh` its two gears, without names. Axes in mm of the train's x and y; planes of a train with
    planetary sets stand beside each other.
    """
    of_mesh = (
        {int(place_of(record, f"{end}_gear", mesh)) for end in ("driver", "driven")}
        if mesh is not None
        else set()
    )
    stand, sense = gear_poses(record)[:, sample], record.geometry["sense"]
    reach = np.full((2, 2), np.nan)
    for gear in gear_outlines(record):
        if of_mesh and gear.number not in of_mesh:
            continue
        x, y, turned = stand[gear.number]
        fill, edge = _COLORS[bool(sense[gear.body] == sense[0])]
        area = PathPatch(_material(gear, x, y, turned), facecolor=f"{fill}b0", edgecolor=edge, linewidth=0.6)
        axes.add_artist(area)
        centre = x / MILLIMETRE, y / MILLIMETRE
        circle = Circle(centre, abs(gear.pitch_radius) / MILLIMETRE, fill=False, edgecolor=QUIET)
        circle.set(linewidth=0.5, linestyle="-.")
        axes.add_artist(circle)
        ends = np.array([[-1.0], [1.0]]) * gear.outside + (x, y)
        reach = np.array([np.fmin(reach[0], ends[0]), np.fmax(reach[1], ends[1])])
    (left, low), (right, high) = reach / MILLIMETRE
    room = 0.03 * max(right - left, high - low)
    axes.set_xlim(left - room, right + room)
    axes.set_ylim(low - room, high + room)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    if mesh is None:
        _draw_carriers(axes, record, sample)
        _name_axes(axes, record, sample)


def _material(gear: GearOutline, x: float, y: float, turned: float) -> Path:
    """Area of a gear as it stands, mm: between lines that run round it in opposite senses."""
    cosine, sine = np.cos(turned), np.sin(turned)
    about = np.array([[cosine, sine], [-sine, cosine]])
    lines = [
        line[::-1] if _area(line) * (-1) ** number < 0.0 else line for number, line in enumerate(gear.edges)
    ]
    return Path.make_compound_path(
        *(Path((line @ about + (x, y)) / MILLIMETRE, closed=True) for line in lines)
    )


def _area(line: np.ndarray) -> float:
    """Twice the area in a closed line, positive where it runs counter-clockwise."""
    return float(np.sum(line[:-1, 0] * line[1:, 1] - line[1:, 0] * line[:-1, 1]))


def _draw_carriers(axes: Axes, record: Record, sample: int) -> None:
    """Draw the carrier of every planetary set as lines from its axis to its planets."""
    places = axes_of(record, sample) / MILLIMETRE
    for gearset in sets_of(record):
        for planet in gearset.planets:
            line = places[[gearset.carrier, planet]]
            axes.plot(*line.T, color=QUIET, linewidth=2.2, solid_capstyle="round")


def _name_axes(axes: Axes, record: Record, sample: int) -> None:
    """Write the names of the bodies at their axes, those of one axis in one plane on lines of their own."""
    of_axis: dict[tuple[float, ...], list[str]] = {}
    planets = {planet for gearset in sets_of(record) for planet in gearset.planets}
    for body, centre in enumerate(axes_of(record, sample)):
        name = str(record["body"][body])
        name = name.rpartition("-")[2] if body in planets else name
        of_axis.setdefault(tuple(np.round(centre, 6)), []).append(literal(name))
    for (x, y), names in of_axis.items():
        box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
        place = x / MILLIMETRE, y / MILLIMETRE
        axes.annotate("\n".join(names), place, ha="center", va="center", fontsize=6, color=INK, bbox=box)


def draw_mesh(axes: Axes, record: Record, m: int, sample: int) -> None:
    """Draw the teeth in a mesh at a sample, with arrows for the loads on the driven gear."""
    draw_train(axes, record, sample, m)
    (x, y), reach = mesh_reach(record, m, float(mesh_turns(record, m)[sample]))
    places, load = contacts(record)[sample, m], record.over_meshes("normal_load")[:, m]
    for pair, (left, low, way) in enumerate(places):
        if not np.isfinite(left):
            continue
        length = _ARROW * reach * load[sample, pair] / np.nanmax(load)
        axes.annotate(
            "",
            ((left + length * np.cos(way)) / MILLIMETRE, (low + length * np.sin(way)) / MILLIMETRE),
            (left / MILLIMETRE, low / MILLIMETRE),
            arrowprops={"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0},
        )
        axes.plot(left / MILLIMETRE, low / MILLIMETRE, marker="o", markersize=3, color="black")
    axes.set_xlim((x - reach) / MILLIMETRE, (x + reach) / MILLIMETRE)
    axes.set_ylim((y - reach) / MILLIMETRE, (y + reach) / MILLIMETRE)


def train_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the first record's train where the part shown begins: whole, and the teeth in every mesh."""
    record = records[0]
    # of those that differ by their planet alone the first
    labels = mesh_labels(record)
    meshes = [m for m, label in enumerate(labels) if labels.index(label) == m][:_MOST]
    sample = last_cycles(record, view.cycles).part.start
    rows = ceil(len(meshes) / _ACROSS)
    columns = min(len(meshes), _ACROSS)
    panel_width = WIDTH / columns
    figure = new_figure(WIDTH, 3.2 + rows * min(panel_width, 3.0))
    grid = figure.add_gridspec(1 + rows, columns, height_ratios=[3.2, *[min(panel_width, 3.0)] * rows])
    whole = figure.add_subplot(grid[0, :])
    draw_train(whole, record, sample)
    mark_panel(whole, "a", "Train, drawn to scale\ncolours: sense of rotation; below: teeth and loads")
    for number, m in enumerate(meshes):
        axes = figure.add_subplot(grid[1 + number // columns, number % columns])
        draw_mesh(axes, record, m, sample)
        mark_panel(axes, chr(ord("b") + number), literal(record.meshes[m]))
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure
