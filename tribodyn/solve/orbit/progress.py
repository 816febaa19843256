"""What has been marched of systems on their way to steady states, and what their last states show."""

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.orbit.recurrence import MAX_PERIOD, Recurrence, recognised, recurrences
from tribodyn.solve.orbit.result import Orbit

#: Periods marched between two looks at the states, and states that are looked at: more than twice
#: `recurrence.MAX_PERIOD`.
BLOCK, LOOK = 12, 25
#: Changes of a motion that falls no further, over the scale, which may be the integration's own noise: where
#: contact opens and closes marching at 1e-6 leaves up to a few 1e-4. It is marched finely from then on; and
#: the blocks over which a change must halve not to count as stuck.
NOISE = 1e-2
STUCK = 2


class Progress:
    """What has been marched of every system.

    Parameters
    ----------
    states, scale : (C, N)
        Where each starts, and sizes by which states are measured.
    """

    def __init__(self, states: Float[Array, "case state"], scale: Float[Array, "case state"]):
        self.current = states.copy()
        self.marched = np.zeros(len(states), dtype=int)
        self.next_shot: dict[tuple[int, int], int] = {}
        self.seen: dict[int, list[Recurrence]] = {}
        self.smallest = np.full(len(states), np.inf)
        self.history: list[list[float]] = [[] for _ in states]
        self.track: dict[int, Float[Array, "period state"]] = dict(enumerate((states / scale)[:, None]))
        self.fallback: dict[int, Orbit] = {}
        self.fine = np.zeros(len(states), dtype=bool)

    def take(self, case: int, states: Float[Array, "period state"], scale: Float[Array, " state"]) -> None:
        """Take in a block that was marched, and look at the last states."""
        self.current[case] = states[-1]
        self.marched[case] += BLOCK
        self.track[case] = np.concatenate([self.track[case], states / scale])[-LOOK:]
        found = recurrences(self.track[case])
        self.seen[case] = recognised(found)
        self.smallest[case] = min(one.change for one in found)
        self.history[case].append(max(self.smallest[case], min(one.earlier for one in found)))

    def shown(self, case: int) -> int:
        """Periods after which a case all but repeats; 1 where it does not."""
        nearest = min(self.seen[case], key=lambda one: one.change)
        return nearest.period if nearest.change <= NOISE else 1

    def put(self, case: int, state: Float[Array, " state"], scale: Float[Array, " state"]) -> None:
        """Go on from another state, which what was marched before says nothing of."""
        self.current[case] = state
        self.track[case] = state[None] / scale

    def away(self, case: int, state: Float[Array, " state"], scale: Float[Array, " state"]) -> float:
        """Scaled distance from a state."""
        return float(np.max(np.abs(self.current[case] - state) / scale))

    def approaching(self, case: int) -> bool:
        """Whether the change over a period fell over the second half of what was marched."""
        blocks = self.history[case]
        quarter = max(1, len(blocks) // 4)
        return max(blocks[-quarter:]) < 0.5 * max(blocks[-2 * quarter : -quarter] or [0.0])

    def refine_where_stuck(self, case: int) -> None:
        """March finely, and shoot anew, where the change over a period is small and falls no further."""
        blocks = self.history[case]
        if self.fine[case] or len(blocks) < 2 * STUCK or max(blocks[-STUCK:]) > NOISE:
            return
        if max(blocks[-STUCK:]) >= 0.5 * max(blocks[-2 * STUCK : -STUCK]):
            self.fine[case] = True
            for n in range(1, MAX_PERIOD + 1):
                self.next_shot.pop((case, n), None)
