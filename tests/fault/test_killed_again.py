"""Locks of writers that were killed, one after the other, bar nobody."""

import os
from pathlib import Path

from tribodyn.record.writing_lock import WritingLock, lock_path, refuse_if_written


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
