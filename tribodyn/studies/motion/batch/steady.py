"""Cases brought to their periodic steady states, or marched over a given number of mesh cycles."""

from collections.abc import Callable, Hashable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.extremes import Extremes, extremes_of
from tribodyn.errors import InputError
from tribodyn.solve.branch.arclength import BranchEnd
from tribodyn.solve.branch.continuation import Leg
from tribodyn.solve.branch.gear_pairs import LegResult, ModelAt, UnstableRange, followed_states
from tribodyn.solve.ensemble import march
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.solve.orbit.motions import FAILED
from tribodyn.solve.orbit.periodic import WANDERING, SteadyMotion, refuse_time_dependent, steady_states
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.studies.motion.batch.swept import UNKNOWN
from tribodyn.studies.protocol.batch import NeighbourWay, NothingBetween, case_between
from tribodyn.train.layout import TrainLayout, works

if TYPE_CHECKING:
    from tribodyn.solve.branch.gear_pairs import ContinuedBranch


class CaseWindow(NamedTuple):
    """A case's way through its window."""

    first_cycle: int  # whole mesh cycles done before
    #: (cycles · samples, states), over whole mesh cycles, the sample that closes the last not included
    states: np.ndarray
    end: np.ndarray  # the state at its end, before the engagement there
    extremes: Extremes | None = None  # of the motion between the samples


class Outcome(NamedTuple):
    """Outcome of a case."""

    window: CaseWindow | None  # None where the case failed
    #: after the engagement at phase 0, clock and audit at zero: where a neighbour continues
    state: np.ndarray
    section: np.ndarray  # (points, states), states at the start of mesh cycles, the last ones
    solution: str  # sort of motion, as `orbit.motions.Orbit.kind`; or "transient"
    cycles: int  # mesh cycles integrated
    message: str = ""  # why it failed, or a remark on its result
    #: period, stable, multiplier_max, residual: as `report.CASES` has them
    period: int = 0
    stable: int = UNKNOWN
    multiplier_max: float = float("nan")
    residual: float = float("nan")
    ends: tuple[BranchEnd, ...] = ()  # of the branches that were left on the way from the neighbour
    continued: "tuple[ContinuedBranch, ...]" = ()  # those branches beyond their ends


def failed(state: np.ndarray, cycles: float, reason: str) -> Outcome:
    """The outcome of a case that could not go on."""
    return Outcome(None, state, np.empty((0, state.size)), "failed", int(cycles), reason)


def without_audit(state: np.ndarray, layout: TrainLayout) -> np.ndarray:
    """The state with its clock and its audit at zero."""
    state = state.copy()
    state[[layout.lag, *works(layout)]] = 0.0
    return state


def marched(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    window: int,
    points: int,
    samples: int,
    common: int = 1,
    **solver: Any,
) -> list[Outcome]:
    """March every case from its state, (C, states), after the engagement at phase 0.

    So many mesh `cycles`; of the last, the `window`, samples are kept, and of the last `points` periods of
    `common` cycles the first state. `solver` are further arguments of `ensemble.march`.
    """
    before = cycles - window
    sections = max(0, min(points * common, cycles) - window)
    led = march(models, states, cycles=before, window=sections, samples=1, **solver)
    good = np.flatnonzero(led.status == Status.DONE).tolist()
    ran = march(
        [models[i] for i in good],
        led.state[good],
        cycles=window,
        window=window,
        samples=samples,
        started=before > 0,
        first_cycle=before,
        extremes=True,
        **solver,
    )
    rows = {i: row for row, i in enumerate(good)}
    begun = np.arange(before - sections, cycles) % common == 0
    outcomes = []
    for i, model in enumerate(models):
        part, row = (ran, rows[i]) if i in rows else (led, i)
        reached = float(part.reached[row]) + (before if i in rows else 0)
        if part.status[row] != Status.DONE:
            reason = f"stopped after {reached:.4g} mesh cycles: {REASONS[Status(int(part.status[row]))]}"
            outcomes.append(failed(part.state[row], reached, reason))
            continue
        section = np.concatenate([led.samples[i], ran.samples[row, ::samples]]).reshape(
            -1, model.layout.states
        )
        state = ran.state[row].copy()
        engage_next(state, cycles, model)
        extremes = extremes_of(ran.extremes, row)
        kept = CaseWindow(before, ran.samples[row], ran.state[row], extremes)
        still, section = without_audit(state, model.layout), section[begun][-points:]
        outcomes.append(Outcome(kept, still, section, "transient", int(reached)))
    return outcomes


#: Cases without period that are marched at a time, for the room that they take.
AT_A_TIME = 16
#: Parts of a way at most, where every place on it needs a table of its own.
PARTS = 4

PreparedAt = Callable[[int, float], Any]
"""Gives the prepared case on a line at a value of the parameter; raises InputError where there is none."""


def legs_of(
    cases: Sequence[tuple[Any, np.ndarray]],
    ways: Sequence[NeighbourWay | None],
    table_key: Callable[[Any], Hashable],
) -> list[Leg]:
    """The leg to each case, with the state that it begins from."""
    legs = []
    for line, ((prepared, state), way) in enumerate(zip(cases, ways, strict=True)):
        if way is None:
            legs.append(Leg(line, 0.0, 0.0, state, 0))
        else:
            finest = _finest(way, prepared.case, table_key)
            legs.append(Leg(line, way.start, way.target, state, way.period, finest, way.reach))
    return legs


def _finest(way: NeighbourWay, case: Any, table_key: Callable[[Any], Hashable]) -> float:
    """Minimum step on a way, as `Leg.finest`."""
    try:
        case_between(way.neighbour, case, 0.5)
    except NothingBetween:
        return np.inf
    needs_tables = table_key(way.neighbour) != table_key(case)
    return abs(way.target - way.start) / PARTS if needs_tables else 0.0


def prepared_between(
    cases: Sequence[Any],
    ways: Sequence[NeighbourWay | None],
    prepare: Callable[[Any], Any],
) -> PreparedAt:
    """Gives the prepared case at a place on the way to a case, or beyond it."""

    def prepared_at(line: int, value: float) -> Any:
        way = ways[line]
        if way is None or value == way.target:
            return cases[line]
        share = (value - way.start) / (way.target - way.start)
        case = case_between(way.neighbour, cases[line].case, share)
        return prepare(case)

    return prepared_at


def steady(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    points: int,
    samples: int,
    method: str,
    common: int = 1,
    wandering: int = WANDERING,
    legs: Sequence[Leg] | None = None,
    model_at: ModelAt | None = None,
    unstable: UnstableRange | None = None,
    **solver: Any,
) -> list[Outcome]:
    """Find every case's steady state from its state, (C, states), after the engagement at phase 0.

    `cycles` are marched at most; `points` has the section of a motion without period, of which `wandering`
    cycles are sampled; `common` as of `marched`. `legs`, `model_at` and `unstable` follow a neighbour's
    motion to each case, see `gear_pairs.followed_states`; lines are cases. `method` and `solver`, with rtol,
    max_steps and workers, as `ensemble.march` takes them.
    """
    outcomes: dict[int, Outcome] = {}
    for i, model in enumerate(models):
        try:
            refuse_time_dependent(model)
        except InputError as error:
            outcomes[i] = failed(states[i], 0, str(error))
    pending = [i for i in range(len(models)) if i not in outcomes]
    shared: dict[str, Any] = {"samples": samples, "max_cycles": cycles, "solver": method, **solver}
    followed: list[LegResult] = []
    if legs is None or model_at is None:
        motions = steady_states([models[i] for i in pending], states[pending], **shared)
    else:
        followed = followed_states(model_at, [legs[i] for i in pending], unstable=unstable, **shared)
        motions = [result.steady for result in followed]
    without = []
    for i, motion in zip(pending, motions, strict=True):
        if motion.kind == FAILED:
            outcomes[i] = failed(motion.last, common * motion.cycles, motion.message)
        elif motion.period:
            outcomes[i] = _periodic(motion, samples, common, models[i].layout)
        else:
            without.append((i, motion))
    for part in range(0, len(without), AT_A_TIME):
        some = without[part : part + AT_A_TIME]
        stretches = marched(
            [models[i] for i, _ in some],
            np.array([motion.last for _, motion in some]),
            cycles=max(points, wandering),
            window=wandering,
            common=common,
            points=points,
            samples=samples,
            method=method,
            **solver,
        )
        for (i, motion), stretch in zip(some, stretches, strict=True):
            outcomes[i] = _described(stretch, motion, common)
    for i, (_, arrival, continued) in zip(pending, followed, strict=False):
        outcomes[i] = outcomes[i]._replace(
            state=without_audit(arrival.next_state, models[i].layout),
            ends=arrival.ends,
            continued=tuple(continued),
        )
    return [outcomes[i] for i in range(len(models))]


def _periodic(motion: SteadyMotion, samples: int, common: int, layout: TrainLayout) -> Outcome:
    window = CaseWindow(0, motion.samples, motion.end, motion.extremes)
    section = motion.samples[:: samples * common]
    state = without_audit(motion.state, layout)
    outcome = Outcome(window, state, section, motion.kind, common * motion.period)
    return _described(outcome, motion, common)._replace(period=motion.period)


def _described(outcome: Outcome, motion: SteadyMotion, common: int) -> Outcome:
    if outcome.window is None:
        return outcome
    moduli = np.abs(motion.multipliers[np.isfinite(motion.multipliers)])
    return outcome._replace(
        solution=motion.kind,
        cycles=outcome.cycles + common * motion.cycles,
        message=motion.message,
        stable=int(motion.stable) if motion.period else UNKNOWN,
        multiplier_max=float(moduli.max()) if moduli.size else float("nan"),
        residual=float(motion.residual),
    )
