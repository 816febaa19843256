"""Spectrum of the transmission error, orders of the mesh and natural frequencies marked."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.cycles import Window, last_cycles
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.spectra import Spectrum, amplitude_spectrum
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, QUIET, ROW, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record

#: Orders of the mesh that are shown at least, and where no mode is known.
ORDERS = 12
#: Lines below this part of the highest one are off the scale.
FLOOR = 1e-5
#: Orders that have a mark, and names of orders above the axes, at most.
MARKED, NAMED = 40, 14


def steady_spectrum(record: Record) -> tuple[Spectrum, Window]:
    """Take the spectrum of the rotational transmission error, m, over the second half of the run.

    The rotational one, because it is one signal for all pairs, without jumps where numbers pass on.
    """
    whole = int(last_cycles(record, None).phase[-1])
    if whole < 1:
        raise InputError("record", str(record.path), "holds no whole mesh cycle", "run at least one cycle")
    window = last_cycles(record, max(1, whole // 2))
    signal = record["transmission_error_rotational"][window.part]
    return amplitude_spectrum(signal, window.samples_per_cycle), window


def mode_frequencies(record: Record) -> np.ndarray:
    """Natural frequencies that the record's summary holds, Hz; of a record of an older version none."""
    return np.atleast_1d(np.asarray(record.summary.get("mode_frequencies", []), dtype=float))


def _orders_shown(record: Record, mesh: float, spectrum: Spectrum) -> float:
    """Orders up to a little above the highest mode, and at most those that the sampling resolves."""
    modes = mode_frequencies(record)
    wanted = 1.08 * float(modes.max()) / mesh if modes.size else 0.0
    return min(max(wanted, ORDERS + 0.5), float(spectrum.orders[-1]))


def draw_spectrum(axes: Axes, record: Record, color: str) -> tuple[float, float]:
    """Draw amplitude (µm) over frequency (kHz), orders as stems; highest amplitude and frequency."""
    spectrum, window = steady_spectrum(record)
    mesh = window.mesh_frequency
    limit = _orders_shown(record, mesh, spectrum)
    amplitudes = np.abs(spectrum.amplitudes) * 1e6
    shown = (spectrum.orders > 0) & (spectrum.orders <= limit)
    axes.plot(spectrum.orders[shown] * mesh * 1e-3, amplitudes[shown], color=color, linewidth=0.7, alpha=0.4)
    count = int(limit)
    orders = spectrum.harmonics(count) * 1e6
    places = np.arange(1, count + 1) * mesh * 1e-3
    axes.vlines(places, np.finfo(float).tiny, orders, color=color, linewidth=1.2 if count <= MARKED else 0.7)
    if count <= MARKED:
        axes.plot(places, orders, linestyle="none", marker="o", markersize=4, color=color)
    step = -(-count // NAMED)
    for order in range(1 if step == 1 else step, count + 1, step):
        text = "$f_m$" if order == 1 else f"{order}$f_m$"
        _above(axes, places[order - 1], text, 0)
    for number, frequency in enumerate(mode_frequencies(record), start=1):
        if frequency <= limit * mesh:
            axes.axvline(frequency * 1e-3, color=PALETTE[3], linewidth=0.9, linestyle=(0, (4, 2)), zorder=1)
            _above(axes, frequency * 1e-3, f"mode {number}", 1, PALETTE[3])
    return float(orders.max(initial=0.0)), limit * mesh * 1e-3


def _above(axes: Axes, place: float, text: str, row: int, color: str = QUIET) -> None:
    axes.annotate(
        text,
        (place, 1),
        xycoords=("data", "axes fraction"),
        xytext=(0, 3 + ROW * row),
        textcoords="offset points",
        ha="center",
        fontsize=6.5,
        color=color,
    )


def spectrum_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the spectrum of each record on axes of its own with common limits; the view does not matter.

    The second half of a run is used.
    """
    count = len(records)
    figure = new_figure(WIDTH, count * (PANEL_HEIGHT + 0.1) + 0.5)
    rows = figure.subplots(count, 1, squeeze=False, sharex=True, sharey=True)[:, 0]
    highest = width = 0.0
    for number, (axes, record) in enumerate(zip(rows, records, strict=True)):
        top, right = draw_spectrum(axes, record, PALETTE[number % len(PALETTE)])
        highest, width = max(highest, top), max(width, right)
        mesh = steady_spectrum(record)[1].mesh_frequency
        named = "" if count == 1 else f"{record_label(record)}: "
        title = f"{named}Amplitudes of the transmission error, mesh frequency $f_m$ = {mesh:.4g} Hz"
        mark_panel(axes, "abcdefgh"[number] if 1 < count <= 8 else "", title, 2)
        axes.set_ylabel("Amplitude (µm)")
    rows[-1].set_yscale("log")
    if highest > 0:
        rows[-1].set_ylim(FLOOR * highest, 2 * highest)
    rows[-1].set_xlim(0, width)
    beyond = any(modes.size and modes.max() * 1e-3 > width for modes in map(mode_frequencies, records))
    said = "; higher ones are above half the sampling rate" if beyond else ""
    rows[-1].set_xlabel(f"Frequency (kHz); dashed: natural frequencies at the mean mesh stiffness{said}")
    if count == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure
