"""Where the chunks of a sweep are evaluated: in this process over its cores or through JAX, or by Dask."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Protocol

import numpy as np

from tribodyn.errors import InputError, SimulationError
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.batch import Chunk
from tribodyn.studies.protocol.cluster import client_of, workers_of
from tribodyn.studies.protocol.evaluated import OneByOne, kept_in

Block = dict[str, np.ndarray]
JAX, DASK = "jax", "dask"


def evaluate(kind: str, chunk: Chunk, settings: Any, workers: int | None = None) -> Block:
    """Evaluate a chunk of cases of a kind: here, or in another process that has the same packages."""
    study = STUDIES[kind]
    return (study.batch() or OneByOne(study)).evaluate(chunk, settings, workers)


class Engine(Protocol):
    """Evaluates chunks; results come in any order, each once."""

    #: Cases that are integrated side by side at the cost of one.
    width: int

    def __call__(self, kind: str, chunks: Iterable[Chunk], settings: Any) -> Iterator[tuple[Chunk, Block]]:
        """Evaluate; takes the next chunks only as results go out."""
        ...


@dataclass
class LocalEngine:
    """One chunk after the other in this process, its cases over so many threads, by default one per core."""

    workers: int | None = None
    width: int = 1

    def __call__(self, kind: str, chunks: Iterable[Chunk], settings: Any) -> Iterator[tuple[Chunk, Block]]:
        """See `Engine`."""
        with TemporaryDirectory(prefix="tribodyn-", ignore_cleanup_errors=True) as folder:
            for chunk in chunks:
                with kept_in(Path(folder)):
                    block = evaluate(kind, chunk, settings, self.workers)
                yield chunk, block


@dataclass
class DaskEngine:
    """Chunks over the workers of a Dask client; one whose worker dies is done again by another."""

    client: Any
    width: int = 1

    def __call__(self, kind: str, chunks: Iterable[Chunk], settings: Any) -> Iterator[tuple[Chunk, Block]]:
        """See `Engine`."""
        from distributed import as_completed

        rest = iter(chunks)
        sent: dict[str, Chunk] = {}
        running = as_completed()

        def send() -> None:
            for chunk in rest:
                # impure: equal chunks of two sweeps must not be taken for one
                future = self.client.submit(evaluate, kind, chunk, settings, 1, pure=False, retries=3)
                sent[future.key] = chunk
                running.add(future)
                return

        # two chunks per worker, so that none waits for the next one to be sent; this bounds the memory
        for _ in range(2 * workers_of(self.client)):
            send()
        for future in running:
            if future.status == "error":
                raise SimulationError(f"a worker of the cluster could not go on: {future.exception()!r}")
            block = future.result()
            chunk = sent.pop(future.key)
            future.release()
            send()
            yield chunk, block


@contextmanager
def engine_of(name: str, workers: int | None, scheduler: str | None) -> Iterator[Engine]:
    """Give the engine of a name; a local cluster lives as long as the block. Raises as `client_of`."""
    if name == DASK:
        with client_of(workers, scheduler) as client:
            yield DaskEngine(client)
        return
    if scheduler is not None:
        raise InputError("--scheduler", scheduler, "belongs to --engine dask", "add --engine dask")
    width = 1
    if name == JAX:
        from tribodyn.solve.jax.ensemble import width_here

        width = width_here()
    yield LocalEngine(workers, width)
