"""Writes the record of a sweep, case by case in any order, so that it is a valid file at every moment.

As with a run (`writer`), the whole file is laid out before the first case and closed; what a case gives is
bytes put in their place, its `status` last. A sweep that was killed is taken up again by reading `status`.
"""

import math
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple, Self

import h5py
import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.files.output_files import replacing, unwritable
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.numerics.parameter import Variable
from tribodyn.record import disk, layout, sweep_schema
from tribodyn.record.schema import (
    COMPLETE,
    FAILED,
    FORMAT,
    PARTIAL,
    STATUS_NOTES,
    partial_path,
    require_same_code,
)
from tribodyn.record.soundness import UNREADABLE, check_sound, remember_own
from tribodyn.record.sweep_schema import CASE, SWEEP, Listed, SweepLayout, VariedKey
from tribodyn.record.target import Origin, keep_previous, locked, refuse_existing, scratch_path
from tribodyn.record.withheld_efficiency import cases_withheld
from tribodyn.record.writer import check_target, conclude

#: What the root says of a sweep that is not complete.
NOTE = "the sweep is going on, or was stopped: cases whose status is 0 are still to be done"


def values_left(path: str | Path, parameter: str) -> tuple[float, ...]:
    """Values of a parameter in what an unfinished sweep left; none where nothing readable is."""
    try:
        check_sound(partial_path(Path(path)))
        with h5py.File(partial_path(Path(path)), "r") as file:
            return tuple(map(float, file[parameter][...]))  # pyright: ignore
    except (*UNREADABLE, InputError):
        return ()


class SweepHead(NamedTuple):
    """What is known of a sweep before it starts."""

    #: scenario, sha256: the first case's scenario, resolved, and its digest
    scenario: str
    sha256: str
    parameters: tuple[VariedKey, ...]  # in the order of the dimensions
    #: everything else that the results depend on, as TOML: a sweep is taken up only with the same
    settings: str
    directions: tuple[str, ...]  # "up", "down"; none where every case is on its own
    layout: SweepLayout  # what is recorded of every case
    scenario_file: str = ""  # see `previous.Origin`
    #: what is told of every case; where there is anything, the cases stand in a list, in the grid's order
    listed: Mapping[str, Listed] = MappingProxyType({})

    @property
    def origin(self) -> Origin:
        """What the record is made from."""
        return Origin(SWEEP, self.scenario_file)

    @property
    def dims(self) -> tuple[str, ...]:
        """Dimensions of the cases."""
        if self.listed:
            return (CASE,)
        return (*(axis.name for axis in self.parameters), *(("direction",) if self.directions else ()))

    @property
    def shape(self) -> tuple[int, ...]:
        """Their lengths."""
        sizes = [len(parameter.values) for parameter in self.parameters]
        if self.listed:
            return (math.prod(sizes),)
        return (*sizes, len(self.directions)) if self.directions else tuple(sizes)


class SweepWriter:
    """Puts the results of cases into `<name>.partial.h5`, which becomes `<name>.h5` when all are there.

    With `force` an existing record, and what an unfinished sweep left, are replaced; with `resume` that is
    taken up.
    Raises InputError as `writer.check_target`, and where what is left belongs to another sweep.
    """

    def __init__(self, path: str | Path, head: SweepHead, *, force: bool = False, resume: bool = False):
        self.path = Path(path)
        self.partial = partial_path(self.path)
        self._variables = head.layout.variables
        self._kept = Origin() if force else head.origin
        if not (resume and not force and self.partial.exists()):
            check_target(self.path, force, head.origin)
        try:
            with locked(self.path) as self._lock:
                self._places = self._datasets(head, force, resume)
                with h5py.File(self.partial, "r") as file:
                    self.status: np.ndarray = file["status"][...].ravel()  # pyright: ignore
                self._file = disk.open_existing(self.partial)
        except KeyboardInterrupt as error:
            self._say_what_is_kept(error)
            raise

    def _datasets(self, head: SweepHead, force: bool, resume: bool) -> dict[str, layout.DataPlace]:
        """Places of all datasets in what is left, or in a file made anew."""
        if resume and not force and self.partial.exists():
            return _places_of(self.partial, head)
        refuse_existing(self.path, force, head.origin)  # another may just have ended
        blank = _lay_out(head)
        with replacing(self.partial, scratch_path(self.path)) as scratch:
            disk.write_new(scratch, blank.content, blank.blanks)
        return blank.places

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if isinstance(error, KeyboardInterrupt):
            self._say_what_is_kept(error)
        self._file.close()
        self._lock.release()

    def _say_what_is_kept(self, error: KeyboardInterrupt) -> None:
        if self.partial.exists():
            error.add_note(f"the cases done so far: {self.partial}, --resume goes on")

    def write(self, cases: np.ndarray, block: Mapping[str, Any]) -> None:
        """Put results, arrays (n, …) for every dataset of the layout, of cases (n,) in their place.

        The numbers of the cases increase, the last dimension running fastest.
        """
        cases, block = np.asarray(cases), cases_withheld(block)
        runs = np.split(np.arange(len(cases)), np.flatnonzero(np.diff(cases) != 1) + 1)
        for name, variable in self._variables.items():  # status is the last of them
            place = self._places[name]
            values = layout.encode(variable, block[name])
            if values.shape != (len(cases), *place.row):
                raise ValueError(f"{name}: shape {values.shape}, not {(len(cases), *place.row)}")
            try:
                for run in runs:
                    offset = place.offset + int(cases[run[0]]) * place.stride
                    disk.put(self._file, offset, values[run].tobytes())
            except OSError as error:
                kept = f"the cases before: {self.partial}, with more room --resume goes on"
                raise unwritable(self.path, error, kept) from error
        self.status[cases] = block["status"]

    def read(self, name: str, cases: np.ndarray) -> np.ndarray:
        """Give back what was written of some cases, the last run's included."""
        place = self._places[name]
        kind = np.dtype(self._variables[name].dtype)
        rows = []
        for case in cases:
            self._file.seek(place.offset + int(case) * place.stride)
            rows.append(np.frombuffer(self._file.read(place.stride), kind).reshape(place.row))
        return np.array(rows)

    def extend(self, head: SweepHead, rows: np.ndarray, again: np.ndarray) -> None:
        """Give the record more values of its first parameter; what is done moves to its new place.

        Every case is done. `rows` (old values,) are the new numbers of the values that were there, `again`
        (cases,) marks cases, by their new numbers, that wait although they were done.
        """
        blank = _lay_out(head)
        each = int(np.prod(head.shape[1:], dtype=int))
        try:
            with replacing(self.partial, scratch_path(self.path)) as scratch:
                disk.write_new(scratch, blank.content, blank.blanks)
                with disk.open_existing(scratch) as file:
                    for name, place in blank.places.items():
                        old, size = self._places[name], place.stride * each
                        for before, after in enumerate(map(int, rows)):
                            disk.copy(
                                self._file,
                                old.offset + before * size,
                                file,
                                place.offset + after * size,
                                size,
                            )
                    status = blank.places["status"]
                    waiting = np.dtype(self._variables["status"].dtype).type(sweep_schema.WAITING).tobytes()
                    for case in np.flatnonzero(again):
                        disk.put(file, status.offset + int(case) * status.stride, waiting)
                self._file.close()  # a file that is open cannot be replaced everywhere
        except OSError as error:
            kept = f"all cases so far: {self.partial}, with more room --resume goes on"
            raise unwritable(self.path, error, kept) from error
        self._places = blank.places
        status = self.status.reshape(-1, each)
        self.status = np.full((head.shape[0], each), sweep_schema.WAITING, status.dtype)
        self.status[rows] = status
        self.status = np.where(again, sweep_schema.WAITING, self.status.ravel())
        self._file = disk.open_existing(self.partial)

    def finish(self, summary: Mapping[str, Any]) -> Path:
        """Add the summary and give the record its final name; one without a single good case is "failed"."""
        if np.any(self.status == sweep_schema.WAITING):
            raise ValueError(f"{int(np.sum(self.status == sweep_schema.WAITING))} cases are still to be done")
        self._file.close()
        failed = int(np.sum(self.status == sweep_schema.FAILED))
        none = failed == self.status.size
        message = f"{failed} of {self.status.size} cases failed" if failed else STATUS_NOTES[COMPLETE]
        target = self.partial if none else self.path
        try:
            with replacing(target, scratch_path(self.path)) as scratch:
                change = partial(conclude, FAILED if none else COMPLETE, message, summary)
                disk.write_amended(self.partial, scratch, change)
                if not none:
                    keep_previous(self.path, self._kept)
            if not none:
                self.partial.unlink()
            remember_own(target)
        except OSError as error:
            raise unwritable(target, error, f"all cases, without a summary: {self.partial}") from error
        return target


def _lay_out(head: SweepHead) -> layout.LaidOut:
    """Lay out the whole file, every case waiting."""
    content = disk.Layered()
    with h5py.File(content, "w", libver=disk.LIBVER) as file:
        layout.write_head(
            file, head.origin, head.scenario, head.sha256, datetime.now(UTC), computing_digest()
        )
        file.attrs["message"] = NOTE
        file.attrs["sweep"] = head.settings
        for name, value in head.layout.attributes.items():
            file.attrs[name] = value
        scales = _write_scales(file, head)
        places, blanks = {}, []
        for name, variable in head.layout.variables.items():
            full = variable._replace(dims=(*head.dims, *variable.dims))
            if full.units == sweep_schema.FIRST_PARAMETER:
                full = full._replace(units=head.parameters[0].units or "1")
            dataset = layout.reserve(file, name, full, tuple(scales[dim].shape[0] for dim in full.dims))
            layout.attach(dataset, full, scales)
            if dataset.dtype.kind == "S":
                dataset.attrs["_Encoding"] = "utf-8"
            places[name] = layout.place_of(dataset, len(head.dims))
            blanks.append(layout.blank_of(dataset, full))
        file.attrs["datasets"] = " ".join(places)
        if head.listed:
            file.attrs["coordinates"] = " ".join(head.listed)  # xarray takes them for such
            _write_listed(file, head, scales[CASE])
        file.create_group("summary")
    return layout.LaidOut(content, blanks, places)


def _write_scales(file: h5py.File, head: SweepHead) -> dict[str, h5py.Dataset]:
    """Write the scales of all dimensions."""
    scales = {}
    if head.listed:
        numbers = np.arange(head.shape[0])
        scales[CASE] = layout.scale(file, CASE, sweep_schema.CASE_SCALE, numbers)
        scales[CASE].attrs["key"] = CASE
    for parameter in () if head.listed else head.parameters:
        variable = Variable((parameter.name,), parameter.units or "1", f"varied parameter {parameter.key}")
        scales[parameter.name] = layout.scale(file, parameter.name, variable, parameter.values)
        scales[parameter.name].attrs["key"] = parameter.key
    if head.directions:
        scales["direction"] = layout.scale(file, "direction", sweep_schema.DIRECTION, head.directions)
    for name, (variable, values) in head.layout.scales.items():
        scales[name] = layout.scale(file, name, variable, values)
    return scales


def _write_listed(file: h5py.File, head: SweepHead, cases: h5py.Dataset) -> None:
    """Write what is told of every case."""
    for name, (variable, values, key) in head.listed.items():
        array = np.asarray(values)
        text = array.dtype.kind == "U"
        data = np.char.encode(np.char.add(array, ""), "utf-8") if text else array
        dataset = file.create_dataset(
            name, data=data.astype(f"S{max(1, data.dtype.itemsize)}") if text else data
        )
        layout.describe(dataset, variable)
        if text:
            dataset.attrs["_Encoding"] = "utf-8"
        if key:
            dataset.attrs["key"] = key
        dataset.dims[0].attach_scale(cases)


def _places_of(path: Path, head: SweepHead) -> dict[str, layout.DataPlace]:
    """The places in what an unfinished sweep left; InputError if it is damaged, or of something else."""
    other = "move it away, or --force to begin anew"
    try:
        check_sound(path)
        with h5py.File(path, "r") as file:
            if file.attrs.get("format") != FORMAT or file.attrs.get("kind") != SWEEP:
                raise InputError("--resume", str(path), "not what a sweep left", other)
            if file.attrs["status"] != PARTIAL:
                raise InputError("--resume", str(path), f"this sweep {file.attrs['status']}", other)
            if file.attrs["scenario_sha256"] != head.sha256:
                raise InputError("--resume", str(path), "made from another scenario", other)
            if file.attrs["sweep"] != head.settings:
                raise InputError("--resume", str(path), "made with other axes or settings", other)
            require_same_code(file.attrs, path)
            if np.max(file["status"][...], initial=0) > max(sweep_schema.CaseStatus):  # pyright: ignore
                raise ValueError("a case has no known status")
            return {name: _found(file[name], name, head) for name in head.layout.variables}
    except UNREADABLE as error:
        raise InputError("--resume", str(path), f"damaged: {error}", other) from error


def _found(dataset: Any, name: str, head: SweepHead) -> layout.DataPlace:
    """Where a dataset of an unfinished sweep lies; ValueError where it is not as this sweep would make it."""
    variable = head.layout.variables[name]
    inner = tuple(len(head.layout.scales[dim][1]) for dim in variable.dims)
    kind = np.dtype(variable.dtype)
    if dataset.shape != (*head.shape, *inner) or dataset.dtype != kind:
        raise ValueError(f"{name} has another shape or type")
    if dataset.id.get_create_plist().get_layout() != h5py.h5d.CONTIGUOUS or not dataset.id.get_offset():
        raise ValueError(f"{name} has no place of its own")
    return layout.place_of(dataset, len(head.dims))
