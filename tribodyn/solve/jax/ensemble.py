"""Batches through JAX: diffrax over stacked models, on whatever device JAX has.

The same right-hand side, mapped over the cases. For a GPU, and to compare with; on a CPU the lanes of
`ensemble.march` are much faster, as all cases of a part wait for the slowest in every segment.
"""

import threading
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from tribodyn.dynamics.parameters import Model, Options
from tribodyn.numerics.files.cache import use_compilation_cache
from tribodyn.numerics.processes.work import in_threads
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import Ensemble, March, Status, nothing_yet
from tribodyn.solve.jax import integrator
from tribodyn.solve.lanes.batch import SHARED, by_shape
from tribodyn.solve.tolerances import tolerances_of_many
from tribodyn.train.schedule import Schedule, intervals
from tribodyn.train.structure import GearMesh

#: Cases that are integrated side by side: a batch is done in parts of exactly so many, the last one filled up
#: with copies of its last case, so that fewer cases compile nothing again. On a CPU one thread per part.
WIDTH, WIDTH_ON_CPU = 4096, 64


def width_here() -> int:
    """Cases that are integrated side by side on the device that JAX has."""
    return WIDTH_ON_CPU if jax.default_backend() == "cpu" else WIDTH


class BatchPart(NamedTuple):
    """Cases that are integrated side by side, by their places in the batch."""

    method: integrator.DiffraxMethod
    width: int  # at least the number of cases; what is missing is filled up
    one_table: bool  # whether all cases of this shape have the same tables
    places: Int[Array, " case"]


def through_jax(
    models: Sequence[Model],
    states: Float[Array, "case state"],
    method: str,
    march: March,
    workers: int,
    progress: Callable[[float], None] | None = None,
) -> Ensemble:
    """Integrate with a method of diffrax, mapped over the cases: what `ensemble.march` does with those.

    A failed case's state is the one at the end of the interval before, where `reached` points too. On a
    processor the parts go to `workers` threads; elsewhere there is one.

    Compiled once for a method, a width, a shape of models (`lanes.batch.ModelShape`), tables shared or
    not, and every `jax.integrator.ROOM` samples per cycle; for no number, and not for fewer cases.
    """
    use_compilation_cache()
    result = nothing_yet(models[0].layout, states, march.window * march.samples, march.extremes)
    parts = _parts(models, integrator.METHODS[method], width_here())
    threads = workers if jax.default_backend() == "cpu" else 1
    cancelled = threading.Event()
    ticks: list[BatchPart] = []

    def integrate(part: BatchPart) -> None:
        for _ in _cycles(part, models, march, result):
            ticks.append(part)
            if progress:
                progress(len(ticks) / (len(parts) * march.cycles))
            if cancelled.is_set():
                return

    in_threads(integrate, parts, threads, cancelled=cancelled)
    return result


def _parts(models: Sequence[Model], method: integrator.DiffraxMethod, width: int) -> list[BatchPart]:
    """Parts of cases of one shape, those of low speed, which take the most steps, side by side."""
    parts = []
    for group in by_shape(models):
        tables = {tuple(id(mesh.table) for mesh in models[case].meshes) for case in group}
        one_table = len(tables) == 1
        order = np.array(sorted(group, key=lambda case: float(models[case].operation.nominal_speed)))
        parts += [
            BatchPart(method, width, one_table, order[i : i + width]) for i in range(0, len(order), width)
        ]
    return parts


def _cycles(part: BatchPart, models: Sequence[Model], march: March, result: Ensemble):
    """Integrate a part, mesh cycle by mesh cycle, and put what comes into `result`."""
    places = part.places
    rows = np.pad(places, (0, part.width - len(places)), mode="edge")
    mine = [models[case] for case in rows]
    numbers = _stacked_numbers(mine, part.one_table)
    grids = [integrator.padded_phases(model.schedule, march.samples) for model in mine]
    dense = np.array([at for at, _ in grids])
    control = integrator.IntervalControl(
        jnp.asarray(np.array([integrator.places_in_cycle(model.schedule) for model in mine])),
        jnp.full(dense.shape, np.nan, dtype=float),
        jnp.asarray(integrator.steps_end_on(mine)),
        jnp.full(part.width, march.rtol, dtype=float),
        jnp.asarray(tolerances_of_many(mine, result.state[rows], march.rtol)),
        jnp.full(part.width, march.max_steps, dtype=int),
    )
    carried = integrator.beginning(result.state[rows])
    for done in range(march.cycles):
        kept = done - (march.cycles - march.window)
        if kept == 0:
            control = control._replace(at=jnp.asarray(dense))
        passed = intervals(mine[0].schedule, march.first_cycle + done)
        carried, marched = _compiled(
            part,
            mine[0].options,
            numbers,
            carried,
            march.first_cycle + done,
            march.started or done > 0,
            control,
        )
        cases = slice(len(places))
        status = np.asarray(marched.status)[cases, : len(passed)]
        whole = np.argmax(np.pad(status, ((0, 0), (0, 1)), constant_values=-1) != Status.DONE, axis=1)
        starts = np.array([[*np.asarray(m.schedule.start)[list(passed)], 1.0] for m in mine[: len(places)]])
        result.reached[places] += starts[np.arange(len(places)), whole]
        result.steps[places] += np.sum(np.asarray(marched.steps)[cases], axis=1)
        result.evaluations[places] += np.sum(np.asarray(marched.evaluations)[cases], axis=1)
        if kept >= 0 and march.samples:
            sampled = np.asarray(marched.samples)
            for i, case in enumerate(places):
                block = [sampled[i, k, : grids[i][1][passed[k]]] for k in range(whole[i])]
                block = np.concatenate([*block, np.empty((0, sampled.shape[-1]))])
                first = kept * march.samples
                result.samples[case, first : first + len(block)] = block
        result.state[places] = np.asarray(carried.y)[cases]
        result.status[places] = status[:, -1]
        yield done
        if np.all(status[:, -1] != Status.DONE):
            return


def _compiled(
    part: BatchPart,
    options: Options,
    numbers: Any,
    carried: integrator.Carried,
    cycle: int,
    started: bool,
    control: integrator.IntervalControl,
) -> tuple[integrator.Carried, integrator.IntervalResult]:
    """Give `over_one_cycle`; what was not yet compiled is compiled by one thread while the others wait."""
    shapes = tuple((x.shape, x.dtype) for x in jax.tree.leaves((numbers, control)))
    key = (part.method, options, part.one_table, shapes)
    call = partial(over_one_cycle, part.method, options, part.one_table)
    arguments = (numbers, carried, cycle, started, control)
    if key not in _known:
        with _lock:
            result = jax.block_until_ready(call(*arguments))
            _known.add(key)
            return result
    return call(*arguments)


_lock = threading.Lock()
_known: set[tuple[Any, ...]] = set()


@partial(jax.jit, static_argnames=("method", "options", "one_table"))
def over_one_cycle(
    method: integrator.DiffraxMethod,
    options: Options,
    one_table: bool,
    numbers: Any,
    carried: integrator.Carried,
    cycle: Any,
    started: Any,
    control: integrator.IntervalControl,
) -> tuple[integrator.Carried, integrator.IntervalResult]:
    """`jax.integrator.over_cycle` mapped over the cases: a leading axis on all but cycle and started."""

    def over_case(
        numbers: Any, carried: integrator.Carried, control: integrator.IntervalControl
    ) -> tuple[integrator.Carried, integrator.IntervalResult]:
        return integrator.over_cycle(method, options, numbers, carried, cycle, started, control)

    return jax.vmap(over_case, in_axes=(_axes(numbers, one_table), 0, 0))(numbers, carried, control)


def _axes(numbers: Any, one_table: bool) -> Any:
    """Which of the numbers have an axis of cases: all but tables and patterns that they have in common."""
    meshes, *rest = numbers
    table = None if one_table else 0
    others: dict[str, Any] = dict.fromkeys(GearMesh._fields, 0)
    several = tuple(GearMesh(**{**others, "table": table}) for _ in meshes)
    schedule = Schedule(*(None if name in SHARED else 0 for name in Schedule._fields))
    return several, *(schedule if isinstance(part, Schedule) else 0 for part in rest)


def _stacked_numbers(models: Sequence[Model], one_table: bool) -> Any:
    """The numbers of models of one shape as arrays of JAX, with an axis of cases where `_axes` has one."""

    def stacked(axis: Any, *parts: Any) -> Any:
        if axis is None:
            return jax.tree.map(partial(jnp.asarray, dtype=float), parts[0])
        return jax.tree.map(lambda *leaves: jnp.asarray(np.array(leaves, dtype=float)), *parts)

    numbers = [model.numbers for model in models]
    return jax.tree.map(stacked, _axes(numbers[0], one_table), *numbers, is_leaf=lambda axis: axis is None)
