"""The samples of a record over one mesh cycle: from where a pair enters until the next one does."""

from typing import NamedTuple

import numpy as np

from tribodyn.mesh.cycle import MeshCycle
from tribodyn.studies.efficiency.quadrature import Array

#: By how much of a pitch the first and the last sample stand off the end of the path.
_INSIDE = 1e-9


class Samples(NamedTuple):
    """Phases of the table in the order in which they are passed.

    Attributes
    ----------
    turned : (K,)
        Rotation since the first sample, in pitches.
    phase : (K,)
        Phase of the table at each sample. Where the gear drives it falls: contact begins where the table's
        ends, in the mirrored world in which the back flanks are driving flanks.
    later : (K,) bool
        Where the table counts the pairs one slot later than the record.
    way : float
        +1, or −1 where the gear drives.
    """

    turned: Array
    phase: Array
    later: np.ndarray
    way: float

    def by_pair(self, values: Array) -> Array:
        """Values (K, Q) of the table's slots, as those of the record's: the pair that entered last, last."""
        if self.way > 0.0:
            return values
        return np.where(self.later[:, None], np.roll(values, -1, axis=1), values)[:, ::-1]


def samples(cycle: MeshCycle, count: int, way: float) -> Samples:
    """Return count + 1 samples over one mesh cycle of the driving flanks, or of the back flanks."""
    turned = np.linspace(0.0, 1.0, count + 1)
    if way > 0.0:
        return Samples(turned, turned, np.zeros(count + 1, dtype=bool), way)
    span = float((cycle.roll_end - cycle.roll_start) / cycle.pitch_angle)
    # the pair in the first slot enters where the table lets it leave: just inside the path, and the next one
    # is just outside when the cycle ends
    falling = span - (cycle.front_pairs - 1.0) - turned - _INSIDE * (1.0 - 2.0 * turned)
    later = falling < 0.0
    return Samples(turned, np.where(later, falling + 1.0, falling), later, way)
