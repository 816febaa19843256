"""The figures of a gear pair over its mesh cycles and revolutions, and the six panels that sum them up."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post import style
from tribodyn.post.cycles import last_cycles, transient
from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import (
    ALONE,
    KEY_POINTS,
    MOST_CYCLES_DRAWN,
    Trace,
    View,
    abscissa,
    abscissa_label,
    draw,
    legend,
    record_label,
    record_title,
    scale,
)
from tribodyn.post.figures.path_of_contact import draw_path, path_figure
from tribodyn.post.figures.spectrum import has_spectra, spectrum_figure
from tribodyn.post.style import PALETTE, new_figure
from tribodyn.record.reader import Record, mesh_views

TRANSMISSION_ERROR = Trace("transmission_error_rotational", "Transmission error", "$r_pθ_p - r_gθ_g$", "µm")
DEFLECTION = Trace("transmission_error_normal", "Deflection along each pair's normal", "$δ$", "µm")
NORMAL_LOAD = Trace("normal_load", "Normal load of each pair", "$F_n$", "N", from_zero=True)
FRICTION_FORCE = Trace(
    "friction_force", "Friction force on the driving gear", "$F_f$", "N", flag="friction_in_range"
)
FRICTION_COEFFICIENT = Trace(
    "friction_coefficient", "Friction coefficient", "$µ$", "–", from_zero=True, flag="friction_in_range"
)
FILM_THICKNESS = Trace("central_film_thickness", "Film thickness", "$h_c$", "µm", flag="closure_in_range")
FILM_PARAMETER = Trace(
    "film_parameter",
    "Film parameter: film thickness over roughness",
    "$λ = h_c/σ$",
    "–",
    from_zero=True,
    flag="closure_in_range",
)
ENTRAINMENT = Trace("entrainment_speed", "Entrainment speed, mean of both flanks", "$u$", "m/s")
SLIDING = Trace("sliding_speed", "Sliding speed, driving gear less driven gear", "$v_s$", "m/s")
HERTZ_PRESSURE = Trace("hertz_pressure", "Hertz pressure, maximum in the contact", "$p_H$", "GPa")
FLASH_TEMPERATURE = Trace("flash_temperature_rise", "Flash temperature rise", "$ΔT$", "K", from_zero=True)
STIFFNESS = Trace(
    "mesh_stiffness", "Stiffness of each pair along its normal", "$k_i$", "N/µm", from_zero=True
)
EFFICIENCY = Trace("efficiency", "Efficiency at each moment", "$η$", "%")

#: Height of a panel where there are more rows than a few, inch; panels that have letters, at most.
LOW, FEW, MOST_LETTERS = 1.95, 3, 26
#: Film parameters that divide kinds of lubrication, and what lies between.
LUBRICATION = ((1.0, "λ = 1: mixed above, boundary below"), (3.0, "λ = 3: full film above"))


def _groups(trace: Trace, records: Sequence[Record]) -> list[tuple[Sequence[Record], int, str]]:
    """Records and number of a mesh that share a panel, and what to call it.

    All records where none names its meshes; else every mesh of every record has a panel.
    """
    if not any(record.names_meshes for record in records):
        return [(records, 0, "")]
    groups: list[tuple[Sequence[Record], int, str]] = []
    for record in records:
        head = [record_label(record)] if len(records) > 1 else []
        if "mesh" not in record.dims_of(trace.dataset):
            groups.append(([record], 0, ", ".join(head)))
            continue
        for m, mesh in enumerate(record.meshes):
            groups.append(([record], m, ", ".join([*head, style.literal(mesh)])))
    return groups


def _over_phase(traces: Sequence[Trace], records: Sequence[Record], view: View) -> Figure:
    """Draw traces from top to bottom; where meshes have names a row for each mesh, traces side by side."""
    columns = [_groups(trace, records) for trace in traces]
    named = any(record.names_meshes for record in records)
    shape = (max(map(len, columns)), len(traces)) if named else (len(traces), 1)
    height = style.PANEL_HEIGHT + 0.15 if not named or shape[0] <= FEW else LOW
    figure = style.new_figure(style.WIDTH * (1.0 if shape[1] == 1 else 1.6), height * shape[0] + 0.5)
    grid = figure.subplots(*shape, squeeze=False, sharex=not named or len(records) == 1)
    panels = [
        (grid[(row, column) if named else (column, 0)], traces[column], group)
        for column, groups in enumerate(columns)
        for row, group in enumerate(groups)
    ]
    lettered = 1 < len(panels) <= MOST_LETTERS
    for number, (axes, trace, (some, mesh, name)) in enumerate(panels):
        last = axes in grid[-1]
        names = draw(axes, some, trace, view, first=axes is grid[0, 0], last=last, mesh=mesh)
        title = trace.title
        if trace.dataset == STIFFNESS.dataset:
            draw_total_stiffness(axes, some, view, mesh)
            title = "Stiffness of each pair, and of all pairs together along the pitch tangent"
        if trace is FILM_PARAMETER:
            draw_lubrication(axes)
        if name:
            title = f"{name}: {title[0].lower()}{title[1:]}"
        style.mark_panel(axes, chr(ord("a") + number) if lettered else "", title, names)
    figure.align_ylabels()
    legend(figure, [axes for axes, _, _ in panels], records, view)
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure


def draw_total_stiffness(axes: Axes, records: Sequence[Record], view: View, mesh: int = 0) -> None:
    """Add the stiffness Σ k cos² α of all pairs of a mesh along the pitch tangent."""
    highest = 0.0
    for number, record in enumerate(records):
        window = last_cycles(record, view.cycles)
        if window.phase[-1] > MOST_CYCLES_DRAWN:
            continue
        names = "pressure_angle", "mesh_stiffness"
        angle, single = (record.over_meshes(name)[window.part, mesh] for name in names)
        there = np.any(np.isfinite(single), axis=0)  # a mesh of a train may have fewer pairs than another
        single, angle = single[:, there], np.nan_to_num(angle[:, there])
        cosine = np.cos(angle)  # and of helical gears that of the normal's angle to the transverse section
        table = record.of_mesh(record.meshes[mesh], "mesh_cycle")
        axial = 1.0 + (table.get("pitch_slope", 0.0) * cosine) ** 2
        lean = r"\,\cos^2 β_{n,i}" if np.any(axial > 1.0) else ""
        total = np.sum(single * cosine**2 / axial, axis=1) * STIFFNESS.factor
        color = style.INK if len(records) == 1 else style.PALETTE[number % len(style.PALETTE)]
        axes.plot(
            abscissa(window, view),
            total,
            color=color,
            linewidth=1.7,
            alpha=0.85,
            label=f"all pairs, $\\Sigma\\, k_i \\cos^2 α_i{lean}$",
        )
        highest = max(highest, float(total.max()))
    if highest > 0.0:
        axes.set_ylim(0.0, 1.08 * highest)


def draw_lubrication(axes: Axes) -> None:
    """Draw the film parameters that divide kinds of lubrication, the first one always in view."""
    top = max(axes.get_ylim()[1], 1.15 * LUBRICATION[0][0])
    axes.set_ylim(0.0, top)
    for value, text in LUBRICATION:
        if value < top:
            axes.axhline(value, color=style.QUIET, linewidth=0.8, linestyle=(0, (5, 2)))
            where: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "ha": "right"}
            style.write_beside(axes, text, (0.995, value), (0, 2), 6.5, style.QUIET, **where)


#: Size of the overview, inch, and its rows and columns.
GRID = 11.0, 6.6, 2, 3
#: Room in it, inch.
OVERVIEW: dict[str, Any] = {"left": 0.74, "right": 0.42, "top": 0.85, "bottom": 0.5, "between": (0.86, 1.0)}
#: Titles of its panels a, and b to f.
PATH = "Teeth and path of contact"
TRACES = (DEFLECTION, NORMAL_LOAD, FRICTION_FORCE, FILM_THICKNESS, EFFICIENCY)


def overview_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw what the first record holds in six panels; of a transient its speed and load in the first."""
    record = next(iter(mesh_views(records[0]).values()))
    figure, rows = style.new_grid(*GRID)
    if view.cycles is None and transient(record):
        draw_speed(rows[0, 0], record, view)
        style.mark_panel(rows[0, 0], "a", "Speed and load, means of a mesh cycle")
    else:
        draw_path(rows[0, 0], record)
        style.mark_panel(rows[0, 0], "a", PATH)
    for letter, axes, trace in zip("bcdef", rows.flat[1:], TRACES, strict=True):
        names = draw(axes, [record], trace, view)
        style.mark_panel(axes, letter, trace.title, names)
    legend(figure, list(rows.flat[1:]), [record], view)
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=11)
    if isinstance(figure, Figure) and len(figure.axes) == rows.size:
        figure.set_layout_engine(style.Margins(**OVERVIEW))
    return figure


def prepare_overview() -> None:
    """Do what needs no record: make the grid of panels, read the formulas."""
    style.prepare_grid(*GRID)
    titles = [PATH, *(trace.title for trace in TRACES)]
    marked = [style.panel_title(letter, title) for letter, title in zip("abcdef", titles, strict=True)]
    names = [f"${name}$" for name in ("B_g", "C_p", "P", "C_g", "B_p")]
    style.read_formulas([*marked, *(trace.label for trace in TRACES), *names], style.STYLE["font.size"])
    style.read_formulas([*names, KEY_POINTS + ALONE], style.STYLE["legend.fontsize"])


def draw_speed(axes: Axes, record: Record, view: View) -> None:
    """Draw the pinion's speed and the torque on the gear, means of every mesh cycle, on two axes."""
    window = last_cycles(record, view.cycles)
    size = window.samples_per_cycle
    speeds = record.over_bodies("speed")[window.part][:-1]
    power = record["power_out"][window.part][:-1]
    pinion, gear = speeds[:, 0], speeds[:, 1]
    load = np.divide(power, gear, out=np.full_like(power, np.nan), where=gear != 0.0)  # not of what stands
    x, speed, torque = (
        np.mean(values.reshape(-1, size), axis=1)
        for values in (abscissa(window, view)[:-1], pinion * 30 / np.pi, load)
    )
    right = axes.twinx()
    for side, values, color, label in (
        (axes, speed, style.PALETTE[0], "Pinion speed (rpm)"),
        (right, torque, style.PALETTE[1], "Torque on the gear (N m)"),
    ):
        side.plot(x, values, color=color)
        side.set_ylabel(label, color=color)
        scale(side, [values])
    right.spines["right"].set_visible(True)
    right.grid(False)
    axes.set_xlabel(abscissa_label(view, record))


def stacked(about: str, *panels: Trace) -> Drawing:
    """A figure of panels over the mesh cycles, one above the other."""
    return Drawing(about, partial(_over_phase, panels))


#: Of every record over time with loads, films and friction of pairs.
DRAWINGS: dict[str, Drawing] = {
    "overview": Drawing(
        "path of contact, transmission error, load, friction, film, efficiency", overview_figure
    ),
    "transmission-error": stacked(
        "transmission error, and deflection along the normal of every pair", TRANSMISSION_ERROR, DEFLECTION
    ),
    "spectrum": Drawing(
        "spectrum of the rotational transmission error, with the modes", spectrum_figure, has_spectra
    ),
    "normal-load": stacked("normal load of every pair", NORMAL_LOAD),
    "friction": stacked("friction force and coefficient", FRICTION_FORCE, FRICTION_COEFFICIENT),
    "film": stacked("film thickness and film parameter", FILM_THICKNESS, FILM_PARAMETER),
    "entrainment": stacked("entrainment and sliding speed", ENTRAINMENT, SLIDING),
    "pressure": stacked("Hertz pressure and flash temperature", HERTZ_PRESSURE, FLASH_TEMPERATURE),
    "efficiency": stacked("instantaneous efficiency", EFFICIENCY),
    "mesh-stiffness": stacked("stiffness of every pair, and of all together", STIFFNESS),
    "path-of-contact": Drawing("both gears in mesh, path of contact, key points", path_figure),
}


_REVOLUTION = "revolution"
#: Dataset, what stands beside its axis, and what its values are multiplied by.
_BY_REVOLUTION = (
    ("revolution_transmission_error_rms", "Transmission error,\nrms about its mean (µm)", 1e6),
    ("revolution_normal_load_max", "Maximum load\nof a pair (kN)", 1e-3),
    ("revolution_film_thickness_min", "Minimum\nfilm (µm)", 1e6),
)


def has_revolutions(record: Record) -> bool:
    """Whether a record has more than one row by revolution."""
    return _REVOLUTION in record and len(record[_REVOLUTION]) > 1


def revolutions_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw the rows by revolution of the first record, a curve for each mesh."""
    record = records[0]
    figure = new_figure(7.0, 5.2)
    panels = figure.subplots(len(_BY_REVOLUTION), 1, sharex=True)
    for axes, (name, label, factor) in zip(panels, _BY_REVOLUTION, strict=True):
        values = factor * record.over_meshes(name)
        for column, (mesh, curve) in enumerate(zip(record.meshes, values.T, strict=True)):
            axes.plot(record[_REVOLUTION], curve, color=PALETTE[column % len(PALETTE)], label=mesh, lw=1.0)
        finite = values[np.isfinite(values)]
        scale(axes, [finite] if finite.size else [])
        axes.set_ylabel(label)
    if len(record.meshes) > 1:
        panels[0].legend(fontsize=7, ncols=3)
    panels[-1].set_xlabel("Revolution of the gear that drives the first mesh")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


REVOLUTIONS = Drawing(
    "transmission error, load and film by revolution, of gears whose teeth differ",
    revolutions_figure,
    has_revolutions,
)
