"""Frequency response of the oscillator with backlash: steady states followed up and down."""

from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from tribodyn.solve.branch.continuation import Arrival, Leg, follow
from tribodyn.solve.branch.family import BranchEnd
from tribodyn.solve.branch.unstable import unstable_branches
from tribodyn.solve.orbit import motions as orbit
from tribodyn.solve.orbit.motions import Orbit
from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.backlash_oscillator.motion import (
    BACK,
    FREE,
    INTEGRAL,
    MAXIMUM,
    MINIMUM,
    SQUARE,
    OscillatorMap,
)
from tribodyn.studies.backlash_oscillator.unstable import Beyond, measured

UP, DOWN = 0, 1
#: Periods over which a motion that is not periodic is measured.
WINDOW = 100


class MotionKind(IntEnum):
    """The kind of motion, as the record has it; NOT_PERIODIC where it is undecided which of the others."""

    FAILED = 0
    STABLE = 1
    NOT_PERIODIC = 2
    QUASI_PERIODIC = 3
    CHAOTIC = 4
    LONGER_PERIOD = 5


FAILED, STABLE, NOT_PERIODIC, QUASI_PERIODIC, CHAOTIC, LONGER_PERIOD = MotionKind
#: Motions without period, by the search's name.
WITHOUT_PERIOD = {
    orbit.NOT_PERIODIC: NOT_PERIODIC,
    orbit.QUASI_PERIODIC: QUASI_PERIODIC,
    orbit.CHAOTIC: CHAOTIC,
    orbit.LONGER_PERIOD: LONGER_PERIOD,
}


class Response(NamedTuple):
    """Motion at every frequency, reached by going up (column 0) and down (column 1).

    Attributes
    ----------
    frequency : (F,), Ω
    rms : (F, 2), root mean square of x about its mean, over one period of the motion; over `WINDOW` periods
        of the excitation where it is not periodic. NaN where it failed.
    peak_to_peak, mean : (F, 2)
    free, back : (F, 2), shares of the time without contact, and in contact on the back side
    period : (F, 2), of the motion in periods of the excitation; 0 where it is not periodic
    kind : (F, 2), of `MotionKind`; STABLE: periodic
    residual : (F, 2), change of the state over a period of the motion
    multiplier : (F, 2, 2) complex, Floquet multipliers over a period of the motion; NaN where it has none
    displacement, velocity : (F, 2), state where cos Ωτ = 1, at the start of the motion
    messages : remarks on single points
    ends : where branches were left, in the order in which they were met
    beyond : unstable motions beyond these, where the case asks for them
    """

    frequency: np.ndarray
    rms: np.ndarray
    peak_to_peak: np.ndarray
    mean: np.ndarray
    free: np.ndarray
    back: np.ndarray
    period: np.ndarray
    kind: np.ndarray
    residual: np.ndarray
    multiplier: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    messages: list[tuple[float, int, str]]
    ends: list[tuple[int, BranchEnd]]
    beyond: list[Beyond]


def frequency_response(
    case: BacklashOscillatorCase, progress: Callable[[float], None] | None = None
) -> Response:
    """Follow the steady motions over the frequencies, up and down side by side.

    Each frequency is reached from the motion at the one before it in its own direction, by continuation along
    the branch; the first, and the one after a failure, begins at rest under the mean force.
    """
    frequency = np.array(case.frequencies)
    count = len(frequency)
    one = np.full((count, 2), np.nan)
    response = Response(
        frequency,
        *(one.copy() for _ in range(5)),
        period=np.zeros((count, 2), dtype=int),
        kind=np.full((count, 2), FAILED),
        residual=one.copy(),
        multiplier=np.full((count, 2, 2), np.nan, dtype=complex),
        displacement=one.copy(),
        velocity=one.copy(),
        messages=[],
        ends=[],
        beyond=[],
    )
    rest = np.array([at_rest(case.mean_force), 0.0])
    family = _Oscillators(case)
    reach = float(frequency[-1])
    at: list[tuple[float, np.ndarray, int] | None] = [None, None]
    for step in range(count):
        places = [step, count - 1 - step]
        legs = []
        for direction, place in enumerate(places):
            target = float(frequency[place])
            start, state, period = at[direction] or (target, rest, 0)
            legs.append(Leg(direction, start, target, state, period, reach=reach))
        arrivals = follow(family, legs, max_periods=case.max_periods)
        oscillator = oscillator_at(case, frequency[places])
        for direction, arrival in enumerate(arrivals):
            found = arrival.orbit
            _put(response, places[direction], direction, found, oscillator)
            if case.unstable:
                _go_on(response, family, direction, arrival)
            response.ends.extend((direction, end) for end in arrival.ends)
            failed = found.kind == orbit.FAILED
            at[direction] = None if failed else (legs[direction].target, arrival.next_state, found.period)
        if progress:
            progress((step + 1) / count)
    return response


class _Oscillators:
    """The oscillator over its frequency, as `family.SystemFamily`."""

    def __init__(self, case: BacklashOscillatorCase):
        self.case = case

    def at(self, lines: Sequence[int], values: Sequence[float]) -> tuple[OscillatorMap, list[str]]:
        return oscillator_at(self.case, np.array(values)), [""] * len(values)


def oscillator_at(case: BacklashOscillatorCase, frequency: np.ndarray) -> OscillatorMap:
    """Maps of the oscillator at some frequencies."""
    columns = (case.damping, case.mean_force, case.error_amplitude, case.stiffness_variation)
    return OscillatorMap(np.column_stack([np.tile(columns, (len(frequency), 1)), frequency]))


def at_rest(mean_force: float) -> float:
    """Displacement at which the mean force is balanced; in the middle where there is none."""
    return float(mean_force + np.sign(mean_force))


def _go_on(response: Response, family: _Oscillators, direction: int, arrival: Arrival) -> None:
    """Continue the branches beyond the ends of a leg."""
    span = float(response.frequency[0]), float(response.frequency[-1])
    for place, branch in enumerate(unstable_branches(family, direction, arrival.seeds, span)):
        if branch is not None:
            oscillator = oscillator_at(family.case, branch.values)
            response.beyond.append(measured(len(response.ends) + place, branch, oscillator))


def _put(response: Response, place: int, direction: int, found: Orbit, oscillator: OscillatorMap) -> None:
    """Put one orbit, and what is measured on it, into its place."""
    at = place, direction
    if found.message:
        response.messages.append((float(response.frequency[place]), direction, found.message))
    if found.kind == orbit.FAILED:
        return
    state, periods = found.state, found.period or WINDOW
    one = np.array([direction])
    figures = oscillator.figures(state[None], one, periods)[0]
    duration = periods * 2.0 * np.pi / response.frequency[place]
    mean = figures[INTEGRAL] / duration
    response.mean[at] = mean
    response.rms[at] = np.sqrt(max(figures[SQUARE] / duration - mean * mean, 0.0))
    response.peak_to_peak[at] = figures[MAXIMUM] - figures[MINIMUM]
    response.free[at], response.back[at] = figures[FREE] / duration, figures[BACK] / duration
    response.kind[at] = WITHOUT_PERIOD.get(found.kind, STABLE)
    response.period[at] = found.period
    response.residual[at] = found.residual
    response.multiplier[at] = found.multipliers
    response.displacement[at], response.velocity[at] = state
