"""Spectra over a parameter, one behind the other."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.sweep.amplitudes import spectra
from tribodyn.post.figures.sweep.branch import Branch, axis_label, branches, sweep_title
from tribodyn.post.style import GRID, PALETTE, QUIET, WIDTH, new_figure
from tribodyn.record.sweep_reader import SweepRecord

#: Spectra in a figure; of more cases, so many are shown.
MOST_SPECTRA = 60
#: Orders of the mesh that are shown.
ORDERS = 6
#: Height of the highest line, in spacings of the baselines.
HEIGHT = 3.5
#: Lines weaker than the highest by more than this are not seen, dB.
RANGE = 60.0


def waterfall_figure(records: Sequence[SweepRecord]) -> Figure:
    """Draw amplitude spectra of the transmission error over frequency, at the parameter of each case.

    Up and down beside each other where both were followed; of several other parameters the first branch.
    """
    drawn = branches(records[:1])
    drawn = [branch for branch in drawn if branch.place[1 : len(records[0].parameters)] == _first(drawn)]
    figure = new_figure(WIDTH, 4.6)
    panels = figure.subplots(1, len(drawn), squeeze=False, sharex=True, sharey=True)[0]
    highest = max(_highest(branch) for branch in drawn)
    for axes, branch in zip(panels, drawn, strict=True):
        _draw(axes, branch, highest)
        if branch.direction:
            axes.set_title(branch.direction, loc="left")
        axes.set_xlabel("Frequency (kHz)")
    panels[0].set_ylabel(axis_label(records[0].parameters[0]))
    scale = f"highest line {highest * 1e6:.3g} µm, logarithmic over {RANGE:g} dB; modes dashed"
    shown = f": {drawn[0].label}" if drawn[0].label else ""
    title = f"{sweep_title(records)}{shown}\nSpectra of the transmission error: {scale}"
    figure.suptitle(title, x=0.01, ha="left", fontsize=9)
    return figure


def _first(drawn: Sequence[Branch]) -> tuple[int | slice, ...]:
    branch = drawn[0]
    return branch.place[1 : len(branch.record.parameters)]


def _highest(branch: Branch) -> float:
    return max(float(one.amplitudes[1:].max()) for one in spectra(branch) if one is not None)


def _draw(axes: Axes, branch: Branch, highest: float) -> None:
    lines = spectra(branch)
    frequency = branch.values("mesh_frequency") * 1e-3
    stride = -(-len(lines) // MOST_SPECTRA)
    spacing = stride * (branch.x.max() - branch.x.min()) / max(1, len(lines) - 1) or 1.0
    for i in range(0, len(lines), stride):
        one = lines[i]
        if one is None:
            continue
        shown = (one.orders > 0) & (one.orders <= ORDERS + 0.5)
        level = 20 * np.log10(np.maximum(one.amplitudes[shown], 1e-300) / highest) / RANGE + 1
        top = branch.x[i] + np.maximum(level, 0) * HEIGHT * spacing
        axes.axhline(branch.x[i], color=GRID, linewidth=0.5, zorder=1)
        axes.vlines(
            one.orders[shown] * frequency[i], branch.x[i], top, color=PALETTE[0], linewidth=0.9, zorder=2
        )
    limit = float(np.nanmax(frequency)) * min(ORDERS, 4)
    modes = branch.values("mode_frequency") * 1e-3
    for mode in range(modes.shape[1]):
        if np.nanmin(modes[:, mode]) < limit:
            axes.plot(modes[:, mode], branch.x, color=QUIET, linestyle=(0, (3, 2)), linewidth=0.7, zorder=3)
    axes.set_xlim(0, limit)
    axes.grid(False)
