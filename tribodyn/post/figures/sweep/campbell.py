"""The Campbell diagram: natural frequencies and orders of the mesh over the speed, and their answer."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.post.figures.sweep.amplitudes import order_amplitudes
from tribodyn.post.figures.sweep.branch import Branch, axis_label, chosen_branch, sweep_title
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, mark_panel, new_figure
from tribodyn.record.sweep_reader import SweepRecord

#: No case chosen.
NOWHERE: Mapping[str, float | str] = MappingProxyType({})
#: Orders of the mesh that are drawn.
ORDERS = 6
#: Area of the largest marker, square points.
LARGEST_AREA = 160.0


def campbell_figure(records: Sequence[SweepRecord], at: Mapping[str, float | str] = NOWHERE) -> Figure:
    """Draw modes (dashed) and orders of the mesh (rays) over the first parameter, up and down apart.

    The area of a marker on an order is the amplitude of the transmission error there. Of several other
    parameters the branch nearest to `at` is drawn, or the first.
    """
    drawn, named = chosen_branch(records, at)
    figure = new_figure(WIDTH if len(drawn) == 1 else 1.35 * WIDTH, 4.4)
    panels = figure.subplots(1, len(drawn), sharex=True, sharey=True, squeeze=False)[0]
    largest = max(float(np.nanmax(order_amplitudes(branch, ORDERS))) for branch in drawn) or 1.0
    for letter, axes, branch in zip("ab", panels, drawn, strict=False):
        _draw_modes(axes, branch)
        _draw_orders(axes, branch, largest)
        axes.set_xlabel(axis_label(records[0].parameters[0]))
        way = {"up": "Parameter increasing", "down": "Parameter decreasing"}
        title = way.get(branch.direction, "Modes (dashed) and orders of the mesh frequency $f_m$")
        mark_panel(axes, letter if len(drawn) > 1 else "", title, 1)
    panels[0].set_ylabel("Frequency (kHz)")
    shares = (1.0, 0.5, 0.1)
    figure.legend(
        [_marker(share) for share in shares],
        [f"{share * largest * 1e6:.2g} µm" for share in shares],
        loc="outside lower center",
        ncols=len(shares),
        title="Dashed: modes.  Rays: orders of the mesh frequency $f_m$.  "
        "Area of the marks: amplitude of the transmission error",
        title_fontsize=7.5,
    )
    shown = f": {named}" if named else ""
    figure.suptitle(sweep_title(records) + shown, x=0.01, ha="left", fontsize=9)
    return figure


def _marker(share: float) -> Line2D:
    size = float(np.sqrt(LARGEST_AREA * share))
    return Line2D(
        [], [], linestyle="none", marker="o", markersize=size, color=PALETTE[1], markeredgewidth=0, alpha=0.65
    )


def _draw_modes(axes: Axes, branch: Branch) -> None:
    modes = branch.values("mode_frequency") * 1e-3
    for mode in range(modes.shape[1]):
        known = np.flatnonzero(np.isfinite(modes[:, mode]))
        if not known.size:
            continue
        axes.plot(branch.x, modes[:, mode], color=QUIET, linestyle=(0, (4, 2)), linewidth=0.9)
        first = known[np.argmin(branch.x[known])]
        axes.annotate(
            f"mode {mode + 1}: {modes[first, mode]:.3g} kHz",
            (branch.x[first], modes[first, mode]),
            xytext=(2, 2),
            textcoords="offset points",
            fontsize=7,
            color=INK,
        )
    axes.set_ylim(0, 1.15 * float(np.nanmax(modes)))


def _draw_orders(axes: Axes, branch: Branch, largest: float) -> None:
    frequency = branch.values("mesh_frequency") * 1e-3
    amplitudes = order_amplitudes(branch, ORDERS)
    top = axes.get_ylim()[1]
    for order in range(1, ORDERS + 1):
        ray = order * frequency
        axes.plot(branch.x, ray, color=PALETTE[5], linewidth=0.7, zorder=1)
        inside = np.flatnonzero(np.isfinite(ray) & (ray <= top))
        axes.scatter(
            branch.x,
            np.where(ray <= top, ray, np.nan),
            s=LARGEST_AREA * np.nan_to_num(amplitudes[:, order - 1]) / largest,
            facecolor=PALETTE[1],
            edgecolor="none",
            alpha=0.65,
            zorder=2,
        )
        if inside.size:
            last = inside[np.argmax(branch.x[inside])]
            axes.annotate(
                "$f_m$" if order == 1 else f"{order}$f_m$",
                (branch.x[last], ray[last]),
                xytext=(3, 4),
                textcoords="offset points",
                fontsize=7,
                color=PALETTE[0],
                annotation_clip=False,
            )
    axes.margins(x=0.03)
