"""Figures 7 and 9 to 12 of Jia et al.: paths of contact, teeth and rack-cutters over k1 and k2."""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.compliance.sharing.flank_gap import along_face
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.body import rack_outline, tooth_outline
from tribodyn.geometry.drive import SIDES, Side
from tribodyn.geometry.families import family
from tribodyn.geometry.path import position
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.papers.jia import CROWNED, modified

#: Coefficients drawn: from the smallest to below the largest without undercut, the paper's 0.32 among them.
COEFFICIENTS = (0.2, 0.26, 0.32, 0.38, 0.44)
#: The paper's own.
CHOSEN = 0.32
MM = 1e3
#: Relief is drawn so many times as large as it is: at its own size, 8 µm of 25 mm, it would not be seen.
EXAGGERATED = 40.0


def gears(k1: float = CHOSEN, k2: float = CHOSEN) -> Assembly:
    """Return the paper's parabolic gears with other coefficients."""
    case = load_scenario("jia-parabolic-17-29", {"drive.shape.k1": k1, "drive.shape.k2": k2}).pair
    return assemble(family(case.family), case.drive)


def half_tooth(assembly: Assembly, side: Side) -> np.ndarray:
    """Half a tooth from the root circle to the tip: across and up from the pitch circle, (points, 2), m."""
    tooth = assembly.tooth(side)
    shape = tooth_outline(tooth)
    across = np.concatenate([shape.fillet_y, shape.flank_y[1:]])
    up = np.concatenate([shape.fillet_x, shape.flank_x[1:]]) - float(tooth.path.pinion_pitch_radius)
    return np.stack([across, up], axis=-1)


def rack_profile(assembly: Assembly, side: Side) -> np.ndarray:
    """One pitch of a rack-cutter, (points, 2), m; the gear's as it stands against the pinion's."""
    rack = rack_outline(assembly, side)
    sense = 1.0 if side == "pinion" else -1.0
    return np.stack([sense * rack.x, sense * rack.y], axis=-1)


def _colours() -> np.ndarray:
    return colormaps["viridis"](np.linspace(0.0, 0.88, len(COEFFICIENTS)))


def paths(_: Path) -> Figure:
    """Path of contact for the coefficients: k1 in the first quadrant, k2 in the third."""
    figure = new_figure(WIDTH, 0.95 * PANEL_HEIGHT)
    axes = figure.subplots()
    for colour, k in zip(_colours(), COEFFICIENTS, strict=True):
        pair = gears(k, k)
        path = pair.path
        along = path.signed_distance(np.linspace(*pair.roll_limits, 201))
        axes.plot(*(MM * np.stack(position(path, along))), color=colour, label=f"$k_1 = k_2$ = {k:g}")
    for line in (axes.axhline, axes.axvline):
        line(0.0, color="k", linewidth=0.6)
    axes.set_aspect("equal")
    axes.set_xlabel("$x_f$ (mm)")
    axes.set_ylabel("$y_f$ (mm)")
    figure.legend(loc="outside lower center", ncols=len(COEFFICIENTS))
    return figure


def teeth(name: str, _: Path) -> Figure:
    """Teeth of pinion and gear for values of one coefficient, the other at 0.32."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 1.2)
    panels = figure.subplots(1, 2, sharey=True, sharex=True)
    for colour, k in zip(_colours(), COEFFICIENTS, strict=True):
        pair = gears(**{name: k})
        for axes, side in zip(panels, SIDES, strict=True):
            _draw_tooth(axes, half_tooth(pair, side), color=colour, label=f"${name[0]}_{name[1]}$ = {k:g}")
    for letter, axes, side in zip("ab", panels, SIDES, strict=True):
        axes.axhline(0.0, color="k", linewidth=0.6, linestyle="-.")
        axes.set_aspect("equal")
        axes.set_xlabel("Across the tooth (mm)")
        mark_panel(axes, letter, side)
    panels[0].set_ylabel("Above the pitch circle (mm)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(COEFFICIENTS))
    return figure


def _draw_tooth(axes: Axes, half: np.ndarray, **style: Any) -> None:
    across, up = MM * half.T
    axes.plot(np.concatenate([across, -across[::-1]]), np.concatenate([up, up[::-1]]), **style)


def racks(_: Path) -> Figure:
    """Rack-cutters of pinion and gear, k1 = k2 = 0.32, as they fit into each other."""
    pair = gears()
    pitch = MM * rack_outline(pair, "pinion").pitch
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    axes = figure.subplots()
    # against the pinion's the gear's stands half a pitch further on
    for side, first, colour, style in zip(SIDES, (-1.0, -1.5), PALETTE, ("-", "--"), strict=False):
        across, up = MM * rack_profile(pair, side).T
        for number in range(4):
            label = "" if number else f"rack-cutter of the {side}"
            place = across + (first + number) * pitch
            axes.plot(place, up, color=colour, linestyle=style, label=label)
    axes.axhline(0.0, color="k", linewidth=0.6, linestyle="-.")
    axes.set_aspect("equal")
    axes.set_xlim(-1.25 * pitch, 1.25 * pitch)
    axes.set_xlabel("Along the pitch line (mm)")
    axes.set_ylabel("From the pitch line (mm)")
    figure.legend(loc="outside lower center", ncols=2)
    return figure


def relieved_teeth(_: Path) -> Figure:
    """Three teeth of the modified pinion as a grid, the relief of its flanks exaggerated."""
    pair = gears()
    width, radius = float(pair.drive.pinion.face_width), float(pair.path.pinion_pitch_radius)
    place = np.linspace(-width / 2.0, width / 2.0, 26)
    half = half_tooth(pair, "pinion")[::4]
    missing = EXAGGERATED * along_face(modified(CROWNED).lead, width, place)
    # all of it from the form circle up, none at the root circle
    shares = np.interp(
        half[:, 1] + radius, [float(pair.pinion.root_radius), float(pair.pinion.form_radius)], [0, 1]
    )
    across = half[:, :1] - shares[:, None] * missing
    up = np.repeat(half[:, 1:], place.size, axis=1) + radius
    across = np.concatenate([across, np.linspace(1.0, -1.0, 7)[1:-1, None] * across[-1], -across[::-1]])
    up = np.concatenate([up, np.repeat(up[-1:], 5, axis=0), up[::-1]])
    figure = new_figure(WIDTH, 4.4)
    axes: Any = figure.add_subplot(projection="3d")
    for tooth in (-1, 0, 1):
        turn = 2.0 * np.pi / float(pair.drive.pinion.teeth) * tooth
        x, y = across * np.cos(turn) + up * np.sin(turn), up * np.cos(turn) - across * np.sin(turn) - radius
        grid = MM * np.stack([x, np.broadcast_to(place, x.shape), y])
        axes.plot_surface(
            *grid, rstride=1, cstride=1, color="white", edgecolor=PALETTE[0], linewidth=0.3, shade=False
        )
    axes.set_box_aspect((20, 25, 8))
    axes.view_init(elev=32, azim=-50)
    axes.set_xlabel("Across (mm)")
    axes.set_ylabel("Along the face (mm)")
    axes.set_zlabel("Above the\npitch circle (mm)")
    text = f"$y_1 = y_2$ = {CROWNED.relief:g} µm, $y_3$ = {CROWNED.unmodified:g} mm"
    figure.suptitle(
        f"Modified pinion, {text}; relief drawn {EXAGGERATED:g} times as large", x=0.01, ha="left", fontsize=9
    )
    return figure


FIGURES = {
    "figure-7": relieved_teeth,
    "figure-9": paths,
    "figure-10": partial(teeth, "k1"),
    "figure-11": partial(teeth, "k2"),
    "figure-12": racks,
}
