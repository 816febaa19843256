"""Reported quantities of a gear pair's dynamics, how far to trust them, and what a sweep records."""

from collections.abc import Mapping
from typing import Any

from tribodyn.post.report import on_closures, on_energy, on_methods
from tribodyn.quantities.catalogue import QUANTITIES, quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record
from tribodyn.studies.gears.case import ENERGY, TEMPERATURE, TEMPERATURE_SWEPT, TRIBOLOGY

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
    "Geometry": quantities("contact_ratio", "normal_backlash", "stiffness_single_pair_at_pitch_point"),
    "Dynamics": quantities(
        *("mesh_frequency", "transmission_error_mean", "transmission_error_rms"),
        *("transmission_error_peak_to_peak", "transmission_error_harmonics"),
        *("transmission_error_normal_mean", "transmission_error_normal_peak_to_peak"),
        *("mesh_stiffness_mean", "mesh_stiffness_peak_to_peak", "normal_load_max"),
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


#: Relative difference between the extremes of the whole run and those of its last cycles that is said.
DIFFERENT = 0.005

SHORT = {"peak_to_peak": "transmission_error_peak_to_peak", "loss": "power_friction_mean"}

PANELS = (
    *("transmission_error_rotational", "normal_load", "central_film_thickness"),
    *("friction_coefficient", "power_friction"),
)


def on_extremes(summary: Mapping[str, Any]) -> list[str]:
    """Say which extremes of the whole run, or of its last mesh cycles, are not those of the table."""
    described = summary.get("extremes")
    if not described:  # a record of 0.1.0, or of a run that stopped at once
        return []
    said = []
    for part, words in (("run", "Over the whole run"), ("last_cycles", "Over the last mesh cycles")):
        others = []
        for quantity in (QUANTITIES["normal_load_max"], *TRIBOLOGY):
            known, value = described.get(part, {}).get(quantity.name), summary.get(quantity.name)
            if known is None or value is None or not abs(known["value"] - value) > DIFFERENT * abs(value):
                continue
            name = quantity.title[0].lower() + quantity.title[1:]
            at = f" at t = {known['time']:.4g} s" if part == "run" and "time" in known else ""
            others.append(f"{name} {quantity.with_unit(known['value'])}" + at)
        if others:
            said.append(f"{words}: {', '.join(others)}.")
    return said


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked: range of the film law, balance of energy."""
    summary = record.summary
    return [*on_methods(summary), *on_extremes(summary), *on_closures(summary), *on_energy(summary)]
