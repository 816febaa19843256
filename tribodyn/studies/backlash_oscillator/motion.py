"""Native solver of the oscillator with backlash: Taylor series of each linear piece, corners located exactly.

x'' + 2ζ x' + (1 + ε cos Ωτ) f(x) = F_m + F_e Ω² cos Ωτ with f(x) = x − 1 above 1, 0 between, x + 1 below −1
(Kahraman & Singh, J. Sound Vib. 142 (1990) 49, with ε after the same, 146 (1991) 135). Between the corners
|x| = 1 the equation is linear with entire coefficients, so that its Taylor series converges for every step
and its terms follow from a recurrence; steps are chosen so that the series is exact to rounding. A step never
crosses a corner: the first one is found by steps that a bound on the acceleration proves to be too short to
miss it. The force is continuous there, so that the tangent passes a corner unchanged and the map's derivative
is as exact as the map.
"""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.kernels.native import kernel
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.orbit.motions import BLOCK, Marched, Tangent

#: Columns of a row of parameters: ζ, F_m, F_e, ε, Ω.
DAMPING, MEAN_FORCE, ERROR_AMPLITUDE, STIFFNESS_VARIATION, FREQUENCY = range(5)
#: Columns of a row of measures: integrals over time of x and x², time without contact and with contact on the
#: back side (x < −1), maximum and minimum x.
INTEGRAL, SQUARE, FREE, BACK, MAXIMUM, MINIMUM = range(6)
MEASURES = 6

#: Degree of the Taylor polynomials.
DEGREE = 24
#: Minimum share of a polynomial's size that its last two terms may have.
ROUNDING = 1e-16
#: Distance from a corner, in half backlashes, or time before it, within which it counts as reached.
TOUCH = 1e-13
#: Minimum length of a step that starts on a corner, in units of the natural period over 2π. An excursion
#: across the corner shorter than that, some 1e-14 deep, is not counted.
MINIMUM_STEP = 1e-7
#: Displacement at which a motion counts as growing without bound, half backlashes.
UNBOUNDED = 1e4

DONE, GROWS = 0, 1
REASONS = {GROWS: "the motion grows without bound: the mean force or the varying stiffness feeds it"}


@kernel
def _series(side, parameters, phase, position, velocity, forced, a, cosine):
    """Taylor coefficients a_0 … a_DEGREE of x about `phase`, of the homogeneous equation if not `forced`."""
    frequency = parameters[FREQUENCY]
    amplitude = parameters[ERROR_AMPLITUDE] * frequency * frequency
    cosine[0] = math.cos(phase)
    cosine[1] = -frequency * math.sin(phase)
    for k in range(2, DEGREE + 1):
        cosine[k] = -frequency * frequency * cosine[k - 2] / (k * (k - 1))
    stiffness = 0.0 if side == 0 else 1.0
    variation = stiffness * parameters[STIFFNESS_VARIATION]
    a[0] = position - side if forced else position
    a[1] = velocity
    for k in range(DEGREE - 1):
        term = -2.0 * parameters[DAMPING] * (k + 1) * a[k + 1] - stiffness * a[k]
        if variation != 0.0:
            total = 0.0
            for j in range(k + 1):
                total += cosine[j] * a[k - j]
            term -= variation * total
        if forced:
            term += amplitude * cosine[k]
            if k == 0:
                term += parameters[MEAN_FORCE]
        a[k + 2] = term / ((k + 1) * (k + 2))
    if forced:
        a[0] += side


@kernel
def _value(a, t):
    value = a[DEGREE]
    for k in range(DEGREE - 1, -1, -1):
        value = value * t + a[k]
    return value


@kernel
def _slope(a, t):
    value = DEGREE * a[DEGREE]
    for k in range(DEGREE - 1, 0, -1):
        value = value * t + k * a[k]
    return value


@kernel
def _longest(a):
    """Step within which the last two terms stay below rounding."""
    size = ROUNDING * max(1.0, abs(a[0]), abs(a[1]))
    step = 1e3
    for k in (DEGREE - 1, DEGREE):
        if abs(a[k]) > 0.0:
            step = min(step, (size / abs(a[k])) ** (1.0 / k))
    return step


@kernel
def _until_corner(a, step, corner, direction, on_corner):
    """Time of the first passage of `corner` in `direction` (±1), or `step` if there is none before.

    From a distance p and speed p' the corner cannot be reached before p + p' s − M s²/2 = 0, M bounding the
    acceleration over the step: going on by that s again and again converges to the first root, passing none.
    """
    bound = 0.0
    power = 1.0
    for k in range(2, DEGREE + 1):
        bound += k * (k - 1) * abs(a[k]) * power
        power *= step
    bound = max(bound, 1e-300)
    t = min(MINIMUM_STEP, step) if on_corner else 0.0
    while t < step:
        distance = direction * (corner - _value(a, t))
        away = -direction * _slope(a, t)
        root = math.sqrt(away * away + 2.0 * bound * max(distance, 0.0))
        if away > 0.0:  # at rest on the corner this is too little to add to t
            t += max((away + root) / bound, MINIMUM_STEP)
            continue
        if distance <= TOUCH:
            return t
        advance = 2.0 * distance / (root - away)  # the same, without a difference of equal numbers
        if advance <= TOUCH:
            return t
        t += advance
    return step


@kernel
def _record(a, step, side, measures):
    """Add a step to the integrals and extremes of a row."""
    first = 0.0
    second = 0.0
    power = step
    for i in range(DEGREE + 1):
        first += a[i] * power / (i + 1)
        inner = 0.0
        other = 1.0
        for j in range(DEGREE + 1):
            inner += a[j] * other / (i + j + 1)
            other *= step
        second += a[i] * power * inner
        power *= step
    measures[INTEGRAL] += first
    measures[SQUARE] += second
    if side == 0:
        measures[FREE] += step
    if side == -1:
        measures[BACK] += step
    parts = 8
    before = a[1]
    for part in range(1, parts + 1):
        t = step * part / parts
        after = _slope(a, t)
        place = t
        if before * after < 0.0:  # an extremum inside
            low, high = t - step / parts, t
            for _ in range(48):
                place = 0.5 * (low + high)
                if _slope(a, place) * before > 0.0:
                    low = place
                else:
                    high = place
        for at in (place, t):
            value = _value(a, at)
            measures[MAXIMUM] = max(measures[MAXIMUM], value)
            measures[MINIMUM] = min(measures[MINIMUM], value)
        before = after


@kernel
def _advance(state, parameters, periods, strobes, tangent, measures, with_tangent, with_measures, buffer):
    """March one row; returns its status."""
    frequency = parameters[FREQUENCY]
    duration = 2.0 * math.pi / frequency
    x, v = state[0], state[1]
    side = 1 if x > 1.0 else -1 if x < -1.0 else 0
    on_corner = abs(abs(x) - 1.0) <= TOUCH
    a, b, c, cosine = buffer[0], buffer[1], buffer[2], buffer[3]
    for period in range(periods):
        time = 0.0
        while time < duration:
            _series(side, parameters, frequency * time, x, v, True, a, cosine)
            remaining = duration - time
            step = min(remaining, _longest(a))
            if with_tangent:
                for column, d in ((0, b), (1, c)):
                    dx, dv = tangent[0, column], tangent[1, column]
                    _series(side, parameters, frequency * time, dx, dv, False, d, cosine)
                    step = min(step, _longest(d))
            whole = step
            turned = side
            if side >= 0:
                corner, direction, other = (1.0, -1.0, 0) if side == 1 else (1.0, 1.0, 1)
                until = _until_corner(a, step, corner, direction, on_corner)
                if until < step:
                    step, turned = until, other
            if side <= 0:
                corner, direction, other = (-1.0, 1.0, 0) if side == -1 else (-1.0, -1.0, -1)
                until = _until_corner(a, step, corner, direction, on_corner)
                if until < step:
                    step, turned = until, other
            if with_measures:
                _record(a, step, side, measures)
            x, v = _value(a, step), _slope(a, step)
            if with_tangent:
                for column, d in ((0, b), (1, c)):
                    tangent[0, column] = _value(d, step)
                    tangent[1, column] = _slope(d, step)
            if not abs(x) < UNBOUNDED:
                return GROWS
            on_corner = turned != side
            side = turned
            time = duration if step == remaining and step == whole else time + step
        strobes[period, 0] = x
        strobes[period, 1] = v
    return DONE


class Rows(NamedTuple):
    """Where the results of rows are written."""

    strobes: Float[Array, "row period 2"]  # states after every period
    tangents: Float[Array, "row 2 2"]  # the identity before, the derivative of the last state after
    measures: Float[Array, "row quantity"]  # zeros before, extremes ∓inf
    status: Int[Array, " row"]


@kernel
def march_rows(states, parameters, periods, into, with_tangent, with_measures, buffer):
    """March rows (R, 2) with parameters (R, 5) over some periods; fills `into`, a `Rows`."""
    for row in range(states.shape[0]):
        state, row_parameters = states[row], parameters[row]
        strobes, tangent, measures = into.strobes[row], into.tangents[row], into.measures[row]
        into.status[row] = _advance(
            state, row_parameters, periods, strobes, tangent, measures, with_tangent, with_measures, buffer
        )


class OscillatorMap:
    """The oscillator's map over a period of the excitation, as `motions.PeriodMap`.

    Its parameters are rows (C, 5) of ζ, F_m, F_e, ε, Ω. The state is (x, dx/dτ) where cos Ωτ = 1, in units of
    the half backlash; it is its own scale.
    """

    blur, shooting_cost, block = 0.0, 16.0, BLOCK

    def __init__(self, parameters: Float[Array, "case 5"]):
        self.parameters = np.ascontiguousarray(parameters, dtype=float)
        self.scale = np.ones((len(self.parameters), 2))

    def march(
        self, states: Float[Array, "row 2"], cases: Int[Array, " row"], periods: int, fine: bool = True
    ) -> Marched:
        """See `motions.PeriodMap`; always as fine as rounding allows."""
        rows, reasons = self._run(states, cases, periods, False, False)
        return Marched(rows.strobes, reasons)

    def tangent(
        self, states: Float[Array, "row 2"], cases: Int[Array, " row"], periods: int, fine: bool = True
    ) -> Tangent:
        """See `motions.PeriodMap`; by the variational equation."""
        rows, reasons = self._run(states, cases, periods, True, False)
        return Tangent(rows.strobes[:, -1], rows.tangents, reasons)

    def measures(
        self, states: Float[Array, "row 2"], cases: Int[Array, " row"], periods: int
    ) -> Float[Array, "row quantity"]:
        """Integrals and extremes (R, 6) over some periods, see INTEGRAL and the others."""
        return self._run(states, cases, periods, False, True)[0].measures

    def _run(
        self, states: np.ndarray, cases: np.ndarray, periods: int, with_tangent: bool, with_measures: bool
    ) -> tuple[Rows, list[str]]:
        count = len(states)
        into = Rows(
            strobes=np.full((count, periods, 2), np.nan),
            tangents=np.tile(np.eye(2), (count, 1, 1)),
            measures=np.zeros((count, MEASURES)),
            status=np.zeros(count, dtype=np.int64),
        )
        into.measures[:, MAXIMUM], into.measures[:, MINIMUM] = -np.inf, np.inf
        begin, buffer = np.ascontiguousarray(states, dtype=float), np.zeros((4, DEGREE + 1))
        march_rows(begin, self.parameters[cases], periods, into, with_tangent, with_measures, buffer)
        return into, [REASONS.get(int(code), "") for code in into.status]
