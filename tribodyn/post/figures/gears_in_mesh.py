"""Two gears in mesh as a picture: outlines, what bounds the path of contact, the path and its key points."""

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from tribodyn.post.page.motion import key_rolls as key_rolls
from tribodyn.post.style import PALETTE, QUIET

PINION_FILL, GEAR_FILL = "#dcebf5", "#f6e6da"
MILLIMETRE = 1e-3


class GearsInMesh(NamedTuple):
    """What the picture shows, m from the pitch point; x along the pitch tangent, y along the centres."""

    #: pinion, gear: closed outlines as they stand, (points, 2)
    pinion: np.ndarray
    gear: np.ndarray
    path: np.ndarray  # path of contact, (points, 2)
    #: pitch_radii, tip_radii: of pinion and gear; negative of an internal gear, whose outline is its hole
    pitch_radii: tuple[float, float]
    tip_radii: tuple[float, float]
    key_points: dict[str, tuple[float, float]]  # name, as mathematical text, -> (x, y)
    outside: tuple[float, float] = (0.0, 0.0)  # outer radii of pinion and gear where they are internal


def placed(
    pinion: np.ndarray, gear: np.ndarray, pitch_radii: tuple[float, float], roll: float
) -> tuple[np.ndarray, np.ndarray]:
    """Place the outlines of pinion and gear at a roll angle (rad) of the pinion, from the pitch point, m.

    They come as they stand while a pair touches at the pitch point, each about its own axis; the pinion turns
    clockwise, the gear counter-clockwise.
    """
    return (
        _turn(pinion, -roll) - np.array([0.0, pitch_radii[0]]),
        _turn(gear, roll * pitch_radii[0] / pitch_radii[1]) + np.array([0.0, pitch_radii[1]]),
    )


def _turn(points: np.ndarray, angle: float) -> np.ndarray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return points @ np.array([[cosine, sine], [-sine, cosine]])


def draw_gears(axes: Axes, mesh: GearsInMesh) -> None:
    """Draw both gears, tip and pitch circles, and the path with its key points; axes in mm about the path."""
    _draw_outlines(axes, mesh)
    path = mesh.path / MILLIMETRE
    axes.plot(*path.T, color="black", linewidth=1.8)
    _name_points(axes, mesh)
    across, along = reach(mesh)
    axes.set(xlim=(-across, across), ylim=(-along, along))
    axes.annotate("gear", (0.03, 0.95), xycoords="axes fraction", va="top", color=PALETTE[1])
    axes.annotate("pinion", (0.03, 0.05), xycoords="axes fraction", color=PALETTE[0])


def draw_whole(axes: Axes, mesh: GearsInMesh, bore_radii: tuple[float, float]) -> None:
    """Draw both gears whole, with bores and axes, and a frame round what `draw_gears` shows; axes in mm."""
    _draw_outlines(axes, mesh)
    axes.plot(*(mesh.path / MILLIMETRE).T, color="black", linewidth=1.2)
    for centre, bore, color in zip(_centres(mesh), bore_radii, PALETTE, strict=False):
        if bore >= 0:  # an internal gear has none
            circle = centre + bore / MILLIMETRE * _circle()
            axes.fill(*circle.T, facecolor="white", edgecolor=color, linewidth=0.9)
        axes.plot(*centre, marker="+", color=QUIET, markersize=7)
    across, along = reach(mesh)
    axes.plot(
        across * np.array([-1, 1, 1, -1, -1]),
        along * np.array([-1, -1, 1, 1, -1]),
        color="black",
        linewidth=0.8,
    )
    axes.margins(0.03)


def reach(mesh: GearsInMesh) -> tuple[float, float]:
    """Half width and half height of the part that `draw_gears` shows, mm."""
    path = mesh.path / MILLIMETRE
    x, y = np.abs(path).max(axis=0).tolist()
    across = max(0.75 * float(np.ptp(path[:, 0])), 1.1 * x, 1.6 * y) + 1e-9
    return across, 0.8 * across


def _draw_outlines(axes: Axes, mesh: GearsInMesh) -> None:
    outlines = (mesh.pinion, PINION_FILL), (mesh.gear, GEAR_FILL)
    for number, ((outline, fill), color) in enumerate(zip(outlines, PALETTE, strict=False)):
        # the circles below give the limits: to seek those of the outlines takes longer than to draw them
        if mesh.outside[number]:
            _draw_ring(axes, mesh, number, fill, color)
            continue
        axes.add_artist(Polygon(outline / MILLIMETRE, facecolor=fill, edgecolor=color, linewidth=0.9))
    sizes = zip(_centres(mesh), mesh.tip_radii, mesh.pitch_radii, PALETTE, strict=False)
    for centre, tip, pitch, color in sizes:
        circle = _circle()
        axes.plot(*(centre + tip / MILLIMETRE * circle).T, color=color, linewidth=0.8, linestyle=(0, (5, 2)))
        axes.plot(*(centre + pitch / MILLIMETRE * circle).T, color=QUIET, linewidth=0.6, linestyle="-.")
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set(xlabel="Along the pitch tangent (mm)", ylabel="Along the line of centres (mm)")


def _draw_ring(axes: Axes, mesh: GearsInMesh, number: int, fill: str, color: str) -> None:
    """Draw an internal gear: material from its hole to its outer circle."""
    outer = _centres(mesh)[number] + mesh.outside[number] / MILLIMETRE * _circle()
    hole = (mesh.pinion, mesh.gear)[number] / MILLIMETRE
    turns = np.sum(hole[:-1, 0] * hole[1:, 1] - hole[1:, 0] * hole[:-1, 1])
    material = np.concatenate([hole, outer[::-1] if turns > 0 else outer, hole[:1]])
    axes.add_artist(Polygon(material, facecolor=fill, edgecolor="none"))
    axes.add_artist(Polygon(hole, fill=False, edgecolor=color, linewidth=0.9))
    axes.plot(*outer.T, color=color, linewidth=0.9)


def _centres(mesh: GearsInMesh) -> np.ndarray:
    """Axes of pinion and gear, mm."""
    return np.array([[0.0, -mesh.pitch_radii[0]], [0.0, mesh.pitch_radii[1]]]) / MILLIMETRE


def _circle() -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 1441)
    return np.stack([np.cos(turn), np.sin(turn)], axis=1)


def _name_points(axes: Axes, mesh: GearsInMesh) -> None:
    last = len(mesh.key_points) - 2
    for number, (name, position) in enumerate(mesh.key_points.items()):
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
            # to either side of the path in turn and C_p and C_g apart: both may be close to P
            xytext=(-4, 9) if number % 2 == 0 else (9 if number == last else -4, -14),
            textcoords="offset points",
            ha="center",
            fontsize=8.5,
            bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.75},
        )
