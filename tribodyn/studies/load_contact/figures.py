"""Figures of load contact studies: transmission error, load sharing, stiffness, root stress, Harris map."""

from collections.abc import Callable, Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import Drawing, drawing, finished, six_panels
from tribodyn.post.figures.panel import record_label, record_title
from tribodyn.post.style import PAIR_STYLES, PALETTE, PANEL_HEIGHT, WIDTH, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.load_contact import maps, stress
from tribodyn.studies.load_contact.scenario import BODIES

MAP_CURVES = "Transmission error over the mesh cycle, less its mean, at every torque"
PHASE = "Phase (mesh cycles)"
ROLL = "Roll angle from the pitch point (°)"
#: Peak to peak below which an unloaded transmission error is none, m.
_NO_ERROR = 1e-12


def colour(number: int) -> str:
    """Colour of a record, or of a pair of the only one."""
    return PALETTE[number % len(PALETTE)]


def _loaded_error(records: Sequence[Record]) -> Figure:
    modified = any(np.ptp(record["unloaded_transmission_error"]) > _NO_ERROR for record in records)
    figure, rows = _stacked(2 if modified else 1)
    titles = (
        "Transmission error under load, in slow rotation",
        "Transmission error without load: that of modifications and errors",
    )
    for name, axes in zip(("loaded", "unloaded"), rows, strict=False):
        draw_error(axes, records, f"{name}_transmission_error")
        axes.set_ylabel("Transmission error (µm)")
        axes.legend(loc="upper right", ncols=1 + (len(records) > 2))
    rows[-1].set_xlabel(PHASE)
    return finished(figure, rows, titles, records)


def draw_error(axes: Axes, records: Sequence[Record], name: str) -> None:
    """Draw a transmission error of every record over the phase, its peak to peak in the legend."""
    for number, record in enumerate(records):
        phase, error = maps.over_phase(record, name)
        spread = f"peak to peak {np.ptp(error) * 1e6:.3g} µm"
        label = f"{record_label(record)}: {spread}" if len(records) > 1 else spread
        axes.plot(phase, error * 1e6, color=colour(number), label=label)
    # room for the legend
    axes.margins(y=0.12 + 0.12 * len(records))


def _load_sharing(records: Sequence[Record]) -> Figure:
    figure, rows = _stacked(2, sharex=False)
    draw_loads(rows[0], records)
    rows[0].set_xlabel(PHASE)
    for number, record in enumerate(records):
        load = record["normal_load"]
        roll, share = maps.over_roll(record, load / np.sum(load, axis=1, keepdims=True))
        rows[1].plot(np.degrees(roll), 100.0 * share, color=colour(number))
    show_contact(rows[1], records)
    rows[1].set_ylabel("Share of the load (%)")
    rows[1].set_ylim(bottom=0)
    titles = ("Normal load of each pair", "Share of the load of one pair from entry to exit")
    handles, labels = rows[0].get_legend_handles_labels() if len(records) == 1 else ([], [])
    return finished(figure, rows, titles, records, list(zip(labels, handles, strict=True)))


def draw_loads(axes: Axes, records: Sequence[Record]) -> None:
    """Draw the normal load of each pair over the phase; colours tell records apart, or pairs of one."""
    for number, record in enumerate(records):
        for pair in reversed(record.pairs):
            phase, load = maps.pair_over_phase(record, "normal_load", pair)
            if np.nanmax(load) > 0.0:
                which = number if len(records) > 1 else 1 - pair
                style = PAIR_STYLES.get(pair, "-")
                axes.plot(phase, load, color=colour(which), linestyle=style, label=f"pair {pair}")
    axes.set_ylabel("Normal load of each pair (N)")
    axes.set_ylim(bottom=0)


def _mesh_stiffness(records: Sequence[Record]) -> Figure:
    figure, rows = _stacked(1)
    draw_stiffness(rows[0], records)
    return finished(figure, rows, ["Stiffness of all pairs together, at the pitch radius"], records)


def show_contact(axes: Axes, records: Sequence[Record]) -> None:
    """Show, of an axis of roll angles, those at which the pair of any record carries load."""
    rolls = [maps.over_roll(record, record["normal_load"]) for record in records]
    loaded = np.degrees(np.concatenate([roll[load > 0.0] for roll, load in rolls]))
    if loaded.size:
        axes.set_xlim(np.min(loaded) - 0.5, np.max(loaded) + 0.5)
    axes.set_xlabel(ROLL)


def draw_stiffness(axes: Axes, records: Sequence[Record]) -> None:
    """Draw the mesh stiffness of every record over the phase."""
    for number, record in enumerate(records):
        phase, stiffness = maps.over_phase(record, "mesh_stiffness")
        axes.plot(phase, stiffness * 1e-6, color=colour(number))
    axes.set(xlabel=PHASE, ylabel="Mesh stiffness (N/µm)")
    axes.set_ylim(bottom=0)


def _root_stress(records: Sequence[Record]) -> Figure:
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 0.4)
    panels = figure.subplots(2, 2, sharex=True)
    for row, name in enumerate(("root_tension", "root_compression")):
        for column, body in enumerate(BODIES):
            draw_root_stress(panels[row, column], records, name, body)
    for axes in panels[1]:
        show_contact(axes, records)
    for axes, text in zip(panels[:, 0], ("Root tension (MPa)", "Root compression (MPa)"), strict=True):
        axes.set_ylabel(text)
    for row in panels:  # common vertical limits
        low, high = zip(*(axes.get_ylim() for axes in row), strict=True)
        for axes in row:
            axes.set_ylim(min(low), max(high))
    titles = [f"{what} in the fillet of the {body}" for what in ("Tension", "Compression") for body in BODIES]
    return finished(figure, panels.ravel(), titles, records)


def draw_root_stress(axes: Axes, records: Sequence[Record], name: str, body: str, style: str = "-") -> None:
    """Draw the maximum root stress over the face against the roll angle of a pair."""
    for number, record in enumerate(records):
        stress = record[name][:, list(record["body"]).index(body)]
        worst = np.max(stress, axis=-1) if name == "root_tension" else np.min(stress, axis=-1)
        roll, values = maps.over_roll(record, worst)
        axes.plot(np.degrees(roll), values * 1e-6, color=colour(number), linestyle=style)
    axes.margins(y=0.05)


def _harris(records: Sequence[Record]) -> Figure:
    figure, rows = _stacked(2 if len(records) == 1 else 1, sharex=False)
    draw_harris(rows[0], records)
    if len(records) == 1:
        _draw_map_curves(rows[1], records[0])
    titles = ("Peak to peak of the transmission error over torque; circle: torque of all else", MAP_CURVES)
    return finished(figure, rows, titles, records)


def draw_harris(axes: Axes, records: Sequence[Record]) -> None:
    """Draw peak to peak against torque; an open circle is the torque at which all else is recorded."""
    for number, record in enumerate(records):
        spread = record["map_peak_to_peak"] * 1e6
        axes.plot(record["torque"], spread, color=colour(number), marker="o", markersize=3, clip_on=False)
        recorded = np.ptp(record["loaded_transmission_error"]) * 1e6
        at = record.summary["gear_torque"]
        axes.plot(at, recorded, color=colour(number), marker="o", markersize=7, markerfacecolor="none")
    axes.set(xlabel="Torque on the gear (N m)", ylabel="Peak to peak (µm)")
    axes.set_ylim(bottom=0)
    axes.margins(x=0.03)
    axes.locator_params(axis="x", nbins=5)


def _draw_map_curves(axes: Axes, record: Record) -> None:
    """Draw the loaded transmission error over the phase at every torque of the map, from its own mean."""
    torques, errors = record["torque"], record["map_transmission_error"]
    shades = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, len(torques)))
    for torque, error, shade in zip(torques, errors, shades, strict=True):
        phase = np.append(record["phase"], record["phase"][-1] + record["phase"][1])
        closed = np.append(error, error[0])
        axes.plot(phase, (closed - np.mean(error)) * 1e6, color=shade, label=f"{torque:.4g} N m")
    axes.set(xlabel=PHASE, ylabel="Loaded error less its mean (µm)")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=6.5)


def _overview(records: Sequence[Record]) -> Figure:
    record, first = records[0], records[:1]

    def error(axes: Axes) -> None:
        draw_error(axes, first, "loaded_transmission_error")
        axes.set(xlabel=PHASE, ylabel="Loaded transmission error (µm)")
        axes.legend(loc="upper right")

    def loads(axes: Axes) -> None:
        draw_loads(axes, first)
        axes.set(xlabel=PHASE, ylim=(None, 1.3 * axes.get_ylim()[1]))
        axes.legend(loc="upper right", ncols=3, handlelength=1.5)

    def root_tension(axes: Axes) -> None:
        for body, style in zip(BODIES, ("-", "--"), strict=True):
            draw_root_stress(axes, first, "root_tension", body, style)
        show_contact(axes, first)
        axes.set(ylabel="Root tension (MPa)", ylim=(None, 1.2 * axes.get_ylim()[1]))
        axes.legend(BODIES, loc="upper right", ncols=2)

    stiffness = "Stiffness of all pairs", lambda axes: draw_stiffness(axes, first)
    harris = "Harris map: error over torque", lambda axes: draw_harris(axes, first)
    panels = (
        ("Transmission error under load", error),
        ("Normal load of each pair", loads),
        harris if "torque" in record else stiffness,
        (maps.LINE_LOAD.title, lambda axes: maps.draw_map(axes, first, record, maps.LINE_LOAD)),
        (maps.PRESSURE.title, lambda axes: maps.draw_map(axes, first, record, maps.PRESSURE)),
        ("Root tension of one pair", root_tension),
    )
    explained = f"{maps.LINE_LOAD.explained[0].lower()}{maps.LINE_LOAD.explained[1:]}"
    return six_panels(f"{record_title(record)}.  Maps: {explained}", panels)


def _stacked(count: int, sharex: bool = True) -> tuple[Figure, Sequence[Axes]]:
    figure = new_figure(WIDTH, PANEL_HEIGHT * count + 0.4)
    return figure, list(figure.subplots(count, 1, squeeze=False, sharex=sharex)[:, 0])


def _drawing(about: str, draw: Callable[[Sequence[Record]], Figure], *fits: Any) -> Drawing:
    timeless = "a load contact study"
    return drawing(about, lambda records, _: draw(records), *fits, samples=2, timeless=timeless)


DRAWINGS: dict[str, Drawing] = {
    "overview": _drawing(
        "transmission error, loads, stiffness or Harris map, pressure, root stress", _overview
    ),
    "loaded-error": _drawing("loaded and unloaded transmission error", _loaded_error),
    "load-sharing": _drawing("load of every pair, and its share", _load_sharing),
    "line-load": _drawing("line load over roll angle and face", maps.line_load_figure),
    "pressure-map": _drawing(
        "Hertz pressure over roll angle and face",
        lambda records: maps.face_map_figure(records, maps.PRESSURE),
    ),
    "film-map": _drawing(
        "film thickness over roll angle and face, with a lubricant",
        lambda records: maps.face_map_figure(records, maps.FILM),
        lambda record: maps.FILM.dataset in record,
        ("film-map", "{path} holds no film", "run the scenario with a lubricant and a speed"),
    ),
    "root-stress": _drawing("root stress on both sides of the tooth", _root_stress),
    "stress": _drawing(
        "finite elements and von Mises stress of loaded teeth at the pitch point",
        stress.stress_figure,
        stress.known,
        ("stress", "{path} is of helical or internal teeth", "draw it of external spur teeth"),
    ),
    "mesh-stiffness": _drawing("mesh stiffness", _mesh_stiffness),
    "harris": _drawing(
        "Harris map: loaded transmission error over torque",
        _harris,
        lambda record: "torque" in record,
        ("harris", "{path} holds a single torque", "run the scenario with operating.gear_torques"),
    ),
}
