"""Cases marched over a given number of mesh cycles, the last of them kept."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.extremes import extremes_of
from tribodyn.dynamics.parameters import STATES, Model
from tribodyn.solve.engagement import engage_next
from tribodyn.solve.ensemble import march
from tribodyn.solve.integrator import Status
from tribodyn.studies.gear_pair.batch.outcome import Outcome, Passage, continued, failed, stopped


def marched(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    window: int,
    points: int,
    samples: int,
    **solver: Any,
) -> list[Outcome]:
    """March every case from its state, after the engagement at phase 0.

    Parameters
    ----------
    models : sequence of C Models
    states : (C, STATES)
    cycles, window, points : int
        Mesh cycles to march, those of them whose samples are kept, and those whose first state is.
    samples : int
        Samples in a mesh cycle.
    **solver
        Further arguments of `ensemble.march`.
    """
    before = cycles - window
    led = march(
        models, states, cycles=before, window=max(0, min(points, cycles) - window), samples=1, **solver
    )
    outcomes: list[Outcome | None] = [None] * len(models)
    for i in map(int, np.flatnonzero(led.status != Status.DONE)):
        outcomes[i] = failed(led.state[i], led.reached[i], stopped(int(led.status[i]), led.reached[i]))
    good = [int(i) for i in np.flatnonzero(led.status == Status.DONE)]
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
    for row, i in enumerate(good):
        reached = before + float(ran.reached[row])
        if ran.status[row] != Status.DONE:
            outcomes[i] = failed(ran.state[row], reached, stopped(int(ran.status[row]), reached))
            continue
        section = np.concatenate([led.samples[i], ran.samples[row, ::samples]])
        state = ran.state[row].copy()
        engage_next(state, models[i])
        passage = Passage(
            before, ran.samples[row], led.state[i], ran.state[row], extremes_of(ran.extremes, row)
        )
        outcomes[i] = Outcome(
            passage, continued(state), section.reshape(-1, STATES)[-points:], "transient", int(reached)
        )
    return [one for one in outcomes if one is not None]
