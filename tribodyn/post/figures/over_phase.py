"""Figures over the phase of the mesh: transmission error, loads, friction, film, speeds, efficiency."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures.panel import (
    MOST_CYCLES_DRAWN,
    Trace,
    View,
    abscissa,
    draw,
    legend,
    record_title,
)
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, QUIET, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record

TRANSMISSION_ERROR = Trace("transmission_error_rotational", "Transmission error", "$r_pθ_p - r_gθ_g$", "µm")
DEFLECTION = Trace("transmission_error_normal", "Deflection along each pair's normal", "$δ$", "µm")
NORMAL_LOAD = Trace("normal_load", "Normal load of each pair", "$F_n$", "N", from_zero=True)
FRICTION_FORCE = Trace(
    "friction_force", "Friction force on the pinion", "$F_f$", "N", flag="friction_in_range"
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
SLIDING = Trace("sliding_speed", "Sliding speed, pinion less gear", "$v_s$", "m/s")
HERTZ_PRESSURE = Trace("hertz_pressure", "Hertz pressure, maximum in the contact", "$p_H$", "GPa")
FLASH_TEMPERATURE = Trace("flash_temperature_rise", "Flash temperature rise", "$ΔT$", "K", from_zero=True)
STIFFNESS = Trace(
    "mesh_stiffness", "Stiffness of each pair along its normal", "$k_i$", "N/µm", from_zero=True
)
EFFICIENCY = Trace("efficiency", "Efficiency at each moment", "$η$", "%")

#: Figures by name: the panels of each, from top to bottom.
PANELS: dict[str, tuple[Trace, ...]] = {
    "transmission-error": (TRANSMISSION_ERROR, DEFLECTION),
    "normal-load": (NORMAL_LOAD,),
    "friction": (FRICTION_FORCE, FRICTION_COEFFICIENT),
    "film": (FILM_THICKNESS, FILM_PARAMETER),
    "entrainment": (ENTRAINMENT, SLIDING),
    "pressure": (HERTZ_PRESSURE, FLASH_TEMPERATURE),
    "efficiency": (EFFICIENCY,),
    "mesh-stiffness": (STIFFNESS,),
}
#: Film parameters that divide kinds of lubrication, and what lies between.
LUBRICATION = ((1.0, "λ = 1: mixed above, boundary below"), (3.0, "λ = 3: full film above"))


def over_phase(name: str, records: Sequence[Record], view: View) -> Figure:
    """Draw the figure `name` of `PANELS`."""
    panels = PANELS[name]
    figure = new_figure(WIDTH, (PANEL_HEIGHT + 0.15) * len(panels) + 0.5)
    rows = figure.subplots(len(panels), 1, squeeze=False, sharex=True)[:, 0]
    for letter, axes, trace in zip("abc", rows, panels, strict=False):
        names = draw(axes, records, trace, view, first=axes is rows[0], last=axes is rows[-1])
        title = trace.title
        if trace is STIFFNESS:
            draw_total_stiffness(axes, records, view)
            title = "Stiffness of each pair, and of all pairs together along the pitch tangent"
        if trace is FILM_PARAMETER:
            draw_lubrication(axes)
        mark_panel(axes, letter if len(panels) > 1 else "", title, names)
    figure.align_ylabels()
    legend(figure, list(rows), records, view)
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure


def draw_total_stiffness(axes: Axes, records: Sequence[Record], view: View) -> None:
    """Add the stiffness Σ k cos² α of all pairs along the pitch tangent."""
    highest = 0.0
    for number, record in enumerate(records):
        window = last_cycles(record, view.cycles)
        if window.phase[-1] > MOST_CYCLES_DRAWN:
            continue
        angle = np.nan_to_num(record["pressure_angle"][window.part])
        single = record["mesh_stiffness"][window.part]
        total = np.sum(single * np.cos(angle) ** 2, axis=1) * STIFFNESS.factor
        color = INK if len(records) == 1 else PALETTE[number % len(PALETTE)]
        axes.plot(
            abscissa(window, view),
            total,
            color=color,
            linewidth=1.7,
            alpha=0.85,
            label=r"all pairs, $\Sigma\, k_i \cos^2 α_i$",
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
            axes.axhline(value, color=QUIET, linewidth=0.8, linestyle=(0, (5, 2)))
            axes.annotate(
                text,
                (0.995, value),
                xycoords=("axes fraction", "data"),
                xytext=(0, 2),
                textcoords="offset points",
                ha="right",
                fontsize=6.5,
                color=QUIET,
            )
