"""Both gears in mesh, with tip circles, path of contact and its key points."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.post.cycles import along_path, outside_of, pair_history, path_limits
from tribodyn.post.figures.gears_in_mesh import GearsInMesh, draw_gears, key_rolls, placed
from tribodyn.post.figures.panel import ALONE, KEY_POINTS, View, record_label, record_title
from tribodyn.post.style import QUIET, WIDTH, new_figure
from tribodyn.record.reader import Record


def key_positions(record: Record) -> dict[str, tuple[float, float]]:
    """Find the key points of the path, m: where a pair of driving flanks touches at their roll angles."""
    table = record.mesh_cycle
    rolls = key_rolls(*path_limits(record), 2 * np.pi / table["pinion_teeth"])
    if "face_position" in table:  # nowhere does a pair of helical teeth carry alone because its middle does
        rolls = {name: roll for name, roll in rolls.items() if name not in ("C_p", "C_g")}
        *along, roll = along_path(record.geometry["path_of_contact"], table["pinion_pitch_radius"])
        histories = [(roll, values) for values in along]
    else:
        histories = [pair_history(record, name) for name in ("signed_distance", "pressure_angle")]
    distances, angles = (np.interp(list(rolls.values()), *history) for history in histories)
    places = zip((distances * np.cos(angles)).tolist(), (distances * np.sin(angles)).tolist(), strict=True)
    # the pitch point may lie beyond an end of an internal pair's path
    return dict(zip(rolls, places, strict=True)) | {"P": (0.0, 0.0)}


def gears_in_mesh(record: Record, phase: float) -> tuple[np.ndarray, np.ndarray]:
    """Place the outlines of pinion and gear at a phase of the mesh, (points, 2) from the pitch point, m.

    The record holds them as they stand while a pair touches at the pitch point, each about its own axis.
    """
    table, geometry = record.mesh_cycle, record.geometry
    roll = table["roll_start"] + phase * 2 * np.pi / table["pinion_teeth"]
    return placed(geometry["pinion_outline"], geometry["gear_outline"], _pitch_radii(record), roll)


def draw_path(axes: Axes, record: Record) -> None:
    """Draw both gears as a pair enters, what bounds the path, the path and its key points; axes in mm.

    Of helical gears in the middle of the face.
    """
    geometry = record.geometry
    table = record.mesh_cycle
    late = path_limits(record)[0] - table["roll_start"] if "face_position" in table else 0.0
    pinion, gear = gears_in_mesh(record, late * table["pinion_teeth"] / (2 * np.pi))
    tips = geometry["pinion_tip_radius"], geometry["gear_tip_radius"]
    path = geometry["path_of_contact"]
    points, outside = key_positions(record), outside_of(geometry)
    draw_gears(axes, GearsInMesh(pinion, gear, path, _pitch_radii(record), tips, points, outside))


def _pitch_radii(record: Record) -> tuple[float, float]:
    return record.mesh_cycle["pinion_pitch_radius"], record.mesh_cycle["gear_pitch_radius"]


def path_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the drives side by side, at the moment a pair enters."""
    columns = min(len(records), 2)
    rows = -(-len(records) // columns)
    width = 0.8 * WIDTH if columns == 1 else 1.25 * WIDTH
    for record in records:
        if "pinion_outline" not in record.geometry:
            raise record.refused("holds no tooth outlines", "draw another figure")
    figure = new_figure(width, rows * (0.8 * (width / columns - 0.6) + 0.6) + 0.5)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in grid[len(records) :]:
        axes.remove()
    for axes, record in zip(grid, records, strict=False):
        draw_path(axes, record)
        axes.set_title(
            record_label(record) if len(records) > 1 else record_title(record), loc="left", fontsize=9
        )
    shown = grid[: len(records)]
    across, along = (
        max(abs(end) for axes in shown for end in get(axes)) for get in (Axes.get_xlim, Axes.get_ylim)
    )
    for axes in shown:
        axes.set_xlim(-across, across)
        axes.set_ylim(-along, along)
    lines: tuple[tuple[str, Any, str], ...] = (
        ("black", "-", "path of contact"),
        (QUIET, (0, (5, 2)), "tip circles"),
        (QUIET, "-.", "pitch circles"),
    )
    names = {name for record in records for name in key_positions(record)}
    figure.legend(
        [Line2D([], [], color=color, linestyle=style) for color, style, _ in lines],
        [label for _, _, label in lines],
        loc="outside lower center",
        ncols=3,
        title=KEY_POINTS + ALONE * ("C_p" in names),
        title_fontsize=7.5,
    )
    return figure
