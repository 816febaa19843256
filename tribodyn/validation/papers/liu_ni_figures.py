"""Figures 2 and 9 to 16 of Liu & Ni, Mechanics & Industry 23 (2022) 10, with their printed numbers.

As in the paper, over one mesh cycle with pairs 0 and 1; transmission errors by its (6), of pair 1. Beside the
six degrees of freedom figures 9 and 10 have what is built here of the paper's other models: quasi-static
loads, and the same motion, with teeth by finite elements.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.record_arrays import from_arrays
from tribodyn.post.cycles import last_cycles, pair_curve
from tribodyn.post.figures import over_mesh
from tribodyn.post.figures.panel import Trace, View, abscissa, draw, legend, mark_key_points, pair_label
from tribodyn.post.figures.spectrum import steady_spectrum
from tribodyn.post.style import PAIR_STYLES, PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.published import published

PAPER = "liu-ni-2022"
DRIVES = ("crc-23-47", "involute-23-47")
#: Without friction: the six degrees of freedom, by the energy method and with teeth by finite elements.
MODELS = {"6 DOF": "crc-23-47-frictionless", "6 DOF, teeth by finite elements": "crc-23-47-fem-frictionless"}
#: Records of the transmission errors with and without friction.
WITH_FRICTION = {
    "CRC": "crc-23-47",
    "CRC, no friction": "crc-23-47-frictionless",
    "involute": "involute-23-47",
    "involute, no friction": "involute-23-47-frictionless",
}
#: Orders of the mesh in the spectrum.
ORDERS = 8
#: Line of a published number.
PRINTED = (0, (6, 2))
#: Models of the printed loads.
PRINTED_MODELS = {"6dof": "6 DOF", "mbd": "multi-body", "fem": "quasi-static FE"}
ERROR = "DTE by (6), pair 1 (µm)"
_ONE = View(1)


def _value(row: str) -> float:
    """A published number by the end of its name, SI."""
    return float(published(PAPER)[f"liu-ni/{row}"]["published"])


@contextmanager
def _opened(records: Path, names: Sequence[str]) -> Iterator[list[Record]]:
    with ExitStack() as stack:
        yield [stack.enter_context(Record(records / f"{name}.h5")) for name in names]


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
    quantity: Trace,
    printed: Callable[[Axes, Sequence[Record]], None] | None,
    records: Path,
    drives: Sequence[str] = DRIVES,
) -> Figure:
    """Draw a quantity of the drives over one mesh cycle, with what the paper prints of it."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.9)
    axes = figure.subplots()
    with _opened(records, drives) as opened:
        rows = draw(axes, opened, quantity, _ONE)
        mark_panel(axes, "", quantity.title, rows)
        if printed:
            printed(axes, opened)
        legend(figure, [axes], opened, _ONE)
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
    """Normal loads of consecutive pairs without friction, with the printed means in single contact."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 1.3)
    axes = figure.subplots()
    case = load_scenario("crc-23-47-frictionless").pair
    with _opened(records, tuple(MODELS.values())) as opened:
        dynamic = opened[0]
        window = last_cycles(dynamic, 1)
        phase, load = quasi_static_load(opened[1], case.operating.gear_torque)
        pitch = float(dynamic.mesh_cycle["pitch_point_phase"])
        for pair in dynamic.pairs:
            style = PAIR_STYLES[pair]
            curve = pair_curve(dynamic, dynamic["normal_load"], pair, window, abscissa(window, _ONE))
            axes.plot(*curve, color=PALETTE[0], linestyle=style, label=f"6 DOF, {pair_label(pair)}")
            label = f"quasi-static, teeth by finite elements, {pair_label(pair)}"
            axes.plot(phase + pitch + pair - 1, load, color=PALETTE[1], linestyle=style, label=label)
        # before its path of contact begins the next pair already touches
        axes.plot(phase + pitch + 1, load, color=PALETTE[1], linestyle=":", label="the next pair")
        rows = mark_key_points(axes, [dynamic], _ONE)
    for number, names in enumerate((("6dof", "mbd"), ("fem",))):
        values = [_value(f"load-stcp-{name}") for name in names]
        text = ", ".join(f"{PRINTED_MODELS[name]} {_value(f'load-stcp-{name}'):.0f} N" for name in names)
        label = f"mean in single contact printed: {text}"
        for value in values:
            color = PALETTE[2 + number]
            axes.axhline(value, color=color, linewidth=1.2, linestyle=PRINTED, zorder=3, label=label)
            label = ""
    axes.set(
        xlim=(0.0, 1.0), ylim=(0.0, None), xlabel="Phase (mesh cycles)", ylabel=over_mesh.NORMAL_LOAD.label
    )
    mark_panel(axes, "", "CRC drive without friction: normal loads of consecutive pairs", rows)
    figure.legend(loc="outside lower center", ncols=2)
    return figure


def quasi_static_load(record: Record, gear_torque: float) -> tuple[np.ndarray, np.ndarray]:
    """Normal load of a pair (N, NaN out of contact) by a record's table, over pitches from P."""
    cycle = from_arrays(record.mesh_cycle)
    load = np.asarray(quasi_static(cycle, gear_torque).normal_load)
    pairs = load.shape[-1]
    later = pairs - 1.0 - np.arange(pairs)
    place = np.asarray(cycle.phase)[..., None] + later - float(cycle.pitch_point_phase)
    # the table begins with the pair that entered first
    order = np.argsort(place, axis=None, kind="stable")
    return place.ravel()[order], np.where(load > 0.0, load, np.nan).ravel()[order]


def _error(record: Record, view: View) -> tuple[np.ndarray, np.ndarray]:
    """Transmission error by (6) of pair 1, µm, over the view's abscissa from 0."""
    window = last_cycles(record, view.cycles)
    error = 1e6 * record["transmission_error_normal"][window.part][:, list(record.pairs).index(1)]
    along = abscissa(window, view)
    return along - along[0], error


def error_and_spectrum(records: Path) -> Figure:
    """Transmission error of the CRC drive without friction over time, and its spectrum."""
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 0.6)
    above, below = figure.subplots(2, 1)
    with _opened(records, tuple(MODELS.values())) as opened:
        pitches = [float(record.mesh_cycle["pitch_point_phase"]) for record in opened]
        for number, (label, record) in enumerate(zip(MODELS, opened, strict=True)):
            spectrum, window = steady_spectrum(record)
            time, error = _error(record, View(3, "time"))
            late = (pitches[0] - pitches[number]) / window.mesh_frequency * 1e3
            above.plot(time + late, error, color=PALETTE[number], linewidth=0.9, label=label)
            above.set_xlim(0.0, 2e3 / window.mesh_frequency)
            places = np.arange(1, ORDERS + 1) * window.mesh_frequency
            at = places + (0.6 * number - 0.3)
            below.vlines(at, 0.0, 1e6 * spectrum.harmonics(ORDERS), color=PALETTE[number], linewidth=2.2)
            below.plot([], [], color=PALETTE[number], label=label)
    above.set(xlabel="Time (ms)", ylabel=ERROR)
    above.legend()
    mark_panel(above, "a", "CRC drive without friction: transmission error")
    harmonics = [_value("mesh-frequency"), *published(PAPER)["liu-ni/mesh-harmonics"]["published"]]
    for harmonic in harmonics:
        below.axvline(harmonic, color=PALETTE[2], linestyle=PRINTED, linewidth=0.9, zorder=0.9)
    below.set_xlim(0.0, (ORDERS + 0.5) * harmonics[0])
    below.set_ylim(bottom=0.0)
    below.set_xlabel("Frequency (Hz)")
    below.set_ylabel("Amplitude (µm)")
    texts = ", ".join(f"{harmonic:.2f}" for harmonic in harmonics)
    mark_panel(below, "b", f"its amplitudes, rotational; dashed: harmonics printed, {texts} Hz")
    return figure


def with_and_without_friction(records: Path) -> Figure:
    """Transmission errors of both drives, with and without friction."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.9)
    axes = figure.subplots()
    with _opened(records, tuple(WITH_FRICTION.values())) as opened:
        for number, (label, record) in enumerate(zip(WITH_FRICTION, opened, strict=True)):
            style = {"linestyle": "-" if number % 2 == 0 else PRINTED, "color": PALETTE[number // 2]}
            axes.plot(*_error(record, _ONE), linewidth=0.9, label=label, **style)
        rows = mark_key_points(axes, [opened[0], opened[2]], _ONE)
        mark_panel(axes, "", "Dynamic transmission error", rows)
    axes.set(xlabel="Phase (mesh cycles)", ylabel=ERROR)
    figure.legend(loc="outside lower center", ncols=4)
    return figure


FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-2": partial(_compared, over_mesh.STIFFNESS, None, drives=DRIVES[:1]),
    "figure-9": normal_load,
    "figure-10": error_and_spectrum,
    "figure-11": with_and_without_friction,
    "figure-12": partial(_compared, over_mesh.FRICTION_FORCE, _friction),
    "figure-13": partial(_compared, over_mesh.FRICTION_COEFFICIENT, None),
    "figure-14": partial(_compared, over_mesh.FILM_THICKNESS, None),
    "figure-15": partial(_compared, over_mesh.ENTRAINMENT, None),
    "figure-16": partial(_compared, over_mesh.EFFICIENCY, _efficiency),
}
