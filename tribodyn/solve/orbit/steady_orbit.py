"""Steady states of periodically driven systems: march, recognise the period, shoot, judge the stability.

Written over `period_map.PeriodMap`, so that the gear model and the backlash oscillator share it. A system is
marched until its states once per period repeat, or until the contraction shows that Newton's method would get
there sooner, with the period that the states show; a state that shooting found is taken only if it is stable
and near what marching was heading for, otherwise marching goes on. What is returned is the motion itself: an
unstable state that marching leaves is named in the message only.
"""

from collections.abc import Callable, Iterator
from typing import Literal

import numpy as np

from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.orbit.period_map import PeriodMap
from tribodyn.solve.orbit.progress import BLOCK, Progress
from tribodyn.solve.orbit.recurrence import Recurrence
from tribodyn.solve.orbit.result import Orbit, failed_orbit
from tribodyn.solve.orbit.shooting import Shot, critical_direction, shoot
from tribodyn.solve.orbit.stability import NEUTRAL, judge
from tribodyn.solve.orbit.wandering import wanderings

Method = Literal["auto", "marching", "shooting"]

#: Estimated distance from the steady state, over the scale, at which Newton's method takes over; it does so
#: from afar too where marching on would take twice the maps of the derivatives that shooting should need.
NEAR = 1e-3
DERIVATIVES = 2
#: Distance within which the result of shooting is that of marching, whatever the last periods did.
THERE = 1e-5
#: Share of the changes over fewer periods that the change over several has where these are sought from afar.
DISTINCT = 0.25
#: Newton steps allowed while marching may go on, and when it may not.
STEPS, LAST_STEPS = 8, 20
#: Periods within which a case that is pushed off an unstable state should have left it, and the largest push.
LEAVING, LARGEST_PUSH = 100, 0.1


def find(
    period_map: PeriodMap,
    states: Float[Array, "case state"],
    *,
    tolerance: float = 1e-7,
    max_periods: int = 2000,
    method: Method = "auto",
    progress: Callable[[float], None] | None = None,
) -> list[Orbit]:
    """Steady states of all systems of a map, each from its own start.

    Parameters
    ----------
    period_map : PeriodMap
    states : (C, N)
        Where each system starts.
    tolerance : float
        Maximum scaled change over a period of the motion.
    max_periods : int
        Periods that a system may march.
    method : {"auto", "marching", "shooting"}
        "marching" takes only what marching alone brings within the tolerance; "shooting" starts Newton's
        method for one period from the states given and takes unstable states too.
    progress : callable, optional
        Called with the share of systems done.
    """
    count = len(states)
    if method == "shooting":
        return _shoot_from(period_map, states, tolerance)
    done: list[Orbit | None] = [None] * count
    so_far = Progress(states, period_map.scale)
    pending = np.arange(count)
    while pending.size:
        wanted: dict[int, list[int]] = {}
        for case, states_on, reason in _block(period_map, so_far, pending, method):
            if reason:
                done[case] = failed_orbit(so_far.current[case], int(so_far.marched[case]), reason)
                continue
            so_far.take(case, states_on, period_map.scale[case])
            period = _candidate(so_far, case, tolerance, method)
            if period:
                wanted.setdefault(period, []).append(case)
            so_far.refine_where_stuck(case)
        for period, these in wanted.items():
            for case, orbit in _attempt(period_map, so_far, these, period, tolerance, method).items():
                done[case] = orbit
        late = [c for c in pending if done[c] is None and so_far.marched[c] + BLOCK > max_periods]
        for case, orbit in _last_resort(period_map, so_far, late, tolerance, method).items():
            done[case] = orbit
        pending = np.array([c for c in pending if done[c] is None], dtype=int)
        if progress:
            progress(1.0 - len(pending) / count)
    return [orbit for orbit in done if orbit is not None]


def _block(
    period_map: PeriodMap, so_far: Progress, pending: Int[Array, " case"], method: Method
) -> Iterator[tuple[int, Float[Array, "period state"], str]]:
    """March all pending systems over a block: number, states (BLOCK, N) and what stopped it."""
    fine = so_far.fine[pending] | (method == "marching")
    for exactly in (False, True):
        cases = pending[fine == exactly]
        if cases.size:
            marched = period_map.march(so_far.current[cases], cases, BLOCK, exactly)
            yield from zip(map(int, cases), marched.states, marched.reasons, strict=True)


def _candidate(so_far: Progress, case: int, tolerance: float, method: Method) -> int:
    """Period for which to try shooting; 0 for none."""
    size = so_far.current.shape[1]
    smaller: list[Recurrence] = []
    for one in so_far.seen[case]:
        n, last, rate = one.period, one.change, one.rate
        settling = any(n % other.period == 0 and other.change <= 100.0 * tolerance for other in smaller)
        distinct = all(last <= DISTINCT * other.change for other in smaller)
        smaller.append(one)
        if settling:  # about to settle to a period that divides this one
            continue
        if last <= tolerance:
            return n
        if method == "marching" or so_far.marched[case] < so_far.next_shot.get((case, n), 0):
            continue
        if rate >= 1.0:
            if last <= THERE:  # so slow, or so near, that the contraction cannot be seen
                return n
            continue
        maps_left = np.log(tolerance / last) / np.log(rate) if rate > 0.0 else 0.0
        near = last / (1.0 - rate**n) <= NEAR
        if near or (distinct and maps_left > 2.0 * n * DERIVATIVES * (size + 2)):
            return n
    return 0


def _attempt(period_map, so_far: Progress, these, period, tolerance, method) -> dict[int, Orbit]:
    """Shoot from where marching stands; returns the orbits that are taken."""
    cases = np.array(these)
    steps = 0 if method == "marching" else STEPS
    shots = shoot(period_map, so_far.current[cases], cases, period, tolerance, steps)
    taken = {}
    for case, shot in zip(these, shots, strict=True):
        so_far.next_shot[case, period] = 2 * int(so_far.marched[case])
        if shot.reason:
            continue
        orbit = judge(period_map, shot, case, period, int(so_far.marched[case]), tolerance)
        neutral = abs(shot.multipliers[0]) >= 1.0 - NEUTRAL
        if orbit.stable and _heading(
            so_far.track[case], shot.state / period_map.scale[case], period, neutral
        ):
            taken[case] = orbit
            continue
        if not orbit.stable and method == "auto":
            _push_off(so_far, case, shot, period, period_map.scale[case])
        so_far.fallback.setdefault(case, orbit)
    return taken


def _push_off(so_far: Progress, case: int, shot: Shot, period: int, scale: Float[Array, " state"]) -> None:
    """Displace a case that sits on an unstable state, which it would take long to leave by itself.

    The more, the slower it would leave.
    """
    if so_far.away(case, shot.state, scale) <= NEAR:
        growth = float(np.abs(shot.multipliers[0])) ** (LEAVING / period)
        push = np.clip(1.0 / growth, NEAR, LARGEST_PUSH) * critical_direction(shot.jacobian, scale)
        so_far.put(case, shot.state + push, scale)


def _heading(
    track: Float[Array, "period state"], target: Float[Array, " state"], period: int, neutral: bool
) -> bool:
    """Whether the last periods came nearer to a state, or had come to it: a neutral one attracts nothing."""
    away = np.max(np.abs(track[::-period] - target), axis=1)[::-1]
    half = len(away) // 2
    return bool(away[-1] <= THERE or (not neutral and np.max(away[half:]) < np.max(away[:half])))


def _last_resort(period_map, so_far: Progress, late, tolerance, method) -> dict[int, Orbit]:
    """What to say of systems that have marched all their periods."""
    said: dict[int, Orbit] = {}
    wandering = []
    shown = {case: so_far.shown(case) for case in late}
    for period in sorted(set(shown.values())):
        cases = [case for case in late if shown[case] == period]
        shots = _last_shots(period_map, so_far, cases, period, tolerance, method)
        for case in cases:
            orbit = shots.get(case)
            away = np.inf if orbit is None else so_far.away(case, orbit.state, period_map.scale[case])
            if orbit is not None and orbit.stable and (away <= NEAR or so_far.approaching(case)):
                message = f"obtained by shooting, {away:.1e} away: {_marched(so_far, case)}"
                said[case] = orbit._replace(message=message)
            else:
                wandering.append(case)
                if orbit is not None:
                    so_far.fallback[case] = orbit
    if wandering:
        cases = np.array(wandering)
        told = wanderings(period_map, so_far.current[cases], cases)
        for case, one in zip(wandering, told, strict=True):
            beside = so_far.fallback.get(case)
            remarks = [_marched(so_far, case), one.describe()]
            if beside is not None:
                stable = "shooting found a stable state that it does not reach"
                remarks.append(stable if beside.stable else f"beside {beside.message}")
            last, marched = so_far.current[case].copy(), int(so_far.marched[case])
            none = np.full(last.shape, np.nan, dtype=complex)
            smallest = float(so_far.smallest[case])
            said[case] = Orbit(
                last, last, 0, smallest, none, False, one.kind, "marching", marched, "; ".join(remarks)
            )
    return said


def _last_shots(period_map, so_far, cases, period, tolerance, method) -> dict[int, Orbit]:
    """Orbits of the last attempt at systems that show a period."""
    if method != "auto":
        return {}
    shots = shoot(period_map, so_far.current[np.array(cases)], np.array(cases), period, tolerance, LAST_STEPS)
    return {
        case: judge(period_map, shot, case, period, int(so_far.marched[case]), tolerance)
        for case, shot in zip(cases, shots, strict=True)
        if not shot.reason
    }


def _marched(so_far: Progress, case: int) -> str:
    smallest = float(so_far.smallest[case])
    return f"marched {so_far.marched[case]} periods without repeating, smallest change {smallest:.1e}"


def _shoot_from(period_map, states, tolerance) -> list[Orbit]:
    orbits = []
    for case, shot in enumerate(shoot(period_map, states, np.arange(len(states)), 1, tolerance)):
        orbits.append(
            failed_orbit(shot.state, 0, shot.reason)
            if shot.reason
            else judge(period_map, shot, case, 1, 0, tolerance)._replace(method="shooting")
        )
    return orbits
