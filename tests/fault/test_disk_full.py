"""A disk that is full at any byte: one message, whatever was computed can be read, nothing lies about."""

import errno
import os
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.support.killed_sweeps import differences
from tests.support.record_samples import SWEEP_HEAD, block, gear_pair_writer, geometry, sweep_record
from tests.support.soak_parameters import all_in_soak
from tribodyn.errors import OutputError
from tribodyn.numerics.files import cache
from tribodyn.record import disk
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE
from tribodyn.record.sweep_writer import SweepWriter

SAMPLES = 30


class Disk:
    """Takes so many bytes in all, and no more."""

    def __init__(self, room: int) -> None:
        self.room = room
        self.full = False

    def opened(self, function):
        def opened(path):
            return Stream(function(path), self)

        return opened


class Stream:
    """A file on such a disk."""

    def __init__(self, stream, on: Disk) -> None:
        self._stream, self._on = stream, on

    def __getattr__(self, name: str):
        return getattr(self._stream, name)

    def __enter__(self):
        return self

    def __exit__(self, *_: object) -> None:
        self._stream.close()

    def write(self, content) -> int:
        taken = bytes(content)[: self._on.room]
        self._stream.write(taken)
        self._on.room -= len(taken)
        if len(taken) < len(content):
            self._on.full = True
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return len(taken)


def on_a_disk(room: int, monkeypatch: pytest.MonkeyPatch) -> Disk:
    small = Disk(room)
    for name in ("open_new", "open_existing"):
        monkeypatch.setattr(disk, name, small.opened(getattr(disk, name)))
    return small


def record(path: Path, fails: bool = False) -> None:
    head = {"outlines": geometry(), "scenario_toml": "title = 1\n", "sha256": "0"}
    with gear_pair_writer(path, SAMPLES, **head) as writer:
        writer.write(0, block(0, 20))
        if fails:
            writer.fail("stopped", {})
        else:
            writer.write(20, block(20, SAMPLES))
            writer.finish({"efficiency": 0.98})


def failed_record(path: Path) -> None:
    record(path, fails=True)


def bytes_of(work, folder: Path, monkeypatch: pytest.MonkeyPatch) -> int:
    """What a work writes in all."""
    folder.mkdir()
    with monkeypatch.context() as patch:
        whole = on_a_disk(10**9, patch)
        work(folder / "run.h5")
    return 10**9 - whole.room


#: Into how many parts a record is cut: places at which the disk is full.
PARTS = pytest.mark.parametrize("parts", all_in_soak([4, 400], [4]))


@PARTS
@pytest.mark.parametrize("work", [record, failed_record])
def test_a_run_keeps_what_it_has(work, parts: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    total = bytes_of(work, tmp_path / "whole", monkeypatch)
    for room in sorted({*range(0, total, total // parts), *range(total - 9, total, 2)}):
        folder = tmp_path / str(room)
        folder.mkdir()
        with monkeypatch.context() as patch:
            on_a_disk(room, patch)
            with pytest.raises(OutputError, match="No space left on device") as error:
                work(folder / "run.h5")
        assert {path.name for path in folder.iterdir()} <= {"run.partial.h5"}, room
        if error.value.kept:
            with Record(folder / "run.partial.h5") as left:
                count = left.samples
                assert f"first {count} of {SAMPLES}" in error.value.kept or count == SAMPLES
                np.testing.assert_array_equal(left["normal_load"], block(0, SAMPLES)["normal_load"][:count])
        else:
            assert not list(folder.iterdir())


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EIO])
def test_a_finished_record_that_cannot_get_its_name_is_kept(tmp_path: Path, monkeypatch, number: int):
    original = os.replace

    def replace(source, target):
        if str(target).endswith("run.h5"):
            raise OSError(number, os.strerror(number))
        original(source, target)

    monkeypatch.setattr(cache.os, "replace", replace)
    with pytest.raises(OutputError, match=r"all samples, without a summary: .*run\.partial\.h5"):
        record(tmp_path / "run.h5")
    assert [path.name for path in tmp_path.iterdir()] == ["run.partial.h5"]
    with Record(tmp_path / "run.partial.h5") as left:
        assert (left.status, left.samples) == ("partial", SAMPLES)


@PARTS
def test_a_sweep_goes_on_when_there_is_room_again(
    parts: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    total = bytes_of(sweep_record, tmp_path / "whole", monkeypatch)
    for room in sorted({*range(0, total, total // parts), *range(total - 9, total, 2)}):
        folder = tmp_path / str(room)
        folder.mkdir()
        with monkeypatch.context() as patch:
            on_a_disk(room, patch)
            with pytest.raises(OutputError, match="No space left on device"):
                sweep_record(folder / "run.h5")
        left = [path.name for path in folder.iterdir()]
        assert left in ([], ["run.partial.h5"])
        if left:
            with SweepRecord(folder / left[0]) as found:
                assert sum(found.count()[name] for name in ("done", "waiting")) == 3
                # of a case that still waits, half of it may be written
                assert set(found["message"][found["status"] == DONE]) <= {"ä"}
        sweep_record(folder / "run.h5", resume=True)
        assert differences(folder / "run.h5", tmp_path / "whole" / "run.h5") == []


def test_what_waits_holds_no_foreign_memory(tmp_path: Path):
    with SweepWriter(tmp_path / "run.h5", SWEEP_HEAD):
        pass
    with h5py.File(tmp_path / "run.partial.h5") as file:
        assert set(file["message"][...]) == {b""}  # pyright: ignore[reportIndexIssue, reportArgumentType]
        assert set(file["status"][...]) == {0}  # pyright: ignore[reportIndexIssue, reportArgumentType]


@pytest.mark.skipif(os.name == "nt", reason="limits of POSIX")
@pytest.mark.parametrize("blocks", all_in_soak([1, 200], [200]))
def test_the_command_ends_with_one_message_and_status_3(blocks: int, tmp_path: Path):
    """A limit to the size of files, which the system reports like a full disk."""
    command = f"ulimit -f {blocks}; exec {sys.executable} -m tribodyn run crc-23-47 --no-plot -o run.h5"
    ended = subprocess.run(["sh", "-c", command], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ended.returncode == 3, ended.stderr
    assert len(ended.stderr.splitlines()) == 1
    assert "run.h5: cannot be written: File too large" in ended.stderr
    assert not list(tmp_path.glob("*.tmp"))


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="a device of Linux")
def test_standard_output_on_a_full_disk_is_no_bug(tmp_path: Path):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "tribodyn", "list", "--json"]
        streams = {"stdout": full, "stderr": subprocess.PIPE}
        ended = subprocess.run(command, cwd=tmp_path, text=True, check=False, **streams)
    assert (ended.returncode, ended.stderr) == (3, "the output: cannot be written: No space left on device\n")
