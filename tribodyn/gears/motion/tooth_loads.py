"""Loads of the teeth of a mesh in its last cycles, each tooth from its entry to its exit."""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Cycles that loads are of where they do not repeat from one to the next; change that counts as none.
LAST, REPEATED = 4, 1e-3


class ToothLoads(NamedTuple):
    """Loads of the driving flanks over whole mesh cycles, the pair that entered first in front."""

    roll_angle: Float[Array, "position pair"]  # of the pinion from the pitch point, rad
    normal_load: Float[Array, "cycle position pair"]  # N
    mean_load: float  # of all pairs together, over all cycles that were looked at, N

    def seen_from_driven(self, ratio: float) -> "ToothLoads":
        """The same as if the driven gear drove backwards, `ratio` driver's teeth over its own, signed."""
        turned = -ratio * self.roll_angle[::-1, ::-1], self.normal_load[:, ::-1, ::-1]
        return ToothLoads(*turned, self.mean_load)

    def of_load(self, mean: float, dynamic_factor: float) -> "ToothLoads":
        """The same about another mean load, N, and as high as a dynamic factor says at least.

        Between samples loads may be higher than at them.
        """
        reached = float(np.max(np.sum(self.normal_load, axis=2))) / self.mean_load
        factor = max(1.0, dynamic_factor / reached) * mean / self.mean_load
        return self._replace(normal_load=factor * self.normal_load, mean_load=mean)


def tooth_loads(
    phase: Float[Array, " time"],
    load: Float[Array, "time pair"],
    pairs: tuple[int, ...],
    table: dict[str, Any],
    positions: int,
    period: float = 1.0,
) -> ToothLoads | None:
    """Loads at so many positions of a cycle: of the last one where they repeat, else of the most loaded.

    None of a run without a whole cycle of the mesh.

    Parameters
    ----------
    phase : mesh cycles, increasing; a whole number where a pair enters
    load : normal loads by the pairs' numbers, 1 that entered last, N; NaN: none
    table : the mesh cycle of the record, with ``roll_start`` and ``pinion_teeth``
    period : mesh cycles after which the motion may repeat
    """
    front = tuple(number for number in pairs if number <= 1)
    known = np.nan_to_num(load)
    last = math.floor(phase[-1] + 1e-9)
    first = max(last - max(LAST, math.ceil(period - 1e-9)), math.ceil(phase[0] - 1e-9))
    if last <= first:
        return None
    wanted = (np.arange(first * positions, last * positions)) / positions
    at = np.clip(np.searchsorted(phase, wanted, side="right") - 1, 0, len(phase) - 2)
    begun = np.floor(phase + 1e-12).astype(int)
    later = (wanted - phase[at]) / (phase[at + 1] - phase[at])
    entered = np.repeat(np.arange(first, last), positions)
    column = {number: place for place, number in enumerate(pairs)}
    found = np.zeros((len(wanted), len(front)))
    for place, number in enumerate(front):
        for sample, weight in ((at, 1.0 - later), (at + 1, later)):
            # a tooth has another number in the cycle before and after
            slots = [column.get(own, -1) for own in (entered + number - begun[sample]).tolist()]
            values = np.where(np.array(slots) >= 0, known[sample, slots], 0.0)
            found[:, place] += weight * values
    cycles = found.reshape(last - first, positions, len(front))
    if len(cycles) > 1 and np.max(np.abs(cycles[-1] - cycles[-2])) < REPEATED * np.max(cycles):
        cycles = cycles[-1:]
    mean = float(np.mean(np.sum(cycles, axis=2)))
    hardest = np.argsort(-np.max(np.sum(cycles, axis=2), axis=1), kind="stable")[:LAST]
    pitch = 2.0 * math.pi / float(table["pinion_teeth"])
    ages = np.array([1 - number for number in front])
    roll = float(table["roll_start"]) + pitch * ((np.arange(positions) / positions)[:, None] + ages)
    return ToothLoads(roll, cycles[np.sort(hardest)], mean)
