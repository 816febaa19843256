"""What is requested of systems along a parameter while their motions are followed, and the results."""

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.branch.arclength import Seed, SystemFamily, Turn, follow_arc
from tribodyn.solve.orbit.motions import NOT_PERIODIC, Orbit, PeriodMap, failed_orbit
from tribodyn.solve.orbit.search import find
from tribodyn.solve.orbit.shooting import closed_orbit, shoot

#: Newton steps that a step along a branch may take: one that needs more is too long.
STEPS = 6


class Correct(NamedTuple):
    """Close a motion of a period at a value, from a guess of its state."""

    value: float
    state: Float[Array, " state"]
    period: int


class Relax(NamedTuple):
    """Find the motion that a state comes to at a value."""

    value: float
    state: Float[Array, " state"]


class Continue(NamedTuple):
    """March a state over some periods at a value."""

    value: float
    state: Float[Array, " state"]
    periods: int


class FollowArc(NamedTuple):
    """Follow a branch from a `Seed` by its arclength; `size` measures steps of the parameter."""

    value: float
    state: Float[Array, " state"]
    period: int
    way: float
    size: float


Request = Correct | Relax | Continue | FollowArc


class RequestResult(NamedTuple):
    """What was found, and the sizes (N,) by which its states are measured; `FollowArc` gives a turn only."""

    orbit: Orbit
    scale: Float[Array, " state"]
    turn: Turn | None = None


def fulfil(
    family: SystemFamily,
    lines: Mapping[int, int],
    requests: Mapping[int, Request],
    tolerance: float,
    max_periods: int,
) -> dict[int, RequestResult]:
    """Fulfil requests by number, each on its line, those of a sort and a period side by side."""
    results: dict[int, RequestResult] = {}
    alike: dict[tuple[type, int], list[int]] = {}
    for number, request in requests.items():
        if isinstance(request, FollowArc):
            seed = Seed(request.value, request.state, request.period, request.way)
            turn = follow_arc(family, lines[number], seed, request.size, tolerance=tolerance)
            results[number] = _refused(request, "")._replace(turn=turn)
        else:
            periods = 0 if isinstance(request, Relax) else request[-1]
            alike.setdefault((type(request), periods), []).append(number)
    for (sort, periods), numbers in alike.items():
        values = [requests[number].value for number in numbers]
        period_map, refusals = family.at([lines[number] for number in numbers], values)
        for number, why in zip(numbers, refusals, strict=True):
            if why:
                results[number] = _refused(requests[number], why)
        there = [number for number in numbers if number not in results]
        if not there:
            continue
        states = np.array([requests[number].state for number in there])
        if sort is Relax:
            orbits = find(period_map, states, tolerance=tolerance, max_periods=max_periods)
        elif sort is Correct:
            orbits = _corrected(period_map, states, periods, tolerance)
        else:
            orbits = _marched(period_map, states, periods)
        results |= dict(zip(there, map(RequestResult, orbits, period_map.scale), strict=True))
    return results


def _refused(request: Request, why: str) -> RequestResult:
    return RequestResult(failed_orbit(request.state, 0, why), np.ones_like(request.state))


def _corrected(
    period_map: PeriodMap, states: Float[Array, "case state"], period: int, tolerance: float
) -> list[Orbit]:
    shots = shoot(period_map, states, np.arange(len(states)), period, tolerance, STEPS)
    return [
        failed_orbit(shot.state, 0, shot.reason)
        if shot.reason
        else closed_orbit(period_map, shot, case, period, 0, tolerance)
        for case, shot in enumerate(shots)
    ]


def _marched(period_map: PeriodMap, states: Float[Array, "case state"], periods: int) -> list[Orbit]:
    marched = period_map.march(states, np.arange(len(states)), periods, False)
    return [
        failed_orbit(state, 0, reason)
        if reason
        else replace(failed_orbit(track[-1], periods, ""), kind=NOT_PERIODIC)
        for state, track, reason in zip(states, marched.states, marched.reasons, strict=True)
    ]
