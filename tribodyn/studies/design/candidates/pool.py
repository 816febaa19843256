"""Evaluates candidates side by side, on this machine or on those of a cluster.

On this machine one is evaluated in this process, the others in processes of their own, which are handed lines
of text. They import nothing of the user's program, which a process of `multiprocessing` would run again.
"""

import json
import threading
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import TYPE_CHECKING, Any, Protocol, Self

from tribodyn.errors import SimulationError
from tribodyn.numerics import child
from tribodyn.numerics.work import usable_cores
from tribodyn.studies.design.candidates.evaluation import evaluate
from tribodyn.studies.sweeping.cluster import workers_of

if TYPE_CHECKING:
    import subprocess

#: Evaluations that a process of its own is worth.
WORTH = 24

Figures = list[dict[str, Any] | str]


def workers_for(evaluations: int) -> int:
    """How many evaluate side by side: one per core, fewer where there is little to do."""
    return max(1, min(usable_cores(), evaluations // WORTH))


class Evaluators(Protocol):
    """What evaluates candidates; a context manager."""

    #: What the record says of it.
    name: str
    #: How many evaluate at a time.
    workers: int

    def submit(self, several: Sequence[Mapping[str, Any]]) -> Any:
        """Evaluate cases by their overrides; gives what has their `Figures` as its ``result()``."""
        ...


class Pool:
    """Evaluates lists of overrides; a context manager.

    Parameters
    ----------
    scenarios : as `evaluation.evaluate` takes them
    workers : how many at a time
    """

    name = "native"

    def __init__(self, scenarios: Mapping[str, Mapping[str, Any]], workers: int) -> None:
        self.scenarios = scenarios
        self.workers = workers
        self._own = threading.local()
        self._processes: list[subprocess.Popen[bytes]] = []
        self._seats = list(range(workers))
        self._lock = threading.Lock()
        self._threads = ThreadPoolExecutor(workers, initializer=self._seat)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)
        for process in self._processes:
            child.end(process)

    def submit(self, several: Sequence[Mapping[str, Any]]) -> "Future[Figures]":
        """Evaluate cases by their overrides, as `evaluation.evaluate` does."""
        return self._threads.submit(self._evaluate, list(several))

    def _seat(self) -> None:
        """Give the first thread this process, every other one a process of its own."""
        with self._lock:
            seat = self._seats.pop(0)
        self._own.process = None
        if seat:
            process = child.start(f"{evaluate.__module__}:serve")
            with self._lock:
                self._processes.append(process)
            self._own.process = process
            child.tell(process, _line(self.scenarios))

    def _evaluate(self, several: list[Mapping[str, Any]]) -> Figures:
        process = self._own.process
        if process is None:
            return evaluate(self.scenarios, several, None if self.workers == 1 else 1)
        try:
            child.tell(process, _line(several))
            answer = process.stdout.readline()
        except OSError:
            answer = b""
        if not answer:
            raise SimulationError("a process that evaluates designs ended: out of memory, or killed")
        return json.loads(answer)


def _line(message: Any) -> bytes:
    return json.dumps(message).encode() + b"\n"


class Cluster:
    """Evaluates lists of overrides by the workers of a Dask scheduler; a context manager.

    What a worker was at when it died is done again by another. Workers need the same version of tribodyn.

    Parameters
    ----------
    scenarios : as `evaluation.evaluate` takes them
    client : distributed.Client
    """

    name = "dask"

    def __init__(self, scenarios: Mapping[str, Mapping[str, Any]], client: Any) -> None:
        self.scenarios = scenarios
        self.client = client
        self.workers = workers_of(client)
        self._sent: list[Any] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.client.cancel([future for future in self._sent if not future.done()])

    def submit(self, several: Sequence[Mapping[str, Any]]) -> "_Answer":
        """Evaluate cases by their overrides, as `evaluation.evaluate` does."""
        # impure: equal candidates of two searches must not be taken for one
        sent = self.client.submit(evaluate, self.scenarios, list(several), 1, pure=False, retries=3)
        self._sent.append(sent)
        return _Answer(sent)


class _Answer:
    """What a worker of a cluster answers."""

    def __init__(self, sent: Any) -> None:
        self._sent = sent

    def result(self) -> Figures:
        try:
            return self._sent.result()
        except Exception as error:
            raise SimulationError(f"a worker of the cluster could not go on: {error!r}") from error
