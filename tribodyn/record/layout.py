"""Lays out the HDF5 file of a record, complete but for its samples."""

import importlib.metadata
import re
from collections.abc import Callable, Mapping
from datetime import datetime
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, BinaryIO, NamedTuple

import h5py
import numpy as np

from tribodyn import __version__
from tribodyn.numerics.parameter import Variable
from tribodyn.record import disk, schema
from tribodyn.record.disk import LIBVER, Blank, Layered
from tribodyn.record.schema import Layout
from tribodyn.record.target import SCENARIO_FILE, Origin
from tribodyn.record.withheld_efficiency import withheld

#: Libraries whose versions are recorded, because results depend on them.
LIBRARIES = ("numpy", "scipy", "numba", "jax", "diffrax", "h5py")


class Head(NamedTuple):
    """What is known of a run before it starts."""

    kind: str  # kind of study
    layout: Layout  # what the records of the study hold
    #: scenario, sha256: the resolved scenario as TOML, and its digest
    scenario: str
    sha256: str
    created: datetime
    #: name of a group of the layout -> arrays and numbers by name: the mesh cycle, outlines
    groups: Mapping[str, Mapping[str, Any]] = MappingProxyType({})
    scales: Mapping[str, Any] = MappingProxyType({})  # values along the axes other than the run's own
    code: str = ""  # see `schema.CODE`; empty: nothing goes on with such a record
    scenario_file: str = ""  # see `previous.Origin`

    @property
    def origin(self) -> Origin:
        """What the record is made from."""
        return Origin(self.kind, self.scenario_file)


class DataPlace(NamedTuple):
    """Where a dataset's bytes lie in the file: offset of the first row, bytes per row, shape of a row."""

    offset: int
    stride: int
    row: tuple[int, ...]


class LaidOut(NamedTuple):
    """A file that is laid out and not yet written."""

    content: Layered  # all but what the datasets hold
    blanks: list[Blank]  # that
    places: dict[str, DataPlace]  # where each dataset lies


def create(head: Head, samples: int) -> LaidOut:
    """Lay out the file with room for `samples` samples."""
    layout, axis = head.layout, head.layout.axis_name
    content = Layered()
    with h5py.File(content, "w", libver=LIBVER) as file:
        write_head(file, head.origin, head.scenario, head.sha256, head.created, head.code)
        size = {axis: samples, **{name: len(values) for name, values in head.scales.items()}}
        datasets = {axis: reserve(file, axis, layout.axis, (samples,))}
        datasets[axis].make_scale(axis)
        scales = {axis: datasets[axis]}
        for name, values in head.scales.items():
            scales[name] = scale(file, name, layout.scales[name], values)
        for name, variable in (*layout.samples.items(), *layout.others.items()):
            if all(dim in size for dim in variable.dims):
                datasets[name] = reserve(file, name, variable, tuple(size[dim] for dim in variable.dims))
                attach(datasets[name], variable, scales)
        file.attrs["axis"] = axis
        # words, not an array of texts: Octave stops reading at those
        file.attrs["datasets"] = " ".join(datasets)
        for name in schema.ANGLES.keys() & datasets.keys():
            file[schema.ANGLES[name]] = datasets[name]
        datasets["samples_written"] = reserve(file, "samples_written", schema.SAMPLES_WRITTEN, ())
        for name, table in layout.groups.items():
            _write_arrays(file.create_group(name), table, head.groups.get(name, {}), scales)
        file.create_group("summary")
        places = {name: place_of(dataset) for name, dataset in datasets.items()}
        variables = {**layout.along, **layout.others, "samples_written": schema.SAMPLES_WRITTEN}
        blanks = [blank_of(dataset, variables[name]) for name, dataset in datasets.items()]
    return LaidOut(content, blanks, places)


def write_trimmed(
    head: Head,
    samples: int,
    source: tuple[BinaryIO, Mapping[str, DataPlace]],
    scratch: Path,
    change: Callable[[h5py.File], None],
) -> None:
    """Write a record anew with the first of its samples.

    `source` is what was written and where its datasets lie; `change` concludes it.
    """
    trimmed = create(head, samples)
    disk.amend(trimmed.content, change)
    disk.write_new(scratch, trimmed.content, trimmed.blanks)
    file, places = source
    with disk.open_existing(scratch) as target:
        for blank, (name, place) in zip(trimmed.blanks, trimmed.places.items(), strict=True):
            disk.copy(file, places[name].offset, target, place.offset, blank.size)


def write_summary(file: h5py.File, summary: Mapping[str, Any], prefix: str = "") -> None:
    """Put a summary into the group's attributes, nested names joined by `/`, None left out."""
    for name, value in withheld(summary).items():
        if isinstance(value, Mapping):
            write_summary(file, value, f"{prefix}{name}/")
        elif value is not None:
            file["summary"].attrs[f"{prefix}{name}"] = value


def encode(variable: Variable, values: Any) -> np.ndarray:
    """Turn `values` into what the file holds: NaN of flags into "nothing written", texts cut to the room."""
    kind, values = np.dtype(variable.dtype), np.asarray(values)
    if kind.kind == "S" and values.dtype.kind in "OU":
        texts = [_cut(str(value), kind.itemsize) for value in values.flat]
        return np.array(texts, kind).reshape(values.shape)
    if variable.flags and values.dtype.kind == "f":
        values = np.where(np.isnan(values), variable.fill, values)
    return values.astype(kind)


def _cut(text: str, room: int) -> bytes:
    """Bytes of a text, cut at a whole character."""
    raw = text.encode()
    return raw if len(raw) <= room else raw[: room - 3].decode(errors="ignore").encode() + "…".encode()


def write_head(
    file: h5py.File, origin: Origin, scenario: str, sha256: str, created: datetime, code: str = ""
) -> None:
    """Write the root's attributes, status `partial`."""
    file.attrs["Conventions"] = "CF-1.10"
    file.attrs["format"] = schema.FORMAT
    file.attrs["format_version"] = schema.FORMAT_VERSION
    file.attrs["kind"] = origin.kind
    if origin.file:
        file.attrs[SCENARIO_FILE] = origin.file
    file.attrs["tribodyn_version"] = __version__
    file.attrs["created"] = created.isoformat(timespec="seconds")
    file.attrs["scenario"] = scenario
    file.attrs["scenario_sha256"] = sha256
    if code:
        file.attrs[schema.CODE] = code
    file.attrs["status"] = schema.PARTIAL
    file.attrs["message"] = schema.STATUS_NOTES[schema.PARTIAL]
    for library in LIBRARIES:
        file.attrs[f"{library}_version"] = _version(library)


@cache
def _version(library: str) -> str:
    """Version by the head of what the installer wrote: to parse all of it takes ten times as long."""
    head = importlib.metadata.distribution(library).read_text("METADATA") or ""
    named = re.search("^Version: *(.+)$", head, re.MULTILINE)
    return named[1] if named else importlib.metadata.version(library)


def reserve(file: h5py.File, name: str, variable: Variable, shape: tuple[int, ...]) -> h5py.Dataset:
    """Create a dataset for which there is nothing to write yet.

    It is contiguous, with an address in the file from the start; its bytes are not written here: `blank_of`.
    """
    plan = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    plan.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
    plan.set_fill_time(h5py.h5d.FILL_TIME_NEVER)
    if np.dtype(variable.dtype).kind != "S":  # h5py takes other memory for a text's; HDF5's own is empty
        plan.set_fill_value(np.array(variable.fill, dtype=variable.dtype))
    space = h5py.h5s.create_simple(shape) if shape else h5py.h5s.create(h5py.h5s.SCALAR)
    kind = h5py.h5t.py_create(np.dtype(variable.dtype))
    # at the low level, because create_dataset drops the plan where the dataset is a scalar
    dataset = h5py.Dataset(h5py.h5d.create(file.id, name.encode(), kind, space, plan))
    describe(dataset, variable)
    if variable.flags:
        first = int(variable.fill)
        meanings = variable.flags.split()
        dataset.attrs["flag_values"] = np.arange(first, first + len(meanings), dtype=variable.dtype)
        dataset.attrs["flag_meanings"] = variable.flags
    return dataset


def blank_of(dataset: h5py.Dataset, variable: Variable) -> Blank:
    """The bytes of a dataset that holds nothing: what stands for "nothing written"."""
    offset, value = place_of(dataset).offset, np.array(variable.fill, dtype=variable.dtype).tobytes()
    return Blank(offset, dataset.dtype.itemsize * int(dataset.size or 0), value)


def place_of(dataset: h5py.Dataset, dims: int = 1) -> DataPlace:
    """Say where a dataset's bytes lie, whose rows are counted by so many dimensions."""
    row = dataset.shape[dims:]
    stride = dataset.dtype.itemsize * int(np.prod(row, dtype=int))
    offset = dataset.id.get_offset()
    if offset is None and dataset.size:
        raise OSError(f"HDF5 gave {dataset.name} no place in the file")
    return DataPlace(offset or 0, stride, row)


def describe(dataset: h5py.Dataset, variable: Variable) -> None:
    """Give a dataset its unit and meaning."""
    dataset.attrs["units"] = variable.units
    dataset.attrs["long_name"] = variable.long_name


def scale(group: h5py.Group, name: str, variable: Variable, values: Any) -> h5py.Dataset:
    """Write a dimension scale, and return it."""
    array = np.asarray(values)
    text = array.dtype.kind == "U"
    # of fixed length, because Octave stops reading at other strings; the attribute makes xarray decode
    dataset = group.create_dataset(name, data=np.char.encode(array, "utf-8") if text else array)
    if text:
        dataset.attrs["_Encoding"] = "utf-8"
    describe(dataset, variable)
    dataset.make_scale(name)
    return dataset


def attach(dataset: Any, variable: Variable, scales: Mapping[str, h5py.Dataset]) -> None:
    """Attach to every axis of a dataset its scale."""
    for axis, dim in enumerate(variable.dims):
        dataset.dims[axis].attach_scale(scales[dim])


def counted(name: str) -> str:
    """What the scale of a dimension that only counts says of itself: such a scale is no data."""
    return f"number of the {name.replace('_', ' ')}"


def _write_arrays(
    group: h5py.Group,
    table: Mapping[str, Variable],
    values: Mapping[str, Any],
    scales: Mapping[str, h5py.Dataset],
) -> None:
    """Arrays of `table` become datasets with the group's scales or the root's, numbers attributes."""
    arrays = {}
    for name, value in values.items():
        if name in table and table[name].dims:
            arrays[name] = np.asarray(value, dtype="<f8")
            continue
        group.attrs[name] = value
        if name in table:
            group.attrs[f"{name}_units"] = table[name].units
    scales = dict(scales)
    written = {}
    for name, variable in table.items():
        if name in arrays:
            written[name] = group.create_dataset(name, data=arrays[name])
            describe(written[name], variable)
            if variable.dims == (name,):
                written[name].make_scale(name)
                scales[name] = written[name]
    for name, variable in table.items():
        if name not in arrays or variable.dims == (name,):
            continue
        for dim, length in zip(variable.dims, arrays[name].shape, strict=True):
            if dim not in scales:
                scales[dim] = scale(group, dim, Variable((dim,), "1", counted(dim)), np.arange(length))
        attach(written[name], variable, scales)
