"""What a motion is that does not repeat soon: on a torus, chaotic, of a long period, or neither."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.orbit.period_map import PeriodMap
from tribodyn.solve.orbit.recurrence import recurrences
from tribodyn.solve.orbit.result import CHAOTIC, LONGER_PERIOD, NOT_PERIODIC, QUASI_PERIODIC

#: Distance of the companion, over the scale: far above the noise of a finely integrated map, far below the
#: size of a motion. It is brought back to that after every `STRIDE` periods.
APART, STRIDE = 1e-4, 4
#: Strides in which the companion turns into the direction of fastest growth, and over which it is measured.
TURNING, MEASURED = 8, 64
#: Parts of what is measured whose spread gives the error of the mean.
PARTS = 8
#: Exponent, per period, below which a motion neither gathers nor spreads: on a torus the distance stays
#: within a factor of e or so, which over 256 periods is 0.004 per period.
NEUTRAL = 0.01
#: Share of a motion's extent within which a motion on a torus comes back to a former state, and periods
#: before which that is no return.
RETURN, RECENT = 0.05, 16
TINY = np.finfo(float).tiny
#: Share of its extent by which a motion that creeps towards one with a period, or away, changes over that.
CREEP = 1e-3
#: Factor by which the extents of both halves of a settled motion differ at most.
SETTLED = 1.5


class Wandering(NamedTuple):
    """What a motion without period is.

    Attributes
    ----------
    kind : str
        Chaotic where neighbours part, quasi-periodic where they neither part nor gather and the motion comes
        back near former states, of a longer period where they gather; not periodic where none of these
        holds, or the motion is not settled.
    exponent : float
        Largest Lyapunov exponent, per period of the excitation.
    error : float
        Standard error of it.
    """

    kind: str
    exponent: float
    error: float

    def describe(self) -> str:
        """Say how that was decided."""
        return f"largest Lyapunov exponent {self.exponent:+.3f} ± {self.error:.3f} per period"


def wanderings(
    period_map: PeriodMap, states: Float[Array, "row state"], cases: Int[Array, " row"]
) -> list[Wandering]:
    """Tell what the motions are that begin at some states and do not repeat.

    The largest Lyapunov exponent is the mean growth of the distance to a companion that is brought back near
    (G. Benettin, L. Galgani & J.-M. Strelcyn, Phys. Rev. A 14 (1976) 2338): the map need not be smooth.
    """
    scale = period_map.scale[cases]
    rows, size = states.shape
    here, beside = states, states + APART * scale / np.sqrt(size)
    growth = np.zeros((TURNING + MEASURED, rows))
    track = np.zeros((MEASURED * STRIDE, rows, size))
    twice = np.concatenate([cases, cases])
    for stride in range(TURNING + MEASURED):
        marched = period_map.march(np.concatenate([here, beside]), twice, STRIDE, True).states
        here = marched[:rows, -1]
        away = (marched[rows:, -1] - here) / scale
        distance = np.maximum(np.linalg.norm(away, axis=1), TINY)
        growth[stride] = np.log(distance / APART) / STRIDE
        beside = here + APART * scale * away / distance[:, None]
        if stride >= TURNING:
            first = (stride - TURNING) * STRIDE
            track[first : first + STRIDE] = np.swapaxes(marched[:rows], 0, 1) / scale
    measured = growth[TURNING:]
    parts = measured.reshape(PARTS, -1, rows).mean(axis=1)
    errors = parts.std(axis=0, ddof=1) / np.sqrt(PARTS)
    return [_told(float(measured[:, row].mean()), float(errors[row]), track[:, row]) for row in range(rows)]


def _told(exponent: float, error: float, track: Float[Array, "period state"]) -> Wandering:
    extent = np.ptp(track, axis=0)
    halves = [float(np.max(np.ptp(half, axis=0))) for half in np.split(track, 2)]
    if not np.isfinite(exponent) or max(halves) > SETTLED * min(halves):
        return Wandering(NOT_PERIODIC, exponent, error)
    if abs(exponent) > max(NEUTRAL, 3.0 * error):
        return Wandering(CHAOTIC if exponent > 0.0 else LONGER_PERIOD, exponent, error)
    nearest = float(np.min(np.max(np.abs(track[:-RECENT] - track[-1]), axis=1)))
    creeps = min(one.change for one in recurrences(track)) <= CREEP * np.max(extent)
    on_torus = abs(exponent) <= NEUTRAL and nearest <= RETURN * np.max(extent) and not creeps
    return Wandering(QUASI_PERIODIC if on_torus else NOT_PERIODIC, exponent, error)
