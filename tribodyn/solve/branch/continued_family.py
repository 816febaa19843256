"""What is asked of systems along a parameter while their motions are followed, and the answers."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.branch.arclength import Rounded, rounded
from tribodyn.solve.branch.end import Seed
from tribodyn.solve.branch.family import Family
from tribodyn.solve.orbit.period_map import PeriodMap
from tribodyn.solve.orbit.result import NOT_PERIODIC, Orbit, failed_orbit
from tribodyn.solve.orbit.shooting import shoot
from tribodyn.solve.orbit.stability import judge
from tribodyn.solve.orbit.steady_orbit import find

#: Newton steps that a step along a branch may take: one that needs more is too long.
STEPS = 6


class Close(NamedTuple):
    """Close a motion of a period at a value, from a guess of its state."""

    value: float
    state: Float[Array, " state"]
    period: int


class Settle(NamedTuple):
    """Find the motion that a state comes to at a value."""

    value: float
    state: Float[Array, " state"]


class Carry(NamedTuple):
    """March a state over some periods at a value."""

    value: float
    state: Float[Array, " state"]
    periods: int


class Round(NamedTuple):
    """Follow a branch by its arclength where nothing is found behind a value.

    Attributes
    ----------
    value, state
        The last place.
    period : int
        Of the motion.
    way : float
        Sense of the parameter, ±1.
    size : float
        Magnitude by which steps of the parameter are measured.
    """

    value: float
    state: Float[Array, " state"]
    period: int
    way: float
    size: float


Request = Close | Settle | Carry | Round


class Answer(NamedTuple):
    """What was found, and the sizes by which its states are measured.

    Attributes
    ----------
    orbit : Orbit
    scale : (N,)
    rounded : Rounded or None
        The answer to `Round`, whose orbit is none.
    """

    orbit: Orbit
    scale: Float[Array, " state"]
    rounded: Rounded | None = None


def answered(
    family: Family,
    lines: Mapping[int, int],
    asked: Mapping[int, Request],
    tolerance: float,
    max_periods: int,
) -> dict[int, Answer]:
    """Answer requests by number, those of a sort and a period side by side.

    Parameters
    ----------
    family : Family
    lines : mapping
        Line of each number.
    asked : mapping
        Request of each number.
    tolerance, max_periods
        As `steady_orbit.find` has them.
    """
    answers: dict[int, Answer] = {}
    alike: dict[tuple[Any, ...], list[int]] = {}
    for number, request in asked.items():
        if isinstance(request, Round):
            seed = Seed(*request[:4])
            state = request.state
            turn = rounded(family, lines[number], seed, request.size, tolerance=tolerance)
            answers[number] = Answer(failed_orbit(state, 0, ""), np.ones_like(state), turn)
            continue
        extra = request[2:]  # periods
        alike.setdefault((type(request), *extra), []).append(number)
    for (sort, *extra), numbers in alike.items():
        values = [asked[number].value for number in numbers]
        period_map, refusals = family.at([lines[number] for number in numbers], values)
        for number, why in zip(numbers, refusals, strict=True):
            if why:
                state = asked[number].state
                answers[number] = Answer(failed_orbit(state, 0, why), np.ones_like(state))
        there = [number for number in numbers if number not in answers]
        if not there:
            continue
        states = np.array([asked[number].state for number in there])
        if sort is Settle:
            orbits = find(period_map, states, tolerance=tolerance, max_periods=max_periods)
        elif sort is Close:
            orbits = _closed(period_map, states, extra[0], tolerance)
        else:
            orbits = _marched(period_map, states, extra[0])
        answers |= dict(zip(there, map(Answer, orbits, period_map.scale), strict=True))
    return answers


def _closed(
    period_map: PeriodMap, states: Float[Array, "case state"], period: int, tolerance: float
) -> list[Orbit]:
    shots = shoot(period_map, states, np.arange(len(states)), period, tolerance, STEPS)
    return [
        failed_orbit(shot.state, 0, shot.reason)
        if shot.reason
        else judge(period_map, shot, case, period, 0, tolerance)
        for case, shot in enumerate(shots)
    ]


def _marched(period_map: PeriodMap, states: Float[Array, "case state"], periods: int) -> list[Orbit]:
    marched = period_map.march(states, np.arange(len(states)), periods, False)
    return [
        failed_orbit(state, 0, reason)
        if reason
        else failed_orbit(track[-1], periods, "")._replace(kind=NOT_PERIODIC)
        for state, track, reason in zip(states, marched.states, marched.reasons, strict=True)
    ]
