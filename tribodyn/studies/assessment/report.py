"""Reported quantities of an assessment, and how far to trust them."""

from tribodyn.quantities.catalogue import quantities, scatter_of
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": quantities("contact_ratio", "contact_ratio_effective"),
    "Loaded contact": (
        *quantities("loaded_transmission_error_peak_to_peak"),
        scatter_of("loaded_transmission_error_peak_to_peak"),
        *quantities("face_load_factor"),
        scatter_of("face_load_factor"),
        *quantities("transverse_load_factor", "transverse_load_factor_method_b"),
        scatter_of("transverse_load_factor"),
        *quantities("pinion_root_tension_max", "gear_root_tension_max"),
    ),
    "Steady states": (
        *quantities("dynamic_factor"),
        scatter_of("dynamic_factor"),
        *quantities("dynamic_factor_max", "dynamic_factor_max_speed", "contact_loss_speed_from"),
    ),
    "Film and losses": quantities(
        *("specific_film_min", "contact_temperature_max", "power_friction_mean"),
        *("efficiency", "efficiency_lowest", "efficiency_highest"),
    ),
    "Solver": quantities("wall_time"),
}

SWEPT = quantities(
    *("efficiency", "power_friction_mean", "dynamic_factor", "dynamic_factor_max"),
    *("hertz_pressure_max", "specific_film_min", "contact_temperature_max"),
    *("loaded_transmission_error_peak_to_peak", "pinion_root_tension_max", "gear_root_tension_max"),
)

PANELS = ("hertz_pressure", "contact_temperature", "specific_film")


def sentences(record: Record) -> list[str]:
    """Say what is assumed and what is extrapolated."""
    summary = record.summary
    return [str(text) for name in ("assumed", "extrapolated") for text in summary.get(name, {}).values()]
