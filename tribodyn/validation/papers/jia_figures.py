"""Figures 7 and 9 to 21 of Jia et al.: paths, teeth and racks over k1 and k2, then loads and stresses.

Where the paper draws contact stress these show the maximum line load along the face, which its figures
behave like (docs/validation.md); Hertz pressures have a figure of their own.
"""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import at_pitch_point
from tribodyn.compliance.sharing.tooth_field import tooth_field
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.body import rack_outline, tooth_outline
from tribodyn.geometry.drive import SIDES, Side
from tribodyn.geometry.families import family
from tribodyn.geometry.flank_form import along_face
from tribodyn.geometry.path import position
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure, panel_title
from tribodyn.studies.load_contact import stress
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.papers.jia import (
    CROWNED,
    DRIVES,
    SLICES,
    FaceState,
    Name,
    elastic,
    modified,
    passage,
    rolled,
)

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
    axes.set(aspect="equal", xlabel="$x_f$ (mm)", ylabel="$y_f$ (mm)")
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
        axes.set(aspect="equal", xlabel="Across the tooth (mm)")
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
    axes.set(xlabel="Across (mm)", ylabel="Along the face (mm)", zlabel="Above the\npitch circle (mm)")
    text = f"$y_1 = y_2$ = {CROWNED.relief:g} µm, $y_3$ = {CROWNED.unmodified:g} mm"
    figure.suptitle(
        f"Modified pinion, {text}; relief drawn {EXAGGERATED:g} times as large", x=0.01, ha="left", fontsize=9
    )
    return figure


FACE = "From the middle of the face (mm)"
ROLL = "Pinion angle from the pitch point (°)"
#: Along the face of the pair at the pitch point, and of the `Passage` of a pair: label, and SI to its unit.
QUANTITIES = {
    "face": ("Line load (N/mm)", 1e-3),
    "line_load": ("Maximum line load (N/mm)", 1e-3),
    "pressure": ("Hertz pressure (GPa)", 1e-9),
    "compression": ("Root compression (MPa)", 1e-6),
    "tension": ("Root tension (MPa)", 1e-6),
}


class Panel(NamedTuple):
    """Curves of one drive, by their labels."""

    title: str
    drive: Name
    states: dict[str, FaceState]


RELIEVED = [
    Panel(
        f"parabolic, $y_3$ = {unmodified:g} mm",
        "parabolic",
        {f"$y_1 = y_2$ = {relief:g} µm": FaceState(relief, unmodified) for relief in (0.0, 4.0, 8.0, 12.0)},
    )
    for unmodified in (0.0, 8.0)
]
#: The four panels of figures 17 and 19 to 21.
MISALIGNED = [
    Panel(
        f"{drive}, {title}",
        drive,
        {f"{minutes:g}′": state._replace(misalignment=minutes) for minutes in (0.0, 1.0, 2.0, 3.0)},
    )
    for title, state in (("unmodified", FaceState()), ("8/8 µm, 8 mm", CROWNED))
    for drive in ("involute", "parabolic")
]


def _figure(height: float, quantities: Sequence[str], panels: Sequence[Panel], _: Path) -> Figure:
    """Two panels a row, those of one quantity after those of another."""
    wanted = [(quantity, panel) for quantity in quantities for panel in panels]
    figure = new_figure(height=height)
    sharey = "row" if len(quantities) > 1 else "all"
    grid = figure.subplots(len(wanted) // 2, 2, sharex=True, sharey=sharey, squeeze=False)
    for letter, axes, (quantity, panel) in zip("abcdef", grid.flat, wanted, strict=False):
        _draw(axes, quantity, panel)
        axes.set_title(panel.title)
        mark_panel(axes, letter)
    for axes, (quantity, _panel) in zip(grid[:, 0], wanted[::2], strict=True):
        axes.set(ylabel=QUANTITIES[quantity][0], ylim=(0.0, None))
    for axes in grid[-1]:
        axes.set_xlabel(FACE if quantities == ["face"] else ROLL)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def face_load(name: Name, state: FaceState = FaceState()) -> tuple[np.ndarray, np.ndarray]:
    """Line load (N/m) along the face (m from its middle) of the pair that is nearest to the pitch point."""
    run = rolled(name, state)
    return run.slice_position, run.line_load[at_pitch_point(run.roll)]


def _draw(axes: Axes, quantity: str, panel: Panel) -> None:
    colours = colormaps["viridis"](np.linspace(0.0, 0.88, len(panel.states)))
    for colour, (label, state) in zip(colours, panel.states.items(), strict=True):
        if quantity == "face":
            place, values = face_load(panel.drive, state)
            along = 1e3 * place
        else:
            course = passage(panel.drive, state)
            along, values = np.degrees(course.roll), getattr(course, quantity)
        axes.plot(along, QUANTITIES[quantity][1] * values, color=colour, label=label)


def compared(_: Path) -> Figure:
    """Line load and root stresses of the parabolic gears beside the involute's."""
    quantities = ("line_load", "compression", "tension")
    figure = new_figure(height=7.2)
    rows = figure.subplots(len(quantities), 1, sharex=True)
    for letter, axes, quantity in zip("abc", rows, quantities, strict=True):
        label, factor = QUANTITIES[quantity]
        for colour, drive in zip(PALETTE, DRIVES, strict=False):
            course = passage(drive)
            values = factor * getattr(course, quantity)
            axes.plot(np.degrees(course.roll), values, color=colour, label=drive)
        axes.set(ylabel=label, ylim=(0.0, None))
        mark_panel(axes, letter)
    rows[-1].set_xlabel(ROLL)
    rows[0].legend()
    return figure


def stresses(misalignment: float, wanted: Sequence[tuple[str, Name, FaceState]], _: Path) -> Figure:
    """Von Mises stress of the pinion's tooth with the pair at the pitch point, one scale for all."""
    fields = []
    for _title, drive, state in wanted:
        run = rolled(drive, state._replace(misalignment=misalignment))
        position, pair = at_pitch_point(run.roll)
        flanks = LoadedFlanks(elastic(drive), slices=SLICES)
        fields.append(tooth_field(flanks, "pinion", run.roll[position], run.line_load[position], pair))
    columns = 2 if len(wanted) > 3 else len(wanted)
    rows = len(wanted) // columns
    figure = new_figure(1.3 * WIDTH, 2.6 * rows + 0.3)
    scale, panels = stress.scale_of(fields), []
    for number, ((title, _drive, _state), field) in enumerate(zip(wanted, fields, strict=True)):
        panels.append(figure.add_subplot(rows, columns, number + 1, projection="3d"))
        stress.draw_tooth(panels[-1], field, scale)
        panels[-1].set_title(panel_title("abcd"[number], title), loc="left")
    stress.add_bar(figure, scale, panels)
    return figure


_UNMODIFIED, _CROWNED = "unmodified", "8/8 µm, 8 mm"
#: Panels of figures 15 and 18: title, drive, state.
OF_RELIEF: tuple[tuple[str, Name, FaceState], ...] = (
    (_UNMODIFIED, "parabolic", FaceState()),
    ("8/8 µm, 0 mm", "parabolic", FaceState(8.0, 0.0)),
    (_CROWNED, "parabolic", CROWNED),
)
OF_BOTH: tuple[tuple[str, Name, FaceState], ...] = tuple(
    (f"{drive}, {title}", drive, state)
    for title, state in ((_UNMODIFIED, FaceState()), (_CROWNED, CROWNED))
    for drive in DRIVES
)


FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-7": relieved_teeth,
    "figure-9": paths,
    "figure-10": partial(teeth, "k1"),
    "figure-11": partial(teeth, "k2"),
    "figure-12": racks,
    "figure-13": compared,
    "figure-14": partial(_figure, 3.0, ["face"], RELIEVED),
    "figure-15": partial(stresses, 0.0, OF_RELIEF),
    "figure-16": partial(_figure, 7.2, ["line_load", "compression", "tension"], RELIEVED),
    "figure-17": partial(_figure, 5.2, ["face"], MISALIGNED),
    "figure-18": partial(stresses, 3.0, OF_BOTH),
    "figure-19": partial(_figure, 5.2, ["line_load"], MISALIGNED),
    "figure-19-pressure": partial(_figure, 5.2, ["pressure"], MISALIGNED),
    "figure-20": partial(_figure, 5.2, ["compression"], MISALIGNED),
    "figure-21": partial(_figure, 5.2, ["tension"], MISALIGNED),
}
