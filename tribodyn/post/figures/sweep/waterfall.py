"""Spectra over a parameter: a line of the spectrum is a mark at its frequency, coloured by its amplitude."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from tribodyn.post.figures.sweep.amplitudes import spectra
from tribodyn.post.figures.sweep.branch import Branch, axis_label, chosen_branch, sweep_title
from tribodyn.post.figures.sweep.campbell import NOWHERE
from tribodyn.post.style import INK, QUIET, ROW, WIDTH, mark_panel, new_figure
from tribodyn.record.sweep_reader import SweepRecord

#: Orders of the mesh that are shown at least.
ORDERS = 4
#: Lines weaker than the highest by more than this are not shown, dB.
RANGE = 60.0
_LOWEST = 10 ** (-RANGE / 20)


def waterfall_figure(records: Sequence[SweepRecord], at: Mapping[str, float | str] = NOWHERE) -> Figure:
    """Draw amplitude spectra of the transmission error over frequency and the first parameter.

    Up and down beside each other where both were followed; of several other parameters the branch nearest to
    `at`, or the first.
    """
    drawn, named = chosen_branch(records, at)
    figure = new_figure(WIDTH if len(drawn) == 1 else 1.35 * WIDTH, 4.6)
    panels = figure.subplots(1, len(drawn), squeeze=False, sharex=True, sharey=True)[0]
    highest = max(_highest(branch) for branch in drawn) * 1e6 or 1.0
    norm = LogNorm(highest * _LOWEST, highest)
    limit = max(map(_limit, drawn))
    lines: Any = None
    for letter, axes, branch in zip("ab", panels, drawn, strict=False):
        lines = _draw(axes, branch, norm, limit)
        way = {"up": ", parameter increasing", "down": ", parameter decreasing"}.get(branch.direction, "")
        mark_panel(axes, letter if len(drawn) > 1 else "", f"Spectra of the transmission error{way}", 2)
        axes.set_xlabel("Frequency (kHz)")
    panels[0].set_ylabel(axis_label(records[0].parameters[0]))
    bar = figure.colorbar(lines, ax=list(panels), label="Amplitude (µm)", pad=0.02)
    bar.outline.set_visible(False)
    shown = f": {named}" if named else ""
    figure.suptitle(f"{sweep_title(records)}{shown}", x=0.01, ha="left", fontsize=9)
    return figure


def _highest(branch: Branch) -> float:
    return max(float(one.amplitudes[1:].max()) for one in spectra(branch) if one is not None)


def _limit(branch: Branch) -> float:
    """Highest frequency shown, kHz: above the highest mode and the first orders."""
    modes, mesh = branch.values("mode_frequency"), branch.values("mesh_frequency")
    return 1e-3 * max(1.05 * float(np.nanmax(modes)), ORDERS * float(np.nanmax(mesh)))


def _draw(axes: Axes, branch: Branch, norm: LogNorm, limit: float) -> LineCollection:
    frequency = branch.values("mesh_frequency") * 1e-3
    low, high = _edges(branch.x)
    places, amplitudes = [], []
    for i, one in enumerate(spectra(branch)):
        if one is None:
            continue
        levels = one.amplitudes * 1e6
        for k in np.flatnonzero(
            (one.orders > 0)
            & (levels > _LOWEST * float(norm.vmax or 0.0))
            & (one.orders * frequency[i] <= limit)
        ):
            x = one.orders[k] * frequency[i]
            places.append([(x, low[i]), (x, high[i])])
            amplitudes.append(levels[k])
    order = np.argsort(amplitudes)  # the strongest on top
    lines = LineCollection(
        [places[i] for i in order],
        array=np.array(amplitudes)[order],
        norm=norm,
        cmap="viridis_r",
        linewidths=1.8,
        capstyle="butt",
    )
    axes.add_collection(lines)
    modes = branch.values("mode_frequency") * 1e-3
    last = int(np.argmax(branch.x))
    for mode in range(modes.shape[1]):
        axes.plot(modes[:, mode], branch.x, color=QUIET, linestyle=(0, (3, 2)), linewidth=0.7, zorder=0.9)
        if np.isfinite(modes[last, mode]):
            axes.annotate(
                f"mode {mode + 1}",
                (modes[last, mode], 1),
                xycoords=("data", "axes fraction"),
                xytext=(0, 3 + ROW * (mode % 2)),
                textcoords="offset points",
                ha="center",
                fontsize=6.5,
                color=INK,
            )
    axes.set_xlim(0, limit)
    axes.set_ylim(float(np.min(low)), float(np.max(high)))
    axes.grid(False)
    return lines


def _edges(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the mark of each case begins and ends: halfway to its neighbours."""
    if len(x) < 2:
        return x - 0.5, x + 0.5
    order = np.argsort(x)
    middle = (x[order][1:] + x[order][:-1]) / 2.0
    first, last = 2 * x[order][0] - middle[0], 2 * x[order][-1] - middle[-1]
    low, high = np.empty(len(x)), np.empty(len(x))
    low[order], high[order] = np.concatenate([[first], middle]), np.concatenate([middle, [last]])
    return low, high
