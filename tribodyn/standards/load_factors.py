"""Load factors K_Hβ and K_Hα from the loads that a contact analysis gives: method A of ISO 6336-1:2019.

The standard's definitions: how far the load of a place exceeds what an even distribution would give.
"""

from typing import Any

import numpy as np

from tribodyn.numerics.shapes import Array, Float


def face_load_factor(line_load: Float[Array, "position pair slice"]) -> float:
    """K_Hβ = (F/b)_max/(F_m/b) over the face, where the line load of a pair is at its maximum: (43)."""
    loads = np.nan_to_num(np.asarray(line_load))
    position, pair, _ = np.unravel_index(np.argmax(loads), loads.shape)
    carried = loads[position, pair]
    return float(np.max(carried) / np.mean(carried))


def transverse_load_factor(share: Any, standard_share: Any) -> float:
    """K_Hα: maximum share of a pair's load over that of accurate teeth, where these carry together.

    Parameters
    ----------
    share : (places,)
        Load of one pair over the load of all, over places of its path, with the deviations that it has.
    standard_share : (places,)
        The same of accurate teeth.
    """
    both = (np.asarray(standard_share) > 0.0) & (np.asarray(standard_share) < 1.0 - 1e-9)
    if not np.any(both):
        return 1.0
    return max(1.0, float(np.max(np.asarray(share)[both]) / np.max(np.asarray(standard_share)[both])))
