"""A data set at a glance: a piece of a signal, and the mean spectrum, of the cases of each label."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures.drawing import SweepDrawing
from tribodyn.post.figures.sweep.branch import sweep_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE

#: Labels that are drawn, cases that a spectrum is the mean of, seconds of a signal that are shown.
LABELS, CASES, SHOWN = 4, 24, 0.1
#: Characters of a legend in an inch of its width.
CHARACTERS = 18.0


def signals_figure(records: Sequence[SweepRecord], _at: Mapping[str, float | str]) -> Figure:
    """Draw the first signal of a data set: one case of each label over time, and spectra."""
    if len(records) > 1:
        raise InputError(
            "record", str(records[1].path), "a data set is drawn alone", "draw one after the other"
        )
    record = records[0]
    name = str(record.attrs["sensors"]).split()[0]
    labels, done = record.listed["label"].astype(str), record["status"] == DONE
    time = record[record.dims_of(name)[-1]]
    unit = record.units(name).replace("m/s2", "m/s²")
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 1.2)
    above, below = figure.subplots(2)
    window = np.hanning(len(time))
    frequency = np.fft.rfftfreq(len(time), time[1] - time[0]) / 1e3 if len(time) > 1 else np.zeros(1)
    for number, label in enumerate(list(dict.fromkeys(labels[done]))[:LABELS]):
        color = PALETTE[number % len(PALETTE)]
        chosen = np.flatnonzero(done & (labels == label))[:CASES].tolist()
        piece = time <= SHOWN
        above.plot(time[piece] * 1e3, record.case(name, (chosen[0],))[piece], color=color, linewidth=0.7)
        power = np.zeros(len(frequency))
        for case in chosen:
            values = record.case(name, (case,)).astype(float)
            lines = np.fft.rfft((values - values.mean()) * window)[: len(frequency)]
            power += np.abs(2.0 * lines / np.sum(window)) ** 2 / len(chosen)
        below.semilogy(frequency, np.sqrt(power), color=color, linewidth=0.8, label=literal(label))
    above.set_xlabel("Time (ms)")
    below.set_xlabel("Frequency (kHz)")
    for axes, title in ((above, f"{name}: first case of each label"), (below, "Mean spectrum of each label")):
        axes.set_ylabel(literal(unit))
        axes.margins(x=0.01)
        mark_panel(axes, "", literal(title))
    handles, shown = below.get_legend_handles_labels()
    # in a row of its own: beside the curves, and no wider than the figure
    room = int(
        figure.bbox.width / figure.dpi * CHARACTERS / max([len(label) + 6 for label in shown], default=1)
    )
    how = {"ncols": max(1, min(LABELS, room)), "fontsize": 7, "frameon": False}
    figure.legend(handles, shown, loc="outside lower center", **how)
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure


DATA_SET_DRAWINGS = {
    "signals": SweepDrawing("a signal of each label over time, and the mean spectra", signals_figure)
}
