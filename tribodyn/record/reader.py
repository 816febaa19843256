"""Reads a record: arrays by name, units, scenario, summary, mesh cycle and geometry; or one mesh of it."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import h5py
import numpy as np

from tribodyn.record import schema, trust
from tribodyn.record.layout import counted
from tribodyn.record.open_record import OpenRecord, attributes, stored_name, summary_of_today, todays_name
from tribodyn.record.soundness import UNREADABLE
from tribodyn.record.sweep_schema import SWEEP
from tribodyn.record.withheld_efficiency import withheld

#: No axis reaches so far; differences and squares of what it holds are numbers.
LARGEST = 1e100


#: Group of a record of a train that has a group for every mesh; the same in its summary.
MESHES = "meshes"


class Record(OpenRecord):
    """The record of a run; samples that an unfinished run never wrote are left out everywhere.

    A file that names its meshes makes them a dimension of its record, and bodies another. Of a pair of gears,
    whose only mesh has no name, the dimension of meshes is left out, and motions stand under degrees of
    freedom of pinion and gear.
    """

    def __getitem__(self, name: str) -> np.ndarray:
        """Return one dataset in SI units, first axis time; `pair` and `dof` give the other axes' labels."""
        return self._read(name, slice(self.samples) if todays_name(name, self._names) in self._along else ...)

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the datasets over time, or over what takes its place."""
        yield from self._along

    @cached_property
    def axis(self) -> str:
        """Name of the axis on which the run went on: "time", "phase" in slow rotation, "frequency"."""
        named = self.attrs.get("axis")
        if named:
            return str(named)
        for name in ("time", "phase", "frequency"):  # a record of 0.1.0, which does not say it
            if name in self._file:
                return name
        raise KeyError("axis")

    @cached_property
    def _along(self) -> tuple[str, ...]:
        """The axis, and the datasets along it."""
        names = str(self.attrs["datasets"]).split() if "datasets" in self.attrs else sorted(self._file)
        datasets = [name for name in names if self.axis in self.dims_of(name)[:1]]
        return self.axis, *(todays_name(name, self._names) for name in datasets if name != self.axis)

    @cached_property
    def others(self) -> tuple[str, ...]:
        """The datasets along other axes, such as revolutions."""
        names = str(self.attrs.get("datasets", "")).split()
        return tuple(todays_name(n, self._names) for n in names if self.axis not in self.dims_of(n)[:1])

    @property
    def trust(self) -> str:
        """Whether the result lies within its model, see `record.trust`; "" where nothing was judged."""
        return trust.verdict(self.summary)

    @cached_property
    def kind(self) -> str:
        """Kind of the study; a record of 0.1.0 of an efficiency says so in its scenario only."""
        named = str(self.attrs.get("kind", ""))
        return named if "datasets" in self.attrs else str(self.scenario.get("kind", named))

    @cached_property
    def samples(self) -> int:
        """Number of samples that hold results."""
        return int(self._file["samples_written"][()])

    @cached_property
    def pairs(self) -> tuple[int, ...]:
        """Numbers of the pair slots, in the order of the pair axis; none where elements roll."""
        return self._numbers("pair")

    @cached_property
    def elements(self) -> tuple[int, ...]:
        """Numbers of the rolling elements, in the order of the element axis; none in a gear pair."""
        return self._numbers("element")

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Results of the run; names that hold `/` become nested dictionaries.

        A quantity that is withheld is None, see `record.withheld_efficiency`.
        """
        nested: dict[str, Any] = {}
        for name, value in self._attributes["summary"].items():
            *parents, leaf = name.split("/")
            place = nested
            for parent in parents:
                place = place.setdefault(parent, {})
            place[leaf] = value
        return withheld(summary_of_today(nested, self._file))

    @cached_property
    def mesh_cycle(self) -> dict[str, Any]:
        """The table the run was made from; `tribodyn.mesh.cycle.from_arrays` takes it."""
        return self._group("mesh_cycle")

    @cached_property
    def geometry(self) -> dict[str, Any]:
        """Outlines and path of contact (points, 2), radii and other lengths, m."""
        return self._group("geometry")

    @cached_property
    def _attributes(self) -> dict[str, dict[str, Any]]:
        """Attributes of the groups."""
        return {name: attributes(self._file[name]) for name in self.groups}

    @cached_property
    def groups(self) -> tuple[str, ...]:
        """Names of the groups: "mesh_cycle", "geometry", "summary", as far as there are."""
        return tuple(name for name, item in self._file.items() if isinstance(item, h5py.Group))

    @contextmanager
    def reading(self, name: str) -> Iterator[Any]:  # h5py types no item of a group
        """A group, to be read inside the block; what it lacks there is an InputError of the record."""
        try:
            yield self._file[name]
        except UNREADABLE as error:
            raise self._damaged(error) from error

    @cached_property
    def names_meshes(self) -> bool:
        """Whether the meshes have names, and are a dimension; else there is one, of the bodies' gears."""
        return "mesh" in self

    @cached_property
    def meshes(self) -> tuple[str, ...]:
        """Names of the meshes; "mesh" where they have none."""
        return tuple(map(str, self["mesh"])) if self.names_meshes else ("mesh",)

    @property
    def mesh_summaries(self) -> dict[str, Mapping[str, Any]]:
        """What the summary has of every mesh, by its name."""
        if not self.names_meshes:
            return {self.meshes[0]: self.summary}
        found = self.summary.get(MESHES)
        return {name: found[name] for name in self.meshes if isinstance(found, Mapping) and name in found}

    def of_mesh(self, mesh: str, part: str) -> dict[str, Any]:
        """`mesh_cycle` or `geometry` of a mesh, by its name."""
        return self._group(f"{MESHES}/{mesh}/{part}" if self.names_meshes else part)

    def over_meshes(self, name: str) -> np.ndarray:
        """A dataset (sample, mesh, …); where it has no dimension of meshes that is one."""
        values = self[name]
        return values if "mesh" in self.dims_of(name) else values[:, None]

    def over_bodies(self, name: str) -> np.ndarray:
        """Motion (sample, body) in a coordinate: x, y, z, angle, tilt_x or tilt_y, or a rate.

        Rates are x_rate, y_rate, z_rate and speed. Where the meshes have no names the bodies are pinion and
        gear, and a motor's values are NaN. KeyError where the record does not hold it.
        """
        if "dof" not in self:
            return self[name]
        coordinate = {"angle": "theta", "speed": "theta"}.get(name, name.removesuffix("_rate"))
        moved = self["displacement" if name in (coordinate, "angle") else "velocity"]
        dof = list(self["dof"])
        values = [moved[:, dof.index(f"{coordinate}_{side}")] for side in "pg"]
        further = len(self["body"]) - len(values) if "body" in self else 0
        return np.stack([*values, *[np.full(len(moved), np.nan)] * further], axis=1)

    def _numbers(self, scale: str) -> tuple[int, ...]:
        return tuple(int(number) for number in self._file[scale][...]) if scale in self else ()

    def _group(self, name: str) -> dict[str, Any]:
        """Arrays and numbers of a group; of scales only those that are data themselves."""
        try:
            group = self._file[name]
            items = attributes(group).items()
            numbers = {key: value for key, value in items if not key.endswith("_units")}
            data = {key: item for key, item in group.items() if item.attrs["long_name"] != counted(key)}
            return {**{key: item[...] for key, item in data.items()}, **numbers}
        except (OSError, KeyError, RuntimeError) as error:
            raise self._damaged(error) from error

    def _check(self) -> None:
        if self._file.attrs.get("format") != schema.FORMAT:
            raise self.refused("an HDF5 file, but not a record", "name the record of a run")
        version = int(self.attrs["format_version"])
        if version > schema.FORMAT_VERSION:
            rule = f"its format is version {version}, this program reads up to {schema.FORMAT_VERSION}"
            raise self.refused(rule, f"use tribodyn {self.attrs['tribodyn_version']} or newer")
        schema.require_head(self.attrs)
        if self.attrs.get("kind") == SWEEP:
            raise self.refused("the record of a sweep, not of a run", "show, plot or open it")
        _ = self.axis, self.pairs, self.elements
        for name in str(self.attrs.get("datasets", self.axis)).split():
            if not isinstance(self._file[name], h5py.Dataset):
                raise ValueError(f"{name} is no dataset")
            if "" in self.dims_of(name):
                raise ValueError(f"{name} lacks the scale of an axis")
        if self.samples < 0:
            raise ValueError(f"{self.samples} samples")
        for name in self._along:
            if self._file[stored_name(name, self._names)].shape[0] < self.samples:
                raise ValueError(f"{name} is too short")
        axis = np.asarray(self._file[self.axis][: self.samples])
        if axis.dtype.kind != "f" or not np.all(np.abs(axis) < LARGEST):
            raise ValueError(f"{self.axis} is not a finite number throughout")
        _ = self.summary


#: What only a record of several meshes has.
_OF_SEVERAL = "mesh", "mesh_phase"


class MeshView(Record):
    """A mesh, by its number along the axis of meshes; it shares the open file of its record.

    `pinion_angle` is the nominal rotation of its driver, rad, 0 where a cycle of the mesh begins.
    """

    def __init__(self, record: Record, mesh: int, label: str = "") -> None:
        vars(self).update(vars(record))
        self._mesh, self._phase = mesh, record["mesh_phase"][:, mesh]
        name = record.meshes[mesh]
        self.label = f"{record.label}: {label or name}"
        parts: dict[str, Any] = {part: record.of_mesh(name, part) for part in ("mesh_cycle", "geometry")}
        vars(self).update(parts, groups=tuple(parts), names_meshes=False, meshes=(name,))

    def of_mesh(self, mesh: str, part: str) -> dict[str, Any]:
        """`mesh_cycle` or `geometry`."""
        return getattr(self, part)

    def __getitem__(self, name: str) -> np.ndarray:
        """A dataset of this mesh, without the axis of meshes."""
        if name == "pinion_angle":
            return self._phase * (2 * np.pi / self.mesh_cycle["pinion_teeth"])
        values, dims = super().__getitem__(name), super().dims_of(name)
        return values.take(self._mesh, dims.index("mesh")) if "mesh" in dims else values

    def __contains__(self, name: object) -> bool:
        return name not in _OF_SEVERAL and super().__contains__(name)

    def dims_of(self, name: str) -> tuple[str, ...]:
        """Names of a dataset's dimensions, that of meshes left out."""
        return tuple(dim for dim in super().dims_of(name) if dim != "mesh")


def mesh_views(record: Record) -> dict[str, Record]:
    """A view of every mesh by name; of a record that does not name its meshes the record itself."""
    if not record.names_meshes:
        return {record.meshes[0]: record}
    return {name: MeshView(record, m) for m, name in enumerate(record.meshes)}
