"""Figures over the phase of the mesh: transmission error, loads, friction, film, speeds, efficiency."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from tribodyn.post.figures.panel import Quantity, View, draw, legend, record_title
from tribodyn.post.style import PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record

TRANSMISSION_ERROR = Quantity("transmission_error", 1e6, "Transmission error (µm)")
NORMAL_LOAD = Quantity("normal_load", 1.0, "Normal load $F_n$ (N)", from_zero=True)
FRICTION_FORCE = Quantity("friction_force", 1.0, "Friction force $F_f$ (N)")
FRICTION_COEFFICIENT = Quantity("friction_coefficient", 1.0, "Friction coefficient µ (–)", from_zero=True)
FILM_THICKNESS = Quantity("central_film_thickness", 1e6, "Film thickness $h_c$ (µm)")
FILM_PARAMETER = Quantity("film_parameter", 1.0, "Film parameter $h_c/σ$ (–)")
ENTRAINMENT = Quantity("entrainment_speed", 1.0, "Entrainment speed (m/s)")
SLIDING = Quantity("sliding_speed", 1.0, "Sliding speed (m/s)")
HERTZ_PRESSURE = Quantity("hertz_pressure", 1e-9, "Hertz pressure $p_H$ (GPa)")
FLASH_TEMPERATURE = Quantity("flash_temperature_rise", 1.0, "Flash temperature rise (K)", from_zero=True)
STIFFNESS = Quantity("mesh_stiffness", 1e-6, "Mesh stiffness (N/µm)", from_zero=True)
EFFICIENCY = Quantity("efficiency", 100.0, "Efficiency (%)")

#: Figures by name: the panels of each, from top to bottom.
PANELS: dict[str, tuple[Quantity, ...]] = {
    "transmission-error": (TRANSMISSION_ERROR,),
    "normal-load": (NORMAL_LOAD,),
    "friction": (FRICTION_FORCE, FRICTION_COEFFICIENT),
    "film": (FILM_THICKNESS, FILM_PARAMETER),
    "entrainment": (ENTRAINMENT, SLIDING),
    "pressure": (HERTZ_PRESSURE, FLASH_TEMPERATURE),
    "efficiency": (EFFICIENCY,),
    "mesh-stiffness": (STIFFNESS,),
}


def over_phase(name: str, records: Sequence[Record], view: View) -> Figure:
    """Draw the figure `name` of `PANELS`."""
    panels = PANELS[name]
    figure = new_figure(WIDTH, PANEL_HEIGHT * len(panels) + 0.4)
    rows = figure.subplots(len(panels), 1, squeeze=False, sharex=True)[:, 0]
    for letter, axes, quantity in zip("abc", rows, panels, strict=False):
        draw(axes, records, quantity, view, first=axes is rows[0], last=axes is rows[-1])
        if len(panels) > 1:
            mark_panel(axes, letter)
    figure.align_ylabels()
    legend(figure, rows[0], records)
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure
