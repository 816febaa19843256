"""How the bytes of a record reach the disk: HDF5 lays them out in memory, plain writes put them in the file.

HDF5 that fails to write (a full disk) cannot close its file any more and may end the process. So it never
has one: it works on a `Layered` file, which keeps in memory what is written, and that is put into the file
here, where a full disk is an OSError like any other.
"""

import io
import os
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import BinaryIO, NamedTuple

import h5py

from tribodyn.numerics.files.output_files import CAREFUL, open_new

#: The oldest file format: every HDF5 reader knows it, and nothing in it says whether a writer has it open.
LIBVER = ("earliest", "v108")
#: Bytes written at a time.
BLOCK = 2**20


class Blank(NamedTuple):
    """A stretch of a file that holds one value over and over: offset, bytes, and the bytes of the value."""

    offset: int
    size: int
    value: bytes


class Layered(io.RawIOBase):
    """A file for h5py: reads what is below, or nothing, and keeps in memory what is written."""

    def __init__(self, below: BinaryIO | None = None) -> None:
        self._below = below
        self._place = 0
        self.size = below.seek(0, os.SEEK_END) if below else 0
        #: What was written: (offset, bytes), in order.
        self.written: list[tuple[int, bytes]] = []

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """See io."""
        start = {os.SEEK_SET: 0, os.SEEK_CUR: self._place, os.SEEK_END: self.size}[whence]
        self._place = start + offset
        return self._place

    def truncate(self, size: int | None = None) -> int:
        """See io."""
        self.size = self._place if size is None else size
        return self.size

    def readinto(self, buffer: "memoryview") -> int:  # pyright: ignore[reportIncompatibleMethodOverride]
        """See io; zeros where nothing was written."""
        start, stop = self._place, self._place + len(buffer)
        buffer[:] = bytes(len(buffer))
        if self._below:
            self._below.seek(start)
            underlying = self._below.read(len(buffer))
            buffer[: len(underlying)] = underlying
        for offset, content in self.written:
            first, last = max(start, offset), min(stop, offset + len(content))
            if first < last:
                buffer[first - start : last - start] = content[first - offset : last - offset]
        self._place = stop
        return len(buffer)

    def write(self, content: "memoryview") -> int:  # pyright: ignore[reportIncompatibleMethodOverride]
        """See io."""
        kept = bytes(content)
        self.written.append((self._place, kept))
        self._place += len(kept)
        self.size = max(self.size, self._place)
        return len(kept)


def write_new(path: Path, content: Layered, blanks: Iterable[Blank]) -> None:
    """Write a file that HDF5 has laid out; OSError where the system refuses it."""
    with open_new(path) as stream:
        for blank in sorted(blanks):
            _fill(stream, blank)
        _put(stream, content)


def write_amended(source: Path, path: Path, change: Callable[[h5py.File], None]) -> None:
    """Write a copy of a file in which `change` altered something; OSError where the system refuses it."""
    with source.open("rb") as below, open_new(path) as stream:
        layered = Layered(below)
        amend(layered, change)
        below.seek(0)
        shutil.copyfileobj(below, stream, BLOCK)
        _put(stream, layered)


def amend(content: Layered, change: Callable[[h5py.File], None]) -> None:
    """Let `change` alter a file that is laid out."""
    with h5py.File(content, "r+", libver=LIBVER) as file:
        change(file)


def open_existing(path: Path) -> BinaryIO:
    """Open a file to write into it, unbuffered; OSError where it is a link or no regular file."""
    return os.fdopen(os.open(path, os.O_RDWR | CAREFUL), "r+b", buffering=0)


def put(file: BinaryIO, offset: int, content: bytes) -> None:
    """Write all of some bytes at a place of a file, which may take less at a time if it is unbuffered."""
    file.seek(offset)
    rest = memoryview(content)
    while rest:
        rest = rest[file.write(rest) :]


def copy(source: BinaryIO, start: int, target: BinaryIO, offset: int, size: int) -> None:
    """Copy bytes from one file's place to another's."""
    source.seek(start)
    while size:
        piece = source.read(min(size, BLOCK))
        if not piece:
            raise OSError(f"{source.name} ends too early")
        put(target, offset, piece)
        offset, size = offset + len(piece), size - len(piece)


def _fill(stream: BinaryIO, blank: Blank) -> None:
    stream.seek(blank.offset)
    repeated = blank.value * max(1, BLOCK // len(blank.value))
    whole, rest = divmod(blank.size, len(repeated))
    for _ in range(whole):
        stream.write(repeated)
    stream.write(repeated[:rest])


def _put(stream: BinaryIO, content: Layered) -> None:
    for offset, piece in content.written:
        stream.seek(offset)
        stream.write(piece)
    stream.truncate(content.size)
