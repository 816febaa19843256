"""Results of the cases of a batch."""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.extremes import Extremes, no_extremes, put_extremes
from tribodyn.dynamics.parameters import STATES
from tribodyn.numerics.shapes import Array, Float, Int


class Ensemble(NamedTuple):
    """Results of C cases.

    Attributes
    ----------
    state : at the end, before the next engagement; of a failed case the last one that was accepted
    samples : states over the last `window` cycles at phases k/samples; NaN from where a case failed
    status : an `integrator.Status`
    reached : mesh cycles done by this call
    steps, evaluations : accepted steps, and evaluations of the right-hand side
    extremes : of the motion over the window; of no cases where they were not sought
    """

    state: Float[Array, "case state"]
    samples: Float[Array, "case sample state"]
    status: Int[Array, " case"]
    reached: Float[Array, " case"]
    steps: Int[Array, " case"]
    evaluations: Int[Array, " case"]
    extremes: Extremes


def put(result: Ensemble, places: Int[Array, " some"], part: Ensemble) -> None:
    """Put the results of some cases into those of all."""
    for all_of_it, some in zip(result[:-1], part[:-1], strict=True):
        all_of_it[places] = some
    if len(part.extremes.measure):
        put_extremes(result.extremes, places, part.extremes)


def nothing_yet(states: Float[Array, "case state"], kept: int, extremes: bool = False) -> Ensemble:
    """Results before anything is integrated, with room for `kept` samples per case, and maybe extremes."""
    count = len(states)
    return Ensemble(
        states.copy(),
        np.full((count, kept, STATES), np.nan),
        np.zeros(count, dtype=int),
        np.zeros(count),
        np.zeros(count, dtype=int),
        np.zeros(count, dtype=int),
        no_extremes(count if extremes else 0),
    )
