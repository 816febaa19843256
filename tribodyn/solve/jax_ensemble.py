"""Batches through JAX: diffrax over stacked models, on whatever device JAX has.

The same right-hand side, mapped over the cases. For a GPU, and to compare with; on a CPU the lanes of
`ensemble.march` are much faster, as all cases here wait for the slowest in every step.
"""

from collections.abc import Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.lanes.packing import Kind, kind_of
from tribodyn.solve.diffrax_engine import march_segments, outcome, sample_phases, use_compilation_cache
from tribodyn.solve.engine import DONE
from tribodyn.solve.ensemble import MAX_STEPS, Ensemble, nothing_yet
from tribodyn.solve.transient import tolerances_from


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
    method: str = "tsit5",
) -> Ensemble:
    """Integrate every case over the same number of mesh cycles; see `ensemble.march`.

    A failed case's state is the one at the end of the segment before, and `max_steps` counts in one segment.

    Parameters
    ----------
    method : {"tsit5", "dopri8", "kvaerno5"}
    """
    use_compilation_cache()
    states = np.asarray(states, dtype=float)
    found = nothing_yet(states, window * samples)
    groups: dict[Kind, list[int]] = {}
    for case, model in enumerate(models):
        groups.setdefault(kind_of(model), []).append(case)
    for places in groups.values():
        mine = [models[case] for case in places]
        atol = np.array(
            [
                tolerances_from(model, states[case], rtol, max_steps).atol
                for model, case in zip(mine, places, strict=True)
            ]
        )
        parts = ((0, cycles - window, 0), (cycles - window, window, samples))
        for done, more, wanted in parts:
            if more:
                going = np.array(places)[found.status[places] == DONE]
                chosen = [places.index(case) for case in going]
                _go_on(
                    [mine[i] for i in chosen],
                    atol[chosen],
                    found,
                    going,
                    (done, more, wanted, first_cycle + done, started or done > 0, rtol, max_steps, method),
                )
    return found


def _go_on(models: list[Model], atol: np.ndarray, found: Ensemble, places: np.ndarray, how: tuple) -> None:
    """Integrate the cases at some places further, and note what became of them."""
    done, cycles, samples, first_cycle, restart, rtol, max_steps, method = how
    if not models:
        return
    numbers, axes = stacked([(model.table, model.mechanics, model.contact) for model in models])
    phases = [sample_phases(np.asarray(model.table.boundary), samples) for model in models]

    def one(numbers: Any, y: Any, at: Any, atol: Any) -> Any:
        return march_segments(
            method,
            models[0].options,
            cycles,
            at.shape[1],
            numbers,
            y,
            first_cycle,
            restart,
            at,
            rtol,
            atol,
            max_steps,
        )

    (_, _), results = jax.vmap(one, in_axes=(axes, 0, 0, 0))(
        numbers,
        jnp.asarray(found.state[places]),
        jnp.asarray(np.array([at for at, _ in phases])),
        jnp.asarray(atol),
    )
    sampled, failed, stalled, steps, ends = (np.asarray(x) for x in results)
    for i, case in enumerate(places):
        boundary, counts = np.asarray(models[i].table.boundary), phases[i][1]
        block = outcome(
            sampled[i], failed[i], stalled[i], steps[i], boundary, counts, cycles, max_steps, method
        )
        if len(block.samples):
            found.samples[case, : len(block.samples)] = block.samples
        whole = len(ends[i]) if block.status == DONE else int(np.argmax(failed[i]))
        if whole:
            found.state[case] = ends[i][whole - 1]
        found.status[case] = block.status
        found.reached[case] = done + block.reached
        found.steps[case] += block.steps
        found.evaluations[case] += block.evaluations


def stacked(trees: list[Any]) -> tuple[Any, Any]:
    """Pytrees of arrays as one with a leading axis, and that axis of every leaf: None where all share one."""
    leaves = [jax.tree.leaves(tree) for tree in trees]
    structure = jax.tree.structure(trees[0])
    values, axes = [], []
    for column in zip(*leaves, strict=True):
        shared = all(value is column[0] for value in column)
        values.append(jnp.asarray(column[0] if shared else np.array(column, dtype=float)))
        axes.append(None if shared else 0)
    return jax.tree.unflatten(structure, values), jax.tree.unflatten(structure, axes)
