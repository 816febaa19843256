"""Evaluates points of operation, in this process and others or by a cluster; what was evaluated is kept."""

import hashlib
import json
import tomllib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import lru_cache, partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.loss_part import LossSource, OperatingPoints
from tribodyn.errors import SimulationError
from tribodyn.numerics.files.output_files import write_output
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.numerics.processes.work import usable_cores
from tribodyn.numerics.processes.workers import Workers, serve
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.map.case import MapCase
from tribodyn.studies.protocol.cluster import workers_of
from tribodyn.studies.protocol.load import Loaded, load_data

#: Points that are evaluated together: at least, and at most.
FEWEST, MOST = 32, 400
#: Points that a process of its own is worth.
WORTH = 200
#: Of the files with points that were evaluated.
_ENDING = ".points"

Points = Float[Array, "point axis"]
Answer = dict[str, Any]
"""Sources, limits of formulas that are exceeded, and rows of the drag and of the meshes, as lists."""


def evaluate(subject: Loaded, points: Sequence[Sequence[float]]) -> Answer:
    """Losses of a gearbox at points (torque, speed, oil temperature)."""
    losses = subject.losses
    torque, speed, oil = np.asarray(points, float).T
    own = losses.nominal(subject.case).output_torque
    load = torque / own if own else 0.0 * torque  # refused by the case where it is not 0
    found = losses.at(subject.case, OperatingPoints(load, speed, oil))
    return {
        "sources": [list(source) for source in found.sources],
        "exceeded": [list(limits) for limits in found.exceeded],
        "drag": np.asarray(found.drag).tolist(),
        "meshes": {name: np.asarray(values).tolist() for name, values in found.meshes.items()},
    }


@lru_cache(maxsize=2)
def _loaded(scenario: str) -> Loaded:
    data = json.loads(scenario)
    return load_data(data, str(data.get("name") or "gearbox"))


def evaluate_scenario(scenario: str, points: Sequence[Sequence[float]]) -> Answer:
    """The same of a scenario as JSON, in another process; the gearbox's tables are kept between calls."""
    return evaluate(_loaded(scenario), points)


def serve_points() -> None:
    """Evaluate points that come in, see `numerics.processes.workers`."""
    serve(lambda scenario: partial(evaluate_scenario, scenario))


class PointCluster:
    """Evaluates points by the workers of a client of Dask; those of one that dies another does again."""

    def __init__(self, scenario: str, client: Any) -> None:
        self.count = workers_of(client)
        self._scenario, self._client = scenario, client

    def submit(self, points: Sequence[Sequence[float]]) -> Any:
        """Evaluate points; what is given has their answer as its ``result()``."""
        return self._client.submit(evaluate_scenario, self._scenario, points, pure=False, retries=3)


@contextmanager
def evaluators(case: MapCase, points: int, client: Any) -> "Iterator[Workers | PointCluster]":
    """What evaluates about so many points: the workers of a client, or the cores of this machine."""
    scenario = json.dumps(_scenario_of(case))
    if client:
        yield PointCluster(scenario, client)
        return
    count = max(1, min(usable_cores(), points // WORTH))
    about = "a process that evaluates points of the map"
    target = f"{__name__}:{serve_points.__name__}"
    with Workers(count, partial(evaluate, case.subject), target, lambda _: scenario, about) as workers:
        yield workers


def _scenario_of(case: MapCase) -> dict[str, Any]:
    return tomllib.loads(case.toml)["scenario"]


class KnownPoints(NamedTuple):
    """What is known at points, in their order."""

    sources: tuple[LossSource, ...]
    exceeded: tuple[tuple[str, ...], ...]  # of every source, at any point that was evaluated
    drag: Float[Array, "point source"]
    meshes: dict[str, Float[Array, "point mesh"]]


class PointStore:
    """Points that were evaluated, each once, also by an earlier call that was stopped.

    They lie in `folder`, where one is given, in files of some points each.
    """

    def __init__(
        self,
        case: MapCase,
        workers: "Workers | PointCluster",
        folder: Path | None = None,
        progress: Callable[[int], None] | None = None,
    ) -> None:
        self._workers, self._folder, self._progress = workers, folder, progress
        self._origin = hashlib.sha256(
            f"{json.dumps(_scenario_of(case), sort_keys=True)} {computing_digest()}".encode()
        ).hexdigest()
        self._row: dict[tuple[float, ...], int] = {}
        self._answers: list[Answer] = []
        self._drag: list[list[float]] = []
        self._meshes: dict[str, list[list[float]]] = {}
        if folder and folder.is_dir():
            for file in sorted(folder.glob(f"*{_ENDING}")):
                self._take_up(file)

    def __len__(self) -> int:
        return len(self._row)

    def drag(self, points: Points) -> Float[Array, " point"]:
        """Drag torque of all sources at points."""
        return self.at(points).drag.sum(axis=1)

    def at(self, points: Points) -> KnownPoints:
        """Everything at points; what is not known yet is evaluated."""
        keys = [tuple(map(float, point)) for point in points]
        self._evaluate([key for key in dict.fromkeys(keys) if key not in self._row])
        rows = [self._row[key] for key in keys]
        sources = tuple(LossSource(*source) for source in self._answers[0]["sources"])
        exceeded = tuple(
            tuple(dict.fromkeys(limit for limits in of for limit in limits))
            for of in zip(*(answer["exceeded"] for answer in self._answers), strict=True)
        )
        meshes = {name: np.array(values, float)[rows] for name, values in self._meshes.items()}
        return KnownPoints(sources, exceeded, np.array(self._drag, float)[rows], meshes)

    def _evaluate(self, points: list[tuple[float, ...]]) -> None:
        # those of one temperature and speed together, for which a gearbox may have tables
        ordered = sorted(points, key=lambda point: point[::-1])
        size = int(np.clip(-(-len(ordered) // (4 * self._workers.count)), FEWEST, MOST))
        parts = [ordered[start : start + size] for start in range(0, len(ordered), size)]
        for part, answer in zip(parts, [self._workers.submit(part) for part in parts], strict=True):
            try:
                found = answer.result()
            except SimulationError:
                raise
            except Exception as error:
                if isinstance(self._workers, Workers):
                    raise
                raise SimulationError(f"a worker of the cluster could not go on: {error!r}") from error
            self._take(part, found)
            self._keep(part, found)
            if self._progress:
                self._progress(len(self._row))

    def _take(self, points: Sequence[Sequence[float]], answer: Answer) -> None:
        for point in points:
            self._row[tuple(point)] = len(self._row)
        self._answers.append({name: answer[name] for name in ("sources", "exceeded")})
        self._drag += answer["drag"]
        for name, values in answer["meshes"].items():
            self._meshes.setdefault(name, []).extend(values)

    def _keep(self, points: Sequence[Sequence[float]], answer: Answer) -> None:
        if self._folder is None:
            return
        self._folder.mkdir(parents=True, exist_ok=True)
        content = json.dumps([self._origin, points, answer])
        write_output(self._folder / f"{len(self._row):08d}{_ENDING}", content, force=True)

    def _take_up(self, file: Path) -> None:
        """Take what an earlier call wrote; of another gearbox, or other code, it is removed."""
        origin, points, answer = "", [], {}
        with suppress(OSError, ValueError):
            origin, points, answer = json.loads(file.read_text(encoding="utf-8"))
        if origin != self._origin:
            file.unlink()
            return
        new = [place for place, point in enumerate(points) if tuple(point) not in self._row]
        rows = {name: [values[place] for place in new] for name, values in answer["meshes"].items()}
        drag = [answer["drag"][place] for place in new]
        self._take([points[place] for place in new], {**answer, "drag": drag, "meshes": rows})


def discard(folder: Path) -> None:
    """Remove what was kept in a folder, and it, unless something else lies there."""
    for file in folder.glob(f"*{_ENDING}"):
        file.unlink()
    with suppress(OSError):
        folder.rmdir()
