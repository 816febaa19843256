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
from tribodyn.solve.engine import DONE, TOO_MANY_STEPS, March
from tribodyn.solve.stiffness import EXPLICIT, THROUGH_JAX, choose
from tribodyn.solve.transient import cycles_per_block, make_engine, tolerances_from

#: Explicit steps in one mesh cycle above which a case of a batch is taken out of the lanes and begun anew by
#: itself, with the method that `stiffness.choose` finds for it: the estimate costs as much as many cycles, so
#: that it is made for few.
HANDED_OVER = 5000
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
        Mesh cycles to do; with 0 the states come back as they are.
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
        "auto": explicit, and where that takes too many steps what `stiffness.choose` finds; or a method's
        name, see `transient.make_engine`; those of diffrax are mapped over the cases, see `jax_ensemble`.
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
    if cycles == 0 or cases == 0:
        # no kernel is made for it: they all do a cycle before they look
        return nothing_yet(states, window * samples)
    count = workers or usable_cores()
    shared = March(first_cycle, cycles, window, samples, started, float(rtol), max_steps)
    if method in THROUGH_JAX:
        from tribodyn.solve.jax_ensemble import through_jax

        return through_jax(models, states, method, shared, count, progress)
    if method not in ("auto", EXPLICIT):
        return one_by_one(models, states, method, shared, count, progress)
    limit = max_steps if method == EXPLICIT else min(max_steps, HANDED_OVER)
    found = in_lanes(models, states, shared._replace(max_steps=limit), count, progress)
    dear = np.flatnonzero((found.status == TOO_MANY_STEPS) & (limit < max_steps)).tolist()
    if dear:
        again = one_by_one([models[case] for case in dear], states[dear], method, shared, count, progress)
        for whole, part in zip(found, again, strict=True):
            whole[dear] = part
    return found


def in_lanes(
    models: Sequence[Model],
    states: np.ndarray,
    shared: March,
    workers: int,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate with the explicit method, many cases side by side in the lanes of vectors."""
    from tribodyn.solve.lane_batch import batches, run_threads

    found = nothing_yet(states, shared.window * shared.samples)
    batches_ = batches(models, states, shared)
    run_threads(batches_, shared, workers, progress)
    for batch in batches_:
        for name in Ensemble._fields:
            getattr(found, name)[batch.places] = getattr(batch.queue, name)
    return found


def one_by_one(
    models: Sequence[Model],
    states: np.ndarray,
    method: str,
    shared: March,
    workers: int,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate each case with its own engine, as a single run does, one case a thread."""
    found = nothing_yet(states, shared.window * shared.samples)
    cancelled = threading.Event()
    opening = shared.cycles - shared.window

    def one(case: int) -> None:
        model = models[case]
        chosen = choose(method, model, states[case]).method
        tolerances = tolerances_from(model, states[case], shared.rtol, shared.max_steps)
        engine = make_engine(chosen, model, shared.samples, tolerances)
        engine.started = shared.started
        size = cycles_per_block(chosen, shared.cycles)
        done = 0
        while done < shared.cycles and not cancelled.is_set():
            # blocks end where the window begins, so that nothing before it is kept for long
            end = opening if done < opening else shared.cycles
            cycles = min(size, end - done)
            block = engine.block(found.state[case], shared.first_cycle + done, cycles)
            if done >= opening:
                first = (done - opening) * shared.samples
                found.samples[case, first : first + len(block.samples)] = block.samples
            found.state[case] = block.state
            found.reached[case] += block.reached
            found.steps[case] += block.steps
            found.evaluations[case] += block.evaluations
            if block.status != DONE:
                found.status[case] = block.status
                return
            done += cycles

    with ThreadPoolExecutor(workers) as pool:
        try:
            jobs = [pool.submit(one, case) for case in range(len(models))]
            for done, job in enumerate(as_completed(jobs), 1):
                job.result()
                if progress:
                    progress(done / len(jobs))
        finally:
            cancelled.set()
            pool.shutdown(cancel_futures=True)
    return found


def nothing_yet(states: np.ndarray, kept: int) -> Ensemble:
    """Results before anything is integrated, with room for `kept` samples a case."""
    count = len(states)
    return Ensemble(
        states.copy(),
        np.full((count, kept, STATES), np.nan),
        np.zeros(count, dtype=int),
        np.zeros(count),
        np.zeros(count, dtype=int),
        np.zeros(count, dtype=int),
    )
