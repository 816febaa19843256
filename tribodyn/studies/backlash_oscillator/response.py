"""Frequency response of the oscillator with backlash: steady states followed up and down."""

from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from tribodyn.solve.branch.arclength import BranchEnd
from tribodyn.solve.branch.continuation import Leg, follow
from tribodyn.solve.branch.unstable import UnstableBranch, unstable_branches
from tribodyn.solve.orbit import motions as orbit
from tribodyn.solve.orbit.motions import Orbit
from tribodyn.studies.backlash_oscillator.motion import FREQUENCY, OscillatorMap
from tribodyn.studies.backlash_oscillator.scenario import SAMPLES, BacklashOscillatorCase

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


class MeasuredBranch(NamedTuple):
    """A branch beyond the end of its stable part."""

    end: int  # place of that end in `Response.ends`
    branch: UnstableBranch
    measures: dict[str, np.ndarray]  # of its motions, as `measured` gives them


class Response(NamedTuple):
    """Motion at every frequency, reached by going up (column 0) and down (column 1); named as in the record.

    Measures are over one period of the motion, or over `WINDOW` periods of the excitation where it is not
    periodic; NaN where it failed.
    """

    frequency: np.ndarray  # (F,), Ω
    rms_displacement: np.ndarray  # (F, 2), about the mean
    peak_to_peak_displacement: np.ndarray
    mean_displacement: np.ndarray
    contact_loss_fraction: np.ndarray
    back_contact_fraction: np.ndarray
    period: np.ndarray  # (F, 2), of the motion in periods of the excitation; 0 where it is not periodic
    motion: np.ndarray  # (F, 2), of `MotionKind`; STABLE: periodic
    residual: np.ndarray  # (F, 2), change of the state over a period of the motion
    #: (F, 2, 2) complex, Floquet multipliers over a period of the motion; NaN where it has none
    multiplier: np.ndarray
    #: section_displacement, section_velocity: (F, 2), state where cos Ωτ = 1, at the start of the motion
    section_displacement: np.ndarray
    section_velocity: np.ndarray
    messages: list[tuple[float, int, str]]  # frequency, direction and text of remarks on single points
    #: direction and where branches were left, in the order in which they were met
    ends: list[tuple[int, BranchEnd]]
    beyond: list[MeasuredBranch]  # unstable motions beyond these, where the case asks for them


def frequency_response(
    case: BacklashOscillatorCase, progress: Callable[[float], None] | None = None
) -> Response:
    """Follow the steady motions over the frequencies, up and down side by side.

    Each frequency is reached from the motion at the one before it in its own direction, by continuation along
    the branch; the first, and the one after a failure, begins at rest under the mean force.
    """
    frequency = np.array(case.frequencies)
    count = len(frequency)
    response = _empty_response(frequency)
    rest = np.array([at_rest(case.mean_force), 0.0])
    family = _Oscillators(case)
    span = float(frequency[0]), float(frequency[-1])
    at: list[tuple[float, np.ndarray, int] | None] = [None, None]
    for step in range(count):
        places = [step, count - 1 - step]
        legs = []
        for direction, place in enumerate(places):
            target = float(frequency[place])
            start, state, period = at[direction] or (target, rest, 0)
            legs.append(Leg(direction, start, target, state, period, reach=span[1]))
        arrivals = follow(family, legs, max_periods=case.max_periods)
        oscillator = oscillator_at(case, frequency[places])
        for direction, arrival in enumerate(arrivals):
            steady = arrival.orbit
            _put(response, places[direction], direction, steady, oscillator)
            branches = unstable_branches(family, direction, arrival.seeds, span) if case.unstable else []
            for end, branch in enumerate(branches, len(response.ends)):
                if branch is not None:
                    response.beyond.append(measured_branch(case, end, branch))
            response.ends.extend((direction, end) for end in arrival.ends)
            failed = steady.kind == orbit.FAILED
            at[direction] = None if failed else (legs[direction].target, arrival.next_state, steady.period)
        if progress:
            progress((step + 1) / count)
    return response


def _empty_response(frequency: np.ndarray) -> Response:
    shape = len(frequency), 2
    columns: dict[str, Any] = {name: np.full(shape, np.nan) for name in SAMPLES if name in Response._fields}
    columns |= {"period": np.zeros(shape, dtype=int), "motion": np.full(shape, FAILED)}
    columns["multiplier"] = np.full((*shape, 2), np.nan, dtype=complex)
    return Response(frequency=frequency, messages=[], ends=[], beyond=[], **columns)


class _Oscillators(NamedTuple):
    """The oscillator over its frequency, as `arclength.SystemFamily`."""

    case: BacklashOscillatorCase

    def at(self, lines: Sequence[int], values: Sequence[float]) -> tuple[OscillatorMap, list[str]]:
        return oscillator_at(self.case, np.array(values)), [""] * len(values)


def oscillator_at(case: BacklashOscillatorCase, frequency: np.ndarray) -> OscillatorMap:
    """Maps of the oscillator at some frequencies."""
    columns = (case.damping, case.mean_force, case.error_amplitude, case.stiffness_variation)
    return OscillatorMap(np.column_stack([np.tile(columns, (len(frequency), 1)), frequency]))


def at_rest(mean_force: float) -> float:
    """Displacement at which the mean force is balanced; in the middle where there is none."""
    return float(mean_force + np.sign(mean_force))


def measured(
    oscillator: OscillatorMap, states: np.ndarray, cases: np.ndarray, periods: int
) -> dict[str, np.ndarray]:
    """Measures of motions over some periods, by their names in the record."""
    integral, square, free, back, maximum, minimum = oscillator.measures(states, cases, periods).T
    duration = periods * 2.0 * np.pi / oscillator.parameters[cases, FREQUENCY]
    mean = integral / duration
    return {
        "mean_displacement": mean,
        "rms_displacement": np.sqrt(np.maximum(square / duration - mean * mean, 0.0)),
        "peak_to_peak_displacement": maximum - minimum,
        "contact_loss_fraction": free / duration,
        "back_contact_fraction": back / duration,
    }


def measured_branch(case: BacklashOscillatorCase, end: int, branch: UnstableBranch) -> MeasuredBranch:
    """A branch with the measures of its motions; `end` is the place of the end before it."""
    oscillator, cases = oscillator_at(case, branch.values), np.arange(len(branch.values))
    return MeasuredBranch(end, branch, measured(oscillator, branch.states, cases, branch.period))


def _put(response: Response, place: int, direction: int, steady: Orbit, oscillator: OscillatorMap) -> None:
    """Put one orbit, and what is measured on it, into its place."""
    at = place, direction
    if steady.message:
        response.messages.append((float(response.frequency[place]), direction, steady.message))
    if steady.kind == orbit.FAILED:
        return
    measures = measured(oscillator, steady.state[None], np.array([direction]), steady.period or WINDOW)
    for name, values in measures.items():
        getattr(response, name)[at] = values[0]
    response.motion[at] = WITHOUT_PERIOD.get(steady.kind, STABLE)
    response.period[at] = steady.period
    response.residual[at] = steady.residual
    response.multiplier[at] = steady.multipliers
    response.section_displacement[at], response.section_velocity[at] = steady.state
