"""Spectrum of the transmission error, harmonics of the mesh marked."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.cycles import Window, last_cycles
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.spectra import Spectrum, amplitude_spectrum
from tribodyn.post.style import PALETTE, QUIET, WIDTH, new_figure
from tribodyn.record.reader import Record

#: How many harmonics of the mesh are shown: beyond, gears of usual stiffness answer no more.
HARMONICS = 12
#: Lines below this part of the highest one are off the scale.
FLOOR = 1e-4


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


def draw_spectrum(axes: Axes, records: Sequence[Record]) -> None:
    """Draw amplitude (µm) over frequency (Hz), the harmonics as stems."""
    highest, width = 0.0, 0.0
    for number, record in enumerate(records):
        spectrum, window = steady_spectrum(record)
        color = PALETTE[number % len(PALETTE)]
        mesh = window.mesh_frequency
        amplitudes = np.abs(spectrum.amplitudes) * 1e6
        shown = (spectrum.orders > 0) & (spectrum.orders <= HARMONICS + 0.5)
        axes.plot(spectrum.orders[shown] * mesh, amplitudes[shown], color=color, linewidth=0.8, alpha=0.45)
        harmonics = spectrum.harmonics(HARMONICS) * 1e6
        places = np.arange(1, HARMONICS + 1) * mesh
        tiny = np.finfo(float).tiny
        # of later records larger and hollow, so that equal amplitudes still show both
        axes.vlines(places, tiny, harmonics, color=color, linewidth=1.2, zorder=2.5 - 0.1 * number)
        axes.plot(
            places,
            harmonics,
            linestyle="none",
            marker="os^Dv"[number % 5],
            markersize=4 + 2.5 * number,
            markeredgecolor=color,
            markerfacecolor="none" if number else color,
            label=f"{record_label(record)}, mesh frequency {mesh:.4g} Hz",
        )
        highest, width = max(highest, harmonics.max()), max(width, (HARMONICS + 0.5) * mesh)
        if number == 0:
            _name_harmonics(axes, places)
    axes.set_yscale("log")
    if highest > 0:
        axes.set_ylim(FLOOR * highest, 2 * highest)
    axes.set_xlim(0, width)
    axes.set_xlabel("Frequency (Hz)")
    axes.set_ylabel("Transmission error (µm)")


def _name_harmonics(axes: Axes, places: np.ndarray) -> None:
    for order, place in enumerate(places, start=1):
        axes.annotate(
            "$f_m$" if order == 1 else f"{order}$f_m$",
            (place, 1),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=7,
            color=QUIET,
        )


def spectrum_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the spectrum of each record; the view's cycles do not matter, the second half of a run is used."""
    figure = new_figure(WIDTH, 2.9)
    axes = figure.subplots()
    draw_spectrum(axes, records)
    figure.legend(loc="outside lower center", ncols=2)
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure
