"""From a wear law's coefficient to the depth worn off flanks in contact; running-in of the roughness.

New flanks smooth each other within some revolutions.

The roughness falls from σ to s σ like σ [s + (1 − s) exp(−N/N_0)]: the simplest course that begins with the
roughness as made and ends with that as run in. Both numbers are the user's, from measured flanks; there is no
default.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float


def specific_slip(rolling_speed: Any, sliding_speed: Any) -> Float[Array, " contact"]:
    """Way by which a flank slides per width of the contact that passes it, abs(v_1 − v_2)/abs(v_own).

    0 where the flank stands still in the contact: it would have to be worn for ever there.
    """
    own, sliding = np.abs(rolling_speed), np.abs(sliding_speed)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(own > 0.0, sliding / own, 0.0)


def depth_per_passage(coefficient: Any, line_load: Any, slip: Any) -> Any:
    """Depth that one passage of the contact wears off a flank, m: K w' times the `specific_slip`.

    K volume per load and way, m²/N, w' load per length of the line of contact, N/m.
    """
    return coefficient * line_load * slip


class RunningIn(NamedTuple):
    """How the roughness falls."""

    roughness_share: float  # s, roughness after over before, 0 < s ≤ 1
    revolutions: float  # N_0, > 0

    def share_at(self, revolutions: float) -> float:
        """Roughness after so many revolutions over that of new flanks."""
        transient = 1.0 - self.roughness_share
        return self.roughness_share + transient * math.exp(-revolutions / self.revolutions)

    def step_at(self, revolutions: float) -> float:
        """Revolutions in which a tenth of the running-in happens, about."""
        return 0.1 * self.revolutions * math.exp(min(revolutions / self.revolutions, 100.0))
