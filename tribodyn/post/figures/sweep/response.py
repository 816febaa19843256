"""The response to a parameter: transmission error, dynamic factor, contact loss, film, efficiency."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.figures.sweep.branch import (
    axis_label,
    branch_legend,
    branches,
    draw_branch,
    regime_handles,
    shade_contact_loss,
    sweep_title,
)
from tribodyn.post.style import PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.sweep_reader import SweepRecord

#: Dataset, factor from SI, label, whether the axis starts at 0.
PANELS = (
    ("transmission_error_rms", 1e6, "Transmission error,\nRMS (µm)", True),
    ("transmission_error_peak_to_peak", 1e6, "Transmission error,\npeak to peak (µm)", True),
    ("dynamic_factor", 1.0, "Dynamic factor (–)", False),
    ("contact_loss_fraction", 100.0, "Time without\ncontact (%)", True),
    ("film_min", 1e6, "Least film\nthickness (µm)", True),
    ("efficiency", 100.0, "Efficiency (%)", False),
)
#: Curves that vary by less than this share are constant.
FLAT = 1e-5


def response_figure(records: Sequence[SweepRecord]) -> Figure:
    """Draw six figures of every case over the first parameter; up and down apart where both were followed.

    Shaded where contact is lost at times; marked where the motion does not repeat with the mesh.
    """
    figure = new_figure(WIDTH, 3 * (PANEL_HEIGHT - 0.4) + 0.6)
    rows = figure.subplots(3, 2, sharex=True)
    drawn = branches(records)
    for letter, axes, (name, factor, label, from_zero) in zip("abcdef", rows.flat, PANELS, strict=True):
        for branch in drawn:
            draw_branch(axes, branch, branch.values(name) * factor)
        axes.margins(x=0.02)
        axes.set_ylabel(label)
        if from_zero:
            axes.set_ylim(bottom=0)
        elif np.ptp(axes.dataLim.intervaly) < FLAT * abs(axes.dataLim.y1):
            # a constant: no scale of rounding errors
            axes.set_ylim(0.98 * axes.dataLim.y1, 1.004 * axes.dataLim.y1)
        shade_contact_loss(axes, drawn)
        mark_panel(axes, letter)
    for axes in rows[-1]:
        axes.set_xlabel(axis_label(records[0].parameters[0]))
    figure.align_ylabels()
    branch_legend(figure, drawn, marks=regime_handles(drawn))
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure
