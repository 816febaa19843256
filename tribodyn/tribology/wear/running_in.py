"""Running-in of the roughness: new flanks smooth each other within some revolutions.

The roughness falls from σ to s σ like σ [s + (1 − s) exp(−N/N_0)]: the simplest course that begins with the
roughness as made and ends with that as run in. Both numbers are the user's, from measured flanks; there is no
default.
"""

import math
from typing import NamedTuple


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
