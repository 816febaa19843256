"""Evaluates cases of a base scenario, side by side: on this machine or on those of a cluster.

On this machine one is evaluated in this process, the others in processes of their own.
"""

import copy
import json
from collections.abc import Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from math import isfinite
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple, Self

from tribodyn.errors import InputError, SimulationError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.limits import LIMITS, plain_distances
from tribodyn.input.names import named_in, same_key
from tribodyn.input.resolve import resolve_table
from tribodyn.input.tables.duty import LOADS, SPEEDS
from tribodyn.numerics.processes import workers
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.sources import own
from tribodyn.studies.protocol.cluster import workers_of
from tribodyn.studies.protocol.evaluated import evaluated, kept_in, within
from tribodyn.studies.protocol.load import Loaded, SoundScenario, sound, table_of

#: Keys of `operating` of which one is given.
ALTERNATIVES = (SPEEDS, LOADS)
#: Stands for the file of a base scenario: what choices name is looked for from here.
FILE = Path("scenario")

Results = list[dict[str, Any] | str]
"""Quantities of cases by name; a text instead where one has none: why."""


def loaded_case(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> Loaded:
    """Load the base scenario with some keys set; raises as `protocol.load.load`."""
    return sound_case(base, overrides).loaded()


def sound_case(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> SoundScenario:
    """The same before its case is made."""
    data, given = copy.deepcopy(dict(base)), {same_key(key) for key in overrides}
    for group in ALTERNATIVES:
        if any(f"operating.{name}" in given for name in group):
            for name in group:  # what is given takes the place of what stands there
                data.get("operating", {}).pop(named_in(data.get("operating", {}), name), None)
    return sound(resolve_table(data, FILE, overrides, table_of), FILE)


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
) -> Results:
    """Quantities of cases by their overrides, numbers alone; a text instead where one fails: why.

    `scenarios` are by their names as sources; `workers` are threads of a study that evaluates cases together.
    """
    results: Results = [{} for _ in several]
    for number, (name, data) in enumerate(scenarios.items()):
        schema = study_of(data).table(data)
        requests = [own(name, schema, overrides, scenarios) for overrides in several]
        keys = [json.dumps(request, sort_keys=True) for request in requests]
        once = dict(zip(keys, requests, strict=True))
        with within(number):
            by_key = dict(zip(once, _found(data, list(once.values()), workers), strict=True))
        results = [_with(whole, name, by_key[key]) for whole, key in zip(results, keys, strict=True)]
    return results


def _with(quantities: dict[str, Any] | str, name: str, more: dict[str, Any] | str) -> dict[str, Any] | str:
    """Quantities of a case with those of one more scenario."""
    if isinstance(quantities, str):
        return quantities
    if isinstance(more, str):
        return f"{name}: {more}" if name else more
    return quantities | {f"{name}.{key}" if name else key: value for key, value in more.items()}


def _found(data: Mapping[str, Any], several: Sequence[Mapping[str, Any]], workers: int | None) -> Results:
    """Quantities of cases of one scenario."""
    cases: list[Any] = []
    for overrides in several:
        try:
            cases.append(loaded_case(data, overrides).case)
        except InputError as error:
            cases.append(str(error))
    try:
        results = evaluated(study_of(data), cases, workers)
    except InputError as error:  # of all cases together
        results = [str(error)] * len(cases)
    return [value if isinstance(value, str) else numbers(value) for value in results]


def distance_from_limits(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> float:
    """The least distance of a case's gears from the limits of their existence, in modules.

    Negative where they cannot be made or cannot run together; −1 where there is no case.
    """
    try:
        pair = loaded_case(base, overrides).case.pair
    except InputError:
        return -1.0
    distances, module = plain_distances(assemble(family(pair.family), pair.drive)), pair.drive.module
    return min(value / (module if LIMITS[name] == "m" else 1.0) for name, value in distances.items())


def numbers(quantities: Mapping[str, Any]) -> dict[str, float]:
    """The quantities that are single finite numbers."""
    return {
        name: float(value)
        for name, value in quantities.items()
        if isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
    }


def serve() -> None:
    """Evaluate lists of overrides that come in, see `numerics.processes.workers`."""
    workers.serve(lambda head: partial(_evaluate_in, head[0], Path(head[1]), 1))


def _evaluate_in(
    scenarios: Mapping[str, Mapping[str, Any]],
    folder: Path,
    threads: int | None,
    several: Sequence[Mapping[str, Any]],
) -> Results:
    """The same as `evaluate`, with a folder for the parts of the cases."""
    with kept_in(folder):
        return evaluate(scenarios, several, threads)


class Pool(workers.Workers):
    """Evaluates lists of overrides as `evaluate` does, so many at a time; a context manager."""

    name = "native"

    def __init__(self, scenarios: Mapping[str, Mapping[str, Any]], count: int) -> None:
        self.workers = count
        # of the parts of cases, by worker; its own, as processes that are ended cannot remove theirs
        self._folder = TemporaryDirectory(prefix="tribodyn-", ignore_cleanup_errors=True)
        own = partial(_evaluate_in, scenarios, self._place(0), None if count == 1 else 1)
        super().__init__(
            count,
            own,
            f"{evaluate.__module__}:serve",
            lambda number: [scenarios, str(self._place(number))],
            "a process that evaluates designs",
        )

    def __exit__(self, *_: object) -> None:
        super().__exit__()
        self._folder.cleanup()

    def _place(self, number: int) -> Path:
        """Where the parts of the cases of a worker lie."""
        return Path(self._folder.name) / str(number)


class Cluster:
    """Evaluates lists of overrides by the workers of a client of Dask; a context manager.

    What a worker was at when it died is done again by another. Workers need the same version of tribodyn.
    """

    name = "dask"

    def __init__(self, scenarios: Mapping[str, Mapping[str, Any]], client: Any) -> None:
        self.workers = workers_of(client)
        self._scenarios = scenarios
        self._client = client
        self._sent: list[Any] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._client.cancel([future for future in self._sent if not future.done()])

    def submit(self, several: Sequence[Mapping[str, Any]]) -> "_Answer":
        """Evaluate cases by their overrides, as `evaluate` does."""
        # impure: equal candidates of two searches must not be taken for one
        sent = self._client.submit(evaluate, self._scenarios, list(several), 1, pure=False, retries=3)
        self._sent.append(sent)
        return _Answer(sent)


class _Answer(NamedTuple):
    """What a worker of a cluster answers."""

    sent: Any

    def result(self) -> Results:
        try:
            return self.sent.result()
        except Exception as error:
            raise SimulationError(f"a worker of the cluster could not go on: {error!r}") from error


Evaluators = Pool | Cluster
Answer = Future[Results] | _Answer
"""What they give: it has the quantities of the cases as its ``result()``."""
