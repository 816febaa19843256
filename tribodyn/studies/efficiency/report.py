"""Reported quantities of an efficiency study, and how far to trust them."""

from tribodyn.gears.case import ENERGY, TEMPERATURE, TEMPERATURE_SWEPT, TRIBOLOGY
from tribodyn.post.report import on_closures, on_energy, on_methods
from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities(
        *("contact_ratio", "contact_ratio_effective", "overlap_ratio", "total_contact_ratio", "slices"),
        "specific_sliding_max",
    ),
    "Dynamics": quantities("mesh_frequency", "normal_load_max"),
    "Tribology": TRIBOLOGY,
    "Energy": (
        *ENERGY,
        *quantities(
            *("load_sharing", "efficiency_elastic", "efficiency_uniform", "efficiency_single_pair"),
            *("efficiency_torque_ratio", "efficiency_loss_factor", "efficiency_hoehn"),
        ),
    ),
    "Temperature": TEMPERATURE,
    "Load spectrum": quantities(
        *("spectrum_efficiency", "spectrum_power_friction_mean"),
        *("duty_share", "duty_efficiency", "duty_power_friction_mean"),
        *("duty_film_parameter_min", "duty_hertz_pressure_max"),
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = (
    *quantities(
        *("efficiency", "power_friction_mean", "friction_coefficient_mean"),
        *("film_min", "hertz_pressure_max", "flash_temperature_max", "film_parameter_min", "normal_load_max"),
        *("contact_ratio", "overlap_ratio", "total_contact_ratio", "specific_sliding_max"),
        *("efficiency_elastic", "efficiency_uniform", "efficiency_single_pair", "efficiency_torque_ratio"),
    ),
    *TEMPERATURE_SWEPT,
    *quantities("friction_in_range_fraction", "closure_in_range_fraction"),
)

SHORT = {"loss": "power_friction_mean"}

PANELS = ("normal_load", "friction_coefficient", "hertz_pressure", "power_friction", "efficiency")


def sentences(record: Record) -> list[str]:
    """Say how well the study satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_closures(summary), *on_energy(summary)]
