"""A record with the samples that were written, and without room for others."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import BinaryIO

import h5py

from tribodyn.record import disk, layout


def write_trimmed(
    head: layout.Head,
    samples: int,
    source: tuple[BinaryIO, Mapping[str, layout.Place]],
    scratch: Path,
    change: Callable[[h5py.File], None],
) -> None:
    """Write a record anew with the first of its samples.

    Parameters
    ----------
    head : Head
        As it was laid out with.
    samples : int
        How many to keep.
    source : (file, places)
        What was written, and where its datasets lie.
    scratch : Path
        To write to.
    change : callable
        Concludes it.
    """
    trimmed = layout.create(head, samples)
    disk.amend(trimmed.content, change)
    disk.write_new(scratch, trimmed.content, trimmed.blanks)
    file, places = source
    with disk.open_existing(scratch) as target:
        for blank, (name, place) in zip(trimmed.blanks, trimmed.places.items(), strict=True):
            _copy(file, places[name].offset, target, place.offset, blank.size)


def _copy(source: BinaryIO, start: int, target: BinaryIO, offset: int, size: int) -> None:
    """Copy bytes from one file's place to another's."""
    source.seek(start)
    target.seek(offset)
    while size:
        rest = memoryview(source.read(min(size, disk.BLOCK)))
        if not rest:
            raise OSError(f"{source.name} ends too early")
        size -= len(rest)
        while rest:
            rest = rest[target.write(rest) :]
