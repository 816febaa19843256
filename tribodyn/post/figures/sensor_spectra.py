"""Signals over time, their amplitudes over the orders of a shaft with the lines named, and along the time."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import INK, PALETTE, QUIET, WIDTH, literal, mark_panel, name_above, new_figure
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SENSORS, Sensed, SensorSignal, read_sensed
from tribodyn.signals.indicators import crest_factor, kurtosis, rms
from tribodyn.signals.lines import MESH, PASS, SHAFT, SignalLine
from tribodyn.signals.resampling import PASSED
from tribodyn.signals.spectra import AmplitudeSpectrum, order_spectrum, spectrogram

#: Signals in a figure, at most.
MOST = 6
#: Samples that a spectrum needs.
FEWEST = 32
#: SI unit of a signal -> that of a figure and the factor to it.
UNITS = {"m/s2": ("m/s²", 1.0), "m": ("µm", 1e6), "rad": ("µrad", 1e6), "N*m": ("N m", 1.0)}


class ShownSignal(NamedTuple):
    """A signal as a figure shows it."""

    signal: SensorSignal
    values: Float[Array, " sample"]  # in `unit`
    unit: str
    name: str  # as figures write it

    @property
    def turning(self) -> float:
        """Mean turns of the reference in a second."""
        turns, time = self.signal.turns, self.signal.time
        return float((turns[-1] - turns[0]) / (time[-1] - time[0]))


def has_signals(record: Record) -> bool:
    """Whether a record holds signals that are long enough for a spectrum."""
    return SENSORS in record.groups and any(len(s.values) >= FEWEST for s in read_sensed(record).signals)


def shown_signals(records: Sequence[Record]) -> tuple[Sensed, list[ShownSignal]]:
    """The signals of the first record that has some; InputError where none has."""
    for record in records:
        sensed = read_sensed(record)
        signals = [_shown(signal) for signal in sensed.signals if len(signal.values) >= FEWEST][:MOST]
        if signals:
            return sensed, signals
    path = str(records[0].path)
    raise InputError("record", path, "holds no signals of sensors", "add a [[sensor]] and run it again")


def _shown(signal: SensorSignal) -> ShownSignal:
    unit, factor = UNITS.get(signal.units, (signal.units, 1.0))
    return ShownSignal(signal, signal.values * factor, unit, literal(signal.name))


def shafts_of(lines: Sequence[SignalLine]) -> list[SignalLine]:
    """Shafts that turn."""
    return [line for line in lines if line.sort == SHAFT and line.order > 0.0]


def toothed(lines: Sequence[SignalLine]) -> list[tuple[SignalLine, list[int]]]:
    """Shafts with the orders of the meshes of their gears, where these are whole."""
    meshes = [line for line in lines if line.sort == MESH]
    shafts = [(shaft, sorted({shaft.teeth_of(mesh) for mesh in meshes} - {0})) for shaft in shafts_of(lines)]
    return [(shaft, teeth) for shaft, teeth in shafts if teeth]


def turns_of(signal: SensorSignal, shaft: SignalLine) -> float:
    """Revolutions of a shaft in a signal."""
    return float(np.ptp(signal.turns)) * shaft.order


_HEIGHT = 1.75
#: Harmonics of the slowest mesh that are shown, and below which part of the highest amplitude nothing is.
_HARMONICS, _FLOOR, _MAP_FLOOR = 5.5, 1e-5, 1e-3
#: Harmonics of a mesh that are marked, at most.
_MOST_LINES = 100
#: Sidebands of every shaft whose places are drawn on either side.
_BESIDE = 3
#: Periods of the slowest mesh in one spectrum of a spectrogram, and spectra at least.
_PERIODS, _PARTS = 24, 40


def sensor_panels(
    records: Sequence[Record], height: float, rows: int, ratios: Sequence[int] = (1,)
) -> tuple[Figure, np.ndarray]:
    """A figure so high (inch) with its panels (row, column); columns of these ratios, of two a wider one."""
    figure = new_figure(WIDTH if len(ratios) == 1 else 1.35 * WIDTH, height)
    figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure, figure.subplots(rows, len(ratios), squeeze=False, width_ratios=ratios)


def signal_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw what every sensor of the first record gave, over time; at the right a turn of the reference."""
    sensed, shown = shown_signals(records)
    figure, rows = sensor_panels(records, _HEIGHT * len(shown) + 0.5, len(shown), (3, 2))
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
    figure, rows = sensor_panels(records, (_HEIGHT + 0.3) * len(shown) + 0.8, len(shown), (5, 4))
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
        axes.set(yscale="log", ylim=(_FLOOR * top, 3.0 * top))


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
    figure, rows = sensor_panels(records, (_HEIGHT + 0.45) * len(shown) + 0.5, len(shown))
    meshes = [line for line in sensed.lines if line.sort == MESH]
    for number, ((axes,), one) in enumerate(zip(rows, shown, strict=True)):
        _draw_map(figure, axes, one, meshes)
        mark_panel(
            axes, _letter(number, len(shown)), f"{one.name} over time and frequency; dotted: mesh orders"
        )
    rows[-1, 0].set_xlabel("Time (ms)")
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
    axes.set(ylim=(0.0, limit * 1e-3), ylabel="Frequency (kHz)")
    axes.grid(False)


def _letter(number: int, count: int) -> str:
    return "abcdefghijkl"[number] if count > 1 else ""
