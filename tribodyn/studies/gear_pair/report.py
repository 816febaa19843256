"""Lines and sentences of the summary of a gear pair's dynamics."""

from tribodyn.post.report import Line, Lines, on_closures, on_energy, on_methods
from tribodyn.record.reader import Record
from tribodyn.studies.gear_pair.sweep_layout import FIGURES
from tribodyn.studies.gears import (
    CONTACT_RATIO,
    ENERGY,
    MESH_FREQUENCY,
    NORMAL_LOAD,
    SINGLE_PAIR,
    TRIBOLOGY,
    WALL_TIME,
)

LINES: Lines = {
    "Geometry": (CONTACT_RATIO, SINGLE_PAIR),
    "Dynamics": (
        MESH_FREQUENCY,
        Line("transmission_error_mean", "Transmission error, mean", 1e6, "µm"),
        Line("transmission_error_peak_to_peak", "Transmission error, peak to peak", 1e6, "µm"),
        NORMAL_LOAD,
        Line("dynamic_factor", "Dynamic factor", form=".3f"),
        Line("contact_loss_fraction", "Time without contact", 100.0, "%", ".3g"),
    ),
    "Tribology": TRIBOLOGY,
    "Energy": ENERGY,
    "Solver": (
        Line("solver", "Method"),
        Line("steps", "Steps", form=",d"),
        Line("rhs_evaluations", "Right-hand sides", form=",d"),
        WALL_TIME,
    ),
}


SWEPT = FIGURES

#: What a sweep prints, minimum and maximum of each.
SWEEP_LINES = (
    Line("transmission_error_rms", "Transmission error, RMS", 1e6, "µm"),
    Line("transmission_error_peak_to_peak", "Transmission error, peak to peak", 1e6, "µm"),
    Line("dynamic_factor", "Dynamic factor", form=".3f"),
    Line("normal_load_max", "Maximum normal load", form=",.0f", unit="N"),
    Line("hertz_pressure_max", "Maximum Hertz pressure", 1e-9, "GPa", ".3g"),
    Line("film_min", "Minimum film thickness", 1e6, "µm", ".3g"),
    Line("efficiency", "Efficiency", 100.0, "%", ".3f"),
    Line("friction_work_on_vibration", "Friction's work on the vibration", 100.0, "%", ".2g"),
    Line("contact_loss_fraction", "Time without contact", 100.0, "%", ".3g"),
)


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_closures(summary), *on_energy(summary)]
