"""Steady states of periodically driven systems: march, recognise the period, shoot, judge the stability.

Written over `motions.PeriodMap`, so that the gear model and the backlash oscillator share it. A system is
marched until its states once per period repeat, or until the contraction shows that Newton's method would get
there sooner, with the period that the states show; a state that shooting found is taken only if it is stable
and near what marching was heading for, otherwise marching goes on. What is returned is the motion itself: an
unstable state that marching leaves is named in the message only.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Literal

import numpy as np

from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.orbit import motions
from tribodyn.solve.orbit.shooting import NEUTRAL, Shot, closed_orbit, critical_direction, shoot

Method = Literal["auto", "marching", "shooting"]

#: States that are looked at: more than twice `motions.MAX_PERIOD`.
LOOK = 25
#: Changes of a motion that falls no further, over the scale, which may be the integration's own noise: where
#: contact opens and closes marching at 1e-6 leaves up to a few 1e-4. It is marched finely from then on; and
#: the blocks over which a change must halve not to count as stuck.
NOISE = 1e-2
STUCK = 2
#: Estimated distance from the steady state, over the scale, at which Newton's method takes over; it does so
#: from afar too where marching on would take more than the `shooting_cost`.
NEAR = 1e-3
#: Distance within which the result of shooting is that of marching, whatever the last periods did.
THERE = 1e-5
#: Share of the changes over fewer periods that the change over several has where these are sought from afar.
DISTINCT = 0.25
#: Newton steps allowed while marching may go on, and when it may not.
STEPS, LAST_STEPS = 8, 20
#: Periods within which a case that is pushed off an unstable state should have left it, and the largest push.
LEAVING, LARGEST_PUSH = 100, 0.1


def find(
    period_map: motions.PeriodMap,
    states: Float[Array, "case state"],
    *,
    tolerance: float = 1e-7,
    max_periods: int = 2000,
    method: Method = "auto",
    progress: Callable[[float], None] | None = None,
) -> list[motions.Orbit]:
    """Steady states of all systems of a map, each from its own start.

    `tolerance` is the maximum scaled change over a period of the motion, `max_periods` are those that a
    system may march. "marching" takes only what marching alone brings within the tolerance; "shooting" starts
    Newton's method for one period from the states given and takes unstable states too. `progress` is called
    with the share of systems done.
    """
    if method == "shooting":
        orbits = []
        for case, shot in enumerate(shoot(period_map, states, np.arange(len(states)), 1, tolerance)):
            if shot.reason:
                orbits.append(motions.failed_orbit(shot.state, 0, shot.reason))
                continue
            orbits.append(replace(closed_orbit(period_map, shot, case, 1, 0, tolerance), method=method))
        return orbits
    search = OrbitSearch(period_map, states, tolerance, max_periods, method)
    while search.pending.size:
        search.advance()
        if progress:
            progress(1.0 - len(search.pending) / len(states))
    return [search.orbits[case] for case in range(len(states))]


class Progress:
    """What has been marched of every system from its start, and what its last states show."""

    def __init__(self, states: Float[Array, "case state"], scale: Float[Array, "case state"]):
        self.current, self.scale = states.copy(), scale
        self.marched = np.zeros(len(states), dtype=int)
        self.next_shot: dict[tuple[int, int], int] = {}
        self.seen: dict[int, list[motions.Recurrence]] = {}
        self.smallest = np.full(len(states), np.inf)
        self.history: list[list[float]] = [[] for _ in states]
        self.track: dict[int, Float[Array, "period state"]] = dict(enumerate((states / scale)[:, None]))
        self.fallback: dict[int, motions.Orbit] = {}
        self.fine = np.zeros(len(states), dtype=bool)

    def take(self, case: int, states: Float[Array, "period state"]) -> None:
        """Take in a block that was marched, and look at the last states."""
        self.current[case] = states[-1]
        self.marched[case] += len(states)
        self.track[case] = np.concatenate([self.track[case], states / self.scale[case]])[-LOOK:]
        recurrences = motions.recurrences(self.track[case])
        self.seen[case] = motions.recognised(recurrences)
        self.smallest[case] = min(recurrence.change for recurrence in recurrences)
        earlier = min(recurrence.earlier for recurrence in recurrences)
        self.history[case].append(max(self.smallest[case], earlier))

    def shown(self, case: int) -> int:
        """Periods after which a case all but repeats; 1 where it does not."""
        nearest = min(self.seen[case], key=lambda recurrence: recurrence.change)
        return nearest.period if nearest.change <= NOISE else 1

    def put(self, case: int, state: Float[Array, " state"]) -> None:
        """Go on from another state, to which what was marched before does not apply."""
        self.current[case] = state
        self.track[case] = state[None] / self.scale[case]

    def away(self, case: int, state: Float[Array, " state"]) -> float:
        """Scaled distance from a state."""
        return float(np.max(np.abs(self.current[case] - state) / self.scale[case]))

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
            for n in range(1, motions.MAX_PERIOD + 1):
                self.next_shot.pop((case, n), None)

    def describe(self, case: int) -> str:
        """How far a case was marched without repeating."""
        smallest = float(self.smallest[case])
        return f"marched {self.marched[case]} periods without repeating, smallest change {smallest:.1e}"


class OrbitSearch:
    """The search of `find` by marching and shooting; `orbits` fills up as it goes on."""

    def __init__(
        self, period_map: motions.PeriodMap, states, tolerance: float, max_periods: int, method: Method
    ):
        self.period_map, self.tolerance = period_map, tolerance
        self.max_periods, self.method = max_periods, method
        self.progress = Progress(states, period_map.scale)
        self.pending = np.arange(len(states))
        self.orbits: dict[int, motions.Orbit] = {}

    def advance(self) -> None:
        """March all pending systems over a block, and shoot where that promises something."""
        progress = self.progress
        wanted: dict[int, list[int]] = {}
        for case, states, reason in self._block():
            if reason:
                self.orbits[case] = motions.failed_orbit(
                    progress.current[case], int(progress.marched[case]), reason
                )
                continue
            progress.take(case, states)
            period = self._candidate(case)
            if period:
                wanted.setdefault(period, []).append(case)
            progress.refine_where_stuck(case)
        for period, cases in wanted.items():
            self._attempt(cases, period)
        unfinished = [case for case in self.pending.tolist() if case not in self.orbits]
        most = self.max_periods - self.period_map.block
        self._last_resort([case for case in unfinished if progress.marched[case] > most])
        self.pending = np.array([case for case in unfinished if case not in self.orbits], dtype=int)

    def _block(self) -> Iterator[tuple[int, Float[Array, "period state"], str]]:
        """March over a block: number, states (period, N) and what stopped it."""
        fine = self.progress.fine[self.pending] | (self.method == "marching")
        for exactly in (False, True):
            cases = self.pending[fine == exactly]
            if cases.size:
                current, block = self.progress.current[cases], self.period_map.block
                marched = self.period_map.march(current, cases, block, exactly)
                yield from zip(map(int, cases), marched.states, marched.reasons, strict=True)

    def _candidate(self, case: int) -> int:
        """Period for which to try shooting; 0 for none."""
        smaller: list[motions.Recurrence] = []
        for recurrence in self.progress.seen[case]:
            n, last, rate = recurrence.period, recurrence.change, recurrence.rate
            divisors = (other for other in smaller if n % other.period == 0)
            settling = any(other.change <= 100.0 * self.tolerance for other in divisors)
            distinct = all(last <= DISTINCT * other.change for other in smaller)
            smaller.append(recurrence)
            if settling:  # about to settle to a period that divides this one
                continue
            if last <= self.tolerance:
                return n
            waits = self.progress.marched[case] < self.progress.next_shot.get((case, n), 0)
            if self.method == "marching" or waits:
                continue
            if rate >= 1.0:
                if last <= THERE:  # so slow, or so near, that the contraction cannot be seen
                    return n
                continue
            maps_left = np.log(self.tolerance / last) / np.log(rate) if rate > 0.0 else 0.0
            near = last / (1.0 - rate**n) <= NEAR
            if near or (distinct and maps_left > n * self.period_map.shooting_cost):
                return n
        return 0

    def _shoot(self, cases: list[int], period: int, steps: int) -> Iterator[tuple[int, Shot, motions.Orbit]]:
        """Shoot from where marching stands; the shots that close, with their orbits."""
        places = np.array(cases)
        current = self.progress.current[places]
        shots = shoot(self.period_map, current, places, period, self.tolerance, steps)
        for case, shot in zip(cases, shots, strict=True):
            if not shot.reason:
                cycles = int(self.progress.marched[case])
                orbit = closed_orbit(self.period_map, shot, case, period, cycles, self.tolerance)
                yield case, shot, orbit

    def _attempt(self, cases: list[int], period: int) -> None:
        """Take the stable orbits that marching was heading for."""
        progress = self.progress
        for case in cases:
            progress.next_shot[case, period] = 2 * int(progress.marched[case])
        for case, shot, orbit in self._shoot(cases, period, 0 if self.method == "marching" else STEPS):
            if orbit.stable and self._heading(case, shot, period):
                self.orbits[case] = orbit
                continue
            if not orbit.stable and self.method == "auto":
                self._push_off(case, shot, period)
            progress.fallback.setdefault(case, orbit)

    def _push_off(self, case: int, shot: Shot, period: int) -> None:
        """Displace a case that sits on an unstable state, the more, the slower it would leave by itself."""
        if self.progress.away(case, shot.state) <= NEAR:
            growth = float(np.abs(shot.multipliers[0])) ** (LEAVING / period)
            direction = critical_direction(shot.jacobian, self.period_map.scale[case])
            self.progress.put(case, shot.state + np.clip(1.0 / growth, NEAR, LARGEST_PUSH) * direction)

    def _heading(self, case: int, shot: Shot, period: int) -> bool:
        """Whether the last periods came nearer to a state, or had come to it: a neutral one attracts none."""
        target = shot.state / self.period_map.scale[case]
        away = np.max(np.abs(self.progress.track[case][::-period] - target), axis=1)[::-1]
        half = len(away) // 2
        neutral = abs(shot.multipliers[0]) >= 1.0 - NEUTRAL
        return bool(away[-1] <= THERE or (not neutral and np.max(away[half:]) < np.max(away[:half])))

    def _last_resort(self, late: list[int]) -> None:
        """The orbits of systems that have marched all their periods."""
        progress = self.progress
        shown: dict[int, list[int]] = {}
        for case in late:
            shown.setdefault(progress.shown(case), []).append(case)
        wandering = []
        for period, cases in sorted(shown.items()):
            shots = self._shoot(cases, period, LAST_STEPS) if self.method == "auto" else ()
            orbits = {case: orbit for case, _, orbit in shots}
            for case in cases:
                orbit = orbits.get(case)
                away = np.inf if orbit is None else progress.away(case, orbit.state)
                if orbit is not None and orbit.stable and (away <= NEAR or progress.approaching(case)):
                    message = f"obtained by shooting, {away:.1e} away: {progress.describe(case)}"
                    self.orbits[case] = replace(orbit, message=message)
                    continue
                wandering.append(case)
                if orbit is not None:
                    progress.fallback[case] = orbit
        if wandering:
            cases: Int[Array, " case"] = np.array(wandering)
            kinds = motions.wanderings(self.period_map, progress.current[cases], cases)
            for case, motion in zip(wandering, kinds, strict=True):
                remarks = [progress.describe(case), motion.describe()]
                fallback = progress.fallback.get(case)
                if fallback is not None:
                    stable = "shooting found a stable state that it does not reach"
                    remarks.append(stable if fallback.stable else f"beside {fallback.message}")
                last, cycles = progress.current[case], int(progress.marched[case])
                smallest = float(progress.smallest[case])
                message = "; ".join(remarks)
                self.orbits[case] = motions.orbit_without_period(last, cycles, smallest, motion.kind, message)
