"""Whether an HDF5 file from anywhere can be read safely: looked through by a child process with a time limit.

HDF5 follows what a file says: into other files, around in circles, to sizes that no memory has, and now and
then it crashes. So a file that this process has not written is first read in a child process.

The child is a copy of this process where that is safe: 0.02 s for every record that is read, where a new
process needs 0.2 s to import h5py. Otherwise, as in a notebook, whose threads a copy would not have, it is a
copy of a process that is kept for this: only the first call waits for imports. Where the system copies no
processes, that process calls the function itself.
"""

import atexit
import math
import os
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from traceback import walk_tb
from typing import Any

import h5py

from tribodyn.errors import InputError, no_descriptors
from tribodyn.numerics.processes import child

#: Seconds that a look through a file may take, also where other work keeps the processor busy.
TIME_LIMIT = 20.0
#: Seconds of the processor, and bytes of the file for each further one. A record of 1 GB takes milliseconds,
#: its data are not read; those of one that somebody has compressed are.
PROCESSOR_LIMIT, BYTES_A_SECOND = 1.5, 5e7
#: Seconds more where a process has to be started: a slow machine needs some time to import h5py.
START_LIMIT = 40.0
#: Characters of what is said of a file.
_LONGEST = 4096

Look = Callable[[Path], str]

CRASHED = "HDF5 crashes on it"


def through_a_child(look: Look, path: Path) -> str:
    """Call a function at module level of a path in a child process.

    Returns what it says is wrong with the file, "" where nothing is, or that it hung or crashed.
    """
    return forked(look, path) if child.copies_are_safe() else _kept(look).answer(path)


def forked(look: Look, path: Path) -> str:
    """Call it in a copy of this process."""
    try:
        processor = PROCESSOR_LIMIT + path.stat().st_size / BYTES_A_SECOND
        reply = child.in_a_copy(lambda: look(path)[:_LONGEST].encode(errors="replace"), TIME_LIMIT, processor)
    except TimeoutError as error:
        return f"reading it {error}"
    except ChildProcessError:
        return CRASHED
    return reply.decode()


class _Kept:
    """A process that calls a function in copies of itself; it ends with this one."""

    def __init__(self, look: Look) -> None:
        self.owner = os.getpid()
        self._lock = threading.Lock()
        self._process = child.start(f"{__name__}:serve", look.__module__, look.__name__)
        atexit.register(self.end)  # it would end by itself, but with a warning of Python's

    def alive(self) -> bool:
        return self._process.poll() is None

    def end(self) -> None:
        """End it, if it is this process's own."""
        if self.owner == os.getpid():
            child.end(self._process)
            return
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()

    def answer(self, path: Path) -> str:
        """What the function says of a file."""
        limit = START_LIMIT + TIME_LIMIT
        with self._lock:
            try:
                child.tell(self._process, os.fsencode(path.absolute()).hex().encode() + b"\n")
                line = child.answer(self._process, limit, line=True)
            except BaseException as error:  # the answer to this would be taken for one to the next
                self.end()
                if isinstance(error, TimeoutError):
                    return f"reading it did not end within {limit:g} s"
                if isinstance(error, (OSError, ValueError)):  # it has ended
                    return CRASHED
                raise
            if not line.endswith(b"\n"):
                self.end()
                return CRASHED
        return bytes.fromhex(line.decode()).decode(errors="replace")


_processes: dict[Look, _Kept] = {}
_starting = threading.Lock()


def _kept(look: Look) -> _Kept:
    """The process that is kept for a function; another one if it ended or belongs to who forked this one."""
    with _starting:
        process = _processes.get(look)
        if process is None or process.owner != os.getpid() or not process.alive():
            if process is not None:
                process.end()
            process = _processes[look] = _Kept(look)
        return process


def serve(module: str, name: str) -> None:
    """Answer every path on standard input with what a function says of it; both are hexadecimal."""
    look: Look = getattr(import_module(module), name)
    call = forked if hasattr(os, "fork") else lambda look, path: look(path)[:_LONGEST]
    for line in sys.stdin.buffer:
        reply = call(look, Path(os.fsdecode(bytes.fromhex(line.decode()))))
        sys.stdout.buffer.write(reply.encode(errors="replace").hex().encode() + b"\n")
        sys.stdout.buffer.flush()


#: What a damaged file makes h5py and those who read it raise.
UNREADABLE = (OSError, LookupError, RuntimeError, ValueError, TypeError, AttributeError, OverflowError)
#: What else it makes those raise who evaluate what it holds: numbers for texts, tables without their keys.
_MISREAD = (*(error for error in UNREADABLE if error is not OSError), ArithmeticError, AssertionError)
#: Maximum number of items in a group, and of items in all; depth of groups, axes of a dataset, and bytes of
#: an attribute. A record of a search has a dataset per free key, one of a train 45 items per mesh, others a
#: hundred.
MAXIMUM_MEMBERS, MAXIMUM_ITEMS, MAXIMUM_DEPTH, MAXIMUM_AXES, MAXIMUM_ATTRIBUTE = 1000, 5000, 4, 8, 2**26
#: Maximum number of attributes of an item: a summary has 145 for every mesh of a train.
MAXIMUM_ATTRIBUTES = 20_000
#: Maximum ratio of a compressed dataset's size to its bytes in the file, and bytes that need none; largest
#: part that is read at once.
MAXIMUM_RATIO, SMALL, MAXIMUM_PART = 100, 2**24, 2**26
#: Attributes by which HDF5 connects datasets with their scales; they hold references.
_REFERENCES = {"DIMENSION_LIST", "REFERENCE_LIST"}
#: Mark of a scale as HDF5 writes it, and bytes of its name.
_SCALE, _LONGEST_NAME = b"DIMENSION_SCALE", 1024

_sound: set[tuple[int, ...]] = set()
_own: set[tuple[int, ...]] = set()


def remember_own(path: Path) -> None:
    """Take note that this process has written a file: as long as it stays as it is, it needs no look."""
    with suppress(OSError):
        _own.add(_identity(path))


def blamed(path: Path, error: BaseException | None) -> Exception | None:
    """An error that ends the reading of a file if it is the file's fault.

    It is not if this process has written the file, nor if the error is of a user's own code while the file
    is open, or of the import of a library, as by its settings. With ``TRIBODYN_TRACEBACK=1`` in the
    environment none is: a reader's mistake can be found so.
    """
    if error is None or no_descriptors(error):
        return None
    if not (isinstance(error, _MISREAD) or (isinstance(error, OSError) and error.errno is None)):
        return None
    package = __name__.partition(".")[0]
    names = {str(frame.f_globals.get("__name__")) for frame, _ in walk_tb(error.__traceback__)}
    if package not in {name.partition(".")[0] for name in names} or "importlib._bootstrap" in names:
        return None
    with suppress(OSError):
        if os.environ.get("TRIBODYN_TRACEBACK") or _identity(path) in _own:
            return None
    return error


def reason_of(error: Exception) -> str:
    """What a file's error says, on one line; an exception that says nothing of itself by its name."""
    text = " ".join(str(error).split()).strip("'\"")
    plain = isinstance(error, (ValueError, OSError, RuntimeError)) and text
    return text if plain else f"{type(error).__name__}: {text}".rstrip(": ")


def check_sound(path: Path) -> None:
    """Look through a file that will be read; raises OSError as from opening it.

    InputError if it cannot be read safely: links to other files, no end of groups, sizes that it lacks.
    """
    if _identity(path) in _own | _sound:
        return
    reason = through_a_child(unsound, path)
    if no_descriptors(failed := OSError(reason)):
        raise failed
    if reason:
        raise InputError("record", str(path), f"damaged: {reason}", "make it anew")
    _sound.add(_identity(path))


def unsound(path: Path) -> str:
    """Why a file cannot be read safely; empty where it can, or where opening it says so."""
    try:
        file = h5py.File(path, "r")
    except (OSError, RuntimeError, ValueError) as error:
        # whoever opens it finds the same, but for want of descriptors
        return str(error) if no_descriptors(error) else ""
    with file:
        try:
            _Look(path.stat().st_size).file(file)
        except _Unsound as found:
            return str(found)
        except Exception as error:  # whatever a damaged file makes h5py raise
            return reason_of(error)
    return ""


class _Unsound(Exception):
    """What is wrong with a file."""


class _Look:
    """A walk through a file of some size."""

    def __init__(self, size: int) -> None:
        self._size, self._items = size, 0
        self._groups: set[Any] = set()
        self._scales: set[Any] = set()

    def file(self, file: Any) -> None:
        """Look through a file: its groups first, as HDF5 searches all of them for the name of a scale."""
        datasets: list[tuple[str, h5py.Dataset]] = []
        self._group(file, 0, datasets)
        for name, dataset in datasets:
            self._dataset(name, dataset)

    def _group(self, group: Any, depth: int, datasets: list[tuple[str, h5py.Dataset]]) -> None:
        if (address := _address(group)) in self._groups or depth > MAXIMUM_DEPTH:
            raise _Unsound("its groups have no end")
        self._groups.add(address)
        self._attributes(group)
        if len(group) > MAXIMUM_MEMBERS:
            raise _Unsound(f"a group of {len(group)} items")
        for name in group:
            self._items += 1
            if self._items > MAXIMUM_ITEMS:
                raise _Unsound("it holds too many items")
            if not isinstance(group.get(name, getlink=True), h5py.HardLink):
                raise _Unsound(f"{name!r} is a link to somewhere else")
            item = group[name]
            if isinstance(item, h5py.Group):
                self._group(item, depth + 1, datasets)
            elif isinstance(item, h5py.Dataset):
                datasets.append((name, item))
            else:
                raise _Unsound(f"{name!r} is neither a group nor a dataset")

    def _dataset(self, name: str, dataset: h5py.Dataset) -> None:
        text = dataset.dtype.kind == "S"
        readable = text or dataset.dtype.kind in "fiu"
        if dataset.shape is None or len(dataset.shape) > MAXIMUM_AXES or not readable:
            raise _Unsound(f"{name!r} is of no type that records have")
        if dataset.external or dataset.is_virtual:
            raise _Unsound(f"the data of {name!r} lie in another file")
        size = int(dataset.size or 0) * dataset.dtype.itemsize
        layout = dataset.id.get_create_plist().get_layout()
        if layout == h5py.h5d.CONTIGUOUS and (offset := dataset.id.get_offset()) is not None:
            whole = offset + size <= self._size
        else:
            whole = size <= MAXIMUM_RATIO * dataset.id.get_storage_size() + SMALL
            if whole and layout == h5py.h5d.CHUNKED:
                self._parts(name, dataset)
        if not whole:
            raise _Unsound(f"{name!r} is larger than the file")
        _check_scale(name, dataset)
        self._attributes(dataset)
        if text and str(dataset.attrs.get("units", "1")) != "1":
            raise _Unsound(f"{name!r} is a text and has a unit")
        # what connects datasets with their scales, HDF5 takes on trust
        _ = dataset.is_scale
        for dim in dataset.dims:
            if len(dim) and (address := _address(dim[0])) not in self._scales:
                self._scales.add(address)
                _ = dim[0].name, dim[0].shape

    def _parts(self, name: str, dataset: h5py.Dataset) -> None:
        """Read all parts, one at a time: their index is followed too."""
        if math.prod(dataset.chunks or ()) * dataset.dtype.itemsize > MAXIMUM_PART:
            raise _Unsound(f"a part of {name!r} is too large")
        for part in dataset.iter_chunks():
            dataset[part]

    def _attributes(self, item: Any) -> None:
        if len(item.attrs) > MAXIMUM_ATTRIBUTES:
            raise _Unsound(f"{item.name!r} has {len(item.attrs)} attributes")
        for name in item.attrs:
            if name in _REFERENCES:
                continue
            attribute = item.attrs.get_id(name)
            if attribute.dtype.itemsize * math.prod(attribute.shape or ()) > MAXIMUM_ATTRIBUTE:
                raise _Unsound(f"the attribute {name!r} is too large")
            item.attrs[name]


def _check_scale(name: str, dataset: h5py.Dataset) -> None:
    """Look at the attributes that connect a dataset with scales: HDF5 writes what they hold into its memory.

    It asks neither whether there are as many as axes, nor of what type they are.
    """
    for attribute in ("CLASS", "NAME", *_REFERENCES):
        if attribute not in dataset.attrs:
            continue
        held = dataset.attrs.get_id(attribute)
        kind, shape = held.get_type(), held.shape
        if attribute in _REFERENCES:
            several = attribute == "REFERENCE_LIST"
            number = shape is not None and len(shape) == 1 and (several or shape[0] == len(dataset.shape))
            due = isinstance(kind, h5py.h5t.TypeCompoundID) if several else _is_list_of_references(kind)
            sound = number and due
        else:
            text = isinstance(kind, h5py.h5t.TypeStringID) and not kind.is_variable_str() and shape == ()
            most = len(_SCALE) + 1 if attribute == "CLASS" else _LONGEST_NAME
            sound = text and kind.get_size() <= most
        if not sound:
            raise _Unsound(f"the attribute {attribute!r} of {name!r} is of no type that records have")


def _is_list_of_references(kind: Any) -> bool:
    return isinstance(kind, h5py.h5t.TypeVlenID) and kind.get_super().equal(h5py.h5t.STD_REF_OBJ)


def _address(item: Any) -> int:
    return h5py.h5o.get_info(item.id).addr  # pyright: ignore[reportAttributeAccessIssue]


def _identity(path: Path) -> tuple[int, ...]:
    status = path.stat()
    return status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns
