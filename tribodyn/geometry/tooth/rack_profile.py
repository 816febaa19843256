"""Basic rack tooth profiles of ISO 53:1998: pressure angle 20°, heights and root rounding in modules."""

import math
from typing import NamedTuple


class RackProfile(NamedTuple):
    """Tooth of a basic rack, as the gear's own counterpart has it.

    Parameters
    ----------
    pressure_angle : rad
    addendum, dedendum : h_aP and h_fP, modules
    fillet_radius : ρ_fP of the root, which is the tip of the cutter, modules
    """

    pressure_angle: float
    addendum: float
    dedendum: float
    fillet_radius: float


_ALPHA = math.radians(20.0)
#: Table 2 of the standard; A for high torques, B and C for usual service, D for ground or shaved flanks.
PROFILES = {
    "ISO 53 A": RackProfile(_ALPHA, 1.0, 1.25, 0.38),
    "ISO 53 B": RackProfile(_ALPHA, 1.0, 1.25, 0.3),
    "ISO 53 C": RackProfile(_ALPHA, 1.0, 1.25, 0.25),
    "ISO 53 D": RackProfile(_ALPHA, 1.0, 1.4, 0.39),
}
