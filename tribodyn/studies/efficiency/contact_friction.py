"""The friction law on a contact whose radius and entrainment may vanish at the pitch point."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.studies.efficiency.quadrature import Array
from tribodyn.tribology.contact import Contact, averaged_radius
from tribodyn.tribology.friction import friction


class ContactFriction(NamedTuple):
    """What the law gives, and the contact it saw; arrays of one shape, SI.

    Attributes
    ----------
    coefficient, asperity_load_ratio, central_film_thickness, flash_temperature_rise, hertz_pressure, in_range
        As `tribodyn.tribology.friction` gives them.
    radius, entrainment
        Averaged over the contact's own width where they vanish at the pitch point.
    """

    coefficient: Array
    asperity_load_ratio: Array
    central_film_thickness: Array
    flash_temperature_rise: Array
    hertz_pressure: Array
    in_range: Array
    radius: Array
    entrainment: Array


def contact_friction(
    friction_law: int,
    line_load: Array,
    radius: Array,
    pinion_speed: Array,
    gear_speed: Array,
    surfaces: Contact,
    pitch_point_length: float = 0.0,
    pitch_point_rate: Any = 0.0,
) -> ContactFriction:
    """Evaluate the law in use.

    Parameters
    ----------
    friction_law : int
        Code of `tribodyn.tribology.friction`.
    line_load, radius, pinion_speed, gear_speed : array
        N/m, m, and the rolling speeds in m/s.
    surfaces : Contact
    pitch_point_length, pitch_point_rate : float
        M (m) and entrainment over equivalent radius (1/s) of `geometry.pitch_point`; 0: nothing vanishes, or
        nothing is averaged.
    """
    sliding = pinion_speed - gear_speed
    seen, speeds = radius + 0.0 * line_load, (pinion_speed, gear_speed)
    if pitch_point_length > 0.0:
        seen = averaged_radius(radius, line_load, surfaces.effective_modulus, pitch_point_length)
        # entrainment is averaged with the radius, to which it is proportional there; sliding is not
        added = pitch_point_rate * (seen - radius)
        speeds = pinion_speed + added, gear_speed + added
    entrainment = (speeds[0] + speeds[1]) / 2.0
    with np.errstate(over="ignore", under="ignore"):
        found = friction(friction_law, line_load, 1.0 / seen, entrainment, sliding, *speeds, surfaces)
    return ContactFriction(*found, seen, entrainment)
