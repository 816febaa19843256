"""Spectra of the transmission error: of a steady run, and over the orders of the mesh as speed changes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.cycles import (
    CHANGING,
    Spectrum,
    Window,
    amplitude_spectrum,
    by_time,
    last_cycles,
    refuse_by_time,
)
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, name_above, new_figure
from tribodyn.record.reader import Record

#: Orders of the mesh that are shown at least, and where no mode is known.
ORDERS = 12
#: Amplitudes below this part of the highest one are off the scale, of a spectrum and of a map of spectra.
FLOOR, MAP_FLOOR = 1e-5, 1e-3
#: Orders that have a mark, and names of orders above the axes, at most.
MARKED, NAMED = 40, 14
#: Width of a name of a mode, as a share of the axis.
NAME = 0.055
#: Mesh cycles in the window of one spectrum along a run, and between two.
WINDOW, HOP = 16, 4
#: Spectra over a run, at least, where it is long enough.
MOST_HOPPED = 60
#: Orders of the mesh in the map of spectra, and those followed in the panel below it.
SHOWN, FOLLOWED = 8.0, 4


def steady_spectrum(record: Record) -> tuple[Spectrum, Window]:
    """Take the spectrum of the rotational transmission error, m, over the second half of the run.

    The rotational one, because it is one signal for all pairs, without jumps where numbers pass on.
    """
    refuse_by_time(record)
    whole = int(last_cycles(record, None).phase[-1])
    if whole < 1:
        raise record.refused("holds no whole mesh cycle", "run at least one cycle")
    window = last_cycles(record, max(1, whole // 2))
    signal = record["transmission_error_rotational"][window.part]
    return amplitude_spectrum(signal, window.samples_per_cycle), window


def mode_frequencies(record: Record) -> np.ndarray:
    """Natural frequencies that the record's summary holds, Hz; of a record of an older version none."""
    return np.atleast_1d(np.asarray(record.summary.get("mode_frequencies", []), dtype=float))


def has_spectra(record: Record) -> bool:
    """Whether the meshes of a record have spectra: those with names over whole cycles of theirs."""
    if by_time(record):
        return False
    return not record.names_meshes or any(
        "spectrum_amplitudes" in mesh for mesh in record.mesh_summaries.values()
    )


def mesh_spectra(record: Record) -> list[tuple[str, Spectrum, float]]:
    """Name, spectrum (m) over its orders, and frequency (Hz) of every mesh that has one.

    Of a mesh without a name that of `steady_spectrum`, of others that of the cycles at the end of a run that
    means are of. Raises InputError where these are no whole cycles of any mesh.
    """
    if not record.names_meshes:
        spectrum, window = steady_spectrum(record)
        return [("", spectrum, window.mesh_frequency)]
    refuse_by_time(record)
    if not has_spectra(record):
        cycles = int(record.summary.get("averaging_cycles", 0))
        last = f"{cycles} cycle{'s' if cycles != 1 else ''}"
        rule = f"{record.path} has no whole cycles of a mesh in its last {last}"
        remedy = f"run more: solver.cycles = {2 * int(record.summary.get('common_period', 1))}"
        raise InputError("plot", "spectrum", rule, remedy)
    found = []
    for name, mesh in record.mesh_summaries.items():
        if "spectrum_amplitudes" in mesh:
            frequency = float(mesh["mesh_frequency"])
            orders = np.asarray(mesh["spectrum_frequencies"]) / frequency
            # whole orders are whole but for rounding
            orders = np.where(np.abs(orders - np.round(orders)) < 1e-6, np.round(orders), orders)
            amplitudes = np.asarray(mesh["spectrum_amplitudes"])
            found.append((literal(name), Spectrum(orders, amplitudes), frequency))
    return found


def apart(places: np.ndarray, least: float) -> list[tuple[float, str]]:
    """Numbers from 1 of ascending places and where to write them; those closer than `least` as a range."""
    groups: list[list[int]] = []
    for number, place in enumerate(places):
        if groups and place - places[groups[-1][-1]] < least:
            groups[-1].append(number)
        else:
            groups.append([number])
    ends = [dict.fromkeys((group[0] + 1, group[-1] + 1)) for group in groups]
    return [
        (float(np.mean(places[group])), "–".join(map(str, of)))
        for group, of in zip(groups, ends, strict=True)
    ]


def draw_orders(
    axes: Axes, spectrum: Spectrum, mesh: float, modes: np.ndarray, color: str
) -> tuple[float, float]:
    """Draw a spectrum over frequency, `mesh` that of the mesh, Hz, as far as the `modes` reach; see above."""
    # orders up to a little above the highest mode, and at most those that the sampling resolves
    wanted = 1.08 * float(modes.max()) / mesh if modes.size else 0.0
    limit = min(max(wanted, ORDERS + 0.5), float(spectrum.orders[-1]))
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
        name_above(axes, places[order - 1], text, 0)
    return float(orders.max(initial=0.0)), limit * mesh * 1e-3


def draw_modes(axes: Axes, modes: np.ndarray, width: float) -> None:
    """Draw natural frequencies (Hz, ascending) as lines on an axis of so many kHz, named above it."""
    seen = modes[modes * 1e-3 <= width] * 1e-3
    for frequency in seen:
        axes.axvline(frequency, color=PALETTE[3], linewidth=0.9, linestyle=(0, (4, 2)), zorder=1)
    for place, numbers in apart(seen, NAME * width):
        name_above(axes, place, f"mode {numbers}", 1, PALETTE[3])


def spectrum_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the spectrum of each mesh of each record on axes of its own with common limits.

    The view does not matter, see `mesh_spectra`.
    """
    shown = [(record, *mesh) for record in records for mesh in mesh_spectra(record)]
    count = len(shown)
    figure = new_figure(WIDTH, count * (PANEL_HEIGHT + 0.1) + 0.5)
    rows = figure.subplots(count, 1, squeeze=False, sharex=True, sharey=True)[:, 0]
    highest = width = 0.0
    for number, (axes, (record, name, spectrum, mesh)) in enumerate(zip(rows, shown, strict=True)):
        color = PALETTE[number % len(PALETTE)]
        top, right = draw_orders(axes, spectrum, mesh, mode_frequencies(record), color)
        highest, width = max(highest, top), max(width, right)
        named = ", ".join(filter(None, (record_label(record) if len(records) > 1 else "", name)))
        head = f"{named}: amplitudes" if named else "Amplitudes"
        title = f"{head} of the transmission error, mesh frequency $f_m$ = {mesh:.4g} Hz"
        mark_panel(axes, "abcdefgh"[number] if 1 < count <= 8 else "", title, 2)
        axes.set_ylabel("Amplitude (µm)")
    for axes, (record, *_) in zip(rows, shown, strict=True):
        draw_modes(axes, mode_frequencies(record), width)
    rows[-1].set_yscale("log")
    if highest > 0:
        rows[-1].set_ylim(FLOOR * highest, 2 * highest)
    rows[-1].set_xlim(0, width)
    beyond = any(modes.size and modes.max() * 1e-3 > width for modes in map(mode_frequencies, records))
    higher = "; higher ones are above half the sampling rate" if beyond else ""
    rows[-1].set_xlabel(f"Frequency (kHz); dashed: natural frequencies at the mean mesh stiffness{higher}")
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure


class Track(NamedTuple):
    """Spectra along a run."""

    speed: np.ndarray  # (n,); mean pinion speed in each window, rad/s
    time: np.ndarray  # (n,); at its middle, s
    orders: np.ndarray  # (m,); orders of the mesh
    amplitudes: np.ndarray  # (n, m); of the rotational transmission error, m


def worth_tracking(record: Record) -> bool:
    """Whether a run is long enough, and its speed changes enough, for its orders to be tracked."""
    if by_time(record):
        return False
    whole = last_cycles(record, None) if record.samples > 1 else None
    if whole is None or whole.phase[-1] < 2 * WINDOW:
        return False
    speed = record.over_bodies("speed")[:, 0]
    return float(np.ptp(speed)) > CHANGING * float(np.mean(speed))


def track(record: Record) -> Track:
    """Take spectra of windows of whole mesh cycles, tapered by Hann's window, along the whole run.

    Samples are uniform in the phase of the mesh, so that an order is a line whatever the speed does; a line's
    amplitude is that of the cosine, the window's mean taken out. Raises InputError below two windows.
    """
    refuse_by_time(record)
    whole = last_cycles(record, None)
    per_cycle = whole.samples_per_cycle
    count = round(whole.phase[-1]) - WINDOW
    size, step = WINDOW * per_cycle, min(HOP, max(1, count // MOST_HOPPED)) * per_cycle
    signal = record.over_meshes("transmission_error_rotational")[whole.part, 0]
    if signal.size < 2 * size:
        raise _too_few(record, round(whole.phase[-1]))
    starts = np.arange(0, signal.size - size, step)
    part = starts[:, None] + np.arange(size)
    taper = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(size) / size)
    windows = signal[part]
    windows = windows - windows.mean(axis=1, keepdims=True)
    amplitudes = 2 * np.abs(np.fft.rfft(windows * taper, axis=1)) / taper.sum()
    orders = np.arange(amplitudes.shape[1]) / WINDOW
    keep = orders <= SHOWN + 1e-9
    speed, time = record.over_bodies("speed")[whole.part, 0], record["time"][whole.part]
    return Track(speed[part].mean(axis=1), time[part].mean(axis=1), orders[keep], amplitudes[:, keep])


def _too_few(record: Record, kept: int) -> InputError:
    """What to say of a record whose cycles are too few, which may be a part of those that were run."""
    ran = max(kept, int(record.summary.get("cycles_done", kept)))
    of, remedies = "", []
    by_turns = record.scenario.get("solver", {}).get("revolutions") is not None
    if ran < 2 * WINDOW:
        first = record.of_mesh(record.meshes[0], "mesh_cycle")
        turns = -(-800 // int(first["pinion_teeth"]))
        longer = f"solver.revolutions = {turns}" if by_turns else "solver.cycles = 800"
        remedies.append(f"run at least {2 * WINDOW}: {longer}")
    if ran > kept or by_turns:
        remedies.append('keep all samples: output.window = "all"')
    if ran > kept:
        of = f" of the {ran} that were run"
    rule = f"holds {kept} mesh cycles{of}, too few to track orders"
    return record.refused(rule, ", and ".join(remedies))


def orders_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the spectrogram of the first record over its speed, or time, and the orders of the mesh below.

    Over time too where the speed does not keep rising.
    """
    record = records[0]
    tracked = track(record)
    over_time = (view.chosen and view.against == "time") or not np.all(np.diff(tracked.speed) > 0)
    x = tracked.time * 1e3 if over_time else tracked.speed * 30 / np.pi
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 0.6)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    _draw_map(figure, above, x, tracked)
    for order in range(1, FOLLOWED + 1):
        line = tracked.amplitudes[:, order * WINDOW] * 1e6
        below.plot(x, line, color=PALETTE[order - 1], label=f"order {order}")
    below.set(ylabel="Amplitude (µm)", ylim=(0, None))
    of = "Speed of the first body" if record.names_meshes else "Pinion speed"
    below.set_xlabel("Time (ms)" if over_time else f"{of} (rpm)")
    below.legend(ncols=2)
    over = "time" if over_time else "the speed"
    mark_panel(above, "a", f"Amplitudes of the transmission error over its order and {over}")
    mark_panel(below, "b", f"Orders 1 to {FOLLOWED} of the mesh (1: the mesh frequency)")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


def _draw_map(figure: Figure, axes: Axes, x: np.ndarray, tracked: Track) -> None:
    maximum = float(tracked.amplitudes.max()) * 1e6
    norm = LogNorm(MAP_FLOOR * maximum, maximum) if maximum > 0 else None
    shown = np.maximum(tracked.amplitudes.T * 1e6, MAP_FLOOR * maximum)
    image = axes.pcolormesh(
        x, tracked.orders, shown, norm=norm, cmap="viridis", shading="nearest", rasterized=True
    )
    axes.set_ylabel("Order of the mesh (–)")
    axes.grid(False)
    figure.colorbar(image, ax=axes, label="Transmission error (µm)", pad=0.02)
