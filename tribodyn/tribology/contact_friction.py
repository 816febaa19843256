"""The laws in use on a contact whose radius and entrainment may vanish at the pitch point."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import is_jax
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.contact import LocalContact, averaged_radius, local_contact
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import SurfaceState, surface_state


class ContactFriction(NamedTuple):
    """What the laws give, and the contact they saw; arrays of one shape, SI.

    Attributes
    ----------
    radius, entrainment : averaged over the contact's own width where they vanish at the pitch point
    contact : as the laws see it
    """

    surface: SurfaceState
    radius: Float[Array, "*contact"]
    entrainment: Float[Array, "*contact"]
    contact: LocalContact


def contact_friction(
    closure: Closure,
    line_load: Float[Array, "*contact"],
    radius: Float[Array, "*contact"],
    pinion_speed: Float[Array, "*contact"],
    gear_speed: Float[Array, "*contact"],
    pitch_point_length: Any = 0.0,
    pitch_point_rate: Any = 0.0,
) -> ContactFriction:
    """Evaluate the laws in use.

    Parameters
    ----------
    line_load, radius, pinion_speed, gear_speed : N/m, m, and the rolling speeds in m/s
    pitch_point_length, pitch_point_rate : float
        M (m) and entrainment over equivalent radius (1/s) of `geometry.pitch_point`; 0: nothing vanishes, or
        nothing is averaged. A traced length is taken as positive.
    """
    sliding = pinion_speed - gear_speed
    seen, speeds = radius + 0.0 * line_load, (pinion_speed, gear_speed)
    if is_jax(pitch_point_length) or pitch_point_length > 0.0:
        seen = averaged_radius(radius, line_load, closure.surfaces.effective_modulus, pitch_point_length)
        # entrainment is averaged with the radius, to which it is proportional there; sliding is not
        added = pitch_point_rate * (seen - radius)
        speeds = pinion_speed + added, gear_speed + added
    entrainment = (speeds[0] + speeds[1]) / 2.0
    with np.errstate(over="ignore", under="ignore"):
        contact = local_contact(line_load, 1.0 / seen, entrainment, sliding, *speeds)
        return ContactFriction(surface_state(contact, closure), seen, entrainment, contact)
