"""Signals averaged over the turns of a shaft, what is left without the regular mesh, and envelopes.

Of an envelope: which band of a signal is impulsive, and how often.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.sensors.shown_signals import ShownSignal, shown_signals, toothed, turns_of
from tribodyn.post.figures.sensors.spectra import line_colors
from tribodyn.post.style import PALETTE, QUIET, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SENSORS, Sensed, SensorSignal, read_sensed
from tribodyn.signals.envelopes import Band, Kurtogram, envelope_spectrum, kurtogram
from tribodyn.signals.indicators import FLOOR, fm4, rms
from tribodyn.signals.lines import MESH, SignalLine
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


#: Signals in a figure of envelopes, at most; their lines are drawn up to so many mesh frequencies.
_ENVELOPES, _MESHES = 3, 2.3
_ENVELOPE_HEIGHT = 2.3


def envelope_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw kurtogram and envelope spectrum of the first record's signals, side by side."""
    sensed, shown = shown_signals(records)
    shown = shown[:_ENVELOPES]
    figure = new_figure(1.35 * WIDTH, _ENVELOPE_HEIGHT * len(shown) + 0.6)
    figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    rows = figure.subplots(len(shown), 2, squeeze=False, width_ratios=(2, 3))
    for number, ((left, right), one) in enumerate(zip(rows, shown, strict=True)):
        bands = kurtogram(one.values, one.signal.rate)
        band, most = bands.best()
        _draw_kurtogram(figure, left, bands, band)
        mark_panel(left, "ace"[number], f"Kurtogram of {one.name}, most {most:.3g}")
        _draw_envelope(right, one, band, sensed)
        within = f"{band[0] * 1e-3:.3g} to {band[1] * 1e-3:.3g} kHz"
        mark_panel(right, "bdf"[number], f"Envelope of {one.name} within {within}")
    return figure


def _draw_kurtogram(figure: Figure, axes: Axes, bands: Kurtogram, band: Band) -> None:
    finest = max(len(row) for row in bands.values)
    count = int(np.lcm.reduce([len(row) for row in bands.values])) if finest < 400 else finest
    image = np.stack([np.repeat(row, count // len(row)) for row in bands.values])
    top = bands.widths[0] * 1e-3
    picture = axes.imshow(
        image,
        aspect="auto",
        extent=(0.0, top, len(bands.values) - 0.5, -0.5),
        cmap="viridis",
        interpolation="nearest",
    )
    axes.set_yticks(range(len(bands.widths)), [f"{width:.0f}" for width in bands.widths])
    axes.set_ylabel("Width of the bands (Hz)")
    axes.set_xlabel("Frequency (kHz)")
    level = int(np.argmin(np.abs(np.asarray(bands.widths) - (band[1] - band[0]))))
    corner, size = (band[0] * 1e-3, level - 0.5), ((band[1] - band[0]) * 1e-3, 1.0)
    axes.add_patch(Rectangle(corner, *size, fill=False, edgecolor="white", linewidth=1.0))
    axes.grid(False)
    figure.colorbar(picture, ax=axes, pad=0.02)


def _draw_envelope(axes: Axes, one: ShownSignal, band: Band, sensed: Sensed) -> None:
    envelope = envelope_spectrum(one.values, one.signal.rate, band)
    highest = max((line.order for line in sensed.lines if line.sort == MESH), default=1.0)
    limit = min(_MESHES * highest * one.turning, band[1] - band[0])
    shown = (envelope.frequencies > 2.5 * envelope.step) & (envelope.frequencies <= limit)
    axes.plot(envelope.frequencies[shown], envelope.amplitudes[shown], color=PALETTE[0], linewidth=0.7)
    for line, color in line_colors(sensed.lines).items():
        place = line.order * one.turning
        if 2.0 * envelope.step < place <= limit:
            label = literal(line.name)
            axes.axvline(place, color=color, linewidth=0.8, linestyle=(0, (4, 2)), zorder=0, label=label)
    axes.legend(loc="upper right")
    axes.set_xlim(0.0, limit)
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel("Frequency (Hz)")
    axes.set_ylabel(f"Envelope ({one.unit})")
