"""Cases brought to their periodic steady states; where none is stable, a stretch of the motion instead."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.errors import InputError
from tribodyn.solve.branch.continuation import Leg
from tribodyn.solve.branch.gear_pairs import LegResult, ModelAt, UnstableRange, followed_states
from tribodyn.solve.orbit.motions import FAILED
from tribodyn.solve.orbit.periodic import WANDERING, SteadyMotion, refuse_time_dependent, steady_states
from tribodyn.studies.gear_pair.batch.marched import CaseWindow, Outcome, failed, marched, without_audit
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.prepare import PreparedPair, Tabulated, prepare, table_key
from tribodyn.studies.gear_pair.sweep_layout import UNKNOWN
from tribodyn.studies.sweeping.batch import NeighbourWay
from tribodyn.studies.sweeping.between import NothingBetween, case_between

#: Cases without period that are marched at a time, for the room that they take.
AT_A_TIME = 16
#: Parts of a way at most, where every place on it needs a table of its own.
PARTS = 4

PreparedAt = Callable[[int, float], PreparedPair]
"""Gives the prepared case on a line at a value of the parameter; raises InputError where there is none."""


def legs_of(
    cases: Sequence[tuple[PreparedPair, np.ndarray]], ways: Sequence[NeighbourWay | None]
) -> list[Leg]:
    """The leg to each case, with the state that it begins from."""
    legs = []
    for line, ((prepared, state), way) in enumerate(zip(cases, ways, strict=True)):
        if way is None:
            legs.append(Leg(line, 0.0, 0.0, state, 0))
        else:
            finest = _finest(way, prepared.given)
            legs.append(Leg(line, way.start, way.target, state, way.period, finest, way.reach))
    return legs


def _finest(way: NeighbourWay, case: Case) -> float:
    """Minimum step on a way, as `Leg.finest`."""
    try:
        case_between(way.neighbour, case, 0.5)
    except NothingBetween:
        return np.inf
    needs_tables = table_key(way.neighbour) != table_key(case)
    return abs(way.target - way.start) / PARTS if needs_tables else 0.0


def prepared_between(
    cases: Sequence[PreparedPair], ways: Sequence[NeighbourWay | None], tabulated: Callable[[Case], Tabulated]
) -> PreparedAt:
    """Gives the prepared case at a place on the way to a case, or beyond it."""

    def prepared_at(line: int, value: float) -> PreparedPair:
        way = ways[line]
        if way is None or value == way.target:
            return cases[line]
        share = (value - way.start) / (way.target - way.start)
        case = case_between(way.neighbour, cases[line].given, share)
        return prepare(case, tabulated(case))

    return prepared_at


def steady(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    points: int,
    samples: int,
    method: str,
    legs: Sequence[Leg] | None = None,
    model_at: ModelAt | None = None,
    unstable: UnstableRange | None = None,
    **solver: Any,
) -> list[Outcome]:
    """Find every case's steady state from its state, after the engagement at phase 0.

    Parameters
    ----------
    states : (C, STATES)
    cycles : mesh cycles to march at most
    points, samples : points of the section of a motion without period; samples in a mesh cycle
    legs, model_at, unstable : to follow a neighbour's motion to each case, see `gear_pairs.followed_states`;
        lines are cases
    method, **solver : method, and rtol, max_steps and workers, as `ensemble.march` takes them
    """
    outcomes: dict[int, Outcome] = {}
    for i, model in enumerate(models):
        try:
            refuse_time_dependent(model)
        except InputError as error:
            outcomes[i] = failed(states[i], 0, str(error))
    pending = [i for i in range(len(models)) if i not in outcomes]
    common: dict[str, Any] = {"samples": samples, "max_cycles": cycles, "solver": method, **solver}
    followed: list[LegResult] = []
    if legs is None or model_at is None:
        motions = steady_states([models[i] for i in pending], states[pending], **common)
    else:
        followed = followed_states(model_at, [legs[i] for i in pending], unstable=unstable, **common)
        motions = [result.steady for result in followed]
    wandering = []
    for i, motion in zip(pending, motions, strict=True):
        if motion.kind == FAILED:
            outcomes[i] = failed(motion.last, motion.cycles, motion.message)
        elif motion.period:
            outcomes[i] = _periodic(motion, samples)
        else:
            wandering.append((i, motion))
    for part in range(0, len(wandering), AT_A_TIME):
        some = wandering[part : part + AT_A_TIME]
        stretches = marched(
            [models[i] for i, _ in some],
            np.array([motion.last for _, motion in some]),
            cycles=max(points, WANDERING),
            window=WANDERING,
            points=points,
            samples=samples,
            method=method,
            **solver,
        )
        for (i, motion), stretch in zip(some, stretches, strict=True):
            outcomes[i] = _described(stretch, motion)
    for i, (_, arrival, continued) in zip(pending, followed, strict=False):
        outcomes[i] = outcomes[i]._replace(
            state=without_audit(arrival.next_state), ends=arrival.ends, continued=tuple(continued)
        )
    return [outcomes[i] for i in range(len(models))]


def _periodic(motion: SteadyMotion, samples: int) -> Outcome:
    window = CaseWindow(0, motion.samples, motion.state, motion.end, motion.extremes)
    section = motion.samples[::samples]
    outcome = Outcome(window, without_audit(motion.state), section, motion.kind, motion.period)
    return _described(outcome, motion)._replace(period=motion.period)


def _described(outcome: Outcome, motion: SteadyMotion) -> Outcome:
    if outcome.window is None:
        return outcome
    known = np.abs(motion.multipliers[np.isfinite(motion.multipliers)])
    return outcome._replace(
        solution=motion.kind,
        cycles=outcome.cycles + motion.cycles,
        message=motion.message,
        stable=int(motion.stable) if motion.period else UNKNOWN,
        multiplier_max=float(known.max()) if known.size else float("nan"),
        residual=float(motion.residual),
    )
