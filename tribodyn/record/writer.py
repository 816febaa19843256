"""Writes a record while the run goes on, so that it is a valid file whenever the process dies.

The whole file is laid out and closed before the first sample: every dataset at full length, contiguous,
filled with NaN, the status `partial`. From then on the HDF5 library has no file open and no state to lose;
a block of samples is plain bytes put in their place in the file, and the count `samples_written` follows
last. What ends the run (summary, status) goes into a copy that replaces the record in one rename.
"""

import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5py
import numpy as np

from tribodyn.errors import InputError, OutputError
from tribodyn.numerics.files.output_files import replacing, unwritable
from tribodyn.record import disk, trust
from tribodyn.record.layout import Head, create, encode, write_summary, write_trimmed
from tribodyn.record.schema import COMPLETE, FAILED, STATUS_NOTES, partial_path
from tribodyn.record.soundness import remember_own
from tribodyn.record.target import (
    Origin,
    keep_previous,
    locked,
    refuse_existing,
    refuse_if_written,
    scratch_path,
)
from tribodyn.record.withheld_efficiency import samples_withheld

Beside = Callable[[h5py.File], None]
"""Adds groups to a record as it ends."""


def nothing(file: h5py.File) -> None:
    """Nothing is added."""


def check_target(path: Path, force: bool = False, origin: Origin = Origin()) -> None:
    """Whether a record may be written to `path`; touches nothing, so it can be called before any work.

    Raises InputError if the folder is missing or unwritable, if another process is writing that record, or as
    `previous.refuse_existing`.
    """
    path = Path(path)
    folder = path.parent
    if not os.path.isdir(folder):
        raise InputError("output", str(path), "the folder does not exist", f"create {folder} first")
    if os.path.isdir(path):
        raise InputError("output", str(path), "is a folder", "name a file in it")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise InputError(
            "output", str(path), "the folder cannot be written to", "choose another with --output"
        )
    refuse_if_written(path)
    refuse_existing(path, force, origin)


class RecordWriter:
    """Streams samples into `<name>.partial.h5`, which becomes `<name>.h5` when the run is complete.

    A context manager, which begins the file: leaving it without `finish` marks the record failed and keeps
    what was written. A complete run has so many `samples`; with `force` an existing record, and the remains
    of an unfinished run, are replaced; without it those from the same scenario file, see `previous`.

    Raises InputError as `check_target`, and where the file system refuses the file or has no room for it.
    """

    def __init__(self, path: str | Path, head: Head, samples: int, *, force: bool = False) -> None:
        self.path = Path(path)
        self.partial = partial_path(self.path)
        self.samples = samples
        self.written = 0
        self._open = False
        self._axis = head.layout.axis_name
        self._variables = {**head.layout.along, **head.layout.others}
        self._head = head
        self._force = force
        check_target(self.path, force, head.origin)

    def __enter__(self) -> Self:
        created = False
        try:
            with locked(self.path) as self._lock:
                refuse_existing(self.path, self._force, self._head.origin)  # another may just have ended
                blank = create(self._head, self.samples)
                self._place = blank.places
                with replacing(self.partial, scratch_path(self.path)) as scratch:
                    disk.write_new(scratch, blank.content, blank.blanks)
                    created = True
                self._file, self._open = disk.open_existing(self.partial), True
            return self
        except KeyboardInterrupt:
            if self._open:
                self._close()
            if created:  # there is nothing in it
                self.partial.unlink(missing_ok=True)
                self._lock.release()
            raise

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if isinstance(error, KeyboardInterrupt):
                if self._open or not getattr(error, "__notes__", ()):
                    complete = not self.partial.exists()
                    error.add_note(f"the record is complete: {self.path}" if complete else self._so_far())
                if self._open:
                    self.fail(str(error) or "interrupted by the user")
            elif self._open and isinstance(error, OutputError):
                with suppress(OutputError):  # there is no room for saying it in the file either
                    self.fail(str(error))
                    error.kept = error.kept or self._so_far()
            elif self._open:
                self.fail(f"{kind.__name__}: {error}" if kind else "the run ended without a summary")
        finally:
            self._lock.release()

    def write(self, start: int, block: Mapping[str, Any]) -> None:
        """Put samples `start`, `start + 1`, … in their place; blocks follow each other without a gap.

        The block has arrays (its samples, …) in SI units for any of the record's datasets along `time` (or
        the axis that takes its place), itself included; one that no block names stays NaN. Flags take
        booleans, NaN standing for "nothing to say". Raises KeyError or ValueError for a name that the schema
        does not know or a shape that does not fit: errors of the program.
        """
        length = len(block[self._axis])
        if start != self.written or start + length > self.samples:
            raise ValueError(
                f"block {start}…{start + length} does not follow {self.written} of {self.samples}"
            )
        pieces = [self._piece(name, values, start, (length,)) for name, values in block.items()]
        # last, so that whatever moment the process dies at, the count covers only what is there
        pieces.append((self._place["samples_written"].offset, np.array(start + length, dtype="<i8")))
        self._put_all(pieces)
        self.written = start + length

    def put(self, row: int, values: Mapping[str, Any]) -> None:
        """Put one row into datasets that lie along other axes (`schema.Layout.others`); raises as `write`."""
        self._put_all([self._piece(name, value, row) for name, value in values.items()])

    def _piece(self, name: str, values: Any, row: int, rows: tuple[int, ...] = ()) -> tuple[int, np.ndarray]:
        """Where the values of a row, or of several from it on, go in the file, and what the file holds."""
        place = self._place[name]
        array = encode(self._variables[name], samples_withheld(name, values))
        if array.shape != (*rows, *place.row):
            raise ValueError(f"{name}: shape {array.shape}, not {(*rows, *place.row)}")
        return place.offset + row * place.stride, array

    def finish(self, summary: Mapping[str, Any], trim: bool = False, beside: Beside = nothing) -> Path:
        """Add the summary, mark the record complete and give it its final name, which is returned.

        With `trim` it may have fewer samples than it has room for; `beside` adds what came of the whole run.
        Raises ValueError if samples are missing, OutputError if there is no room for the copy with the
        summary: the samples are kept under the temporary name.
        """
        if self.written != self.samples and not trim:
            raise ValueError(f"{self.written} of {self.samples} samples written")
        self._close()
        change = partial(conclude, COMPLETE, STATUS_NOTES[COMPLETE], summary, beside=beside)
        try:
            with replacing(self.path, scratch_path(self.path)) as scratch:
                if self.written == self.samples:
                    disk.write_amended(self.partial, scratch, change)
                else:
                    self._write_trimmed(scratch, change)
                if not self._force:
                    keep_previous(self.path, self._head.origin)
            self.partial.unlink()
            remember_own(self.path)
        except OSError as error:
            raise unwritable(self.path, error, f"all samples, without a summary: {self.partial}") from error
        self._lock.release()
        return self.path

    def fail(self, message: str, summary: Mapping[str, Any] | None = None, beside: Beside = nothing) -> Path:
        """Trim the record to what was written and mark it failed; it keeps the name `<name>.partial.h5`.

        The message says when and why the run stopped, the summary what can be said of the part that was done.
        """
        self._close()
        try:
            with replacing(self.partial, scratch_path(self.path)) as scratch:
                self._write_trimmed(scratch, partial(conclude, FAILED, message, summary or {}, beside=beside))
            remember_own(self.partial)
        except OSError as error:
            raise unwritable(self.partial, error, f"{self._so_far()}; {message}") from error
        self._lock.release()
        return self.partial

    def _write_trimmed(self, scratch: Path, change: Callable[[h5py.File], None]) -> None:
        """Write a copy with the samples written, and with what concludes it."""
        with self.partial.open("rb") as source:
            write_trimmed(self._head, self.written, (source, self._place), scratch, change)

    def _so_far(self) -> str:
        return f"the first {self.written} of {self.samples} samples: {self.partial}"

    def _put_all(self, pieces: list[tuple[int, np.ndarray]]) -> None:
        try:
            for offset, array in pieces:
                disk.put(self._file, offset, array.tobytes())
        except OSError as error:
            raise unwritable(self.path, error, self._so_far()) from error

    def _close(self) -> None:
        if not self._open:
            raise ValueError("the record is closed")
        self._file.close()
        self._open = False


def conclude(
    status: str, message: str, summary: Mapping[str, Any], file: h5py.File, beside: Beside = nothing
) -> None:
    """Put into a record what ends it."""
    write_summary(file, summary)
    beside(file)
    file.attrs["status"] = status
    file.attrs["message"] = message
    for name, text in trust.attributes(summary).items():
        file.attrs[name] = text
