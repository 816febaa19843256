"""A picture of the laws beside the solved contact."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.style import GRID, PALETTE, QUIET, WIDTH, house_style, literal, new_figure
from tribodyn.studies.ehl.judged import RIGHT, Judged, Judgement


def picture(found: Judgement) -> Figure:
    """Draw minimum, median and maximum of each law over the solved contact; points: medians of the map."""
    groups = [[one for one in found.laws if one.what == what] for what in RIGHT]
    with house_style():
        drawn = new_figure(WIDTH, 1.2 + 0.22 * len(found.laws))
        panels = drawn.subplots(len(groups), 1, height_ratios=[len(laws) for laws in groups], squeeze=False)
        for axes, what, laws in zip(panels[:, 0], RIGHT, groups, strict=True):
            _rows(axes, laws)
            axes.axvspan(1.0 - RIGHT[what], 1.0 + RIGHT[what], color=GRID, zorder=0)
            axes.set_xlabel(f"{what.capitalize()} by the law over the solved one")
        drawn.suptitle(literal(found.title))
    return drawn


def _rows(axes: Axes, laws: Sequence[Judged]) -> None:
    for row, one in enumerate(laws):
        points = np.ravel(one.map)
        axes.plot(points, np.full(len(points), row), ".", color=QUIET, ms=3, zorder=2)
        axes.plot([one.minimum, one.maximum], [row, row], color=PALETTE[0], lw=2.5, zorder=3)
        axes.plot([one.median], [row], "o", color=PALETTE[1], ms=4, zorder=4)
    axes.set_xscale("log")
    axes.axvline(1.0, color=QUIET, lw=0.8)
    axes.set_yticks(range(len(laws)), [_name(one) for one in laws])
    axes.set_ylim(len(laws) - 0.5, -0.5)
    shown = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
    axes.set_xticks(shown, [f"{one:g}" for one in shown])
    axes.minorticks_off()
    every = [value for one in laws for value in (one.minimum, one.maximum, *np.ravel(one.map))]
    known = [value for value in every if np.isfinite(value)]
    axes.set_xlim(max(min([*known, 0.5]) / 1.2, 0.05), min(max([*known, 2.0]) * 1.2, 20.0))


def _name(one: Judged) -> str:
    return literal(f"{one.law} ({one.against})" if one.what == "film" else one.law)
