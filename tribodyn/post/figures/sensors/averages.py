"""Signals averaged over the turns of a shaft, and what is left without the regular mesh."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.sensors.shown_signals import shown_signals, toothed, turns_of
from tribodyn.post.style import PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SENSORS, SensorSignal, read_sensed
from tribodyn.signals.indicators import FLOOR, fm4, rms
from tribodyn.signals.lines import SignalLine
from tribodyn.signals.synchronous import difference, residual, synchronous_average

#: Signals and shafts in a figure, at most, and turns that an average needs.
_SIGNALS, _SHAFTS, _TURNS = 2, 3, 1.0
_HEIGHT = 1.9


def has_turns(record: Record) -> bool:
    """Whether a signal of a record holds a whole turn of a shaft."""
    if SENSORS not in record.groups:
        return False
    sensed = read_sensed(record)
    return any(
        _turned(signal, shaft)
        for signal in sensed.signals
        if len(signal.values) > 1
        for shaft, _ in toothed(sensed.lines)
    )


def _turned(signal: SensorSignal, shaft: SignalLine) -> bool:
    turns = signal.turns * shaft.order
    return np.floor(turns[-1]) - np.ceil(turns[0]) >= _TURNS and turns_of(signal, shaft) >= _TURNS


def average_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw averages of the first record's signals over the turns of its shafts, one panel each."""
    sensed, shown = shown_signals(records)
    pairs = [
        (one, shaft, teeth)
        for one in shown[:_SIGNALS]
        for shaft, teeth in toothed(sensed.lines)[:_SHAFTS]
        if _turned(one.signal, shaft)
    ]
    figure = new_figure(WIDTH, _HEIGHT * max(1, len(pairs)) + 0.8)
    figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    rows = figure.subplots(max(1, len(pairs)), 1, squeeze=False)[:, 0]
    for number, (axes, (one, shaft, teeth)) in enumerate(zip(rows, pairs, strict=True)):
        average = synchronous_average(one.values, one.signal.turns * shaft.order)
        residue, rest = residual(average.values, teeth), difference(average.values, teeth)
        place = np.append(average.turn, 1.0)
        for values, label, color in (
            (average.values - np.mean(average.values), "average", QUIET),
            (residue, "residual: without mesh harmonics", PALETTE[5]),
            (rest, "difference: nor first sidebands", PALETTE[1]),
        ):
            axes.plot(place, np.append(values, values[:1]), color=color, linewidth=0.7, label=label)
        told = f", FM4 {fm4(rest):.3g}" if rms(rest) > FLOOR * rms(average.values) else ""
        name = literal(shaft.name)
        count = f"{average.turns} turns" if average.turns > 1 else "1 turn"
        mark_panel(
            axes, "abcdefgh"[number] if len(pairs) > 1 else "", f"{one.name} over {count} of {name}{told}"
        )
        axes.set_ylabel(f"{one.name} ({one.unit})")
        axes.set_xlim(0.0, 1.0)
        if max(teeth) <= 60:
            axes.set_xticks(np.arange(max(teeth)) / max(teeth), minor=True)
        axes.set_xlabel(f"Turn of {name}; minor ticks: teeth, from where the run began")
    handles, labels = rows[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    return figure
