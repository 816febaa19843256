"""Cases sorted by the shape of their models into queues, and threads that work through these in lanes."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import March, nothing_yet
from tribodyn.solve.lanes.march import march_lanes
from tribodyn.solve.lanes.packing import Packed, by_shape, lane_model, pack
from tribodyn.solve.lanes.queue import Queue, empty_lanes
from tribodyn.solve.march.reversal import stops_of_many
from tribodyn.solve.tolerances import tolerances_of_many

#: Time between two reports of progress, s.
INTERVAL = 0.1


class LaneBatch(NamedTuple):
    """Cases whose models have one shape, in the order of the queue, and their places in the ensemble."""

    places: Int[Array, " case"]
    packed: Packed
    queue: Queue


def batches(models: Sequence[Model], states: Float[Array, "case state"], march: March) -> list[LaneBatch]:
    """One batch per shape of models, the cases of low speed first, which take the most steps.

    Lanes side by side then cost about the same.
    """
    return [_batch(models, states, march, places) for places in by_shape(models)]


def _batch(
    models: Sequence[Model], states: Float[Array, "case state"], march: March, places: Int[Array, " case"]
) -> LaneBatch:
    speeds = [float(models[case].mechanics.nominal_speed) for case in places]
    places = places[np.argsort(speeds, kind="stable")]
    mine = [models[case] for case in places]
    packed = pack(mine)
    result = nothing_yet(states[places], march.window * march.samples, march.extremes)
    counters = (np.zeros(1, dtype=np.int64) for _ in range(3))
    atol, stops = tolerances_of_many(mine, states[places], march.rtol), stops_of_many(mine)
    queue = Queue(packed.numbers, packed.addresses, atol, stops, *result[:-1], *result.extremes, *counters)
    return LaneBatch(places, packed, queue)


def run_threads(
    batches: list[LaneBatch], march: March, workers: int, progress: Callable[[float], None] | None
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


def _work(batch: LaneBatch, march: March) -> None:
    model, numbers, addresses = lane_model(batch.packed)
    march_lanes(model, empty_lanes(batch.packed, numbers, addresses), batch.queue, march)
