"""The orbit that shooting closed: its shortest period, and its stability."""

import numpy as np

from tribodyn.numerics.shapes import Array, Complex
from tribodyn.solve.orbit.period_map import PeriodMap
from tribodyn.solve.orbit.result import UNSTABLE, Orbit, periodic
from tribodyn.solve.orbit.shooting import Shot, shoot

#: Distance of a multiplier's modulus from 1 within which a state counts as neutral.
NEUTRAL = 1e-6
#: Distance over the scale, about the third root of the smallest tolerance, at which motions may have merged.
MERGED = 1e-3


def judge(period_map: PeriodMap, shot: Shot, case: int, period: int, marched: int, tolerance: float) -> Orbit:
    """The orbit of a converged shot over some periods: its shortest period and its stability.

    Parameters
    ----------
    period_map : PeriodMap
    shot : Shot
    case, period : int
        The system, and the periods of the excitation that the shot closes over.
    marched : int
        Periods marched before.
    tolerance : float
        Of the shot.
    """
    for n in range(1, period):
        if period % n == 0:
            again = _over_fewer(period_map, shot, case, n, tolerance)
            if again is not None:
                shot, period = again._replace(steps=again.steps + shot.steps), n
                break
    modulus = float(np.abs(shot.multipliers[0]))
    stable = modulus <= 1.0 + NEUTRAL
    message = "" if stable else f"an unstable state of period {period}: {way_out(shot.multipliers)}"
    if stable and modulus >= 1.0 - NEUTRAL:
        message = "neutral: a multiplier of modulus 1, neighbouring states neither return nor leave"
    return Orbit(
        state=shot.state,
        last=shot.state,
        period=period,
        residual=shot.residual,
        multipliers=shot.multipliers,
        stable=stable,
        kind=periodic(period) if stable else UNSTABLE,
        method="shooting" if shot.steps else "marching",
        marched=marched,
        message=message,
    )


def _over_fewer(period_map: PeriodMap, shot: Shot, case: int, periods: int, tolerance: float) -> Shot | None:
    """The shot over fewer periods, where the motion has no more.

    It has no more where it comes back to within a hundred times the tolerance; and where it nearly does and
    the motion of fewer periods is there and stable: where two merge, the residual falls with the third power
    of the distance and tells them apart no better, but then only one of them is stable.
    """
    scale = period_map.scale[case]
    end = period_map.march(shot.state[None], np.array([case]), periods, True).states[0, -1]
    off = np.max(np.abs(end - shot.state) / scale)
    if not off <= MERGED:
        return None
    again = shoot(period_map, shot.state[None], np.array([case]), periods, tolerance)[0]
    away = np.max(np.abs(again.state - shot.state) / scale)
    if again.reason or away > MERGED:
        return None
    stable = np.abs(again.multipliers[0]) <= 1.0 + NEUTRAL
    return again if stable or off <= 100.0 * tolerance else None


def way_out(multipliers: Complex[Array, " state"]) -> str:
    """In words, how a state with these multipliers, the largest first, is left."""
    largest = multipliers[0]
    modulus = f"largest multiplier {abs(largest):.4g}"
    if abs(largest.imag) > 1e-6 * abs(largest):
        return f"{modulus} at ±{np.degrees(abs(np.angle(largest))):.0f}°, left by a second frequency"
    if largest.real < 0.0:
        return f"{modulus}, negative: left towards twice the period"
    return f"{modulus}, positive: left towards another state"
