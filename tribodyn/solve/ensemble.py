"""Batches: many cases integrated side by side over all cores, each as if it were alone.

A case's result depends on nothing but the case: not on the others, their order, or the number of workers.
A case that fails keeps what it has and leaves the others alone.
"""

import threading
from collections.abc import Callable, Sequence

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.extremes import extremes_of, put_extremes, take_in
from tribodyn.numerics.processes.work import in_threads, usable_cores
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.choice import choose
from tribodyn.solve.integrator import MAX_STEPS, Ensemble, March, Status, nothing_yet, put
from tribodyn.solve.methods import AUTO, EXPLICIT, Runs, runs
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import cycles_at_once, make_integrator
from tribodyn.train.layout import layout_of

#: Explicit steps in one mesh cycle above which a case of a batch is taken out of the lanes and begun again by
#: itself, with the method that `choice.choose` gives for it: the estimate costs as much as many cycles, so
#: that it is made for few cases only.
HANDED_OVER = 5000
#: Layout of the models of a batch without cases.
NOTHING = layout_of(0, 0, [], [], 0, 0)


def march(
    models: Sequence[Model],
    states: Float[Array, "case state"],
    *,
    cycles: int,
    window: int,
    samples: int,
    rtol: float,
    max_steps: int = MAX_STEPS,
    started: bool = False,
    first_cycle: int = 0,
    method: str = "auto",
    extremes: bool = False,
    workers: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate every case over the same number of mesh cycles.

    Parameters
    ----------
    models : they may differ in every number, table and option but their layout
    states : where each case starts, at phase 0
    cycles : mesh cycles to do; with 0 the states come back as they are
    window, samples : last cycles to keep, 0 … cycles, and samples in each of them
    max_steps : steps, accepted ones, that one mesh cycle may take
    started : whether the states stand before the engagement at phase 0, as a march leaves them (False at the
        start of a run)
    first_cycle : whole mesh cycles done before; with the phase and the lag they give the time
    method : "auto": explicit, and where that takes too many steps what `choice.choose` gives; or a method's
        name, see `methods`; those of diffrax are mapped over the cases, see `jax.ensemble`
    extremes : whether to seek the extremes of the motion over the window, between its samples too
    workers : threads; by default as many as cores that this process may use
    progress : called with the share done, 0 … 1
    """
    states = np.asarray(states, dtype=float)
    cases = len(models)
    layout = models[0].layout if cases else NOTHING
    if cases and states.shape != (cases, layout.states):
        wanted = f"({cases}, {layout.states}) for {cases} models"
        raise ValueError(f"states have shape {states.shape}, not {wanted}")
    if not 0 <= window <= cycles:
        raise ValueError(f"a window of {window} cycles does not fit into {cycles}")
    if cycles == 0 or cases == 0:
        # no kernel is made for it: they all do a cycle before they look
        return nothing_yet(layout, states, window * samples, extremes)
    count = workers or usable_cores()
    march = March(first_cycle, cycles, window, samples, started, float(rtol), max_steps, extremes)
    if runs(method) is Runs.JAX:
        from tribodyn.solve.jax.ensemble import through_jax

        result = through_jax(models, states, method, march, count, progress)
        if extremes:
            seek_again(models, result, march, count)
        return result
    if method not in (AUTO, EXPLICIT):
        return one_by_one(models, states, method, march, count, progress)
    from tribodyn.solve.lanes.batch import in_lanes

    limit = max_steps if method == EXPLICIT else min(max_steps, HANDED_OVER)
    result = in_lanes(models, states, march._replace(max_steps=limit), count, progress)
    expensive = np.flatnonzero((result.status == Status.TOO_MANY_STEPS) & (limit < max_steps)).tolist()
    if expensive:
        again = one_by_one(
            [models[case] for case in expensive], states[expensive], method, march, count, progress
        )
        put(result, np.array(expensive), again)
    return result


def seek_again(models: Sequence[Model], result: Ensemble, plan: March, workers: int) -> None:
    """Seek extremes by marching every mesh cycle of the window again, natively, from its own start.

    For methods whose steps are not ours. As each cycle starts where theirs did, no difference adds up.
    """
    for cycle in range(plan.window):
        starts = result.samples[:, cycle * plan.samples]
        there = np.flatnonzero(np.all(np.isfinite(starts), axis=1))
        if not there.size:
            continue
        again = march(
            [models[case] for case in there.tolist()],
            starts[there],
            cycles=1,
            window=1,
            samples=0,
            rtol=plan.rtol,
            max_steps=plan.max_steps,
            first_cycle=plan.first_cycle + plan.cycles - plan.window + cycle,
            extremes=True,
            workers=workers,
        )
        extremes = extremes_of(result.extremes, there)
        take_in(extremes, again.extremes)
        put_extremes(result.extremes, there, extremes)


def one_by_one(
    models: Sequence[Model],
    states: Float[Array, "case state"],
    method: str,
    march: March,
    workers: int,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate each case with an integrator of its own, as a single run does, one case per thread."""
    result = nothing_yet(models[0].layout, states, march.window * march.samples, march.extremes)
    cancelled = threading.Event()
    opening = march.cycles - march.window

    def integrate(case: int) -> None:
        model = models[case]
        chosen = choose(method, model, states[case]).method
        tolerances = tolerances_from(model, states[case], march.rtol, march.max_steps)
        integrator = make_integrator(chosen, model, march.samples, tolerances)
        integrator.started = march.started
        done = 0
        while done < march.cycles and not cancelled.is_set():
            # calls end where the window begins, so that nothing before it is kept for long
            end = opening if done < opening else march.cycles
            size = cycles_at_once(chosen, march.cycles, march.samples, result.steps[case], done)
            cycles = min(size, end - done)
            integrator.extremes = march.extremes and done >= opening
            part = integrator.integrate(result.state[case], march.first_cycle + done, cycles)
            if done >= opening:
                first = (done - opening) * march.samples
                result.samples[case, first : first + len(part.samples)] = part.samples
            if part.extremes:
                take_in(extremes_of(result.extremes, case), part.extremes)
            result.state[case] = part.state
            result.reached[case] += part.reached
            result.steps[case] += part.steps
            result.evaluations[case] += part.evaluations
            if part.status != Status.DONE:
                result.status[case] = part.status
                return
            done += cycles

    in_threads(integrate, range(len(models)), workers, progress, cancelled)
    return result
