"""Batches: many cases integrated side by side over all cores, each as if it were alone.

A case's result depends on nothing but the case: not on the others, their order, or the number of workers.
A case that fails keeps what it has and leaves the others alone.
"""

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import STATES, Model
from tribodyn.solve.engine import DONE
from tribodyn.solve.stiffness import choose
from tribodyn.solve.transient import cycles_per_block, make_engine, tolerances_from

#: Greatest number of steps in one mesh cycle, as a scenario's `solver.max_steps` has it by default.
MAX_STEPS = 1_000_000


class Ensemble(NamedTuple):
    """What became of C cases.

    Attributes
    ----------
    state : (C, STATES)
        At the end, before the next engagement; of a failed case the last one that was accepted.
    samples : (C, window · samples, STATES)
        States over the last `window` cycles at phases k/samples; NaN from where a case failed.
    status : (C,) int
        `engine.DONE` or the kind of failure, a key of `engine.REASONS`.
    reached : (C,)
        Mesh cycles done by this call.
    steps, evaluations : (C,) int
        Accepted steps, and evaluations of the right-hand side.
    """

    state: np.ndarray
    samples: np.ndarray
    status: np.ndarray
    reached: np.ndarray
    steps: np.ndarray
    evaluations: np.ndarray


def usable_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def march(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    window: int,
    samples: int,
    rtol: float,
    max_steps: int = MAX_STEPS,
    started: bool = False,
    first_cycle: int = 0,
    method: str = "auto",
    workers: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate every case over the same number of mesh cycles.

    Parameters
    ----------
    models : sequence of C Models
        They may differ in every number, table and option.
    states : (C, STATES)
        Where each case starts, at phase 0.
    cycles : int
        Mesh cycles to do.
    window, samples : int
        Last cycles to keep, 0 … cycles, and samples in each of them.
    rtol : float
    max_steps : int
        Greatest number of steps in one mesh cycle.
    started : bool
        Whether the states stand before the engagement at phase 0, as a march leaves them (False at the start
        of a run).
    first_cycle : int
        Whole mesh cycles done before; with the phase and the lag they give the time.
    method : str
        "auto" chooses case by case between explicit and stiff, see `stiffness.choose`.
    workers : int, optional
        Threads; by default one a core that this process may use.
    progress : callable, optional
        Called with the share done, 0 … 1.
    """
    states = np.asarray(states, dtype=float)
    cases = len(models)
    if states.shape != (cases, STATES):
        raise ValueError(f"states have shape {states.shape}, not ({cases}, {STATES}) for {cases} models")
    if not 0 <= window <= cycles:
        raise ValueError(f"a window of {window} cycles does not fit into {cycles}")
    found = Ensemble(
        states.copy(),
        np.full((cases, window * samples, STATES), np.nan),
        np.zeros(cases, dtype=int),
        np.zeros(cases),
        np.zeros(cases, dtype=int),
        np.zeros(cases, dtype=int),
    )
    cancelled = threading.Event()

    def one(case: int) -> None:
        model = models[case]
        chosen = choose(method, model, found.state[case]).method
        tolerances = tolerances_from(model, found.state[case], rtol, max_steps)
        engine = make_engine(chosen, model, samples, tolerances)
        engine.started = started
        size = cycles_per_block(chosen, cycles)
        done = 0
        while done < cycles and not cancelled.is_set():
            # blocks end where the window begins, so that nothing before it is kept for long
            end = cycles - window if done < cycles - window else cycles
            count = min(size, end - done)
            block = engine.block(found.state[case], first_cycle + done, count)
            first = (done - (cycles - window)) * samples
            if first >= 0:
                found.samples[case, first : first + len(block.samples)] = block.samples
            found.state[case] = block.state
            found.reached[case] += block.reached
            found.steps[case] += block.steps
            found.evaluations[case] += block.evaluations
            if block.status != DONE:
                found.status[case] = block.status
                return
            done += count

    pool = ThreadPoolExecutor(workers or usable_cores())
    try:
        jobs = [pool.submit(one, case) for case in range(cases)]
        for done, job in enumerate(as_completed(jobs), 1):
            job.result()
            if progress:
                progress(done / cases)
    finally:
        cancelled.set()
        pool.shutdown(cancel_futures=True)
    return found
