"""Steady states of periodically driven systems: march, recognise the period, shoot, judge the stability.

Written over `period_map.PeriodMap`, so that the gear model and the backlash oscillator share it. A system is
marched until its states once per period repeat, or until the contraction shows that Newton's method would get
there sooner; a state that shooting found is taken only if it is stable and near what marching was heading
for, otherwise marching goes on. An unstable state that marching leaves is not returned as an average.
"""

from collections.abc import Callable, Iterator
from typing import Literal

import numpy as np

from tribodyn.solve.orbit import Orbit, failed_orbit
from tribodyn.solve.period_map import PeriodMap
from tribodyn.solve.shooting import Shot, shoot

Method = Literal["auto", "marching", "shooting"]

#: Maximum number of excitation periods in one period of the motion.
MAX_PERIOD = 4
#: Periods marched between two looks at the states: at least twice MAX_PERIOD.
BLOCK = 12
#: Estimated distance from the steady state, over the scale, at which Newton's method takes over; it does so
#: from afar too where marching on would take twice the maps of the derivatives that shooting should need.
NEAR = 1e-3
DERIVATIVES = 2
#: Distance within which the result of shooting is that of marching, whatever the last periods did.
THERE = 1e-5
#: Changes of a motion that falls no further, over the scale, which may be the integration's own noise: where
#: contact opens and closes marching at 1e-6 leaves up to a few 1e-4. It is marched finely from then on; and
#: the blocks over which a change must halve not to count as stuck.
NOISE = 1e-2
STUCK = 2
#: Newton steps allowed while marching may go on, and when it may not.
STEPS, LAST_STEPS = 8, 20
#: Distance of a multiplier's modulus from 1 within which a state counts as neutral.
NEUTRAL = 1e-6


class _Progress:
    """What has been marched of every system."""

    def __init__(self, states: np.ndarray):
        self.current = states.copy()
        self.marched = np.zeros(len(states), dtype=int)
        self.next_shot = np.zeros(len(states), dtype=int)
        self.changes = np.full((len(states), MAX_PERIOD), np.inf)
        self.history: list[list[float]] = [[] for _ in states]
        self.track: dict[int, np.ndarray] = {}
        self.fallback: dict[int, Orbit] = {}
        self.fine = np.zeros(len(states), dtype=bool)

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
            self.next_shot[case] = 0


def find(
    period_map: PeriodMap,
    states: np.ndarray,
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
    so_far = _Progress(states)
    pending = np.arange(count)
    while pending.size:
        wanted: dict[int, list[int]] = {}
        for case, states_on, reason in _block(period_map, so_far, pending, method):
            if reason:
                done[case] = failed_orbit(so_far.current[case], int(so_far.marched[case]), reason)
                continue
            track = np.concatenate([so_far.current[case][None], states_on])
            so_far.current[case] = track[-1]
            so_far.marched[case] += BLOCK
            so_far.track[case] = track / period_map.scale[case]
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
    period_map: PeriodMap, so_far: _Progress, pending: np.ndarray, method: Method
) -> Iterator[tuple[int, np.ndarray, str]]:
    """March all pending systems over a block: number, states (BLOCK, N) and what stopped it."""
    fine = so_far.fine[pending] | (method == "marching")
    for exactly in (False, True):
        cases = pending[fine == exactly]
        if cases.size:
            marched = period_map.march(so_far.current[cases], cases, BLOCK, exactly)
            yield from zip(map(int, cases), marched.states, marched.reasons, strict=True)


def _candidate(so_far: _Progress, case: int, tolerance: float, method: Method) -> int:
    """Period for which to try shooting; 0 for none."""
    half, track = BLOCK // 2, so_far.track[case]
    for n in range(1, MAX_PERIOD + 1):
        change = np.max(np.abs(track[n:] - track[:-n]), axis=1)
        # the maximum over n periods: an oscillating approach passes zero now and then
        last, middle = float(np.max(change[-n:])), float(np.max(change[-n - half : -half]))
        so_far.changes[case, n - 1] = last
        if n == 1:
            so_far.history[case].append(float(np.max(change)))
        within = any(n % d == 0 and so_far.changes[case, d - 1] <= 100.0 * tolerance for d in range(1, n))
        if within:  # about to settle to a period that divides this one
            continue
        if last <= tolerance:
            return n
        if method == "marching" or so_far.marched[case] < so_far.next_shot[case]:
            continue
        rate = (last / middle) ** (1.0 / half) if middle > 0.0 else 0.0
        if rate >= 1.0:
            if last <= THERE:  # so slow, or so near, that the contraction cannot be seen
                return n
            continue
        distance = last / (1.0 - rate**n)
        maps_left = np.log(tolerance / last) / np.log(rate) if rate > 0.0 else 0.0
        if distance <= NEAR or maps_left > 2.0 * n * DERIVATIVES * (track.shape[1] + 2):
            return n
    return 0


def _attempt(period_map, so_far: _Progress, these, period, tolerance, method) -> dict[int, Orbit]:
    """Shoot from where marching stands; returns the orbits that are taken."""
    cases = np.array(these)
    steps = 0 if method == "marching" else STEPS
    shots = shoot(period_map, so_far.current[cases], cases, period, tolerance, steps)
    taken = {}
    for case, shot in zip(these, shots, strict=True):
        so_far.next_shot[case] = 2 * so_far.marched[case]
        if shot.reason:
            continue
        orbit = _judge(period_map, shot, case, period, int(so_far.marched[case]), tolerance)
        neutral = abs(shot.multipliers[0]) >= 1.0 - NEUTRAL
        if orbit.stable and _heading(
            so_far.track[case], shot.state / period_map.scale[case], period, neutral
        ):
            taken[case] = orbit
            continue
        if case not in so_far.fallback and not orbit.stable and method == "auto":
            _push_off(so_far, case, shot.state, period_map.scale[case])
        so_far.fallback.setdefault(case, orbit)
    return taken


def _push_off(so_far: _Progress, case: int, state: np.ndarray, scale: np.ndarray) -> None:
    """Displace a case that sits on an unstable state, which it would take long to leave by itself."""
    if np.max(np.abs(so_far.current[case] - state) / scale) <= NEAR:
        so_far.current[case] = state + NEAR * scale


def _heading(track: np.ndarray, target: np.ndarray, period: int, neutral: bool) -> bool:
    """Whether the last periods came nearer to a state, or had come to it: a neutral one attracts nothing."""
    away = np.max(np.abs(track[::-period] - target), axis=1)[::-1]
    half = len(away) // 2
    return bool(away[-1] <= THERE or (not neutral and np.max(away[half:]) < np.max(away[:half])))


def _judge(period_map, shot: Shot, case: int, period: int, marched: int, tolerance: float) -> Orbit:
    """The orbit of a converged shot, with its shortest period and its stability."""
    if period > 1:
        one, scale = np.array([case]), period_map.scale[case]
        track = period_map.march(shot.state[None], one, period, True).states[0]
        for n in range(1, period):
            close = np.max(np.abs(track[n - 1] - shot.state) / scale) <= 100.0 * tolerance
            if period % n == 0 and close:
                again = shoot(period_map, shot.state[None], one, n, tolerance)[0]
                if not again.reason:
                    shot, period = again._replace(steps=again.steps + shot.steps), n
                    break
    modulus = float(np.abs(shot.multipliers[0]))
    stable = modulus <= 1.0 + NEUTRAL
    message = "" if stable else f"an unstable state of period {period}: {_way_out(shot.multipliers[0])}"
    if stable and modulus >= 1.0 - NEUTRAL:
        message = "neutral: a multiplier of modulus 1, neighbouring states neither return nor leave"
    return Orbit(
        state=shot.state,
        last=shot.state,
        period=period,
        residual=shot.residual,
        multipliers=shot.multipliers,
        stable=stable,
        kind=f"period-{period}" if stable else "unstable",
        method="shooting" if shot.steps else "marching",
        marched=marched,
        message=message,
    )


def _way_out(multiplier: complex) -> str:
    """In words, how a state whose largest multiplier this is is left."""
    modulus = f"largest multiplier {abs(multiplier):.4g}"
    if abs(multiplier.imag) > 1e-6 * abs(multiplier):
        return f"{modulus} at ±{np.degrees(abs(np.angle(multiplier))):.0f}°, left by a second frequency"
    if multiplier.real < 0.0:
        return f"{modulus}, negative: left towards twice the period"
    return f"{modulus}, positive: left towards another state"


def _last_resort(period_map, so_far: _Progress, late, tolerance, method) -> dict[int, Orbit]:
    """What to say of systems that have marched all their periods."""
    said: dict[int, Orbit] = {}
    shots: list[Shot | None] = [None] * len(late)
    if method == "auto" and late:
        cases = np.array(late)
        shots = list(shoot(period_map, so_far.current[cases], cases, 1, tolerance, LAST_STEPS))
    for case, shot in zip(late, shots, strict=True):
        marched, last = int(so_far.marched[case]), so_far.current[case].copy()
        orbit = so_far.fallback.get(case)
        if shot is not None and not shot.reason:
            orbit = _judge(period_map, shot, case, 1, marched, tolerance)
        smallest = float(np.min(so_far.changes[case]))
        wandering = f"marched {marched} periods without repeating, smallest change {smallest:.1e}"
        if orbit is not None and orbit.stable and so_far.approaching(case):
            said[case] = orbit._replace(message=f"obtained by shooting, still far away: {wandering}")
        elif orbit is not None and not orbit.stable:
            said[case] = orbit._replace(last=last, marched=marched, message=f"{orbit.message}; {wandering}")
        else:
            beside = "; shooting found a stable state that it does not reach" if orbit else ""
            none = np.full(last.shape, np.nan, dtype=complex)
            message = wandering + beside
            said[case] = Orbit(
                last, last, 0, smallest, none, False, "not periodic", "marching", marched, message
            )
    return said


def _shoot_from(period_map, states, tolerance) -> list[Orbit]:
    orbits = []
    for case, shot in enumerate(shoot(period_map, states, np.arange(len(states)), 1, tolerance)):
        orbits.append(
            failed_orbit(shot.state, 0, shot.reason)
            if shot.reason
            else _judge(period_map, shot, case, 1, 0, tolerance)._replace(method="shooting")
        )
    return orbits
