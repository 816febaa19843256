"""Two processes want to write one record: the second is refused, until the first has ended or was killed."""

import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.verbs import complaint, invoke
from tribodyn.errors import InputError
from tribodyn.record.target import WritingLock, lock_path, refuse_if_written
from tribodyn.record.writer import check_target

HOLD = (
    "import sys\nfrom pathlib import Path\nfrom tribodyn.record.target import WritingLock\n"
    "held = WritingLock(Path(sys.argv[1]))\nprint('held', flush=True)\nsys.stdin.read()\n"
)
SHORT = ("--set", "output.samples_per_cycle=40")
SWEEP = ("sweep", "crc-23-47", "--vary", "operating.pinion_speed=100,200 rad/s", "--transient", "2", *SHORT)
RUN = ("run", "crc-23-47", "--set", "solver.cycles=2", *SHORT, "--no-plot")


@pytest.fixture
def holder(tmp_path: Path) -> Iterator["subprocess.Popen[str]"]:
    """A process that writes the record `here.h5`."""
    command = [sys.executable, "-c", HOLD, str(tmp_path / "here.h5")]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    with process:
        assert process.stdout is not None
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


def test_a_second_writer_is_refused_until_the_first_is_killed(
    holder: "subprocess.Popen[str]", tmp_path: Path
):
    path = tmp_path / "here.h5"
    partial = tmp_path / "here.partial.h5"
    partial.write_bytes(b"what the other process has written so far")
    for words in (SWEEP, (*SWEEP, "--force"), (*SWEEP, "--resume"), RUN, (*RUN, "--force")):
        assert complaint(*words, "-o", path) == (
            f"output = {path}: process {holder.pid} is writing it; "
            "wait for its end, or choose another name with --output"
        )
    assert partial.read_bytes() == b"what the other process has written so far"
    holder.kill()
    holder.wait()
    assert lock_path(path).exists()  # nobody was there to remove it
    partial.unlink()
    invoke(*SWEEP, "--resume", "-o", path)
    assert path.exists()
    assert not lock_path(path).exists()
    invoke(*RUN, "--force", "-o", path)
    assert not lock_path(path).exists()


def test_asking_beforehand_leaves_nothing_behind(tmp_path: Path):
    check_target(tmp_path / "run.h5")
    assert not list(tmp_path.iterdir())


def test_never_two_at_a_time(tmp_path: Path):
    """Eight writers that come and go, each taking the lock's file away: no two of them hold it at once."""
    path, inside, most = tmp_path / "run.h5", [0], []
    count = threading.Lock()
    held = [0] * 8

    def come_and_go(number: int) -> None:
        while held[number] < 25:
            try:
                lock = WritingLock(path)
            except InputError:
                continue
            with count:
                inside[0] += 1
                most.append(inside[0])
            held[number] += 1
            with count:
                inside[0] -= 1
            lock.release()

    threads = [threading.Thread(target=come_and_go, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(most) == 200
    assert set(most) == {1}
    assert not lock_path(path).exists()


def test_a_lock_is_taken_over_from_any_number_of_dead_writers(tmp_path: Path):
    path = tmp_path / "record.h5"
    for _ in range(4):
        lock = WritingLock(path)
        assert lock_path(path).read_text(encoding="ascii") == str(os.getpid())
        assert lock._number is not None
        os.close(lock._number)  # as the system does when a process is killed: the file stays
        refuse_if_written(path)
    last = WritingLock(path)
    last.release()
    assert not lock_path(path).exists()
