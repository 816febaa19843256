"""Results of the cases of a batch."""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import STATES
from tribodyn.numerics.shapes import Array, Float, Int


class Ensemble(NamedTuple):
    """Results of C cases.

    Attributes
    ----------
    state : (C, STATES)
        At the end, before the next engagement; of a failed case the last one that was accepted.
    samples : (C, window · samples, STATES)
        States over the last `window` cycles at phases k/samples; NaN from where a case failed.
    status : (C,) int
        An `integrator.Status`.
    reached : (C,)
        Mesh cycles done by this call.
    steps, evaluations : (C,) int
        Accepted steps, and evaluations of the right-hand side.
    """

    state: Float[Array, "case state"]
    samples: Float[Array, "case sample state"]
    status: Int[Array, " case"]
    reached: Float[Array, " case"]
    steps: Int[Array, " case"]
    evaluations: Int[Array, " case"]


def nothing_yet(states: Float[Array, "case state"], kept: int) -> Ensemble:
    """Results before anything is integrated, with room for `kept` samples per case."""
    count = len(states)
    return Ensemble(
        states.copy(),
        np.full((count, kept, STATES), np.nan),
        np.zeros(count, dtype=int),
        np.zeros(count),
        np.zeros(count, dtype=int),
        np.zeros(count, dtype=int),
    )
