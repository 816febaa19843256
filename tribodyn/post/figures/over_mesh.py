"""The figures of a gear pair over its mesh cycles, and the six panels that sum them up."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.cycles import last_cycles, transient
from tribodyn.post.figures import over_phase as panels
from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import (
    ALONE,
    KEY_POINTS,
    View,
    abscissa,
    abscissa_label,
    draw,
    legend,
    record_title,
)
from tribodyn.post.figures.path_of_contact import draw_path, path_figure
from tribodyn.post.figures.scale import scale
from tribodyn.post.figures.spectrum import spectrum_figure
from tribodyn.post.style import (
    PALETTE,
    STYLE,
    Margins,
    mark_panel,
    new_grid,
    panel_title,
    prepare_grid,
    read_formulas,
)
from tribodyn.record.reader import Record

#: Size of the overview, inch, and its rows and columns.
GRID = 11.0, 6.6, 2, 3
#: Room in it, inch.
OVERVIEW: dict[str, Any] = {"left": 0.74, "right": 0.42, "top": 0.85, "bottom": 0.5, "between": (0.86, 1.0)}
#: Titles of its panels a, and b to f.
PATH = "Teeth and path of contact"
TRACES = (
    panels.DEFLECTION,
    panels.NORMAL_LOAD,
    panels.FRICTION_FORCE,
    panels.FILM_THICKNESS,
    panels.EFFICIENCY,
)


def overview_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw what the first record holds in six panels; of a transient its speed and load in the first."""
    record = records[0]
    drawn, rows = new_grid(*GRID)
    if view.cycles is None and transient(record):
        draw_speed(rows[0, 0], record, view)
        mark_panel(rows[0, 0], "a", "Speed and load, means of a mesh cycle")
    else:
        draw_path(rows[0, 0], record)
        mark_panel(rows[0, 0], "a", PATH)
    for letter, axes, trace in zip("bcdef", rows.flat[1:], TRACES, strict=True):
        names = draw(axes, [record], trace, view)
        mark_panel(axes, letter, trace.title, names)
    legend(drawn, list(rows.flat[1:]), [record], view)
    drawn.suptitle(record_title(record), x=0.01, ha="left", fontsize=11)
    if isinstance(drawn, Figure) and len(drawn.axes) == rows.size:
        drawn.set_layout_engine(Margins(**OVERVIEW))
    return drawn


def prepare_overview() -> None:
    """Do what needs no record: make the grid of panels, read the formulas."""
    prepare_grid(*GRID)
    titles = [PATH, *(trace.title for trace in TRACES)]
    marked = [panel_title(letter, title) for letter, title in zip("abcdef", titles, strict=True)]
    names = [f"${name}$" for name in ("B_g", "C_p", "P", "C_g", "B_p")]
    read_formulas([*marked, *(trace.label for trace in TRACES), *names], STYLE["font.size"])
    read_formulas([*names, KEY_POINTS + ALONE], STYLE["legend.fontsize"])


def draw_speed(axes: Axes, record: Record, view: View) -> None:
    """Draw the pinion's speed and the torque on the gear, means of every mesh cycle, on two axes."""
    window = last_cycles(record, view.cycles)
    size = window.samples_per_cycle
    dof = list(record["dof"])
    velocity = record["velocity"][window.part][:-1]
    power = record["power_out"][window.part][:-1]
    pinion, gear = (velocity[:, dof.index(name)] for name in ("theta_p", "theta_g"))
    x, speed, torque = (
        np.mean(values.reshape(-1, size), axis=1)
        for values in (abscissa(window, view)[:-1], pinion * 30 / np.pi, power / gear)
    )
    right = axes.twinx()
    for one, values, color, label in (
        (axes, speed, PALETTE[0], "Pinion speed (rpm)"),
        (right, torque, PALETTE[1], "Torque on the gear (N m)"),
    ):
        one.plot(x, values, color=color)
        one.set_ylabel(label, color=color)
        scale(one, [values])
    right.spines["right"].set_visible(True)
    right.grid(False)
    axes.set_xlabel(abscissa_label(view))


def _over_phase(name: str, about: str) -> Drawing:
    return Drawing(about, partial(panels.over_phase, name))


#: Of every record over time with loads, films and friction of pairs.
DRAWINGS: dict[str, Drawing] = {
    "overview": Drawing(
        "path of contact, transmission error, load, friction, film, efficiency", overview_figure
    ),
    "transmission-error": _over_phase(
        "transmission-error", "transmission error, and deflection along the normal of every pair"
    ),
    "spectrum": Drawing("spectrum of the rotational transmission error, with the modes", spectrum_figure),
    "normal-load": _over_phase("normal-load", "normal load of every pair"),
    "friction": _over_phase("friction", "friction force and coefficient"),
    "film": _over_phase("film", "film thickness and film parameter"),
    "entrainment": _over_phase("entrainment", "entrainment and sliding speed"),
    "pressure": _over_phase("pressure", "Hertz pressure and flash temperature"),
    "efficiency": _over_phase("efficiency", "instantaneous efficiency"),
    "mesh-stiffness": _over_phase("mesh-stiffness", "stiffness of every pair, and of all together"),
    "path-of-contact": Drawing("both gears in mesh, path of contact, key points", path_figure),
}
