"""The laws in use on a contact whose radius and entrainment may vanish at the pitch point."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.studies.efficiency.quadrature import Array
from tribodyn.tribology.contact import LocalContact, averaged_radius, local_contact
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import SurfaceState, surface_state


class ContactFriction(NamedTuple):
    """What the laws give, and the contact they saw; arrays of one shape, SI.

    Attributes
    ----------
    surface : SurfaceState
    radius, entrainment
        Averaged over the contact's own width where they vanish at the pitch point.
    contact : LocalContact
        As the laws see it.
    """

    surface: SurfaceState
    radius: Array
    entrainment: Array
    contact: LocalContact


def contact_friction(
    closure: Closure,
    line_load: Array,
    radius: Array,
    pinion_speed: Array,
    gear_speed: Array,
    pitch_point_length: float = 0.0,
    pitch_point_rate: Any = 0.0,
) -> ContactFriction:
    """Evaluate the laws in use.

    Parameters
    ----------
    closure : Closure
    line_load, radius, pinion_speed, gear_speed : array
        N/m, m, and the rolling speeds in m/s.
    pitch_point_length, pitch_point_rate : float
        M (m) and entrainment over equivalent radius (1/s) of `geometry.pitch_point`; 0: nothing vanishes, or
        nothing is averaged.
    """
    sliding = pinion_speed - gear_speed
    seen, speeds = radius + 0.0 * line_load, (pinion_speed, gear_speed)
    if pitch_point_length > 0.0:
        seen = averaged_radius(radius, line_load, closure.surfaces.effective_modulus, pitch_point_length)
        # entrainment is averaged with the radius, to which it is proportional there; sliding is not
        added = pitch_point_rate * (seen - radius)
        speeds = pinion_speed + added, gear_speed + added
    entrainment = (speeds[0] + speeds[1]) / 2.0
    with np.errstate(over="ignore", under="ignore"):
        contact = local_contact(line_load, 1.0 / seen, entrainment, sliding, *speeds)
        return ContactFriction(surface_state(contact, closure), seen, entrainment, contact)
