"""Lays out the HDF5 file of a record, complete but for its samples."""

import importlib.metadata
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np

from tribodyn import __version__
from tribodyn.record import schema
from tribodyn.record.schema import Variable

#: The oldest file format: every HDF5 reader knows it, and nothing in it says whether a writer has it open.
LIBVER = ("earliest", "v108")

#: Libraries whose versions are recorded, because results depend on them.
LIBRARIES = ("numpy", "scipy", "numba", "jax", "diffrax", "h5py")


class Head(NamedTuple):
    """What is known of a run before it starts; `scales` are the values along its other axes, by name."""

    scenario: str
    sha256: str
    created: datetime
    mesh_cycle: dict[str, Any]
    geometry: dict[str, Any]
    kind: str
    scales: dict[str, Any]


class Place(NamedTuple):
    """Where a dataset's bytes lie in the file: offset of the first row, bytes a row, shape of a row."""

    offset: int
    stride: int
    row: tuple[int, ...]


def create(path: Path, head: Head, samples: int) -> dict[str, Place]:
    """Write the file at `path` with room for `samples` samples, and say where each dataset lies."""
    with h5py.File(path, "w", libver=LIBVER) as file:
        write_head(file, head.kind, head.scenario, head.sha256, head.created)
        kind, axis = schema.KINDS[head.kind], schema.axis_name(head.kind)
        datasets = {axis: _empty(file, axis, kind.axis, (samples,))}
        datasets[axis].make_scale(axis)
        for name, values in head.scales.items():
            scale(file, name, kind.scales[name], np.asarray(values))
        size = {axis: samples, **{name: len(values) for name, values in head.scales.items()}}
        for name, variable in (*kind.samples.items(), *kind.others.items()):
            if all(dim in size for dim in variable.dims):
                shape = tuple(size[dim] for dim in variable.dims)
                datasets[name] = _empty(file, name, variable, shape)
                attach(file, file, datasets[name], variable)
        written = _empty(file, "samples_written", schema.SAMPLES_WRITTEN, ())
        _write_arrays(file, file.create_group("mesh_cycle"), schema.MESH_CYCLE, head.mesh_cycle)
        _write_arrays(file, file.create_group("geometry"), schema.GEOMETRY, head.geometry)
        file.create_group("summary")
        places = {name: place_of(dataset) for name, dataset in datasets.items()}
        places["samples_written"] = place_of(written)
    return places


def pair_scales(side: Any) -> dict[str, Any]:
    """Give the scales of a gear pair's dynamics, whose pair slots have these sides."""
    side = np.asarray(side)
    numbers = schema.pair_numbers(int(np.sum(side > 0)), side.size)
    return {"pair": np.array(numbers), "dof": np.array(schema.DOF)}


def write_summary(file: h5py.File, summary: Mapping[str, Any], prefix: str = "") -> None:
    """Put a summary into the group's attributes, nested names joined by `/`, None left out."""
    for name, value in summary.items():
        if isinstance(value, Mapping):
            write_summary(file, value, f"{prefix}{name}/")
        elif value is not None:
            file["summary"].attrs[f"{prefix}{name}"] = value


def encode(name: str, values: Any) -> np.ndarray:
    """Turn `values` into the numbers that the file holds."""
    if name not in schema.FLAGS:
        return np.ascontiguousarray(values, dtype="<f8")
    values = np.asarray(values)
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), schema.NO_CONTACT, values)
    return np.ascontiguousarray(values, dtype="i1")


def write_head(file: h5py.File, kind: str, scenario: str, sha256: str, created: datetime) -> None:
    """Write the root's attributes, status `partial`."""
    file.attrs["Conventions"] = "CF-1.10"
    file.attrs["format"] = schema.FORMAT
    file.attrs["format_version"] = schema.FORMAT_VERSION
    file.attrs["kind"] = kind
    file.attrs["tribodyn_version"] = __version__
    file.attrs["created"] = created.isoformat(timespec="seconds")
    file.attrs["scenario"] = scenario
    file.attrs["scenario_sha256"] = sha256
    file.attrs["status"] = schema.PARTIAL
    file.attrs["message"] = schema.STATUS_NOTES[schema.PARTIAL]
    for library in LIBRARIES:
        file.attrs[f"{library}_version"] = importlib.metadata.version(library)


def _empty(file: h5py.File, name: str, variable: Variable, shape: tuple[int, ...]) -> h5py.Dataset:
    """Create the dataset of a run, filled with what stands for "nothing written"."""
    flag = name in schema.FLAGS
    count = name == "samples_written"
    kind, fill = ("i1", schema.NO_CONTACT) if flag else ("<i8", 0) if count else ("<f8", np.nan)
    dataset = reserve(file, name, variable, shape, kind, fill)
    if flag:
        dataset.attrs["flag_values"] = np.array([-1, 0, 1], dtype="i1")
        dataset.attrs["flag_meanings"] = "out_of_contact_or_none_stated out_of_range in_range"
    return dataset


def reserve(
    file: h5py.File, name: str, variable: Variable, shape: tuple[int, ...], kind: str, fill: Any
) -> h5py.Dataset:
    """Create a contiguous dataset whose bytes are in the file, at an address, from the start."""
    plan = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    plan.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
    plan.set_fill_value(np.array(fill, dtype=kind))
    space = h5py.h5s.create_simple(shape) if shape else h5py.h5s.create(h5py.h5s.SCALAR)
    # at the low level, because create_dataset drops the plan where the dataset is a scalar
    identifier = h5py.h5d.create(file.id, name.encode(), h5py.h5t.py_create(np.dtype(kind)), space, plan)
    dataset = h5py.Dataset(identifier)
    describe(dataset, variable)
    return dataset


def place_of(dataset: h5py.Dataset) -> Place:
    """Say where a dataset's bytes lie."""
    row = dataset.shape[1:]
    stride = dataset.dtype.itemsize * int(np.prod(row, dtype=int))
    offset = dataset.id.get_offset()
    if offset is None and dataset.size:
        raise OSError(f"HDF5 gave {dataset.name} no place in the file")
    return Place(offset or 0, stride, row)


def describe(dataset: h5py.Dataset, variable: Variable) -> None:
    """Give a dataset its unit and meaning."""
    dataset.attrs["units"] = variable.units
    dataset.attrs["long_name"] = variable.long_name


def scale(group: h5py.Group, name: str, variable: Variable, values: np.ndarray) -> None:
    """Write a dimension scale."""
    text = values.dtype.kind == "U"
    # of fixed length, because Octave stops reading at other strings; the attribute makes xarray decode
    dataset = group.create_dataset(name, data=values.astype("S") if text else values)
    if text:
        dataset.attrs["_Encoding"] = "utf-8"
    describe(dataset, variable)
    dataset.make_scale(name)


def attach(file: h5py.File, group: h5py.Group, dataset: Any, variable: Variable) -> None:
    """Attach to every axis of a dataset its scale, out of the group or of the root."""
    for axis, dim in enumerate(variable.dims):
        dataset.dims[axis].attach_scale(group[dim] if dim in group else file[dim])


def _write_arrays(
    file: h5py.File, group: h5py.Group, table: Mapping[str, Variable], values: Mapping[str, Any]
) -> None:
    """Arrays of `table` become datasets with their scales, everything else attributes."""
    for name, value in values.items():
        if name not in table:
            group.attrs[name] = value
            if name in schema.MESH_CYCLE_SCALARS:
                group.attrs[f"{name}_units"] = schema.MESH_CYCLE_SCALARS[name]
    arrays = {name: np.asarray(values[name], dtype="<f8") for name in table if name in values}
    for name, array in arrays.items():
        dataset = group.create_dataset(name, data=array)
        describe(dataset, table[name])
        if table[name].dims == (name,):
            dataset.make_scale(name)
    for name, array in arrays.items():
        for dim, length in zip(table[name].dims, array.shape, strict=True):
            if dim in schema.COUNTED and dim not in group:
                scale(
                    group,
                    dim,
                    Variable((dim,), "1", f"number of the {dim.replace('_', ' ')}"),
                    np.arange(length),
                )
        if table[name].dims != (name,):
            attach(file, group, group[name], table[name])
