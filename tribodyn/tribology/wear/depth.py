"""From a wear law's coefficient to the depth that is worn off flanks in contact."""

from typing import Any

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
