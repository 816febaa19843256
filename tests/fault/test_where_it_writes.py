"""Only records are replaced, nothing is written through a link, and what the dead left half written goes."""

import os
from pathlib import Path

import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.record.target import lock_path, scratch_path

PRECIOUS = b"precious"
#: Greater than any number of a process.
NOBODY = 2**31 - 1


def record(path: Path, force: bool = True) -> None:
    head = {"outlines": geometry(), "scenario_toml": "title = 1\n", "sha256": "0"}
    with gear_pair_writer(path, 5, force=force, **head) as writer:
        writer.write(0, block(0, 5))
        writer.finish({})


def test_a_link_to_a_record_may_be_named(tmp_path: Path):
    record(tmp_path / "first.h5")
    content = (tmp_path / "first.h5").read_bytes()
    (tmp_path / "run.h5").symlink_to(tmp_path / "first.h5")
    record(tmp_path / "run.h5")
    with Record(tmp_path / "run.h5") as found:
        assert found.status == "complete"
    assert (tmp_path / "first.h5").read_bytes() == content


@pytest.mark.parametrize("place", [lock_path, scratch_path])
def test_nothing_is_written_through_a_link(place, tmp_path: Path):
    elsewhere = tmp_path / "elsewhere"
    elsewhere.write_bytes(PRECIOUS)
    planted = place(tmp_path / "run.h5")
    planted.symlink_to(elsewhere)
    if place is lock_path:
        with pytest.raises(InputError, match="where the lock of this record would"):
            record(tmp_path / "run.h5")
    else:
        record(tmp_path / "run.h5")
        assert not os.path.lexists(planted)
    assert elsewhere.read_bytes() == PRECIOUS


@pytest.mark.parametrize("content", ["pipe", b"not a number", b"1" * 100])
def test_a_file_that_is_no_lock_is_left_alone(content, tmp_path: Path):
    lock = lock_path(tmp_path / "run.h5")
    if content == "pipe":
        os.mkfifo(lock)
    else:
        lock.write_bytes(content)
    with pytest.raises(InputError, match="where the lock of this record would"):
        record(tmp_path / "run.h5")
    assert content == "pipe" or lock.read_bytes() == content


def test_what_dead_processes_left_half_written_is_removed(tmp_path: Path):
    left = tmp_path / f"run.{NOBODY}.tmp"
    others = [tmp_path / f"run.{os.getppid()}.tmp", tmp_path / f"other.{NOBODY}.tmp", tmp_path / "run.x.tmp"]
    for path in (left, *others):
        path.write_bytes(PRECIOUS)
    record(tmp_path / "run.h5")
    assert not left.exists()
    assert all(path.read_bytes() == PRECIOUS for path in others)
