"""Marching by SciPy's DOP853 alone, with a comparison against what a followed sweep reports.

Nothing of the package's solvers is used: of the oscillator only its equation, of a gear pair the right-hand
side and the engagement of pairs.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.kernels.native import packed
from tribodyn.solve.right_hand_side import engage, rhs, work_array

#: Steps of the parameter from the neighbour to the point, periods marched at each, and then in a block.
STEPS, CARRIED, BLOCK = 6, 24, 48
#: Blocks at most, and the factor by which the largest distance of a few must fall in as many to go on: where
#: multipliers are complex and almost 1 in modulus, the distance swings while it falls.
BLOCKS, FALLING, FEW = 60, 0.8, 4
#: Distance over the motion's size, at least over the scale, within which two motions are the same.
SAME = 1e-4
#: Distance beyond an end, over the parameter, within which the sweep marches on from it.
NUDGED = 2e-3

March = Callable[[float, np.ndarray, int], np.ndarray]
"""(value of the parameter, state (N,), periods) -> states (periods, N) after every period, over the scale."""


def oscillator_march(
    parameters: Sequence[float],
    state: Sequence[float] | np.ndarray,
    periods: int,
    rtol: float = 1e-12,
    max_step: float = 0.1,
) -> np.ndarray:
    """States once per period of the oscillator with backlash, restarted at every corner that events find."""
    damping, mean_force, error, variation, frequency = parameters

    def rates(t, y, side):
        cosine = np.cos(frequency * t)
        force = 0.0 if side == 0 else y[0] - side
        push = mean_force + error * frequency**2 * cosine
        return [y[1], push - 2.0 * damping * y[1] - (1.0 + variation * cosine) * force]

    def leaving(corner, direction):
        def event(t, y, side):
            return y[0] - corner

        event.terminal, event.direction = True, direction
        return event

    y, found = np.array(state, dtype=float), []
    side = int(np.sign(y[0])) if abs(y[0]) > 1.0 else 0
    for period in range(periods):
        t, end = 2.0 * np.pi * np.array([period, period + 1]) / frequency
        while t < end:
            events = [leaving(1.0, 1), leaving(-1.0, -1)] if side == 0 else [leaving(side, -side)]
            part = solve_ivp(
                rates,
                (t, end),
                y,
                "DOP853",
                args=(side,),
                events=events,
                rtol=rtol,
                atol=rtol / 10.0,
                max_step=max_step,
            )
            t, y = part.t[-1], part.y[:, -1]
            if part.status == 1:
                side = (1 if part.t_events[0].size else -1) if side == 0 else 0
        found.append(y.copy())
    return np.array(found)


def gear_march(model: Model, state: np.ndarray, cycles: int, atol: np.ndarray) -> np.ndarray:
    """States (cycles, states) of a gear pair behind the engagement that ends every mesh cycle."""
    place, rates, work = np.empty_like(state), np.empty_like(state), work_array(model)
    arguments = [packed(item) for item in (place, with_shared_code(model), work, rates)]

    def slope(phase, y, interval):
        place[:] = y
        rhs(phase, 0.0, interval, *arguments)
        return rates.copy()

    y, found = state.copy(), []
    schedule = model.schedule
    for _ in range(cycles):
        for interval, ends in enumerate(zip(schedule.start, schedule.end, strict=True)):
            if interval:
                engage(interval, True, y, model, work, y)
            y = solve_ivp(slope, ends, y, "DOP853", args=(interval,), rtol=1e-12, atol=atol).y[:, -1]
        engage(0, True, y, model, work, y)
        found.append(y.copy())
    return np.array(found)


class Reported(NamedTuple):
    """What a followed sweep says at one value: the value, state over its scale, period (0: none)."""

    value: float
    state: np.ndarray
    period: int


class Compared(NamedTuple):
    """Outcome at a point; changes and distances over the size of the motion, NaN without period."""

    verdict: str  # "same", "no period", "behind an end", or "differs"
    closes: float  # change of the reported motion over its period by the foreign integrator
    away: float  # distance of the marched motion from the reported one
    period: int  # that is reported


def compared(march: March, neighbour: Reported, point: Reported, ends: Sequence[float]) -> Compared:
    """March from the neighbour's motion to the point, and compare with what is reported there."""
    state = neighbour.state
    for value in np.linspace(neighbour.value, point.value, STEPS)[1:]:
        state = march(float(value), state, CARRIED)[-1]
    low, high = sorted((neighbour.value, point.value))
    margin = NUDGED * abs(point.value)
    behind = any(low - margin <= end <= high + margin for end in ends)
    other = "behind an end" if behind else "differs"
    if not point.period:
        track = march(point.value, state, 4 * BLOCK)[-2 * BLOCK :]
        size = max(1.0, float(np.max(np.abs(track))))
        nearest = min(float(np.max(np.abs(track[n:] - track[:-n]))) for n in range(1, 9))
        return Compared("no period" if nearest > SAME * size else other, np.nan, np.nan, 0)
    size = max(1.0, float(np.max(np.abs(point.state))))
    closes = float(np.max(np.abs(march(point.value, point.state, point.period)[-1] - point.state))) / size
    distances: list[float] = []
    for _ in range(BLOCKS):
        track = march(point.value, state, BLOCK)
        state = track[-1]
        distances.append(float(np.min(np.max(np.abs(track[-point.period :] - point.state), axis=1))) / size)
        before = max(distances[-2 * FEW : -FEW]) if len(distances) >= 2 * FEW else np.inf
        if distances[-1] <= SAME / 100.0 or max(distances[-FEW:]) > FALLING * before:
            break
    away = distances[-1]
    return Compared("same" if away <= SAME else other, closes, away, point.period)
