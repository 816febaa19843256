"""Spectra of the cases over a parameter: the Campbell diagram and the waterfall.

The Campbell diagram draws natural frequencies and orders of the mesh over the speed, and the answer at the
orders. In the waterfall a line of the spectrum is a mark at its frequency, coloured by its amplitude.
"""

from collections.abc import Mapping, Sequence
from string import ascii_lowercase
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.errors import InputError
from tribodyn.post.cycles import Spectrum, amplitude_spectrum
from tribodyn.post.figures.spectrum import apart
from tribodyn.post.figures.sweep_branch import Branch, axis_label, chosen_branch, sweep_title
from tribodyn.post.style import (
    INK,
    PALETTE,
    QUIET,
    WIDTH,
    literal,
    mark_panel,
    name_above,
    new_figure,
    write_beside,
)
from tribodyn.record.sweep_reader import SweepRecord, sweeps_of_meshes

#: Orders of the mesh that the Campbell diagram draws, and that the waterfall shows at least.
RAYS, LEAST_ORDERS = 6, 4
#: Area of the largest marker, square points.
LARGEST_AREA = 160.0
#: Share of the height between the names of two modes, at least.
NAMES_APART = 0.035
#: Amplitudes below this share of the highest are not shown: 60 dB.
LOWEST = 10 ** (-60.0 / 20)


def spectra(branch: Branch) -> list[Spectrum | None]:
    """Spectrum, m over orders of its mesh, of every case; None without a window, InputError if nowhere."""
    size = branch.record.samples_per_cycle
    windows = [window[np.isfinite(window)] for window in branch.values("transmission_error_rotational")]
    rates = branch.values("mesh_frequency") / branch.of_first_mesh("mesh_frequency")
    results = [
        _over_own_orders(amplitude_spectrum(window, size), rate) if window.size >= size else None
        for window, rate in zip(windows, rates, strict=True)
    ]
    if not any(results):
        raise InputError("record", str(branch.record.path), "no case is done", "wait, or sweep again")
    return results


def _over_own_orders(spectrum: Spectrum, rate: float) -> Spectrum:
    """A spectrum over orders of a mesh with so many cycles to one of the first mesh."""
    orders = spectrum.orders / rate
    whole = np.round(orders)  # whole orders are whole but for rounding
    return spectrum._replace(orders=np.where(np.abs(orders - whole) < 1e-6 * rate, whole, orders))


def order_amplitudes(branch: Branch, orders: int) -> np.ndarray:
    """Amplitudes (cases, orders) of the mesh orders 1 … orders, m; NaN where a case is not done."""
    none = np.full(orders, np.nan)
    return np.array([spectrum.harmonics(orders) if spectrum else none for spectrum in spectra(branch)])


def _beside(
    records: Sequence[SweepRecord], at: Mapping[str, float | str], height: float
) -> tuple[list[tuple[Axes, Branch, str]], Figure]:
    """Axes, branch and mesh: of the branches nearest to `at`, up and down beside each other, meshes below."""
    of_meshes = {mesh: chosen_branch(some, at) for mesh, some in sweeps_of_meshes(records[:1]).items()}
    curves, name = next(iter(of_meshes.values()))
    shape = len(of_meshes), len(curves)
    figure = new_figure(WIDTH if shape[1] == 1 else 1.35 * WIDTH, height * (1.0 + 0.7 * (shape[0] - 1)))
    title = f"{sweep_title(records)}: {name}" if name else sweep_title(records)
    figure.suptitle(title, x=0.01, ha="left", fontsize=9)
    panels = figure.subplots(*shape, sharex=True, sharey=True, squeeze=False)
    placed = [
        (axes, branch, literal(mesh))
        for row, (mesh, (some, _)) in zip(panels, of_meshes.items(), strict=True)
        for axes, branch in zip(row, some, strict=True)
    ]
    return placed, figure


def campbell_figure(records: Sequence[SweepRecord], at: Mapping[str, float | str]) -> Figure:
    """Draw modes (dashed) and orders of the mesh (rays) over the first parameter, up and down apart.

    The area of a marker on an order is the amplitude of the transmission error there. Of several other
    parameters the branch nearest to `at` is drawn, or the first.
    """
    panels, figure = _beside(records, at, 4.4)
    largest = max(float(np.nanmax(order_amplitudes(branch, RAYS))) for _, branch, _ in panels) or 1.0
    for letter, (axes, branch, mesh) in zip(ascii_lowercase, panels, strict=False):
        _draw_modes(axes, branch)
        _draw_orders(axes, branch, largest)
        axes.set_xlabel(axis_label(records[0].parameters[0]))
        axes.set_ylabel("Frequency (kHz)")
        axes.label_outer()
        way = {"up": "Parameter increasing", "down": "Parameter decreasing"}
        title = way.get(branch.direction, "Modes (dashed) and orders of the mesh frequency $f_m$")
        title = f"{mesh}: {title[0].lower()}{title[1:]}" if mesh else title
        mark_panel(axes, letter if len(panels) > 1 else "", title, 1)
    shares = (1.0, 0.5, 0.1)
    figure.legend(
        [_marker(share) for share in shares],
        [f"{share * largest * 1e6:.2g} µm" for share in shares],
        loc="outside lower center",
        ncols=len(shares),
        title="Dashed: modes.  Rays: orders of the mesh frequency $f_m$.  "
        "Area of the marks: amplitude of the transmission error",
        title_fontsize=7.5,
    )
    return figure


def _marker(share: float) -> Line2D:
    size = float(np.sqrt(LARGEST_AREA * share))
    return Line2D(
        [], [], linestyle="none", marker="o", markersize=size, color=PALETTE[1], markeredgewidth=0, alpha=0.65
    )


def _draw_modes(axes: Axes, branch: Branch) -> None:
    modes = branch.values("mode_frequency") * 1e-3
    axes.plot(branch.x, modes, color=QUIET, linestyle=(0, (4, 2)), linewidth=0.9)
    top = 1.15 * float(np.nanmax(modes))
    solved = np.flatnonzero(np.isfinite(modes[:, 0]))
    first = solved[np.argmin(branch.x[solved])]
    shown = modes[first][np.isfinite(modes[first])]
    for _, numbers in apart(shown, NAMES_APART * top):
        low, high = (shown[int(number) - 1] for number in (numbers.split("–")[0], numbers.split("–")[-1]))
        name = (
            f"modes {numbers}: {low:.3g} to {high:.3g} kHz"
            if low < high
            else f"mode {numbers}: {low:.3g} kHz"
        )
        write_beside(axes, name, (branch.x[first], high), (2, 2), 7, INK)
    axes.set_ylim(0, top)


def _draw_orders(axes: Axes, branch: Branch, largest: float) -> None:
    frequency = branch.values("mesh_frequency") * 1e-3
    amplitudes = order_amplitudes(branch, RAYS)
    top = axes.get_ylim()[1]
    for order in range(1, RAYS + 1):
        ray = order * frequency
        axes.plot(branch.x, ray, color=PALETTE[5], linewidth=0.7, zorder=1)
        inside = np.flatnonzero(np.isfinite(ray) & (ray <= top))
        axes.scatter(
            branch.x,
            np.where(ray <= top, ray, np.nan),
            s=LARGEST_AREA * np.nan_to_num(amplitudes[:, order - 1]) / largest,
            facecolor=PALETTE[1],
            edgecolor="none",
            alpha=0.65,
            zorder=2,
        )
        if inside.size:
            last = inside[np.argmax(branch.x[inside])]
            name, end = "$f_m$" if order == 1 else f"{order}$f_m$", (branch.x[last], ray[last])
            write_beside(axes, name, end, (3, 4), 7, PALETTE[0], annotation_clip=False)
    axes.margins(x=0.03)


def waterfall_figure(records: Sequence[SweepRecord], at: Mapping[str, float | str]) -> Figure:
    """Draw amplitude spectra of the transmission error over frequency and the first parameter.

    Up and down beside each other where both were followed; of several other parameters the branch nearest to
    `at`, or the first.
    """
    panels, figure = _beside(records, at, 4.6)
    available = [spectrum for _, branch, _ in panels for spectrum in spectra(branch) if spectrum]
    highest = max(float(spectrum.amplitudes[1:].max()) for spectrum in available) * 1e6 or 1.0
    norm = LogNorm(highest * LOWEST, highest)
    limit = max(_limit(branch) for _, branch, _ in panels)
    lines: Any = None
    for letter, (axes, branch, mesh) in zip(ascii_lowercase, panels, strict=False):
        lines = _draw(axes, branch, norm, limit)
        way = {"up": ", parameter increasing", "down": ", parameter decreasing"}.get(branch.direction, "")
        title = f"{mesh}: spectra" if mesh else "Spectra"
        mark_panel(axes, letter if len(panels) > 1 else "", f"{title} of the transmission error{way}", 2)
        axes.set_xlabel("Frequency (kHz)")
        axes.set_ylabel(axis_label(records[0].parameters[0]))
        axes.label_outer()
    bar = figure.colorbar(lines, ax=[axes for axes, _, _ in panels], label="Amplitude (µm)", pad=0.02)
    bar.outline.set_visible(False)
    return figure


def _limit(branch: Branch) -> float:
    """Highest frequency shown, kHz: above the highest mode and the first orders."""
    modes, mesh = branch.values("mode_frequency"), branch.values("mesh_frequency")
    return 1e-3 * max(1.05 * float(np.nanmax(modes)), LEAST_ORDERS * float(np.nanmax(mesh)))


def _draw(axes: Axes, branch: Branch, norm: LogNorm, limit: float) -> LineCollection:
    frequency = branch.values("mesh_frequency") * 1e-3
    low, high = _edges(branch.x)
    places, amplitudes = [], []
    for i, spectrum in enumerate(spectra(branch)):
        if spectrum is None:
            continue
        levels, x = spectrum.amplitudes * 1e6, spectrum.orders * frequency[i]
        strong = levels > LOWEST * float(norm.vmax or 0.0)
        for k in np.flatnonzero((spectrum.orders > 0) & strong & (x <= limit)):
            places.append([(x[k], low[i]), (x[k], high[i])])
            amplitudes.append(levels[k])
    order = np.argsort(amplitudes)  # the strongest on top
    lines = LineCollection(
        [places[i] for i in order],
        array=np.array(amplitudes)[order],
        norm=norm,
        cmap="viridis_r",
        linewidths=1.8,
        capstyle="butt",
    )
    axes.add_collection(lines)
    modes = branch.values("mode_frequency") * 1e-3
    last = int(np.argmax(branch.x))
    axes.plot(modes, branch.x, color=QUIET, linestyle=(0, (3, 2)), linewidth=0.7, zorder=0.9)
    for row, (place, numbers) in enumerate(apart(modes[last][np.isfinite(modes[last])], NAMES_APART * limit)):
        name_above(axes, place, f"mode {numbers}", row % 2, INK)
    axes.set(xlim=(0, limit), ylim=(float(np.min(low)), float(np.max(high))))
    axes.grid(False)
    return lines


def _edges(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the mark of each case begins and ends: halfway to its neighbours."""
    if len(x) < 2:
        return x - 0.5, x + 0.5
    order = np.argsort(x)
    middle = (x[order][1:] + x[order][:-1]) / 2.0
    first, last = 2 * x[order][0] - middle[0], 2 * x[order][-1] - middle[-1]
    low, high = np.empty(len(x)), np.empty(len(x))
    low[order], high[order] = np.concatenate([[first], middle]), np.concatenate([middle, [last]])
    return low, high
