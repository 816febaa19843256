"""Cases brought to their periodic steady states; where none is stable, a stretch of the motion instead."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.errors import InputError
from tribodyn.solve.branch.continuation import Leg
from tribodyn.solve.branch.followed import Followed, ModelAt, Unstable, followed_states
from tribodyn.solve.orbit.periodic import WANDERING, Steady, refuse_time_dependent, steady_states
from tribodyn.solve.orbit.result import FAILED
from tribodyn.studies.gear_pair.batch.marched import marched
from tribodyn.studies.gear_pair.batch.outcome import Outcome, Passage, continued, failed
from tribodyn.studies.gear_pair.sweep_layout import UNKNOWN

#: Cases without period that are marched at a time, for the room that they take.
AT_A_TIME = 16


def steady(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    points: int,
    samples: int,
    legs: Sequence[Leg] | None = None,
    model_at: ModelAt | None = None,
    unstable: Unstable | None = None,
    **solver: Any,
) -> list[Outcome]:
    """Find every case's steady state from its state, after the engagement at phase 0.

    Parameters
    ----------
    models : sequence of C Models
    states : (C, STATES)
    cycles : int
        Mesh cycles to march at most.
    points, samples : int
        Points of the section of a motion without period; samples in a mesh cycle.
    legs, model_at, unstable
        To follow a neighbour's motion to each case, see `followed.followed_states`; lines are cases.
    **solver
        rtol, method, max_steps and workers, as `ensemble.march` takes them.
    """
    outcomes: list[Outcome | None] = [None] * len(models)
    for i, model in enumerate(models):
        try:
            refuse_time_dependent(model)
        except InputError as error:
            outcomes[i] = failed(states[i], 0, str(error))
    pending = [i for i, one in enumerate(outcomes) if one is None]
    method = solver.pop("method")
    common: dict[str, Any] = {"samples": samples, "max_cycles": cycles, "solver": method, **solver}
    followed: Sequence[Followed | None] = [None] * len(pending)
    if legs is None or model_at is None:
        answers = steady_states([models[i] for i in pending], states[pending], **common)
    else:
        followed = followed_states(model_at, [legs[i] for i in pending], unstable=unstable, **common)
        answers = [one.steady for one in followed]
    wandering = []
    for i, answer in zip(pending, answers, strict=True):
        if answer.kind == FAILED:
            outcomes[i] = failed(answer.last, answer.cycles, answer.message)
        elif answer.period:
            outcomes[i] = _periodic(answer, samples)
        else:
            wandering.append((i, answer))
    for part in range(0, len(wandering), AT_A_TIME):
        some = wandering[part : part + AT_A_TIME]
        stretches = marched(
            [models[i] for i, _ in some],
            np.array([answer.last for _, answer in some]),
            cycles=max(points, WANDERING),
            window=WANDERING,
            points=points,
            samples=samples,
            method=method,
            **solver,
        )
        for (i, answer), stretch in zip(some, stretches, strict=True):
            outcomes[i] = _described(stretch, answer)
    for i, one in zip(pending, followed, strict=True):
        if one is not None and (outcome := outcomes[i]) is not None:
            outcomes[i] = outcome._replace(
                state=continued(one.arrival.carried), ends=one.arrival.ends, continued=tuple(one.continued)
            )
    return [one for one in outcomes if one is not None]


def _periodic(answer: Steady, samples: int) -> Outcome:
    passage = Passage(0, answer.samples, answer.state, answer.end, answer.extremes)
    section = answer.samples[::samples]
    outcome = Outcome(passage, continued(answer.state), section, answer.kind, answer.period)
    return _described(outcome, answer)._replace(period=answer.period)


def _described(outcome: Outcome, answer: Steady) -> Outcome:
    if outcome.passage is None:
        return outcome
    known = np.abs(answer.multipliers[np.isfinite(answer.multipliers)])
    return outcome._replace(
        solution=answer.kind,
        cycles=outcome.cycles + answer.cycles,
        message=answer.message,
        stable=int(answer.stable) if answer.period else UNKNOWN,
        multiplier_max=float(known.max()) if known.size else float("nan"),
        residual=float(answer.residual),
    )
