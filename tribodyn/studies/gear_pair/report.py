"""Reported quantities of a gear pair's dynamics, how far to trust them, and what a sweep records."""

from tribodyn.post.report import on_closures, on_energy, on_methods
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record
from tribodyn.studies.gears.case import ENERGY, TEMPERATURE, TEMPERATURE_SWEPT, TRIBOLOGY
from tribodyn.studies.gears.over_time.extremes_said import on_extremes
from tribodyn.studies.gears.sensed.tables import sensor_tables

#: One number per case, from its steady window.
SWEPT = (
    *quantities(
        *("mesh_frequency", "transmission_error_rms", "transmission_error_peak_to_peak"),
        "transmission_error_mean",
        *("dynamic_factor", "normal_load_max", "hertz_pressure_max"),
        *("film_min", "film_parameter_min", "flash_temperature_max", "friction_coefficient_mean"),
        *("efficiency", "power_in_mean", "power_friction_mean", "friction_work_on_vibration"),
    ),
    *TEMPERATURE_SWEPT,
    *quantities("contact_loss_fraction", "closure_in_range_fraction", "friction_in_range_fraction"),
)


REPORTED: Reported = {
    "Geometry": quantities(
        *("contact_ratio", "overlap_ratio", "total_contact_ratio", "slices", "normal_backlash"),
        "stiffness_single_pair_at_pitch_point",
    ),
    "Dynamics": quantities(
        *("mesh_frequency", "transmission_error_mean", "transmission_error_rms"),
        *("transmission_error_peak_to_peak", "transmission_error_harmonics"),
        *("transmission_error_normal_mean", "transmission_error_normal_peak_to_peak"),
        *("mesh_stiffness_mean", "mesh_stiffness_peak_to_peak", "normal_load_max"),
        *("line_load_max", "axial_force_mean"),
        *("dynamic_factor", "dynamic_factor_iso", "resonance_ratio_iso", "contact_loss_fraction"),
    ),
    "Tribology": TRIBOLOGY,
    "Energy": ENERGY,
    "Temperature": TEMPERATURE,
    "Solver": quantities("solver", "steps", "rhs_evaluations", "wall_time"),
}

#: What a sweep prints, minimum and maximum of each.
SWEEP_TABLE = quantities(
    *("transmission_error_rms", "transmission_error_peak_to_peak", "dynamic_factor", "normal_load_max"),
    *("hertz_pressure_max", "film_min", "efficiency", "friction_work_on_vibration", "contact_loss_fraction"),
)


SHORT = {"peak_to_peak": "transmission_error_peak_to_peak", "loss": "power_friction_mean"}

PANELS = (
    *("transmission_error_rotational", "normal_load", "central_film_thickness"),
    *("friction_coefficient", "power_friction"),
)


#: Of its sensors.
tables = sensor_tables


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_extremes(summary), *on_closures(summary), *on_energy(summary)]
