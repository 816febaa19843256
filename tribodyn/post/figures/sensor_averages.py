"""Signals averaged over the turns of a shaft, what is left without the regular mesh, and envelopes.

Of an envelope: which band of a signal is impulsive, and how often.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import View
from tribodyn.post.figures.sensor_spectra import (
    ShownSignal,
    has_signals,
    line_colors,
    order_spectrum_figure,
    sensor_panels,
    shown_signals,
    signal_figure,
    spectrogram_figure,
    toothed,
    turns_of,
)
from tribodyn.post.style import PALETTE, QUIET, literal, mark_panel
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SENSORS, Sensed, SensorSignal, read_sensed
from tribodyn.signals.indicators import FLOOR, difference, fm4, residual, rms, synchronous_average
from tribodyn.signals.lines import MESH, SignalLine
from tribodyn.signals.spectra import Band, Kurtogram, envelope_spectrum, kurtogram

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
    count = max(1, len(pairs))
    figure, rows = sensor_panels(records, _HEIGHT * count + 0.8, count)
    for number, ((axes,), (one, shaft, teeth)) in enumerate(zip(rows, pairs, strict=True)):
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
        turns = f"{average.turns} turns" if average.turns > 1 else "1 turn"
        letter = "abcdefgh"[number] if len(pairs) > 1 else ""
        mark_panel(axes, letter, f"{one.name} over {turns} of {name}{told}")
        axes.set(ylabel=f"{one.name} ({one.unit})", xlim=(0.0, 1.0))
        if max(teeth) <= 60:
            axes.set_xticks(np.arange(max(teeth)) / max(teeth), minor=True)
        axes.set_xlabel(f"Turn of {name}; minor ticks: teeth, from where the run began")
    figure.legend(*rows[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


#: Signals in a figure of envelopes, at most; their lines are drawn up to so many mesh frequencies.
_ENVELOPES, _MESHES = 3, 2.3
_ENVELOPE_HEIGHT = 2.3


def envelope_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw kurtogram and envelope spectrum of the first record's signals, side by side."""
    sensed, shown = shown_signals(records)
    shown = shown[:_ENVELOPES]
    figure, rows = sensor_panels(records, _ENVELOPE_HEIGHT * len(shown) + 0.6, len(shown), (2, 3))
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
    axes.set(ylabel="Width of the bands (Hz)", xlabel="Frequency (kHz)")
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
    axes.set(xlim=(0.0, limit), ylim=(0.0, None), xlabel="Frequency (Hz)", ylabel=f"Envelope ({one.unit})")


#: Pictures of sensors by name, in the order of a page.
DRAWINGS: dict[str, Drawing] = {
    "signals": Drawing("what every sensor gave", signal_figure, has_signals),
    "order-spectrum": Drawing(
        "amplitudes of signals over the orders of a shaft, lines named", order_spectrum_figure, has_signals
    ),
    "spectrogram": Drawing(
        "spectra along the signals, with the orders of the meshes drawn in", spectrogram_figure, has_signals
    ),
    "synchronous-average": Drawing(
        "signals averaged over the turns of a shaft, and what regular teeth leave", average_figure, has_turns
    ),
    "envelope": Drawing(
        "kurtogram of signals, and the spectrum of the envelope of their most impulsive band",
        envelope_figure,
        has_signals,
    ),
}
