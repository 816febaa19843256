"""Cases sorted into kinds and queues, and threads that work through the queues in lanes."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import STATES, Model
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.solve.engine import March
from tribodyn.solve.lane_march import march_lanes
from tribodyn.solve.lane_packing import Packed, by_kind, lane_model, pack
from tribodyn.solve.lane_queue import Queue, make_block
from tribodyn.solve.reversal import stops_of_many
from tribodyn.solve.transient import tolerances_of_many

#: How often progress is told, s.
INTERVAL = 0.1


class Batch(NamedTuple):
    """Cases of one kind, in the order of the queue, and the places that they have in the whole ensemble."""

    places: np.ndarray
    packed: Packed
    queue: Queue


def batches(models: Sequence[Model], states: np.ndarray, march: March) -> list[Batch]:
    """One batch a kind, the slow and so dear cases first: lanes of a block then cost about the same."""
    return [_batch(models, states, march, places) for places in by_kind(models)]


def _batch(models: Sequence[Model], states: np.ndarray, march: March, places: np.ndarray) -> Batch:
    speeds = [float(models[case].mechanics.nominal_speed) for case in places]
    places = places[np.argsort(speeds, kind="stable")]
    mine = [models[case] for case in places]
    packed = pack(mine)
    count = len(places)
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
        taken=np.zeros(1, dtype=np.int64),
        done=np.zeros(1, dtype=np.int64),
        stop=np.zeros(1, dtype=np.int64),
    )
    return Batch(places, packed, queue)


def run_threads(
    found: list[Batch], march: March, workers: int, progress: Callable[[float], None] | None
) -> None:
    """Work through the queues; returns when all cases are done, or raises what interrupts it."""
    whole = sum(len(batch.places) for batch in found) * march.cycles
    with ThreadPoolExecutor(workers) as pool:
        try:
            running = {
                pool.submit(_work, batch, march)
                for batch in found
                for _ in range(min(workers, -(-len(batch.places) // WIDTH)))
            }
            while running:
                done, running = wait(running, timeout=INTERVAL if progress else None)
                for job in done:
                    job.result()
                if progress and whole:
                    progress(sum(int(batch.queue.done[0]) for batch in found) / whole)
        finally:
            for batch in found:
                batch.queue.stop[0] = 1
            pool.shutdown(cancel_futures=True)


def _work(batch: Batch, march: March) -> None:
    model, numbers, addresses = lane_model(batch.packed)
    march_lanes(model, make_block(batch.packed, numbers, addresses), batch.queue, march)
