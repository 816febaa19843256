"""Evaluates cases of a base scenario, side by side: on this machine or on those of a cluster.

On this machine one is evaluated in this process, the others in processes of their own, which are handed lines
of text. They import nothing of the user's program, which a process of `multiprocessing` would run again.
"""

import copy
import json
import sys
import threading
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics import child
from tribodyn.numerics.work import usable_cores
from tribodyn.scenario.resolve import resolve_table
from tribodyn.scenario.tables.duty import LOADS, SPEEDS
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.sources import own
from tribodyn.studies.protocol.evaluated import evaluated
from tribodyn.studies.protocol.load import Loaded, loaded_from, table_of
from tribodyn.studies.sweeping.cluster import workers_of

if TYPE_CHECKING:
    import subprocess

#: Keys of `operating` of which one is given.
ALTERNATIVES = (SPEEDS, LOADS)
#: Stands for the file of a base scenario: what choices name is looked for from here.
FILE = Path("scenario")


def loaded_case(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> Loaded:
    """Load the base scenario with some keys set; raises as `protocol.load.load`."""
    data = copy.deepcopy(dict(base))
    for group in ALTERNATIVES:
        if any(f"operating.{name}" in overrides for name in group):
            for name in group:  # what is given takes the place of what stands there
                data.get("operating", {}).pop(name, None)
    return loaded_from(resolve_table(data, FILE, overrides, table_of), FILE)


def loaded_source(
    scenarios: Mapping[str, Mapping[str, Any]], name: str, overrides: Mapping[str, Any]
) -> Loaded:
    """Load one of the scenarios of a search with those of the overrides that belong to it."""
    data = scenarios[name]
    return loaded_case(data, own(name, study_of(data).table(data), overrides, scenarios))


def evaluate(
    scenarios: Mapping[str, Mapping[str, Any]],
    several: Sequence[Mapping[str, Any]],
    workers: int | None = None,
) -> list[dict[str, Any] | str]:
    """Figures of cases, numbers alone; a text instead where one fails: why.

    Parameters
    ----------
    scenarios : data of the scenario that is searched through, and of its parts, by their names as sources
    several : overrides of each case
    workers : threads of a study that evaluates cases together
    """
    found: list[dict[str, Any] | str] = [{} for _ in several]
    for name, data in scenarios.items():
        schema = study_of(data).table(data)
        requests = [own(name, schema, overrides, scenarios) for overrides in several]
        once = {json.dumps(request, sort_keys=True): request for request in requests}
        known = dict(zip(once, _figures(data, list(once.values()), workers), strict=True))
        for place, request in enumerate(requests):
            found[place] = _with(found[place], name, known[json.dumps(request, sort_keys=True)])
    return found


def _with(known: dict[str, Any] | str, name: str, more: dict[str, Any] | str) -> dict[str, Any] | str:
    """Figures of a case with those of one more scenario."""
    if isinstance(known, str):
        return known
    if isinstance(more, str):
        return f"{name}: {more}" if name else more
    return known | {f"{name}.{figure}" if name else figure: value for figure, value in more.items()}


def _figures(
    data: Mapping[str, Any], several: Sequence[Mapping[str, Any]], workers: int | None
) -> list[dict[str, Any] | str]:
    """Figures of cases of one scenario."""
    cases: list[Any] = []
    for overrides in several:
        try:
            cases.append(loaded_case(data, overrides).case)
        except InputError as error:
            cases.append(str(error))
    try:
        found = evaluated(study_of(data), cases, workers)
    except InputError as error:  # of all cases together
        found = [str(error)] * len(cases)
    return [value if isinstance(value, str) else numbers(value) for value in found]


def distance_from_limits(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> float:
    """The least distance of a case's gears from the limits of their existence, in modules.

    Negative where they cannot be made or cannot run together; −1 where there is no case.
    """
    from tribodyn.geometry.assembly import assemble
    from tribodyn.geometry.families import family
    from tribodyn.geometry.limits.limits import LIMITS, plain_distances

    try:
        case = loaded_case(base, overrides).case
    except InputError:
        return -1.0
    found, module = plain_distances(assemble(family(case.family), case.drive)), case.drive.module
    return min(value / (module if LIMITS[name].unit == "m" else 1.0) for name, value in found.items())


def numbers(figures: Mapping[str, Any]) -> dict[str, float]:
    """The figures that are single finite numbers."""
    return {
        name: float(value)
        for name, value in figures.items()
        if isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
    }


def serve() -> None:
    """Evaluate what comes in as lines of JSON: first the scenarios, then lists of overrides."""
    answers, sys.stdout = sys.stdout, sys.stderr  # what a library prints is no answer
    scenarios = json.loads(sys.stdin.readline())
    for line in sys.stdin:
        answers.write(json.dumps(evaluate(scenarios, json.loads(line), workers=1)) + "\n")
        answers.flush()


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
