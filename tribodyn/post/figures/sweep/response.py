"""The response to a parameter: figures of the cases over the first of them."""

from collections.abc import Sequence
from textwrap import wrap
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.figures.sweep.branch import (
    axis_label,
    branch_legend,
    branches,
    draw_branch,
    draw_unstable,
    mark_ends,
    regime_handles,
    shade_contact_loss,
    sweep_title,
)
from tribodyn.post.report import Line
from tribodyn.post.style import PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.post.sweep_report import described
from tribodyn.record.sweep_reader import SweepRecord


class Panel(NamedTuple):
    """One figure of the cases: dataset, factor from SI, label, whether the axis starts at 0."""

    name: str
    factor: float
    label: str
    from_zero: bool = False


#: Panels of a picture, at most.
MOST_PANELS = 6
#: Curves that vary by less than this share are constant.
FLAT = 1e-5


def panels_of(records: Sequence[SweepRecord], lines: Sequence[Line]) -> list[Panel]:
    """Panels of the first figures that vary; of the first that there are where none does.

    Parameters
    ----------
    records : sequence of SweepRecord
    lines : sequence of Line
        What the figures are called, and their units; none: as the first record describes them.
    """
    lines = lines or [described(records[0], name) for name in records[0].figures]
    known = [line for line in lines if all(line.name in record for record in records)]
    varying = [line for line in known if _varies(records, line.name)]
    return [_panel(line) for line in (varying or known)[:MOST_PANELS]]


def _varies(records: Sequence[SweepRecord], name: str) -> bool:
    values = np.concatenate([record[name].ravel() for record in records])
    values = values[np.isfinite(values)]
    return bool(values.size) and np.ptp(values) > FLAT * np.max(np.abs(values))


def _panel(line: Line) -> Panel:
    label = "\n".join(wrap(f"{line.label} ({line.unit or '–'})", 28))
    return Panel(line.name, line.factor, label)


def response_figure(records: Sequence[SweepRecord], panels: Sequence[Panel]) -> Figure:
    """Draw figures of every case over the first parameter; up and down apart where both were followed.

    Shaded where contact is lost at times; marked where the motion does not repeat with the mesh.

    Parameters
    ----------
    records : sequence of SweepRecord
    panels : sequence of Panel
        At most `MOST_PANELS`.
    """
    columns = min(2, len(panels))
    count = -(-len(panels) // columns)
    figure = new_figure(WIDTH, count * (PANEL_HEIGHT - 0.4) + 0.6 + 0.6 * (count == 1))
    rows = figure.subplots(count, columns, sharex=True, squeeze=False)
    for axes in rows.flat[len(panels) :]:
        axes.set_visible(False)
    drawn = branches(records)
    for letter, axes, (name, factor, label, from_zero) in zip("abcdef", rows.flat, panels, strict=False):
        for branch in drawn:
            draw_branch(axes, branch, branch.values(name) * factor)
        draw_unstable(axes, drawn, f"unstable_{name}", factor)
        axes.margins(x=0.02)
        axes.set_ylabel(label)
        if from_zero:
            axes.set_ylim(bottom=0)
        elif np.ptp(axes.dataLim.intervaly) < FLAT * abs(axes.dataLim.y1):
            # a constant: no scale of rounding errors
            axes.set_ylim(0.98 * axes.dataLim.y1, 1.004 * axes.dataLim.y1)
        shade_contact_loss(axes, drawn)
        mark_ends(axes, drawn)
        mark_panel(axes, letter)
    for axes in rows.flat[max(0, len(panels) - columns) : len(panels)]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel(axis_label(records[0].parameters[0]))
    figure.align_ylabels()
    branch_legend(figure, drawn, marks=regime_handles(drawn))
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure
