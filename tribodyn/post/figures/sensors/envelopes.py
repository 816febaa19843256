"""Which band of a signal is impulsive, and how often: kurtogram and spectrum of the envelope."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.sensors.shown_signals import ShownSignal, shown_signals
from tribodyn.post.figures.sensors.spectra import line_colors
from tribodyn.post.style import PALETTE, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed
from tribodyn.signals.envelopes import Band, Kurtogram, envelope_spectrum, kurtogram
from tribodyn.signals.lines import MESH

#: Signals in a figure, at most; lines of the envelope are drawn up to so many mesh frequencies.
_SIGNALS, _MESHES = 3, 2.3
_HEIGHT = 2.3


def envelope_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw kurtogram and envelope spectrum of the first record's signals, side by side."""
    sensed, shown = shown_signals(records)
    shown = shown[:_SIGNALS]
    figure = new_figure(1.35 * WIDTH, _HEIGHT * len(shown) + 0.6)
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
