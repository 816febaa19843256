"""Which gear drives, what it puts into the mesh, and the efficiency: one definition for all studies.

Powers (W) or works (J) keep the signs of a record: the pinion's is positive where it gives to the mesh, the
gear's where it takes from the mesh. Power therefore flows from the pinion to the gear where both are
positive and from the gear to the pinion where both are negative. Where their signs differ nothing passes
through: both give, and friction and damping take it all (an unloaded mesh, or one that locks).
"""

from typing import Any

import numpy as np

from tribodyn.numerics.elementary import namespace


def power_put_in(pinion: Any, gear: Any) -> Any:
    """What the mesh is given, ≥ 0: the pinion's power where that drives, the gear's where that does.

    Parameters
    ----------
    pinion, gear : float or array of one shape
        Power from the pinion to the mesh and from the mesh to the gear, W, or works, J.
    """
    xp = namespace(pinion, gear)
    return xp.maximum(pinion, 0.0) + xp.maximum(-gear, 0.0)


def efficiency(pinion: Any, gear: Any, loss: Any) -> Any:
    """1 − loss over what the driving gear puts in; NaN where power does not pass from one to the other.

    Parameters
    ----------
    pinion, gear
        As for `power_put_in`.
    loss : float or array
        Power or work lost to tooth friction.
    """
    xp = namespace(pinion, gear, loss)
    through = pinion * gear > 0.0
    put_in = xp.where(through, power_put_in(pinion, gear), 1.0)
    return xp.where(through, 1.0 - loss / put_in, np.nan)


def driving_gear(pinion: float, gear: float) -> str:
    """Say which of the two drives: "pinion", "gear" or "neither"."""
    if pinion * gear <= 0.0:
        return "neither"
    return "pinion" if pinion > 0.0 else "gear"
