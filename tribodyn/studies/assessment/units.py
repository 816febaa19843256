"""Units of an assessment's figures, for programs that read them."""

from collections.abc import Mapping
from typing import Any

_OF: dict[str, tuple[str, ...]] = {
    "degC": ("theta_M", "theta_B", "theta_M_flash", "theta_int", "theta_S", "theta_intS"),
    "K": ("oil_temperature", "bulk_temperature", "contact_temperature_max", "flash_temperature_max"),
    "m": (
        "h_Y",
        "film_min",
        "loaded_transmission_error_mean",
        "loaded_transmission_error_peak_to_peak",
        "least_peak_to_peak",
        "transmission_error_peak_to_peak",
    ),
    # stiffness per face width: 1e9 N/m2 is 1 N/(mm um)
    "N/m2": ("c_prime", "c_gamma_alpha", "c_gamma_beta"),
    "N/m": ("stiffness_single_pair_at_pitch_point", "mesh_stiffness_mean", "line_load_max"),
    "N m": ("gear_torque", "least_peak_to_peak_torque"),
    "Pa": ("hertz_pressure_max", "pinion_root_tension_max", "gear_root_tension_max"),
    "W": (
        "loss",
        "loss_by_law",
        "loss_lowest",
        "loss_highest",
        "power_in_mean",
        "power_friction_mean",
        "power_load_independent",
    ),
    "rad": ("point_angles",),
    "rad/s": (
        "pinion_speed",
        "resonance_speed",
        "resonance_speeds",
        "dynamic_factor_max_speed",
        "contact_loss_from",
        "contact_loss_to",
    ),
    "s": ("wall_time",),
}
_UNITS = {name: unit for unit, names in _OF.items() for name in names}
#: What is no figure, or has the unit of what is compared.
_WITHOUT = ("limits", "samples")
_SPREAD = "_spread"


def units_of(summary: Mapping[str, Any]) -> dict[str, str]:
    """Unit of every number of a summary by its name, "1" where it has none.

    A value by points, a scatter and a table of values have the unit of the name that they stand under.
    """
    found: dict[str, str] = {}
    for name, value in summary.items():
        unit = _UNITS.get(name.removesuffix(_SPREAD))
        if name in _WITHOUT:
            continue
        if unit is None and isinstance(value, Mapping):
            found |= units_of(value) if not {"worst", "median"} & set(value) else {name: "1"}
        elif not isinstance(value, str | bool):
            found[name] = unit or "1"
    return dict(sorted(found.items()))
