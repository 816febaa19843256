"""Both gears in mesh, with tip circles, path of contact and its key points."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.style import PALETTE, QUIET, WIDTH, new_figure
from tribodyn.record.reader import Record

PINION_FILL, GEAR_FILL = "#dcebf5", "#f6e6da"
MILLIMETRE = 1e-3


def key_positions(record: Record) -> dict[str, tuple[float, float]]:
    """Find B_g, C_p, P, C_g, B_p on the path, m; C_p and C_g only where one and two pairs alternate."""
    table = record.mesh_cycle
    pitch = 2 * np.pi / table["pinion_teeth"]
    start, end = table["roll_start"], table["roll_end"]
    rolls = {"B_g": start, "P": 0.0, "B_p": end}
    if 1 < table["contact_ratio"] < 2:
        rolls |= {"C_p": end - pitch, "C_g": start + pitch}
    return {
        name: contact_position(record, roll) for name, roll in sorted(rolls.items(), key=lambda item: item[1])
    }


def contact_position(record: Record, roll: float) -> tuple[float, float]:
    """Find the point of contact of a pair of driving flanks at a roll angle (0 at the pitch point), m."""
    table = record.mesh_cycle
    pitch = 2 * np.pi / table["pinion_teeth"]
    fronts = int(np.sum(table["side"] > 0))
    rolls, distances, angles = [], [], []
    for slot in range(fronts):
        touching = table["in_contact"][:, slot] > 0
        rolls.append(table["roll_start"] + (table["phase"][touching] + fronts - 1 - slot) * pitch)
        distances.append(table["signed_distance"][touching, slot])
        angles.append(table["pressure_angle"][touching, slot])
    rolls = np.concatenate(rolls)
    order = np.argsort(rolls, kind="stable")
    distance = np.interp(roll, rolls[order], np.concatenate(distances)[order])
    angle = np.interp(roll, rolls[order], np.concatenate(angles)[order])
    return float(distance * np.cos(angle)), float(distance * np.sin(angle))


def gears_in_mesh(record: Record, phase: float) -> tuple[np.ndarray, np.ndarray]:
    """Place the outlines of pinion and gear at a phase of the mesh, (points, 2) from the pitch point, m.

    The record holds them as they stand while a pair touches at the pitch point, each about its own axis;
    the pinion turns clockwise, the gear counter-clockwise.
    """
    table, geometry = record.mesh_cycle, record.geometry
    radii = table["pinion_pitch_radius"], table["gear_pitch_radius"]
    roll = table["roll_start"] + phase * 2 * np.pi / table["pinion_teeth"]
    pinion = _turn(geometry["pinion_outline"], -roll) - np.array([0.0, radii[0]])
    gear = _turn(geometry["gear_outline"], roll * radii[0] / radii[1]) + np.array([0.0, radii[1]])
    return pinion, gear


def _turn(points: np.ndarray, angle: float) -> np.ndarray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return points @ np.array([[cosine, sine], [-sine, cosine]])


def draw_path(axes: Axes, record: Record, phase: float = 0.0) -> None:
    """Draw both gears at a phase, what bounds the path, and the path with its key points; axes in mm."""
    table, geometry = record.mesh_cycle, record.geometry
    path = geometry["path_of_contact"] / MILLIMETRE
    radii = table["pinion_pitch_radius"] / MILLIMETRE, table["gear_pitch_radius"] / MILLIMETRE
    pinion, gear = (outline / MILLIMETRE for outline in gears_in_mesh(record, phase))
    axes.fill(*pinion.T, facecolor=PINION_FILL, edgecolor=PALETTE[0], linewidth=0.9)
    axes.fill(*gear.T, facecolor=GEAR_FILL, edgecolor=PALETTE[1], linewidth=0.9)
    turn = np.linspace(0, 2 * np.pi, 1441)
    for sign, radius, name, color in zip((-1, 1), radii, ("pinion", "gear"), PALETTE, strict=False):
        tip = geometry[f"{name}_tip_radius"] / MILLIMETRE
        centre = sign * radius
        axes.plot(
            tip * np.cos(turn), centre + tip * np.sin(turn), color=color, linewidth=0.8, linestyle=(0, (5, 2))
        )
        axes.plot(
            radius * np.cos(turn), centre + radius * np.sin(turn), color=QUIET, linewidth=0.6, linestyle="-."
        )
    axes.plot(*path.T, color="black", linewidth=1.8)
    _name_points(axes, record)
    reach = 0.75 * float(np.ptp(path[:, 0])) + 1e-9
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-0.8 * reach, 0.8 * reach)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("Along the pitch tangent (mm)")
    axes.set_ylabel("Along the line of centres (mm)")
    axes.annotate("gear", (0.03, 0.95), xycoords="axes fraction", va="top", color=PALETTE[1])
    axes.annotate("pinion", (0.03, 0.05), xycoords="axes fraction", color=PALETTE[0])


def _name_points(axes: Axes, record: Record) -> None:
    for number, (name, position) in enumerate(key_positions(record).items()):
        place = position[0] / MILLIMETRE, position[1] / MILLIMETRE
        axes.plot(
            *place,
            marker="o",
            markersize=4,
            markerfacecolor="white",
            markeredgecolor="black",
            linestyle="none",
        )
        axes.annotate(
            f"${name}$",
            place,
            # to either side of the path in turn, because P and C_g may be close
            xytext=(-4, 9) if number % 2 == 0 else (5, -14),
            textcoords="offset points",
            ha="center",
            fontsize=8.5,
            bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.75},
        )


def path_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the drives side by side, at the moment a pair enters."""
    columns = min(len(records), 2)
    rows = -(-len(records) // columns)
    width = 0.8 * WIDTH if columns == 1 else 1.25 * WIDTH
    for record in records:
        if "pinion_outline" not in record.geometry:
            raise InputError("record", str(record.path), "holds no tooth outlines", "draw another figure")
    figure = new_figure(width, rows * (0.8 * (width / columns - 0.6) + 0.6))
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in grid[len(records) :]:
        axes.remove()
    for axes, record in zip(grid, records, strict=False):
        draw_path(axes, record)
        axes.set_title(
            record_label(record) if len(records) > 1 else record_title(record), loc="left", fontsize=9
        )
    return figure
