"""Measured curves beside simulated ones."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure

#: More points than these are drawn as a line.
MOST_DOTS = 200
#: Units as a file spells them -> as a figure shows them.
SPELLED = {"um": "µm", "deg": "°", "N*m": "N m", "1": ""}


def spelled(unit: str, name: str) -> str:
    """A unit of a file as a figure shows it; the phase of the mesh is counted in mesh cycles."""
    shown = SPELLED.get(unit, unit)
    return shown or ("mesh cycles" if name == "mesh_phase" else "")


class MeasuredPanel(NamedTuple):
    """A measured quantity and the simulated curves beside it, in the measured units."""

    name: str
    unit: str
    measured: np.ndarray  # (points,)
    curves: Sequence[tuple[str, np.ndarray, np.ndarray, str]]  # (label, x, y, how far they are apart)


def draw(label: str, abscissa: str, unit: str, x: np.ndarray, panels: Sequence[MeasuredPanel]) -> Figure:
    """Draw panels below each other over an abscissa (points,), which has a name and a unit."""
    figure = new_figure(WIDTH, len(panels) * (PANEL_HEIGHT + 0.2) + 0.4)
    rows = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    marks = (
        {"marker": ".", "markersize": 4, "linestyle": "none"} if len(x) <= MOST_DOTS else {"linewidth": 1.0}
    )
    for letter, axes, panel in zip("abcdef", rows, panels, strict=False):
        axes.plot(x, panel.measured, color=INK, label=literal(f"measured: {label}"), zorder=3, **marks)
        said = []
        for number, (name, at, values, text) in enumerate(panel.curves):
            axes.plot(at, values, color=PALETTE[number % len(PALETTE)], label=literal(name), linewidth=1.2)
            said.append(f"{name}: {text}" if len(panel.curves) > 1 else text)
        axes.set_ylabel(literal(spelled(panel.unit, panel.name)))
        lines = map(literal, [panel.name.replace("_", " ").capitalize(), *said])
        mark_panel(axes, letter if len(panels) > 1 else "", "\n".join(lines))
        axes.margins(x=0.01)
    along = spelled(unit, abscissa)
    title = abscissa.replace("_", " ").capitalize()
    rows[-1].set_xlabel(literal(f"{title} ({along})" if along else title))
    handles, labels = rows[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=min(3, len(labels)))
    return figure
