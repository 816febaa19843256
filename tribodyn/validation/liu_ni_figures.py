"""What Liu & Ni, Mechanics & Industry 23 (2022) 10, draw of their drives, with their printed numbers."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures import over_mesh
from tribodyn.post.figures.panel import Trace, View, abscissa, draw, legend
from tribodyn.post.figures.spectrum import steady_spectrum
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.validation.published import published

PAPER = "liu-ni-2022"
DRIVES = ("crc-23-47", "involute-23-47")
#: Orders of the mesh in the spectrum.
ORDERS = 12
#: Line of a published number.
PRINTED = (0, (6, 2))


def _value(row: str) -> float:
    """A published number by the end of its name, SI."""
    return float(published(PAPER)[f"liu-ni/{row}"]["published"])


def _level(axes: Axes, value: float, text: str, color: str, part: tuple[float, float] = (0.0, 1.0)) -> None:
    """Draw a published number as a level line over a part of the panel's width."""
    axes.axhline(value, *part, color=color, linewidth=1.3, linestyle=PRINTED, zorder=3)
    axes.annotate(
        text,
        (part[1], value),
        xycoords=("axes fraction", "data"),
        xytext=(-2, 2),
        textcoords="offset points",
        ha="right",
        fontsize=6.5,
        color=color,
    )


def _compared(
    quantity: Trace, printed: Callable[[Axes, Sequence[Record]], None] | None, records: Path
) -> Figure:
    """Draw a quantity of both drives over one mesh cycle, with what the paper prints of it."""
    view = View(1)
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.9)
    axes = figure.subplots()
    with ExitStack() as stack:
        opened = [stack.enter_context(Record(records / f"{name}.h5")) for name in DRIVES]
        rows = draw(axes, opened, quantity, view)
        mark_panel(axes, "", quantity.title, rows)
        if printed:
            printed(axes, opened)
        legend(figure, [axes], opened, view)
    return figure


def _friction(axes: Axes, opened: Sequence[Record]) -> None:
    """Mean magnitudes of the friction force: ours dotted, the paper's dashed."""
    for number, (record, name) in enumerate(zip(opened, ("crc", "involute"), strict=True)):
        color = PALETTE[number]
        ours = record.summary["friction_force_mean"]
        for pair in (1, 0):
            value = _value(f"friction-pair{pair}-{name}")
            mean = float(ours[list(record.pairs).index(pair)])
            part = (0.5 * number, 0.5 * number + 0.48)
            _level(axes, value, f"{name}, pair {pair}: mean {value:.0f} N printed", color, part)
            axes.axhline(mean, *part, color=color, linewidth=0.8, linestyle=":")
    axes.annotate("dotted: computed mean magnitudes", (0.01, 0.02), xycoords="axes fraction", fontsize=6.5)


def _efficiency(axes: Axes, opened: Sequence[Record]) -> None:
    """Mean efficiencies: ours dotted, the paper's dashed."""
    for number, (record, name) in enumerate(zip(opened, ("crc", "involute"), strict=True)):
        value, color = 100.0 * _value(f"efficiency-{name}"), PALETTE[number]
        _level(axes, value, f"{name}: mean {value:.1f} % printed", color)
        axes.axhline(100.0 * float(record.summary["efficiency"]), color=color, linewidth=0.8, linestyle=":")
    axes.annotate("dotted: computed means", (0.01, 0.02), xycoords="axes fraction", fontsize=6.5)


def normal_load(records: Path) -> Figure:
    """Sum of the normal loads of the CRC drive without friction, with the printed means in single contact."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.6)
    axes = figure.subplots()
    with Record(records / "crc-23-47-frictionless.h5") as record:
        window = last_cycles(record, 1)
        load = record["normal_load"][window.part]
        total, single = np.sum(load, axis=1), np.sum(load > 0.0, axis=1) == 1
        x = abscissa(window, View(1))
        axes.plot(x, total, color=PALETTE[0])
        axes.plot(x, np.where(single, float(np.mean(total[single])), np.nan), color=INK, linewidth=0.8)
    six, bodies, elements = (_value(f"load-stcp-{model}") for model in ("6dof", "mbd", "fem"))
    _level(axes, six, f"printed: 6 DOF {six:.0f} N, multi-body {bodies:.0f} N", PALETTE[1], (0.0, 0.5))
    _level(axes, elements, f"printed: quasi-static FE {elements:.0f} N", PALETTE[2], (0.0, 0.5))
    axes.set_xlim(0.0, 1.0)
    axes.set_xlabel("Phase (mesh cycles)")
    axes.set_ylabel("$\\Sigma F_n$ (N)")
    mark_panel(axes, "", "CRC drive without friction: all pairs; black: computed mean in single contact")
    return figure


def spectrum(records: Path) -> Figure:
    """Spectrum of the CRC drive with the printed mesh frequency."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.6)
    axes = figure.subplots()
    with Record(records / "crc-23-47.h5") as record:
        found, window = steady_spectrum(record)
    amplitudes = found.harmonics(ORDERS) * 1e6
    places = np.arange(1, ORDERS + 1) * window.mesh_frequency * 1e-3
    axes.stem(places, amplitudes, basefmt=" ", bottom=1e-12)
    highest, mesh = float(amplitudes.max()), _value("mesh-frequency")
    axes.axvline(mesh * 1e-3, color=PALETTE[1], linestyle=PRINTED, linewidth=1.0)
    axes.set_yscale("log")
    axes.set_ylim(1e-4 * highest, 2 * highest)
    axes.set_xlim(0.0, (ORDERS + 0.5) * mesh * 1e-3)
    axes.set_xlabel("Frequency (kHz)")
    axes.set_ylabel("Amplitude (µm)")
    mark_panel(axes, "", f"CRC drive: transmission error; dashed: mesh frequency printed, {mesh:.2f} Hz")
    return figure


FIGURES: dict[str, Callable[[Path], Figure]] = {
    "transmission-error": partial(_compared, over_mesh.DEFLECTION, None),
    "spectrum": spectrum,
    "normal-load": normal_load,
    "friction-force": partial(_compared, over_mesh.FRICTION_FORCE, _friction),
    "friction-coefficient": partial(_compared, over_mesh.FRICTION_COEFFICIENT, None),
    "film": partial(_compared, over_mesh.FILM_THICKNESS, None),
    "entrainment": partial(_compared, over_mesh.ENTRAINMENT, None),
    "efficiency": partial(_compared, over_mesh.EFFICIENCY, _efficiency),
}
