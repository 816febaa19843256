"""A sweep gives the same bits in any order and chunks, on any workers, interrupted and resumed; in short."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from tests.support.killed_sweeps import MOVING_ERROR, differences
from tests.support.soak_parameters import all_in_soak
from tribodyn.grid.engines import DaskEngine, Engine, LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.refinement import refinement_of
from tribodyn.grid.run import run, settings_of
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies.motion import batch

KEY, _, ERROR = MOVING_ERROR.partition("=")
SET = {KEY: ERROR, "output.samples_per_cycle": 32}
SPEEDS = (480, 484, 488, 492)
#: Way -> mesh cycles to march, directions, further values where the response bends.
WAYS: dict[str, tuple[int | None, tuple[str, ...], int | None]] = {
    "steady": (None, (), None),
    "followed": (None, ("up", "down"), None),
    "transient": (40, (), None),
    "refined": (40, (), 5),
    "followed and refined": (None, ("up", "down"), 3),
}


class Stopped(Exception):
    """Ends a sweep as Ctrl-C does."""


def sweep(
    way: str, output: Path, engine: Engine, speeds: Sequence[int] = SPEEDS, *, resume=False, stop=0
) -> Path:
    """Run a sweep, which stops after so many cases."""
    cycles, directions, most = WAYS[way]
    grid = Grid("jump-involute-23-47", [f"operating.pinion_speed={','.join(map(str, speeds))}rad/s"], SET)

    def follow(done: int, total: int) -> None:
        if stop and done >= stop and done < total:
            raise Stopped

    options = {
        "directions": directions,
        "refinement": refinement_of(grid, most, ()),
        "resume": resume,
        "follow": follow,
    }
    return run(grid, settings_of(grid, cycles), engine, output, **options).path


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory):
    """(way) -> record of a sweep that nothing stopped."""
    folder, made = tmp_path_factory.mktemp("alone"), {}

    def record(way: str) -> Path:
        if way not in made:
            made[way] = sweep(way, folder / f"{way}.h5", LocalEngine(1))
        return made[way]

    return record


@pytest.mark.parametrize("way", all_in_soak(WAYS, ("steady", "transient", "followed and refined")))
def test_interruptions_change_no_bit(way: str, alone, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    # stopped within the first grid, at its end, and in a later round where there is one
    for chunk, stop, workers in ((1, 1, 2), (2, 2, 1), (1, 1, 2), (1, 1, 1), (3, 0, 2)):
        if (tmp_path / "s.h5").exists():
            break
        monkeypatch.setattr(batch, "MOST_IN_CHUNK", chunk)
        resume = (tmp_path / "s.partial.h5").exists()
        try:
            sweep(way, tmp_path / "s.h5", LocalEngine(workers), resume=resume, stop=stop)
        except Stopped:
            assert stop
    assert differences(tmp_path / "s.h5", alone(way)) == []
    with SweepRecord(alone(way)) as record:
        assert len(record.parameters[0].values) == len(SPEEDS) + (WAYS[way][2] or 0)


@pytest.mark.parametrize("way", ["steady", "transient"])
def test_order_and_part_of_the_range_change_no_bit(way: str, alone, tmp_path: Path):
    part = sweep(way, tmp_path / "part.h5", LocalEngine(2), (492, 480))
    with SweepRecord(part) as some, SweepRecord(alone(way)) as every:
        rows = [SPEEDS.index(492), SPEEDS.index(480)]
        for name in (
            "state",
            "transmission_error_rotational",
            "poincare_rate",
            "efficiency",
            "cycles",
            "residual",
        ):
            assert some[name].tobytes() == every[name][rows].tobytes(), name


def test_dask_changes_no_bit(alone, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(batch, "MOST_IN_CHUNK", 2)
    given = {"n_workers": 1, "threads_per_worker": 1, "processes": False, "dashboard_address": None}
    with distributed.LocalCluster(**given) as cluster, distributed.Client(cluster) as client:
        sweep("steady", tmp_path / "s.h5", DaskEngine(client))
    assert differences(tmp_path / "s.h5", alone("steady")) == []
