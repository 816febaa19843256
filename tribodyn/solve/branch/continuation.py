"""Steady motions followed along a parameter, with the period that they have, as far as their branch goes.

A leg leads from one value of the parameter to another, from the motion at the first. A periodic motion is
followed by Newton's method in steps that control themselves, between the values asked for too: a branch is
left only where it ends, whatever these are. There the end is located, the system is marched from the last
state at a fixed relative distance beyond it, and the motion that it comes to is followed in turn. A motion
without period is marched along values that do not depend on those asked for either. A leg depends on nothing
but the state and the period at its start, so that a sweep can be taken up from any of its values.

Legs are generators that ask for what they need; what all legs ask for at a time is computed in one batch.
"""

from collections.abc import Generator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.solve.branch.arclength import (
    CORNER,
    FOLD,
    NEAR_ZERO,
    BranchEnd,
    Seed,
    SystemFamily,
    kind_of_end,
)
from tribodyn.solve.branch.requests import Continue, Correct, FollowArc, Relax, Request, RequestResult, fulfil
from tribodyn.solve.orbit.motions import FAILED, Orbit
from tribodyn.solve.orbit.shooting import NEUTRAL

#: Steps of the parameter, over its magnitude (`Leg.size`): the first of a leg, the largest, that where two
#: complex multipliers are about to meet on the real axis, where an unstable range may be narrow, and that to
#: which an end is located.
FIRST, LARGEST, NARROW, LOCATED = 5e-3, 1e-2, 2.5e-3, 2e-5
#: Distance beyond an end, over the parameter's magnitude, at which the system is marched on.
NUDGE = 1e-3
#: Change of the state over a step, of its size and at least of the scale, above which the step is halved; and
#: movement of the multipliers.
MOVED, TURNED = 0.15, 0.3
#: Moduli of multipliers that matter for the step, and the distance of complex ones from the real axis where
#: they are about to meet.
MATTERS, MEETING = 0.8, 0.2
#: Shares of the way from a stable to an unstable place of a branch at which a place is sought, until one is
#: found: Newton's method may fail in between too.
SHARES = (0.5, 0.35, 0.65, 0.2, 0.8)
#: Ends in one leg after which it is marched.
MOST_ENDS = 8
#: Values in every factor of two at which a motion without period is marched, and periods at each: at most
#: that part of those that a search may march.
VALUES, PERIODS, PART = 256, 96, 20


class Leg(NamedTuple):
    """A way to go: from the motion at one value of the parameter to another value."""

    line: int  # which of the family's lines
    #: start, target: values of the parameter; equal where nothing was found before
    start: float
    target: float
    state: Float[Array, " state"]  # at the start
    period: int  # of the motion there; 0: it has none, or is not known
    #: minimum step where steps are expensive; 0: as small as it takes; inf: there is nothing in between
    finest: float = 0.0
    #: largest magnitude that the parameter takes: near zero, steps are measured by a quarter of it
    reach: float = 0.0

    def size(self, value: float) -> float:
        """Magnitude of the parameter, by which steps are measured."""
        return max(abs(value), NEAR_ZERO * self.reach)


class Arrival(NamedTuple):
    """How a leg ended."""

    orbit: Orbit  # at the target
    #: from which the next leg begins; of a motion without period the last one marched in between
    next_state: Float[Array, " state"]
    ends: tuple[BranchEnd, ...]  # of the branches that were left on the way
    seeds: tuple[Seed, ...] = ()  # from where these go on, one for each end


_Requests = Generator[Request, RequestResult, Arrival]


def follow(
    family: SystemFamily, legs: Sequence[Leg], *, tolerance: float = 1e-7, max_periods: int = 2000
) -> list[Arrival]:
    """Go all legs, side by side; `tolerance` and `max_periods` are those of `search.find`."""
    arrivals: dict[int, Arrival] = {}
    going: dict[int, _Requests] = {number: _go(leg, max_periods) for number, leg in enumerate(legs)}
    requests = {number: next(steps) for number, steps in going.items()}
    while going:
        lines = {number: legs[number].line for number in going}
        results = fulfil(family, lines, requests, tolerance, max_periods)
        for number, result in results.items():
            try:
                requests[number] = going[number].send(result)
            except StopIteration as stop:
                arrivals[number] = stop.value
                del going[number], requests[number]
    return [arrivals[number] for number in range(len(legs))]


class _Motion(NamedTuple):
    """A motion at a value of the parameter; without an orbit only its state and period are known."""

    value: float
    state: Float[Array, " state"]
    period: int
    orbit: Orbit | None = None

    @classmethod
    def of(cls, value: float, orbit: Orbit) -> "_Motion":
        return cls(value, orbit.state, orbit.period, orbit)


class _Exit(NamedTuple):
    """The end of a branch, from where it goes on, and the state to march from."""

    end: BranchEnd
    seed: Seed
    state: Float[Array, " state"]


def _go(leg: Leg, max_periods: int) -> _Requests:
    """One leg."""
    here = _Motion(leg.start, leg.state, leg.period)
    ends: list[BranchEnd] = []
    seeds: list[Seed] = []
    way = np.sign(leg.target - leg.start)
    while here.period and here.value != leg.target and len(ends) < MOST_ENDS and np.isfinite(leg.finest):
        outcome = yield from _along(here, leg)
        if isinstance(outcome, _Motion):
            here = outcome
            break
        if np.sign(leg.target - here.value) != way:  # back from beyond an end: the branch begins behind it
            here = here._replace(period=0)
            break
        ends.append(outcome.end)
        seeds.append(outcome.seed)
        if leg.finest:
            here = here._replace(state=outcome.state, period=0)
            break
        value = outcome.end.value + way * NUDGE * leg.size(outcome.end.value)
        orbit, *_ = yield Relax(value, outcome.state)
        here = _Motion(value, orbit.last, orbit.period, orbit)
        if orbit.kind == FAILED:
            here = _Motion(outcome.end.value, outcome.state, 0)
    if here.orbit is not None and here.value == leg.target:
        return Arrival(here.orbit, here.orbit.state, tuple(ends), tuple(seeds))
    state = here.state
    if not here.period and not leg.finest:
        for value in between(here.value, leg.target):
            orbit, *_ = yield Continue(value, state, min(PERIODS, max(1, max_periods // PART)))
            if orbit.kind == FAILED:
                break
            state = orbit.last
    orbit, *_ = yield Relax(leg.target, state)
    return Arrival(orbit, orbit.state if orbit.period else state, tuple(ends), tuple(seeds))


def between(start: float, target: float) -> list[float]:
    """Values between two, the same whatever these are: `VALUES` in every factor of two, in order of going."""
    if start == target or start * target <= 0.0:
        return []
    values: list[float] = []
    low, high = sorted((start, target))
    exponent = int(np.floor(np.log2(min(abs(start), abs(target)))))
    while 2.0**exponent <= max(abs(start), abs(target)):
        octave = np.sign(start) * 2.0**exponent * (1.0 + np.arange(VALUES) / VALUES)
        values += octave[(low < octave) & (octave < high)].tolist()
        exponent += 1
    return sorted(values, reverse=bool(target < start))


def _along(here: _Motion, leg: Leg) -> Generator[Request, RequestResult, "_Motion | _Exit"]:
    """Follow a branch to the target, or to its end; to where it stands if its motions are neutral."""
    target, finest = leg.target, leg.finest
    way = float(np.sign(target - here.value))
    before: _Motion | None = None
    beyond: _Motion | None = None
    step = abs(target - here.value) if finest else FIRST * leg.size(here.value)
    good = missed = 0
    while here.value != target:
        size = leg.size(here.value)
        least = max(LOCATED * size, finest)
        room = abs(target - here.value)
        if beyond is not None:
            room = abs(beyond.value - here.value)
            if room <= least or missed == len(SHARES):
                break
            step = room * SHARES[missed]
        trial = target if beyond is None and step >= 0.99 * room else here.value + way * min(step, room)
        other = before if beyond is None or beyond.period < here.period else beyond
        orbit, scale, _ = yield Correct(trial, _guess(other, here, trial), here.period)
        if _neutral(orbit):
            if here.orbit is None:
                corrected, *_ = yield Correct(here.value, here.state, here.period)
                here = _Motion.of(here.value, corrected) if corrected.period else here
            if here.orbit is not None and _neutral(here.orbit):
                return here  # one of a family of motions at every value, none of which leads to another
        if orbit.period and not _comparable(here, orbit, scale, abs(trial - here.value) / size):
            orbit = replace(orbit, kind=FAILED, period=0)
        if orbit.period == here.period and orbit.stable:
            before, here = here, _Motion.of(trial, orbit)
            good, missed = good + 1, 0
            step *= 2.0 if good > 1 else 1.0
            step = min(step, max(LARGEST * size, finest))
            continue
        good = 0
        if orbit.period:
            beyond, missed = _Motion.of(trial, orbit), 0
            continue
        if beyond is not None:
            missed += 1
            continue
        if abs(trial - here.value) > 1.001 * least:
            step = max(abs(trial - here.value) / 2.0, least)
            continue
        on = yield from _gone_on(here, leg)
        if on is None or on.orbit is None:
            break
        if on.orbit.stable:
            before, here, step = here, on, FIRST * size
        else:
            beyond = on
    if here.value == target:
        return here
    return (yield from _exit(here, beyond, leg))


def _follow_arc(here: _Motion, leg: Leg) -> FollowArc:
    way = float(np.sign(leg.target - here.value))
    return FollowArc(here.value, here.state, here.period, way, leg.size(here.value))


def _gone_on(here: _Motion, leg: Leg) -> Generator[Request, RequestResult, _Motion | None]:
    """A place behind one behind which nothing was found; None where the branch ends."""
    if leg.finest:
        return None
    turn = (yield _follow_arc(here, leg)).turn
    if turn is None or turn.folded or np.sign(leg.target - turn.value) != np.sign(leg.target - here.value):
        return None
    orbit, *_ = yield Correct(turn.value, turn.state, here.period)
    return _Motion.of(turn.value, orbit) if orbit.period == here.period else None


def _exit(here: _Motion, beyond: _Motion | None, leg: Leg) -> Generator[Request, RequestResult, _Exit]:
    """The end behind the last place of a branch, and what was found beyond it."""
    way = float(np.sign(leg.target - here.value))
    last = here.orbit
    if last is None:  # the branch ends at once
        last, *_ = yield Correct(here.value, here.state, here.period)
    value = beyond.value if beyond else here.value + way * max(LOCATED * leg.size(here.value), leg.finest)
    seed, multipliers, state = Seed(here.value, here.state, here.period, way), None, here.state
    merged = False
    if beyond is not None and beyond.orbit is not None:
        state, merged = beyond.state, beyond.period < here.period
        if merged:
            seed = Seed(beyond.value, beyond.state, beyond.period, -way)
        else:
            multipliers = beyond.orbit.multipliers
    kind = kind_of_end(last.multipliers, multipliers, merged)
    value, within = 0.5 * (here.value + value), abs(value - here.value)
    if kind in (FOLD, CORNER) and not leg.finest:
        turn = (yield _follow_arc(here, leg)).turn
        if turn is not None and turn.folded:
            kind, value, within = FOLD, turn.value, turn.within
    end = BranchEnd(kind, value, within, here.period, complex(last.multipliers[0]))
    return _Exit(end, seed, state)


def _guess(other: _Motion | None, here: _Motion, value: float) -> Float[Array, " state"]:
    """The state at a value, by a straight line through a place and another, the last or one beyond."""
    if other is None:
        return here.state
    share = (value - here.value) / (here.value - other.value)
    return here.state + min(share, 2.0) * (here.state - other.state)


def _comparable(here: _Motion, orbit: Orbit, scale: Float[Array, " state"], step: float) -> bool:
    """Whether a motion a step farther, over the parameter's magnitude, is surely of the same branch.

    It is near, and no multiplier may have left the unit circle and come back in between.
    """
    if orbit.period < here.period and not orbit.stable:
        return False  # the guess was nearer to the motion whose period doubled
    extent = max(1.0, float(np.max(np.abs(here.state) / scale)))
    if float(np.max(np.abs(orbit.state - here.state) / scale)) > MOVED * extent:
        return False
    if step > NARROW and _meeting(orbit.multipliers):
        return False
    if here.orbit is None or step <= LOCATED or orbit.period != here.period:
        return True
    mattering = [multiplier for multiplier in here.orbit.multipliers if abs(multiplier) > MATTERS]
    return all(np.min(np.abs(orbit.multipliers - before)) <= TURNED for before in mattering)


def _neutral(orbit: Orbit) -> bool:
    return orbit.stable and bool(abs(orbit.multipliers[0]) >= 1.0 - NEUTRAL)


def _meeting(multipliers: Complex[Array, " state"]) -> bool:
    near = (np.abs(multipliers) > MATTERS) & (np.imag(multipliers) != 0.0)
    return bool(np.any(near & (np.abs(np.imag(multipliers)) < MEETING)))
