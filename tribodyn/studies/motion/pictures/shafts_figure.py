"""Drawn shafts from the side: as drawn, and bent by the mean loads of the meshes."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from tribodyn.post.figures.gears_in_mesh import GEAR_FILL, MILLIMETRE, PINION_FILL
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.shaft_lines import rounded_down

#: Largest deflection as drawn, as a share of the height of the picture; length of the largest force.
_BENT, _ARROW = 0.06, 0.11
#: Room about the gears, as a share of the height; width of a bearing as drawn, as a share of its diameter.
_ROOM, _BEARING = 0.06, 0.3


def has_shafts(record: Record) -> bool:
    """Whether a record holds drawn shafts with the places of what they carry."""
    return "station_z" in record.geometry


def shafts_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the shafts of the first record in the plane of their axes, and the plane across it.

    Axes in the order of their places along the longest distance of two; beside each other.
    """
    record = records[0]
    figure = new_figure(WIDTH, 5.4)
    rows = figure.subplots(1, 2)
    along = _direction(record)
    across = np.array([-along[1], along[0]])
    magnified = [_draw(axes, record, along, seen) for axes, seen in zip(rows, (along, across), strict=True)]
    names = "Bent in the plane of the axes", "Bent across it"
    for letter, axes, name, times in zip("ab", rows, names, magnified, strict=True):
        title = f"{name}, deflection × {times:g}\narrows: forces on bearings"
        mark_panel(axes, letter, title)
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def _direction(record: Record) -> np.ndarray:
    """Direction from one axis to the one that is farthest from it; y where all are one."""
    centres = np.asarray(record.geometry["station_centre"])
    apart = centres - centres[0]
    far = apart[int(np.argmax(np.hypot(*apart.T)))]
    length = float(np.hypot(*far))
    return far / length if length > 0.0 else np.array([0.0, 1.0])


def _draw(axes: Axes, record: Record, along: np.ndarray, seen: np.ndarray) -> float:
    """Draw all in mm over z, deflections and forces in the direction `seen`; how far those are magnified."""
    from scipy.interpolate import CubicSpline  # heavy, and most gearboxes need none

    parts = record.geometry
    height = np.asarray(parts["station_centre"]) @ along / MILLIMETRE
    shaft = np.asarray(parts["station_shaft"], int)
    of_shaft = {number: float(height[shaft == number][0]) for number in dict.fromkeys(shaft.tolist())}
    low, high = _gears(axes, record, along)
    for number, start, end, diameter in zip(
        *(parts[f"section_{name}"] for name in ("shaft", "start", "end", "diameter")), strict=True
    ):
        _box(axes, start, end, of_shaft[int(number)], diameter, "#d9d9d9", QUIET)
        low = min(low, of_shaft[int(number)] - diameter / 2.0 / MILLIMETRE)
        high = max(high, of_shaft[int(number)] + diameter / 2.0 / MILLIMETRE)
    moved = np.asarray(parts["station_moved"]) @ seen
    largest = float(np.max(np.abs(moved)))
    times = rounded_down(_BENT * (high - low) * MILLIMETRE / largest) if largest > 0.0 else 1.0
    for number, middle in of_shaft.items():
        own = shaft == number
        z, bent = np.asarray(parts["station_z"])[own], moved[own]
        axes.axhline(middle, color=QUIET, linewidth=0.4, linestyle="-.")
        over = np.linspace(z[0], z[-1], 101)
        curve = CubicSpline(z, bent)(over) if len(z) > 2 else np.interp(over, z, bent)
        axes.plot(over / MILLIMETRE, middle + times * curve / MILLIMETRE, color="#cc0000", linewidth=1.6)
        held = np.isin(z, np.concatenate([parts["carried_z"], parts["seat_z"]]))
        marks = middle + times * bent[held] / MILLIMETRE
        axes.plot(z[held] / MILLIMETRE, marks, ".", color="#cc0000", markersize=4)
    _forces(axes, record, seen, of_shaft, _ARROW * (high - low))
    z = np.concatenate([parts["section_start"], parts["section_end"]]) / MILLIMETRE
    room = _ROOM * max(high - low, float(np.ptp(z)))
    axes.set_xlim(float(np.min(z)) - room, float(np.max(z)) + room)
    axes.set_ylim(low - room, high + room)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("z (mm)")
    axes.set_ylabel("from the first axis (mm)")
    return times


def _gears(axes: Axes, record: Record, along: np.ndarray) -> tuple[float, float]:
    """Draw gears as boxes of their outsides, name what shafts carry; lowest and highest place, mm."""
    from tribodyn.studies.motion.drivetrain.gear_positions import gear_outlines

    parts, low, high = record.geometry, np.inf, -np.inf
    places = dict(zip(np.asarray(parts["carried_body"], int).tolist(), parts["carried_z"], strict=True))
    toothed = set()
    for gear in gear_outlines(record):
        if gear.body not in places:
            continue
        toothed.add(gear.body)
        middle = float(parts["centre"][gear.body] @ along) / MILLIMETRE
        width, z = float(parts["face_width"][gear.number]), float(places[gear.body])
        first = parts["sense"][gear.body] == parts["sense"][0]
        fill, edge = (PINION_FILL, PALETTE[0]) if first else (GEAR_FILL, PALETTE[1])
        _box(axes, z - width / 2.0, z + width / 2.0, middle, 2.0 * gear.outside, f"{fill}b0", edge)
        radius = gear.outside / MILLIMETRE
        low, high = min(low, middle - radius), max(high, middle + radius)
        _name(axes, z, middle + radius, gear.name)
    for body, z in places.items():
        if body not in toothed:
            middle = float(parts["centre"][body] @ along) / MILLIMETRE
            axes.plot(z / MILLIMETRE, middle, marker="D", color=INK, markersize=4)
            _name(axes, z, middle, str(record["body"][body]), 8.0)
    return low, high


def _forces(axes: Axes, record: Record, seen: np.ndarray, of_shaft: dict[int, float], longest: float) -> None:
    """Draw bearings as crosses on their shafts and the forces on them as arrows."""
    parts = record.geometry
    forces = np.asarray(parts["seat_force"])[:, :2] @ seen
    most = max(float(np.max(np.abs(forces))), 1e-300)
    for number, z, force in zip(parts["seat_shaft"], parts["seat_z"], forces, strict=True):
        middle, at = of_shaft[int(number)], float(z) / MILLIMETRE
        inside = (
            (parts["section_shaft"] == number) & (parts["section_start"] <= z) & (z <= parts["section_end"])
        )
        diameter = float(np.max(parts["section_diameter"][inside])) / MILLIMETRE
        for side in (-1.0, 1.0):
            corner = at - _BEARING * diameter / 2.0, middle + side * diameter * 0.7 - diameter * 0.2
            axes.add_patch(
                Rectangle(
                    corner, _BEARING * diameter, 0.4 * diameter, fill=False, edgecolor=INK, linewidth=0.7
                )
            )
        tip = middle + longest * force / most
        arrow = {"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (at, tip), (at, middle), arrowprops=arrow)
        side = 1.0 if force >= 0.0 else -1.0
        axes.annotate(
            f"{abs(force) / 1e3:.3g} kN",
            (at, tip),
            (0, 5 * side),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=6,
        )


def _box(axes: Axes, start: float, end: float, middle: float, height: float, fill: str, edge: str) -> None:
    corner = start / MILLIMETRE, middle - height / 2.0 / MILLIMETRE
    size = (end - start) / MILLIMETRE, height / MILLIMETRE
    axes.add_patch(Rectangle(corner, *size, facecolor=fill, edgecolor=edge, linewidth=0.6))


def _name(axes: Axes, z: float, at: float, name: str, up: float = 4.0) -> None:
    axes.annotate(
        literal(name),
        (z / MILLIMETRE, at),
        (0, up),
        textcoords="offset points",
        ha="center",
        va="center",
        fontsize=6,
        color=INK,
    )
