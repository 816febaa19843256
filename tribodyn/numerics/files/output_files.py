"""How a file appears: whole or not at all; and files that users asked for beside records.

Pictures, pages, tables, drawings and scenarios are written through no link, and replace only what this
program wrote: every kind of file says near its beginning or its end by whom it was made.
"""

import os
import stat
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from tribodyn.errors import NO_ROOM, InputError, OutputError

#: Ending of a file -> what it holds if this program made it. Scenarios and drives that are written to be
#: edited hold nothing of the kind: only the best scenario of a search is replaced by the next search.
MARKS = {
    ".png": b"tEXtSoftware\0tribodyn",
    ".svg": b"<dc:title>tribodyn</dc:title>",
    ".pdf": b"\n% made by tribodyn\n",
    ".html": b'<meta name="generator" content="tribodyn">',
    ".htm": b'<meta name="generator" content="tribodyn">',
    ".json": b'"generator": "tribodyn"',
    ".toml": b"# The best of the search of tribodyn: ",
    ".csv": b"part,x [mm],y [mm],radius [mm],angle [deg]\n",
    ".dxf": b"\ntribodyn\n",
    ".wav": b"ISFT\x0a\0\0\0tribodyn\0\0",
}
#: The same of files that may hold something else than what stands in `MARKS`, and of all other endings.
WRITTEN = {".csv": b"# written by tribodyn"}
OTHERS = b"written by tribodyn"
#: Bytes at the beginning of a file, or at the end, among which its mark stands.
_NEAR = 1000
#: Flags of files that are not to be reached through a link.
CAREFUL = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)


@contextmanager
def replacing(file: Path, scratch: Path | None = None) -> Iterator[Path]:
    """Write a file under another name and give it its own by renaming, so that no reader sees half of it.

    Yields the path to write to. If that ends with an error, nothing is left behind and `file` is as before.
    `scratch` lies in the same folder; by default it is a name that no other thread or process uses, and the
    folder is made if it is not there.
    """
    if scratch is None:
        file.parent.mkdir(parents=True, exist_ok=True)
        scratch = file.with_name(f"{file.name}.{os.getpid()}-{threading.get_ident()}.tmp")
    try:
        yield scratch
        os.replace(scratch, file)
    except BaseException:
        # a folder that is none has no scratch file either
        if os.path.exists(scratch):
            scratch.unlink()
        raise


def write_output(path: str | Path, content: bytes | str, *, force: bool = False) -> Path:
    """Write a file in a folder that is there, a text as UTF-8, or leave what was there as it is.

    With `force` it replaces also what this program did not write, and a link (not what it leads to). Raises
    InputError as `check_output`, and where the system does not let this user write there; OutputError where
    there is no room.
    """
    path = Path(path)
    check_output(path, force)
    data = content.encode("utf-8", "backslashreplace") if isinstance(content, str) else content
    try:
        scratch = path.with_name(f".tribodyn-{os.getpid()}-{threading.get_ident()}.tmp")
        with replacing(path, scratch):
            with open_new(scratch) as stream:
                stream.write(data)
                stream.flush()
                os.fsync(stream.fileno())
            with suppress(OSError):  # who may read the old one may read the new one, and nobody else
                if stat.S_ISREG(old := path.lstat().st_mode):
                    scratch.chmod(old & 0o777)
    except OSError as error:
        raise unwritable(path, error) from None
    return path


def check_output(path: str | Path, force: bool = False) -> None:
    """Whether a file may be written to `path`; touches nothing, so it can be called before any work.

    Raises InputError if something is there that this program did not make, or that is write-protected, and
    `force` is not given; with it, if that is no file, or a folder.
    """
    path = Path(path)
    try:
        status = path.lstat()
    except OSError:  # it is not there, or whoever writes it finds out why not
        return
    if stat.S_ISLNK(status.st_mode):
        rule, remedy = "is a link", "choose another name, or --force to replace the link"
    elif not stat.S_ISREG(status.st_mode):
        what = "a folder" if stat.S_ISDIR(status.st_mode) else "no file"
        raise InputError("output", str(path), f"is {what}", "choose another name")
    elif not _made_here(path):
        # a scenario may have been edited since
        rule = "the file exists" + ("" if path.suffix == ".toml" else ", and tribodyn did not make it")
        remedy = "choose another name, or --force to replace it"
    elif not os.access(path, os.W_OK):
        rule, remedy = "is write-protected", "choose another name, or --force to replace it"
    else:
        return
    if not force:
        raise InputError("output", str(path), rule, remedy)


def unwritable(path: Path, error: OSError, kept: str = "") -> InputError | OutputError:
    """What is said of a file that the operating system refuses; `kept` says what there is of it."""
    reason = error.strerror or str(error)
    if kept or error.errno in NO_ROOM:
        return OutputError(str(path), reason, kept)
    return InputError("output", str(path), f"cannot be written: {reason}", "choose another name or folder")


def make_folder(folder: Path) -> None:
    """Make a folder, and those above it, unless it is there; raises as `write_output`."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(folder, error) from None


def open_new(path: Path, mode: int = 0o666) -> BinaryIO:
    """Open a file that was not there; what a dead process left under that name goes, no link is followed."""
    with suppress(FileNotFoundError):
        path.unlink()
    return os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | CAREFUL, mode), "wb")


def _made_here(path: Path) -> bool:
    """Whether a regular file has the mark of its kind."""
    ending = path.suffix.lower()
    marks = [marks[ending] for marks in (MARKS, WRITTEN) if ending in marks] or [OTHERS]
    try:
        with path.open("rb") as stream:
            if ending == ".pdf":  # what stands before its end would move its parts
                stream.seek(max(0, stream.seek(0, os.SEEK_END) - _NEAR))
            near = stream.read(_NEAR)
            return any(mark in near for mark in marks)
    except OSError:
        return False
