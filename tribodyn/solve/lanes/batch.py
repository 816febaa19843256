"""Cases sorted by the shape of their models into queues, and threads that work through these in lanes."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.extremes import no_extremes
from tribodyn.dynamics.parameters import STATES, Model
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import March
from tribodyn.solve.lanes.march import march_lanes
from tribodyn.solve.lanes.packing import Packed, by_shape, lane_model, pack
from tribodyn.solve.lanes.queue import Queue, empty_lanes
from tribodyn.solve.march.reversal import stops_of_many
from tribodyn.solve.tolerances import tolerances_of_many

#: Time between two reports of progress, s.
INTERVAL = 0.1


class Batch(NamedTuple):
    """Cases whose models have one shape, in the order of the queue, and their places in the ensemble."""

    places: Int[Array, " case"]
    packed: Packed
    queue: Queue


def batches(models: Sequence[Model], states: Float[Array, "case state"], march: March) -> list[Batch]:
    """One batch per shape of models, the cases of low speed first, which take the most steps.

    Lanes side by side then cost about the same.
    """
    return [_batch(models, states, march, places) for places in by_shape(models)]


def _batch(
    models: Sequence[Model], states: Float[Array, "case state"], march: March, places: Int[Array, " case"]
) -> Batch:
    speeds = [float(models[case].mechanics.nominal_speed) for case in places]
    places = places[np.argsort(speeds, kind="stable")]
    mine = [models[case] for case in places]
    packed = pack(mine)
    count = len(places)
    extremes = no_extremes(count if march.extremes else 0)
    queue = Queue(
        numbers=packed.numbers,
        addresses=packed.addresses,
        atol=tolerances_of_many(mine, states[places], march.rtol),
        stops=stops_of_many(mine),
        state=states[places],
        samples=np.full((count, march.window * march.samples, STATES), np.nan),
        status=np.zeros(count, dtype=np.int64),
        reached=np.zeros(count),
        steps=np.zeros(count, dtype=np.int64),
        evaluations=np.zeros(count, dtype=np.int64),
        measure=extremes.measure,
        at=extremes.cycles,
        segment=extremes.segment,
        extreme_state=extremes.state,
        taken=np.zeros(1, dtype=np.int64),
        done=np.zeros(1, dtype=np.int64),
        stop=np.zeros(1, dtype=np.int64),
    )
    return Batch(places, packed, queue)


def run_threads(
    batches: list[Batch], march: March, workers: int, progress: Callable[[float], None] | None
) -> None:
    """Work through the queues; returns when all cases are done, or raises what interrupts it."""
    whole = sum(len(batch.places) for batch in batches) * march.cycles
    with ThreadPoolExecutor(workers) as pool:
        try:
            running = {
                pool.submit(_work, batch, march)
                for batch in batches
                for _ in range(min(workers, -(-len(batch.places) // WIDTH)))
            }
            while running:
                done, running = wait(running, timeout=INTERVAL if progress else None)
                for job in done:
                    job.result()
                if progress and whole:
                    progress(sum(int(batch.queue.done[0]) for batch in batches) / whole)
        finally:
            for batch in batches:
                batch.queue.stop[0] = 1
            pool.shutdown(cancel_futures=True)


def _work(batch: Batch, march: March) -> None:
    model, numbers, addresses = lane_model(batch.packed)
    march_lanes(model, empty_lanes(batch.packed, numbers, addresses), batch.queue, march)
