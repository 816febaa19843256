"""A scenario that is edited and run again: its record is replaced, the older one kept, nothing else lost."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.cheap_searches import SEARCH
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import ROOT, complaint, invoke
from tribodyn.record.reader import Record
from tribodyn.record.target import WritingLock
from tribodyn.studies.protocol.load import load
from tribodyn.studies.protocol.run import run

OSCILLATOR = """title = "mine"
kind = "backlash-oscillator"
damping = DAMPING
mean_force = 0.1
error_amplitude = 0.05
stiffness_variation = 0.0
frequency = { from = 0.8, to = 1.2, step = 0.1 }
"""
RUN = ("run", "mine.toml", "--no-plot")
#: A process that a shell begins in the background ignores Ctrl-C, and so do those that it begins.
HEEDED = (
    "import signal\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
    "from tribodyn.cli import main\nmain()\n"
)


@pytest.fixture
def edit(tmp_path: Path) -> Callable[..., Path]:
    """Write mine.toml, with a value put in."""

    def written(damping: float = 0.05, folder: Path = tmp_path) -> Path:
        (folder / "mine.toml").write_text(OSCILLATOR.replace("DAMPING", str(damping)))
        return folder / "mine.h5"

    return written


def damping_in(path: Path) -> float:
    with Record(path) as record:
        return record.scenario["damping"]


def test_the_older_record_is_kept_once(edit: Callable[..., Path], tmp_path: Path):
    for damping in (0.05, 0.06, 0.07):
        record = edit(damping)
        printed = invoke(*RUN, folder=tmp_path)
        assert damping_in(record) == damping
        assert ("mine.previous.h5" in printed) == (damping > 0.05)
    assert damping_in(tmp_path / "mine.previous.h5") == 0.06
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.h5", "mine.previous.h5", "mine.toml"]
    edit(0.08)
    assert "previous" not in invoke(*RUN, "--force", folder=tmp_path)
    assert damping_in(tmp_path / "mine.previous.h5") == 0.06


def test_a_sweep_and_an_edited_grid(edit: Callable[..., Path], tmp_path: Path):
    edit()
    for values in ("0.05,0.06", "0.05,0.06,0.07"):
        invoke("sweep", "mine.toml", "--vary", f"damping={values}", folder=tmp_path)
    names = {"mine-damping.h5", "mine-damping.previous.h5", "mine.toml"}
    assert {path.name for path in tmp_path.iterdir()} == names


def test_a_search_that_was_edited_stopped_and_resumed(tmp_path: Path):
    file = tmp_path / "mine.toml"
    file.write_text(SEARCH.replace("= 48", "= 6"))
    invoke(*RUN, folder=tmp_path)
    first = (tmp_path / "mine.h5").read_bytes()
    file.write_text(SEARCH.replace("= 48", "= 8"))

    def stop(share: float) -> None:
        # the share is of all that may be evaluated, finer resolutions too: a tenth is among the first eight
        if share > 0.1:
            raise KeyboardInterrupt

    loaded = load(file).recorded_in(tmp_path)
    with pytest.raises(KeyboardInterrupt):
        run(loaded.case, tmp_path / "mine.h5", progress=stop)
    assert "mine.partial.h5 holds what an unfinished run left" in complaint(*RUN, folder=tmp_path)
    assert (tmp_path / "mine.h5").read_bytes() == first
    assert "mine.previous.h5" in invoke(*RUN, "--resume", folder=tmp_path)
    assert (tmp_path / "mine.previous.h5").read_bytes() == first


def other_scenario(folder: Path, edit: Callable[..., Path]) -> str:
    other = folder / "other"
    other.mkdir()
    edit(0.09, other)
    invoke("run", "other/mine.toml", "--no-plot", "--force", folder=folder)
    return "mine.h5: the file exists, and is not known to be made from this scenario file"


def named_by_hand(folder: Path, _edit: Callable[..., Path]) -> str:
    invoke(*RUN, "-o", "mine.h5", "--force", folder=folder)
    return "mine.h5: the file exists, and is not known to be made from this scenario file"


def no_record(folder: Path, _edit: Callable[..., Path]) -> str:
    (folder / "mine.h5").write_bytes(b"precious")
    return "mine.h5: the file exists"


def link(folder: Path, _edit: Callable[..., Path]) -> str:
    (folder / "mine.h5").rename(folder / "far.h5")
    (folder / "mine.h5").symlink_to(folder / "far.h5")
    return "mine.h5: the file exists"


def in_the_way(folder: Path, _edit: Callable[..., Path]) -> str:
    (folder / "mine.previous.h5").write_bytes(b"precious")
    return "mine.previous.h5: is in the way of the older record"


@pytest.mark.parametrize("put", [other_scenario, named_by_hand, no_record, link, in_the_way])
def test_anything_else_is_refused(
    put: Callable[[Path, Callable[..., Path]], str], edit: Callable[..., Path], tmp_path: Path
):
    edit()
    invoke(*RUN, folder=tmp_path)
    rule = put(tmp_path, edit)
    before = {path.name: path.read_bytes() for path in tmp_path.glob("*.h5")}
    assert rule in complaint(*RUN, folder=tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.glob("*.h5")} == before


def test_a_name_given_by_hand_is_refused(edit: Callable[..., Path], tmp_path: Path):
    edit()
    for _ in range(2):
        invoke(*RUN, folder=tmp_path)
    assert "mine.h5: the file exists; choose another name" in complaint(
        *RUN, "-o", "mine.h5", folder=tmp_path
    )


def test_a_record_being_written_is_refused(edit: Callable[..., Path], tmp_path: Path):
    record = edit()
    invoke(*RUN, folder=tmp_path)
    lock = WritingLock(record)
    try:
        assert "is writing it" in complaint(*RUN, folder=tmp_path)
    finally:
        lock.release()


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="to this user no folder is read-only")
def test_a_read_only_folder_is_refused(edit: Callable[..., Path], tmp_path: Path):
    edit()
    invoke(*RUN, folder=tmp_path)
    tmp_path.chmod(0o500)
    try:
        assert "the folder cannot be written to" in complaint(*RUN, folder=tmp_path)
    finally:
        tmp_path.chmod(0o700)


def cycles(scenario: Path, number: int, more: str = "") -> None:
    text = re.sub(r"cycles = .*", f"cycles = {number}{more}", scenario.read_text(), flags=re.DOTALL)
    scenario.write_text(text)


def test_a_failed_run_keeps_the_record_and_bars_no_other(scenario: Path, tmp_path: Path):
    cycles(scenario, 2)
    invoke(*RUN, folder=tmp_path)
    first = (tmp_path / "mine.h5").read_bytes()
    cycles(scenario, 3, "\nmax_steps = 40")
    assert "solver.max_steps" in complaint(*RUN, folder=tmp_path, status=3)
    assert (tmp_path / "mine.partial.h5").exists()
    assert (tmp_path / "mine.h5").read_bytes() == first
    cycles(scenario, 3)
    invoke(*RUN, folder=tmp_path)
    assert (tmp_path / "mine.previous.h5").read_bytes() == first
    assert {path.name for path in tmp_path.iterdir()} == {"mine.h5", "mine.previous.h5", "mine.toml"}


@pytest.mark.parametrize("end", all_in_soak([signal.SIGINT, signal.SIGKILL], [signal.SIGKILL]))
def test_an_interrupted_run_keeps_the_record(end: signal.Signals, scenario: Path, tmp_path: Path):
    cycles(scenario, 2)
    invoke(*RUN, folder=tmp_path)
    first = (tmp_path / "mine.h5").read_bytes()
    cycles(scenario, 20_000)
    command = [sys.executable, "-c", HEEDED, *RUN]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(command, cwd=tmp_path, env=environment, stderr=subprocess.DEVNULL) as process:
        while not (tmp_path / "mine.partial.h5").exists():
            assert process.poll() is None, "it ended before it began to write"
            time.sleep(0.01)
        process.send_signal(end)
        process.wait(timeout=120)
    assert (tmp_path / "mine.h5").read_bytes() == first
    cycles(scenario, 3)
    invoke(*RUN, folder=tmp_path)
    assert (tmp_path / "mine.previous.h5").read_bytes() == first
    assert {path.name for path in tmp_path.iterdir()} == {"mine.h5", "mine.previous.h5", "mine.toml"}
