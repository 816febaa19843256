"""Reported quantities of a train, and how far to trust them."""

from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {}
#: One number per case, from its steady window; of all meshes the worst.
SWEPT = (
    *quantities(
        *("mesh_frequency", "transmission_error_rms", "transmission_error_peak_to_peak"),
        *("dynamic_factor", "normal_load_max", "hertz_pressure_max"),
        *("film_min", "film_parameter_min", "flash_temperature_max"),
        *("efficiency", "power_in_mean", "power_friction_mean", "friction_work_on_vibration"),
        *("bulk_temperature", "contact_loss_fraction"),
        *("closure_in_range_fraction", "friction_in_range_fraction"),
    ),
)
SWEEP_TABLE = quantities(
    *("transmission_error_peak_to_peak", "dynamic_factor", "normal_load_max", "hertz_pressure_max"),
    *("film_min", "efficiency", "contact_loss_fraction"),
)


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked."""
    return []
