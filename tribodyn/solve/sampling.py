"""Which samples of a mesh cycle fall into which of its segments."""

from itertools import pairwise

import numpy as np

from tribodyn.numerics.shapes import Array, Float


def sample_phases(boundary: Float[Array, " boundary"], samples: int) -> list[Float[Array, " sample"]]:
    """Phases k/samples of one mesh cycle by segment, to which its start belongs and its end does not."""
    phases = np.arange(samples) / max(samples, 1)
    return [phases[(phases >= start) & (phases < end)] for start, end in pairwise(boundary)]
