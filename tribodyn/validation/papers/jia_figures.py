"""Figures 13 to 21 of Jia et al.: loads along the face, stresses over the pinion's angle and of the tooth.

Where the paper draws contact stress these show the maximum line load along the face, which its figures
behave like (docs/validation.md); Hertz pressures have a figure of their own.
"""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import at_pitch_point
from tribodyn.compliance.sharing.tooth_field import tooth_field
from tribodyn.post.style import PALETTE, WIDTH, mark_panel, new_figure, panel_title
from tribodyn.studies.load_contact import stress
from tribodyn.validation.papers import jia_profiles
from tribodyn.validation.papers.jia import (
    CROWNED,
    DRIVES,
    SLICES,
    FaceState,
    Name,
    elastic,
    face_load,
    passage,
    rolled,
)

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
        axes.set_ylabel(QUANTITIES[quantity][0])
        axes.set_ylim(bottom=0.0)
    for axes in grid[-1]:
        axes.set_xlabel(FACE if quantities == ["face"] else ROLL)
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


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
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0.0)
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
    **jia_profiles.FIGURES,
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
