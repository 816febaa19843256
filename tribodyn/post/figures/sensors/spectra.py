"""Signals over time, their amplitudes over the orders of a shaft with the lines named, and along the time."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.sensors.shown_signals import ShownSignal, shown_signals
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, name_above, new_figure
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed
from tribodyn.signals.indicators import crest_factor, kurtosis, rms
from tribodyn.signals.lines import MESH, PASS, SHAFT, SignalLine
from tribodyn.signals.resampling import PASSED
from tribodyn.signals.spectra import AmplitudeSpectrum, order_spectrum, spectrogram

_HEIGHT = 1.75
#: Harmonics of the slowest mesh that are shown, and below which part of the highest amplitude nothing is.
_HARMONICS, _FLOOR, _MAP_FLOOR = 5.5, 1e-5, 1e-3
#: Harmonics of a mesh that are marked, at most.
_MOST_LINES = 100
#: Sidebands of every shaft whose places are drawn on either side.
_BESIDE = 3
#: Periods of the slowest mesh in one spectrum of a spectrogram, and spectra at least.
_PERIODS, _PARTS = 24, 40


def signal_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw what every sensor of the first record gave, over time; at the right a turn of the reference."""
    sensed, shown = shown_signals(records)
    figure = new_figure(1.35 * WIDTH, _HEIGHT * len(shown) + 0.5)
    figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    rows = figure.subplots(len(shown), 2, squeeze=False, width_ratios=(3, 2))
    for number, ((whole, last), one) in enumerate(zip(rows, shown, strict=True)):
        time, turns = one.signal.time * 1e3, one.signal.turns
        whole.plot(time, one.values, color=PALETTE[0], linewidth=0.5)
        whole.set_ylabel(f"{one.name} ({one.unit})")
        about = literal(one.signal.about).partition(",")[0]
        mark_panel(whole, _letter(2 * number, 2 * len(shown)), f"{about[:1].upper()}{about[1:]}")
        part = turns >= turns[-1] - 1.0
        last.plot(time[part], one.values[part], color=PALETTE[0], linewidth=0.7)
        told = f"RMS {rms(one.values):.4g}"
        if rms(one.values) > 0.0:
            shape = f"crest factor {crest_factor(one.values):.3g}, kurtosis {kurtosis(one.values):.3g}"
            told = f"{told}, {shape}"
        mark_panel(last, _letter(2 * number + 1, 2 * len(shown)), told)
    rows[-1][0].set_xlabel("Time (ms)")
    rows[-1][1].set_xlabel(f"Time (ms), the last turn of {literal(sensed.reference)}")
    return figure


def order_spectrum_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw amplitudes of the first record's signals over orders of its reference shaft, lines named.

    At the right what lies beside the highest harmonic of a mesh.
    """
    sensed, shown = shown_signals(records)
    figure = new_figure(1.35 * WIDTH, (_HEIGHT + 0.3) * len(shown) + 0.8)
    figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    rows = figure.subplots(len(shown), 2, squeeze=False, width_ratios=(5, 4))
    colors = line_colors([line for line in sensed.lines if line.sort in (SHAFT, PASS)])
    for number, ((left, right), one) in enumerate(zip(rows, shown, strict=True)):
        spectrum = order_spectrum(one.values, one.signal.turns)
        strongest = _draw_orders(left, spectrum, sensed, one)
        left.set_ylabel(f"{one.name} ({one.unit})")
        mark_panel(left, _letter(2 * number, 2 * len(shown)), f"Amplitudes of {one.name}", 1)
        label = _draw_sidebands(right, spectrum, strongest, colors)
        mark_panel(right, _letter(2 * number + 1, 2 * len(shown)), f"Beside {label}", 1)
    for axes in rows[-1]:
        axes.set_xlabel(f"Order (cycles per turn of {literal(sensed.reference)})")
    handles, labels = rows[0][1].get_legend_handles_labels()
    if handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure


def _draw_orders(
    axes: Axes, spectrum: AmplitudeSpectrum, sensed: Sensed, one: ShownSignal
) -> tuple[SignalLine, int]:
    """Draw a spectrum with the harmonics of the meshes; returns the highest of them, a mesh and a number."""
    meshes = [line for line in sensed.lines if line.sort == MESH]
    beyond = PASSED * one.signal.rate / one.turning
    limit = min(_HARMONICS * max((line.order for line in meshes), default=beyond), beyond)
    shown = (spectrum.frequencies > 0.0) & (spectrum.frequencies <= limit)
    axes.plot(spectrum.frequencies[shown], spectrum.amplitudes[shown], color=PALETTE[0], linewidth=0.7)
    _logarithmic(axes, spectrum.amplitudes[shown])
    axes.set_xlim(0.0, limit)
    strongest, most = (meshes[0], 1), -1.0
    for line in meshes:
        for k in range(1, min(int(limit / line.order + 1e-9), _MOST_LINES) + 1):
            axes.axvline(k * line.order, color=QUIET, linewidth=0.6, linestyle=(0, (3, 3)), zorder=0)
            if k == 1 or len(meshes) == 1:
                name_above(axes, k * line.order, literal(line.name) if k == 1 else f"{k}×", 0)
            if spectrum.at(k * line.order) > most:
                strongest, most = (line, k), spectrum.at(k * line.order)
    return strongest


def _draw_sidebands(
    axes: Axes, spectrum: AmplitudeSpectrum, strongest: tuple[SignalLine, int], colors: dict[SignalLine, str]
) -> str:
    """Draw what lies beside a harmonic of a mesh, with the places of the sidebands; returns its name."""
    line, k = strongest
    middle = k * line.order
    width = max(
        (_BESIDE + 0.5) * max((modulation.order for modulation in colors), default=1.0), 20.0 * spectrum.step
    )
    width = min(width, 0.5 * line.order)
    shown = np.abs(spectrum.frequencies - middle) <= width
    for modulation, color in colors.items():
        label: str | None = f"± n × {literal(modulation.name)}"
        for n in (*range(-_BESIDE, 0), *range(1, _BESIDE + 1)):
            place = middle + n * modulation.order
            if abs(place - middle) <= width:
                axes.axvline(place, color=color, linewidth=0.8, linestyle=(0, (4, 2)), zorder=0, label=label)
                label = None
    axes.axvline(middle, color=QUIET, linewidth=0.8, zorder=0)
    axes.plot(spectrum.frequencies[shown], spectrum.amplitudes[shown], color=PALETTE[0], linewidth=0.9)
    _logarithmic(axes, spectrum.amplitudes[shown])
    axes.set_xlim(middle - width, middle + width)
    label = literal(line.name) if k == 1 else f"{k} × {literal(line.name)}"
    name_above(axes, middle, label, 0)
    return label


def _logarithmic(axes: Axes, amplitudes: np.ndarray) -> None:
    top = float(np.max(amplitudes, initial=0.0))
    if top > 0.0:
        axes.set_yscale("log")
        axes.set_ylim(_FLOOR * top, 3.0 * top)


def line_colors(lines: Sequence[SignalLine]) -> dict[SignalLine, str]:
    """Colours by which lines are told apart, those that turn, equal ones once."""
    by_order: dict[float, SignalLine] = {}
    for line in lines:
        if line.order > 0.0:
            by_order.setdefault(round(line.order, 9), line)
    colors = (*PALETTE[1:6], INK)
    return dict(zip(by_order.values(), colors, strict=False))


def spectrogram_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw spectra along the first record's signals, with the orders of its meshes as they turn."""
    sensed, shown = shown_signals(records)
    figure, rows = _rows(len(shown), records, 0.45)
    meshes = [line for line in sensed.lines if line.sort == MESH]
    for number, (axes, one) in enumerate(zip(rows, shown, strict=True)):
        _draw_map(figure, axes, one, meshes)
        mark_panel(
            axes, _letter(number, len(shown)), f"{one.name} over time and frequency; dotted: mesh orders"
        )
    rows[-1].set_xlabel("Time (ms)")
    return figure


def _draw_map(figure: Figure, axes: Axes, one: ShownSignal, meshes: Sequence[SignalLine]) -> None:
    rate, count = one.signal.rate, len(one.values)
    slowest = min((line.order for line in meshes), default=1.0) * one.turning
    length = int(np.clip(_PERIODS * rate / slowest, 16, max(16, count // 8)))
    spectra = spectrogram(one.values, rate, min(length, count), max(1, min(length // 4, count // _PARTS)))
    highest = max((line.order for line in meshes), default=1.0)
    speed = np.gradient(one.signal.turns, one.signal.time)
    limit = min(_HARMONICS * highest * float(np.max(speed)), PASSED * rate)
    keep = spectra.frequencies <= limit
    time = (one.signal.time[0] + spectra.time) * 1e3
    top = float(np.max(spectra.amplitudes[:, keep]))
    norm = LogNorm(_MAP_FLOOR * top, top) if top > 0.0 else None
    values = np.maximum(spectra.amplitudes[:, keep].T, _MAP_FLOOR * top)
    if len(time) > 1:
        image = axes.pcolormesh(
            time,
            spectra.frequencies[keep] * 1e-3,
            values,
            norm=norm,
            cmap="viridis",
            shading="nearest",
            rasterized=True,
        )
        figure.colorbar(image, ax=axes, label=one.unit, pad=0.02)
    turning = np.interp(time * 1e-3, one.signal.time, speed)
    for line in meshes:
        for k in range(1, int(_HARMONICS) + 1):
            over = k * line.order * turning * 1e-3
            if len(over) and np.min(over) < limit * 1e-3:
                axes.plot(time, over, color="white", linewidth=0.8, linestyle=(0, (1, 3)))
                axes.annotate(
                    literal(line.name) if k == 1 else f"{k}×",
                    (time[0], over[0]),
                    xytext=(2, 1),
                    textcoords="offset points",
                    color="white",
                    fontsize=5.5,
                )
    axes.set_ylim(0.0, limit * 1e-3)
    axes.set_ylabel("Frequency (kHz)")
    axes.grid(False)


def _letter(number: int, count: int) -> str:
    return "abcdefghijkl"[number] if count > 1 else ""


def _rows(count: int, records: Sequence[Record], more: float = 0.0) -> tuple[Figure, list[Axes]]:
    figure = new_figure(WIDTH, (_HEIGHT + more) * count + 0.5)
    figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure, list(figure.subplots(count, 1, squeeze=False)[:, 0])
