"""Periodically driven systems, as maps over a period, and what is found of a motion: its period or kind.

The state of the map is what the motion depends on at the start of a period, sampled once per period (Poincaré
section by the phase of the excitation). A steady state of n periods is a fixed point of the n-fold map.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float, Int

#: Step of a difference quotient, as a share of the state's scale: divides the noise of a map integrated to
#: 1e-9 down to 1e-4 or less of the largest multiplier (measured on the CRC drive at 1 and 5 % damping, where
#: truncation stays below that up to 3e-3), and is a third of the width over which contact sets in.
DIFFERENCE = 1e-3


#: Periods, of maps that are not long, marched between two looks at the states.
BLOCK = 12


class Marched(NamedTuple):
    """States once per period, and what stopped a row."""

    states: Float[Array, "row period state"]  # after one, two, … periods; NaN from a failure on
    reasons: list[str]  # one per row, empty where all went well


class Tangent(NamedTuple):
    """The image of states under the n-fold map, and its derivative there."""

    image: Float[Array, "row state"]  # NaN where a row failed
    jacobian: Float[Array, "row state state"]  # ∂image_i/∂state_j: at a fixed point the monodromy matrix
    reasons: list[str]


class PeriodMap(Protocol):
    """A family of systems driven with one period each, marched many at a time.

    Rows are independent of each other: `cases` says which system a row belongs to, and a system may have any
    number of rows.
    """

    #: (cases, N): sizes by which states are measured.
    scale: Float[Array, "case state"]
    #: Distance, over the scale, within which one derivative has another's multipliers: 0 where it is exact,
    #: the step of the difference quotient where it is not.
    blur: float
    #: Periods that are marched rather than that one is sought by shooting from afar.
    shooting_cost: float
    #: Periods marched between two looks at the states: `BLOCK`, or fewer of long ones, 4 at least.
    block: int

    def march(
        self, states: Float[Array, "row state"], cases: Int[Array, " row"], periods: int, fine: bool
    ) -> Marched:
        """States (R, N) over some periods; `fine` asks for the accuracy that a fixed point needs."""
        ...

    def tangent(
        self, states: Float[Array, "row state"], cases: Int[Array, " row"], periods: int, fine: bool = True
    ) -> Tangent:
        """Image after some periods and its derivative; `fine` asks for the accuracy of multipliers.

        Otherwise they need be no better than a step of Newton's method asks for.
        """
        ...


def by_differences(
    march: Callable[[np.ndarray, np.ndarray, int, bool], Marched],
    states: Float[Array, "row state"],
    cases: Int[Array, " row"],
    periods: int,
    scale: Float[Array, "case state"],
) -> Tangent:
    """The tangent of a map by one-sided differences: N companions per row, all marched in one batch."""
    rows, size = states.shape
    shift = DIFFERENCE * scale[cases]
    moved = states[:, None, :] + shift[:, :, None] * np.eye(size)
    batch = np.concatenate([states[:, None, :], moved], axis=1).reshape(-1, size)
    marched = march(batch, np.repeat(cases, size + 1), periods, True)
    end = marched.states[:, -1].reshape(rows, size + 1, size)
    jacobian = np.swapaxes(end[:, 1:] - end[:, :1], 1, 2) / shift[:, None, :]
    by_row = np.reshape(np.array(marched.reasons, dtype=object), (rows, size + 1))
    return Tangent(end[:, 0], jacobian, [next(filter(None, row), "") for row in by_row])


#: Kinds of motion beside `periodic`: without a period that is sought, what only shooting finds, and none.
LONGER_PERIOD = "longer period"
QUASI_PERIODIC = "quasi-periodic"
CHAOTIC = "chaotic"
NOT_PERIODIC = "not periodic"
UNSTABLE = "unstable"
FAILED = "failed"

#: Maximum number of excitation periods in one period of the motion.
MAX_PERIOD = 8
#: Periods between the two changes whose ratio gives the rate of contraction, and changes of which each is the
#: maximum, at least: an oscillating approach passes zero now and then.
HALF, WINDOW = 6, 3
#: Distance from what a motion is coming to, at least, over its change in a period: the rate is an estimate.
FARTHER = 25.0

#: Distance of the companion, over the scale: far above the noise of a finely integrated map, far below the
#: size of a motion. It is brought back to that after every `STRIDE` periods.
APART, STRIDE = 1e-4, 4
#: Strides in which the companion turns into the direction of fastest growth, and over which it is measured.
TURNING, MEASURED = 8, 64
#: Parts of what is measured whose spread gives the error of the mean.
PARTS = 8
#: Exponent, per period, below which a motion neither gathers nor spreads: on a torus the distance stays
#: within a factor of e or so, which over 256 periods is 0.004 per period.
NEUTRAL_EXPONENT = 0.01
#: Share of a motion's extent within which a motion on a torus comes back to a former state, and periods
#: before which that is no return.
RETURN, RECENT = 0.05, 16
TINY = np.finfo(float).tiny
#: Share of its extent by which a motion that creeps towards one with a period, or away, changes over that.
CREEP = 1e-3
#: Factor by which the extents of both halves of a settled motion differ at most.
SETTLED = 1.5


def periodic(period: int) -> str:
    """The kind of a stable motion that repeats after some periods of the excitation."""
    return f"period-{period}"


@dataclass(frozen=True)
class Orbit:
    """One system's steady state, or what can be said instead."""

    #: on the motion that `kind` names, at the start of a period of the excitation
    state: Float[Array, " state"]
    last: Float[Array, " state"]  # where marching ended: the start for a neighbouring system
    period: int  # periods of the excitation in one of the motion; 0 where none was found
    #: maximum change of the state over one period of the motion, each over its scale; of a motion that is not
    #: periodic the smallest over 1 … `MAX_PERIOD` periods
    residual: float
    #: Floquet multipliers over one period of the motion, largest first; NaN where it has none
    multipliers: Complex[Array, " state"]
    stable: bool  # whether the motion is periodic, with no multiplier outside the unit circle
    #: "period-1" … "period-8"; "longer period"; "quasi-periodic", "chaotic", or "not periodic" where it is
    #: undecided which; "failed"; "unstable" only where shooting alone was asked for
    kind: str
    method: str  # "marching" or "shooting": what closed the orbit to the tolerance
    cycles: int  # periods of the excitation marched before the motion was found or given up
    message: str


def failed_orbit(state: Float[Array, " state"], cycles: int, reason: str) -> Orbit:
    """No steady state, for a reason."""
    return orbit_without_period(state, cycles, np.inf, FAILED, reason)


def orbit_without_period(
    state: Float[Array, " state"], cycles: int, residual: float, kind: str, message: str
) -> Orbit:
    """A motion that was marched to a state and does not repeat."""
    none = np.full(len(state), np.nan, dtype=complex)
    last = state.copy()
    return Orbit(last, last, 0, residual, none, False, kind, "marching", cycles, message)


class Recurrence(NamedTuple):
    """How nearly a motion repeats after a number of excitation periods."""

    period: int
    change: float  # maximum change over that period, of states in units of their scale
    earlier: float  # the same, `half` periods before
    half: int

    @property
    def rate(self) -> float:
        """Factor by which the change falls in a period of the excitation; at least 1 where it does not."""
        return (self.change / self.earlier) ** (1.0 / self.half) if self.earlier > 0.0 else 0.0

    @property
    def distance(self) -> float:
        """Cautious estimate of the distance from a motion that repeats."""
        return self.change * max(1.0 / max(1.0 - self.rate**self.period, 1e-3), FARTHER)


def recurrences(track: Float[Array, "period state"]) -> list[Recurrence]:
    """How nearly a motion repeats after 1, 2, … periods, as many as its states (K, N) can tell, K ≥ 5."""
    distances = []
    for n in range(1, min(MAX_PERIOD, (len(track) - 1) // 2) + 1):
        change = np.max(np.abs(track[n:] - track[:-n]), axis=1)
        width = max(n, min(WINDOW, len(change) - 1))
        half = min(HALF, len(change) - width)
        last, before = change[-width:], change[-width - half : len(change) - half]
        distances.append(Recurrence(n, float(np.max(last)), float(np.max(before)), half))
    return distances


def recognised(candidates: list[Recurrence]) -> list[Recurrence]:
    """The periods that the motion may come to repeat after, the smallest first.

    A motion of n periods changes over m < n of them by as much as its points are apart, however near it is;
    over n it changes by what is left of the transient. So m is excluded where its change exceeds twice the
    distance that is left by the change over n.
    """
    limit = 2.0 * min(recurrence.distance for recurrence in candidates)
    return [recurrence for recurrence in candidates if recurrence.change <= limit]


class Wandering(NamedTuple):
    """The kind of a motion that does not repeat soon."""

    #: chaotic where neighbours part, quasi-periodic where they neither part nor gather and the motion comes
    #: back near former states, of a longer period where they gather; not periodic where none of these holds,
    #: or the motion is not settled
    kind: str
    #: exponent, error: largest Lyapunov exponent, per period of the excitation, and its standard error
    exponent: float
    error: float
    reason: str = ""  # what stopped it while the exponent was measured, which is NaN then

    def describe(self) -> str:
        """How that was decided."""
        if self.reason:
            return f"its largest Lyapunov exponent could not be measured: {self.reason}"
        return f"largest Lyapunov exponent {self.exponent:+.3f} ± {self.error:.3f} per period"


def wanderings(
    period_map: PeriodMap, states: Float[Array, "row state"], cases: Int[Array, " row"]
) -> list[Wandering]:
    """The kinds of the motions that begin at some states and do not repeat.

    The largest Lyapunov exponent is the mean growth of the distance to a companion that is brought back near
    (G. Benettin, L. Galgani & J.-M. Strelcyn, Phys. Rev. A 14 (1976) 2338): the map need not be smooth.
    """
    scale = period_map.scale[cases]
    rows, size = states.shape
    here, neighbour = states, states + APART * scale / np.sqrt(size)
    growth = np.zeros((TURNING + MEASURED, rows))
    track = np.zeros((MEASURED * STRIDE, rows, size))
    twice = np.concatenate([cases, cases])
    why = [""] * rows
    for stride in range(TURNING + MEASURED):
        marched, reasons = period_map.march(np.concatenate([here, neighbour]), twice, STRIDE, True)
        pairs = zip(why, reasons[:rows], reasons[rows:], strict=True)
        why = [before or after or other for before, after, other in pairs]
        if all(why):
            break
        here = marched[:rows, -1]
        away = (marched[rows:, -1] - here) / scale
        distance = np.maximum(np.linalg.norm(away, axis=1), TINY)
        growth[stride] = np.log(distance / APART) / STRIDE
        neighbour = here + APART * scale * away / distance[:, None]
        if stride >= TURNING:
            first = (stride - TURNING) * STRIDE
            track[first : first + STRIDE] = np.swapaxes(marched[:rows], 0, 1) / scale
    measured = growth[TURNING:]
    parts = measured.reshape(PARTS, -1, rows).mean(axis=1)
    errors = parts.std(axis=0, ddof=1) / np.sqrt(PARTS)
    return [
        Wandering(NOT_PERIODIC, np.nan, np.nan, why[row])
        if why[row]
        else _wandering(float(measured[:, row].mean()), float(errors[row]), track[:, row])
        for row in range(rows)
    ]


def _wandering(exponent: float, error: float, track: Float[Array, "period state"]) -> Wandering:
    extent = np.ptp(track, axis=0)
    halves = [float(np.max(np.ptp(half, axis=0))) for half in np.split(track, 2)]
    if max(halves) > SETTLED * min(halves):
        return Wandering(NOT_PERIODIC, exponent, error)
    if abs(exponent) > max(NEUTRAL_EXPONENT, 3.0 * error):
        return Wandering(CHAOTIC if exponent > 0.0 else LONGER_PERIOD, exponent, error)
    nearest = float(np.min(np.max(np.abs(track[:-RECENT] - track[-1]), axis=1)))
    creeps = min(recurrence.change for recurrence in recurrences(track)) <= CREEP * np.max(extent)
    on_torus = abs(exponent) <= NEUTRAL_EXPONENT and nearest <= RETURN * np.max(extent) and not creeps
    return Wandering(QUASI_PERIODIC if on_torus else NOT_PERIODIC, exponent, error)
