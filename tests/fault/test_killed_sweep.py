"""A sweep that is killed leaves a valid record and goes on where it stopped; a cluster loses a worker."""

import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.support.killed_sweeps import differences
from tests.support.verbs import complaint, invoke
from tribodyn.grid.engines import DaskEngine, LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE, WAITING
from tribodyn.studies.motion import batch

# one case a chunk, so that there is something between nothing and everything
ONE_A_CHUNK = (
    "from tribodyn.studies.motion import batch\nbatch.MOST_IN_CHUNK = 1\n"
    "from tribodyn.cli import main\nimport sys\nsys.argv = ['tribodyn', 'sweep', *sys.argv[1:]]\nmain()\n"
)
WORDS = ("crc-23-47", "--transient", "40", "--set", "output.samples_per_cycle=40")
VARY = ("--vary", "operating.pinion_speed=20:400/30 rad/s")


@pytest.mark.parametrize(
    "direction", [(), pytest.param(("--direction", "up"), marks=pytest.mark.soak)], ids=["batch", "followed"]
)
def test_a_killed_sweep_goes_on_where_it_stopped(direction: tuple[str, ...], tmp_path: Path):
    sweep = ("sweep", *WORDS, *VARY, *direction)
    words = (*sweep[1:], "-o", "killed.h5")
    process = subprocess.Popen([sys.executable, "-c", ONE_A_CHUNK, *words], cwd=tmp_path)
    partial = tmp_path / "killed.partial.h5"
    started = time.monotonic()
    try:
        while not partial.exists() or _done(partial) < 3:
            assert process.poll() is None
            assert time.monotonic() - started < 300
            time.sleep(0.05)
    finally:
        process.kill()
        assert process.wait() == -signal.SIGKILL
    with SweepRecord(partial) as left:
        assert left.status == "partial"
        before = left["status"]
        assert 3 <= np.sum(before == DONE) < 30
        assert np.isfinite(left["efficiency"][before == DONE]).all()
        # what a case gave is written before its status: one may have been killed in between
        assert np.sum(np.isfinite(left["efficiency"][before == WAITING])) <= 1
    for other in (["--set", "operating.gear_torque=1 N*m"], ["--transient", "39"], ["--direction", "down"]):
        given = (*sweep, *other, "--resume", "-o", tmp_path / "killed.h5")
        assert "--resume" in complaint(*given)
    shutil.copy(partial, tmp_path / "other.partial.h5")
    with h5py.File(tmp_path / "other.partial.h5", "r+") as file:
        file.attrs["code_sha256"] = "0" * 64
    assert "computed by other code" in complaint(*sweep, "--resume", "-o", tmp_path / "other.h5")
    invoke(*sweep, "--resume", "-o", tmp_path / "killed.h5")
    assert not partial.exists()
    with SweepRecord(tmp_path / "killed.h5") as record:
        assert (record["status"] == DONE).all()
        assert record.summary["cases_done_by_this_call"] == np.sum(before == WAITING)
    invoke(*sweep, "-o", tmp_path / "whole.h5")
    assert differences(tmp_path / "killed.h5", tmp_path / "whole.h5") == []


def _done(path: Path) -> int:
    try:
        with SweepRecord(path) as record:
            return int(np.sum(record["status"] == DONE))
    except Exception:  # its datasets are being made
        return 0


def test_a_record_of_something_else_is_not_taken_up(tmp_path: Path):
    with h5py.File(tmp_path / "other.partial.h5", "w") as file:
        file.attrs["format"] = "tribodyn-record"
    words = ("sweep", *WORDS, *VARY, "--resume", "-o", tmp_path / "other.h5")
    assert "not what a sweep left" in complaint(*words)


@pytest.mark.soak
def test_a_cluster_that_loses_a_worker_gives_the_same_record(tmp_path: Path, monkeypatch):
    """A scheduler and two workers in processes of their own; one of them is killed half-way."""
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(batch, "MOST_IN_CHUNK", 1)
    grid = Grid("crc-23-47", ["operating.pinion_speed=100:400/12 rad/s"], {"output.samples_per_cycle": 40})
    settings = settings_of(grid, 8)
    here = run(grid, settings, LocalEngine(), tmp_path / "here.h5")
    address = tmp_path / "scheduler.json"
    scheduler = _start("dask_scheduler", address, "--port", "0")
    workers = [_start("dask_worker", address, "--no-nanny", "--nthreads", "1") for _ in range(2)]
    try:
        with distributed.Client(scheduler_file=str(address), timeout="300s") as client:
            client.wait_for_workers(2, timeout=300)
            done = []

            def follow(so_far: int, total: int) -> None:
                done.append(so_far)
                if so_far == total // 2:
                    workers[0].kill()

            there = run(grid, settings, DaskEngine(client), tmp_path / "there.h5", follow=follow)
        assert done == list(range(1, 13))  # every case arrives once
        assert workers[0].wait() == -signal.SIGKILL
    finally:
        for process in (*workers, scheduler):
            if process.poll() is None:
                process.terminate()
                process.wait()
    assert there.failed == 0
    assert differences(here.path, there.path) == []


def _start(program: str, address: Path, *words: str) -> "subprocess.Popen[bytes]":
    command = [sys.executable, "-m", f"distributed.cli.{program}", "--scheduler-file", str(address)]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen([*command, "--no-dashboard", *words], **quiet)
