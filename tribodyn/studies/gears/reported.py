"""Quantities of the catalogue that the studies of gear pairs report alike."""

from tribodyn.quantities.catalogue import quantities

TRIBOLOGY = quantities(
    "film_min",
    "film_parameter_min",
    "film_parameter_min_roll_angle",
    "hertz_pressure_max",
    "flash_temperature_max",
    "friction_coefficient_mean",
    "friction_force_mean",
)
ENERGY = quantities(
    "driving_gear",
    "power_in_mean",
    "power_friction_mean",
    "power_damping_mean",
    "friction_work_on_vibration",
    "efficiency",
)
TEMPERATURE = quantities(
    "bulk_temperature",
    "contact_temperature_max",
    "oil_temperature",
    "power_churning",
    "power_windage",
    "power_bearings",
    "power_load_independent",
    "efficiency_with_losses",
)
#: What sweeps keep of a case that asks for temperatures or losses.
TEMPERATURE_SWEPT = quantities("bulk_temperature", "power_load_independent", "efficiency_with_losses")
