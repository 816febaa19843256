"""Datasets of a pair's record from its states alone."""

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.outputs import evaluated, sampled
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.studies.motion.record import recorded


def outputs(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    model: Model,
    interval: Int[Array, " sample"] | None = None,
) -> dict[str, np.ndarray]:
    """All datasets of a pair's record at samples (n,), by name: (n,), (n, pairs) or (n, dof), SI.

    Arguments as of `dynamics.recorded.outputs.evaluated`.
    """
    return recorded(sampled(evaluated(cycles, states, model, interval)))
