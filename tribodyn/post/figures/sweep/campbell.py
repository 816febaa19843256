"""The Campbell diagram: natural frequencies and orders of the mesh over the speed, and their answer."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.sweep.amplitudes import order_amplitudes
from tribodyn.post.figures.sweep.branch import Branch, axis_label, branches, named, sweep_title
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, new_figure
from tribodyn.record.sweep_reader import SweepRecord

#: Orders of the mesh that are drawn.
ORDERS = 6
#: Area of the largest marker, square points.
LARGEST_AREA = 160.0


def campbell_figure(records: Sequence[SweepRecord]) -> Figure:
    """Draw modes (dashed) and orders of the mesh (rays) over the first parameter of the first branch.

    The area of a marker on an order is the amplitude of the transmission error there.
    """
    figure = new_figure(WIDTH, 4.0)
    axes = figure.subplots()
    branch = branches(records[:1])[0]
    _draw_modes(axes, branch)
    _draw_orders(axes, branch)
    axes.set_xlabel(axis_label(records[0].parameters[0]))
    axes.set_ylabel("Frequency (kHz)")
    shown = f": {named(branch)}" if named(branch) else ""
    figure.suptitle(sweep_title(records) + shown, x=0.01, ha="left", fontsize=9)
    return figure


def _draw_modes(axes: Axes, branch: Branch) -> None:
    modes = branch.values("mode_frequency") * 1e-3
    for mode in range(modes.shape[1]):
        if not np.isfinite(modes[:, mode]).any():
            continue
        axes.plot(branch.x, modes[:, mode], color=QUIET, linestyle=(0, (4, 2)), linewidth=0.9)
        last = np.flatnonzero(np.isfinite(modes[:, mode]))[-1]
        axes.annotate(
            f"mode {mode + 1}",
            (branch.x[last], modes[last, mode]),
            xytext=(14, 0),
            textcoords="offset points",
            va="center",
            fontsize=7,
            color=INK,
            annotation_clip=False,
        )
    axes.set_ylim(0, 1.15 * float(np.nanmax(modes)))


def _draw_orders(axes: Axes, branch: Branch) -> None:
    frequency = branch.values("mesh_frequency") * 1e-3
    amplitudes = order_amplitudes(branch, ORDERS)
    maximum = float(np.nanmax(amplitudes)) or 1.0
    top = axes.get_ylim()[1]
    for order in range(1, ORDERS + 1):
        ray = order * frequency
        axes.plot(branch.x, ray, color=PALETTE[5], linewidth=0.7, zorder=1)
        inside = np.flatnonzero(np.isfinite(ray) & (ray <= top))
        axes.scatter(
            branch.x,
            np.where(ray <= top, ray, np.nan),
            s=LARGEST_AREA * np.nan_to_num(amplitudes[:, order - 1]) / maximum,
            facecolor=PALETTE[1],
            edgecolor="none",
            alpha=0.65,
            zorder=2,
        )
        if inside.size:
            axes.annotate(
                "$f_m$" if order == 1 else f"{order}$f_m$",
                (branch.x[inside[-1]], ray[inside[-1]]),
                xytext=(3, 4),
                textcoords="offset points",
                fontsize=7,
                color=PALETTE[0],
                annotation_clip=False,
            )
    axes.margins(x=0.03)
    axes.annotate(
        f"largest marker: {maximum * 1e6:.3g} µm",
        (0, 1),
        xycoords="axes fraction",
        xytext=(0, 12),
        textcoords="offset points",
        fontsize=7,
        color=QUIET,
    )
