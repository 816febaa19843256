"""The cache takes nothing that somebody else could have put there, and closes what it makes to others."""

import os
import stat
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

from tribodyn.numerics.files import cache
from tribodyn.numerics.files.cache import (
    alone,
    arrays_kept_or_made,
    keep,
    kept_or_made,
    read_kept,
    trusted_folder,
)

posix = pytest.mark.skipif(os.name == "nt", reason="permissions of POSIX")
root = pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="only root can give files away")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path / "cache"))
    cache._trusted.cache_clear()
    cache._warn.cache_clear()
    return tmp_path / "cache"


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@posix
def test_what_is_kept_is_closed_to_others_whatever_the_umask(folder: Path):
    before = os.umask(0)
    try:
        keep("things", "one", b"content")
    finally:
        os.umask(before)
    assert read_kept("things", "one") == b"content"
    assert (mode(folder), mode(folder / "things"), mode(folder / "things" / "one")) == (0o700, 0o700, 0o600)
    assert [path.name for path in (folder / "things").iterdir()] == ["one"]


@posix
@pytest.mark.parametrize("open_part", ["", "things"])
def test_a_folder_that_others_can_write_is_not_used_and_that_is_said_once(folder: Path, open_part: str):
    keep("things", "one", b"content")
    (folder / open_part).chmod(0o770)
    cache._trusted.cache_clear()
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        assert read_kept("things", "one") is None
        keep("things", "two", b"more")
        assert read_kept("things", "two") is None
    (warning,) = said
    assert "others can write to the cache" in str(warning.message)
    assert not (folder / "things" / "two").exists()


@posix
def test_a_cache_in_a_folder_that_anybody_can_write_is_not_used(tmp_path: Path, monkeypatch):
    shared = tmp_path / "shared"
    shared.mkdir()
    shared.chmod(0o777)
    monkeypatch.setenv("TRIBODYN_CACHE", str(shared / "cache"))
    with pytest.warns(RuntimeWarning, match="others can replace the cache"):
        assert trusted_folder("things") is None
    shared.chmod(0o1777)  # as /tmp: nobody can remove what others have there
    cache._trusted.cache_clear()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert trusted_folder("things") == shared / "cache" / "things"


@root
@pytest.mark.parametrize("part", ["", "things", "things/one"])
def test_what_belongs_to_somebody_else_is_not_read(folder: Path, part: str):
    keep("things", "one", b"content")
    os.chown(folder / part, 1234, 1234)
    cache._trusted.cache_clear()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        assert read_kept("things", "one") is None


def unlike(whole: bytes) -> dict[str, bytes]:
    """A file of the cache after all that may happen to one."""
    head = whole.index(b"\n") + 1
    cuts = {
        f"cut to {n}": whole[:n] for n in (0, 1, head - 1, head, head + 1, len(whole) // 2, len(whole) - 1)
    }
    turned = {
        f"bit of byte {n}": whole[:n] + bytes([whole[n] ^ 1]) + whole[n + 1 :]
        for n in (0, head - 70, head - 2, head - 1, head, len(whole) // 2, len(whole) - 1)
    }
    return {
        **cuts,
        **turned,
        "zeros": bytes(len(whole)),
        "zeros behind the head": whole[:head] + bytes(len(whole) - head),
        "longer": whole + b"\0",
        "without head": whole[head:],
        "head alone twice": whole[:head] + whole,
        "foreign": b"PK\x03\x04 something else",
    }


def test_whatever_happens_to_a_file_it_is_made_again_and_kept(folder: Path):
    arrays = {"coefficients": np.linspace(-1.0, 2.0, 50).reshape(5, 10), "number": np.asarray(0.25)}
    calls: list[str] = []

    def make():
        calls.append("made")
        return arrays

    def look_up():
        found = arrays_kept_or_made("things", "one", make)
        assert {name: value.tobytes() for name, value in found.items()} == bits
        assert found["coefficients"].shape == (5, 10)

    bits = {name: value.tobytes() for name, value in arrays.items()}
    look_up()
    look_up()
    assert calls == ["made"]
    file = folder / "things" / "one"
    whole = file.read_bytes()
    damaged = unlike(whole)
    # of the right format, with the old digest or none: a table whose coefficients are a hundredfold
    other = whole.replace(arrays["coefficients"].tobytes(), (100.0 * arrays["coefficients"]).tobytes())
    assert other != whole
    damaged["a hundredfold"] = other
    damaged["a hundredfold without digest"] = other[other.index(b"\n") + 1 :]
    arrays_kept_or_made("things", "two", lambda: {"number": np.asarray(1.0)})
    damaged["the file of another key"] = (folder / "things" / "two").read_bytes()
    arrays_kept_or_made("others", "one", make)
    damaged["the same name of another folder"] = (folder / "others" / "one").read_bytes()
    for what, content in damaged.items():
        file.write_bytes(content)
        calls.clear()
        look_up()
        assert calls == ["made"], what
        assert file.read_bytes() == whole, what


@pytest.mark.parametrize("content", [b"", b"no archive"])
def test_a_whole_file_of_another_layout_is_made_again(folder: Path, content: bytes):
    keep("things", "one", content)
    assert kept_or_made("things", "one", lambda found: int(found), lambda: (7, b"7")) == 7
    assert read_kept("things", "one") == b"7"


def test_what_is_not_to_be_kept_is_not_and_what_cannot_be_made_leaves_nothing(folder: Path):
    assert kept_or_made("things", "one", int, lambda: (7, None)) == 7
    with pytest.raises(ZeroDivisionError):
        kept_or_made("things", "two", int, lambda: (1 // 0, b""))
    assert list((folder / "things").iterdir()) == []


@posix
def test_a_process_killed_as_it_writes_leaves_nothing_that_is_read_and_it_is_removed(folder: Path):
    dies = (
        "import os\nfrom tribodyn.numerics.files import cache\n"
        "os.fsync = lambda number: os.kill(os.getpid(), 9)\n"
        "cache.kept_or_made('things', 'one', int, lambda: (1, b'1'))\n"
    )
    ended = subprocess.run([sys.executable, "-c", dies], check=False, capture_output=True)
    assert ended.returncode == -9
    (left,) = (folder / "things").iterdir()
    assert left.suffix == ".tmp"
    assert kept_or_made("things", "one", int, lambda: (7, b"7")) == 7
    assert [file.name for file in (folder / "things").iterdir()] == ["one"]


@posix
@pytest.mark.parametrize(
    "planted", ["pipe", "link to a device", "link to a file", "folder", "open file", "huge"]
)
def test_what_is_no_file_of_the_user_alone_is_not_read(folder: Path, planted: str):
    keep("things", "other", b"content")
    file = folder / "things" / "one"
    if planted == "pipe":
        os.mkfifo(file)
    elif planted == "link to a device":
        file.symlink_to("/dev/zero")
    elif planted == "link to a file":
        file.symlink_to(folder / "things" / "other")
    elif planted == "folder":
        file.mkdir()
    else:
        file.write_bytes(b"content")
        file.chmod(0o666 if planted == "open file" else 0o600)
        if planted == "huge":
            os.truncate(file, cache.MAXIMUM_SIZE + 1)
    assert read_kept("things", "one") is None


@posix
def test_a_link_where_a_file_is_to_be_written_is_not_followed(folder: Path, tmp_path: Path):
    keep("things", "one", b"content")
    target = tmp_path / "target"
    target.write_bytes(b"untouched")
    (folder / "things" / "two").symlink_to(target)
    keep("things", "two", b"new")
    assert target.read_bytes() == b"untouched"
    assert read_kept("things", "two") == b"new"


@posix
def test_a_process_waits_for_another_that_makes_the_same_and_for_no_other(folder: Path, monkeypatch):
    works = (
        "from tribodyn.numerics.files.cache import alone\n"
        "with alone('things', 'one'): print(flush=True); input()"
    )
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen([sys.executable, "-c", works], **pipes) as other:
        assert other.stdout is not None
        other.stdout.readline()
        begun = time.monotonic()
        with alone("things", "two"):
            assert time.monotonic() - begun < cache.LONGEST_WAIT / 2
        monkeypatch.setattr(cache, "LONGEST_WAIT", 0.3)
        begun = time.monotonic()
        with alone("things", "one"):  # for ever nobody waits
            assert time.monotonic() - begun >= 0.3
        monkeypatch.setattr(cache, "LONGEST_WAIT", 60.0)
        other.communicate("\n")
    begun = time.monotonic()
    with alone("things", "one"):
        assert time.monotonic() - begun < cache.LONGEST_WAIT / 2


@posix
@pytest.mark.parametrize("what", ["link", "pipe", "folder"])
def test_a_lock_that_is_none_hinders_nobody(folder: Path, what: str, tmp_path: Path):
    keep("locks", "other", b"content")
    lock = folder / "locks" / "things"
    if what == "link":
        lock.symlink_to(tmp_path / "elsewhere")
    elif what == "pipe":
        os.mkfifo(lock)
    else:
        lock.mkdir()
    begun = time.monotonic()
    with alone("things", "one"):
        assert time.monotonic() - begun < cache.LONGEST_WAIT / 2
    assert not (tmp_path / "elsewhere").exists()
