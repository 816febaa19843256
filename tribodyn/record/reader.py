"""Reads a record: arrays by name, units, scenario, summary, mesh cycle and geometry."""

import tomllib
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5py
import numpy as np

from tribodyn.errors import InputError, harmless
from tribodyn.record import schema, trust
from tribodyn.record.layout import counted
from tribodyn.record.soundness import UNREADABLE, blamed, check_sound, reason_of
from tribodyn.record.sweep_schema import SWEEP
from tribodyn.record.withheld import samples_withheld, withheld

#: No axis reaches so far; differences and squares of what it holds are numbers.
LARGEST = 1e100


class Record:
    """A record, open for reading; a context manager.

    Samples that an unfinished run never wrote are left out everywhere.

    Parameters
    ----------
    path : Path
        An HDF5 file that tribodyn wrote.

    Raises
    ------
    InputError
        If the file is missing, damaged, not a record, or of a newer format.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        #: What a legend calls the record: its file's name, unless somebody who has several gives another.
        self.label = harmless(self.path.stem.removesuffix(".partial"))
        self._file: Any = open_file(self.path)  # h5py types no item of a file
        try:
            self._check()
        except InputError:
            self._file.close()
            raise
        except UNREADABLE as error:
            self._file.close()
            raise self._damaged(error) from error

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
        if found := blamed(self.path, error):
            raise self._damaged(found) from found

    def close(self) -> None:
        """Let go of the file."""
        self._file.close()

    def __getitem__(self, name: str) -> np.ndarray:
        """Return one dataset in SI units, first axis time; `pair` and `dof` give the other axes' labels."""
        dataset = self._dataset(name)
        try:
            values = dataset[: self.samples] if name in self._along else dataset[...]
        except (OSError, RuntimeError) as error:
            raise self._damaged(error) from error
        return harmless_texts(values) if values.dtype.kind == "S" else samples_withheld(name, values)

    def __contains__(self, name: object) -> bool:
        return name in self._file and isinstance(self._file[name], h5py.Dataset)

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the datasets over time, or over what takes its place."""
        yield from self._along

    @cached_property
    def axis(self) -> str:
        """Name of the axis on which the run went on: "time", "phase" in slow rotation, "frequency"."""
        said = self.attrs.get("axis")
        if said:
            return str(said)
        for name in ("time", "phase", "frequency"):  # a record of 0.1.0, which does not say it
            if name in self._file:
                return name
        raise KeyError("axis")

    @cached_property
    def _along(self) -> tuple[str, ...]:
        """The axis, and the datasets along it."""
        names = str(self.attrs["datasets"]).split() if "datasets" in self.attrs else sorted(self._file)
        datasets = [name for name in names if self.axis in self.dims_of(name)[:1]]
        return self.axis, *(name for name in datasets if name != self.axis)

    def dims_of(self, name: str) -> tuple[str, ...]:
        """Names of a dataset's dimensions; none of a group, or of a number."""
        if name not in self._known_dims:
            self._known_dims[name] = dims_in(self._file, name, self._scales)
        return self._known_dims[name]

    @cached_property
    def _known_dims(self) -> dict[str, tuple[str, ...]]:
        """Dimensions by dataset: to read them takes longer than to read a short dataset."""
        return {}

    @cached_property
    def _scales(self) -> dict[int, str]:
        """Names of scales, see `dims_in`."""
        return {}

    def units(self, name: str) -> str:
        """Return the SI unit of a dataset."""
        return harmless(str(self._dataset(name).attrs["units"]))

    def long_name(self, name: str) -> str:
        """Return what a dataset means."""
        return harmless(str(self._dataset(name).attrs["long_name"]))

    @property
    def status(self) -> str:
        """`complete`, `partial` (being written, or its process was killed) or `failed`."""
        return str(self.attrs["status"])

    @property
    def message(self) -> str:
        """Why the record is not complete."""
        return str(self.attrs["message"])

    @property
    def trust(self) -> str:
        """Whether the result lies within its model, see `record.trust`; "" where nothing was judged."""
        return trust.verdict(self.summary)

    @cached_property
    def attrs(self) -> dict[str, Any]:
        """Attributes of the file's root."""
        return attributes(self._file)

    @cached_property
    def kind(self) -> str:
        """Kind of the study; a record of 0.1.0 of an efficiency says so in its scenario only."""
        said = str(self.attrs.get("kind", ""))
        return said if "datasets" in self.attrs else str(self.scenario.get("kind", said))

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
    def scenario(self) -> dict[str, Any]:
        """The resolved scenario; InputError where the file's text is no scenario."""
        try:
            return harmless_data(tomllib.loads(str(self.attrs["scenario"])))
        except (KeyError, ValueError, RecursionError) as error:
            raise self._damaged(error) from error

    @cached_property
    def summary(self) -> dict[str, Any]:
        """Results of the run; names that hold `/` become nested dictionaries.

        A figure that is withheld is None, see `record.withheld`.
        """
        nested: dict[str, Any] = {}
        for name, value in self._attributes["summary"].items():
            *parents, leaf = name.split("/")
            place = nested
            for parent in parents:
                place = place.setdefault(parent, {})
            place[leaf] = value
        return withheld(nested)

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

    def _numbers(self, scale: str) -> tuple[int, ...]:
        return tuple(int(number) for number in self._file[scale][...]) if scale in self else ()

    def _group(self, name: str) -> dict[str, Any]:
        """Arrays and numbers of a group; of scales only those that are data themselves."""
        try:
            group = self._file[name]
            own = self._attributes[name].items()
            numbers = {key: value for key, value in own if not key.endswith("_units")}
            data = {key: one for key, one in group.items() if one.attrs["long_name"] != counted(key)}
            return {**{key: one[...] for key, one in data.items()}, **numbers}
        except (OSError, KeyError, RuntimeError) as error:
            raise self._damaged(error) from error

    def _dataset(self, name: str) -> h5py.Dataset:
        if name not in self:
            raise InputError("dataset", name, "no such dataset", f"one of {', '.join(self)}")
        try:
            return self._file[name]
        except (KeyError, RuntimeError) as error:
            raise self._damaged(error) from error

    def _check(self) -> None:
        if self._file.attrs.get("format") != schema.FORMAT:
            raise InputError(
                "record", str(self.path), "an HDF5 file, but not a record", "name the record of a run"
            )
        version = int(self.attrs["format_version"])
        if version > schema.FORMAT_VERSION:
            raise InputError(
                "record",
                str(self.path),
                f"its format is version {version}, this program reads up to {schema.FORMAT_VERSION}",
                f"use tribodyn {self.attrs['tribodyn_version']} or newer",
            )
        schema.require_head(self.attrs)
        if self.attrs.get("kind") == SWEEP:
            raise InputError(
                "record",
                str(self.path),
                "the record of a sweep, not of a run",
                "show, plot or open it",
            )
        _ = self.axis, self.pairs, self.elements
        for name in str(self.attrs.get("datasets", self.axis)).split():
            if not isinstance(self._file[name], h5py.Dataset):
                raise ValueError(f"{name} is no dataset")
            if "" in self.dims_of(name):
                raise ValueError(f"{name} lacks the scale of an axis")
        if self.samples < 0:
            raise ValueError(f"{self.samples} samples")
        for name in self._along:
            if self._file[name].shape[0] < self.samples:
                raise ValueError(f"{name} is too short")
        axis = np.asarray(self._file[self.axis][: self.samples])
        if axis.dtype.kind != "f" or not np.all(np.abs(axis) < LARGEST):
            raise ValueError(f"{self.axis} is not a finite number throughout")
        _ = self.summary

    def _damaged(self, error: Exception) -> InputError:
        rule = f"the record is damaged: {reason_of(error)}"
        return InputError("record", str(self.path), rule, "run the scenario again")


def open_record(path: str | Path) -> Record:
    """Open a record for reading; see `Record`."""
    return Record(path)


def open_file(path: Path) -> h5py.File:
    """Open an HDF5 file for reading; InputError says what hinders it."""
    if not path.is_file():
        raise InputError("record", str(path), "no such file", "name the record of a run")
    try:
        check_sound(path)
        return h5py.File(path, "r")
    except PermissionError as error:
        raise InputError("record", str(path), "may not be read", "change its permissions") from error
    except OSError as error:
        if h5py.is_hdf5(path):
            raise InputError("record", str(path), f"damaged: {error}", "run the scenario again") from error
        raise InputError("record", str(path), "not an HDF5 file", "name the record of a run") from error


def dims_in(file: h5py.File, name: str, scales: dict[int, str]) -> tuple[str, ...]:
    """Names of a dataset's dimensions; none of a group, or of a number.

    `scales` remembers names by the scales' addresses in the file: HDF5 searches the file for each.
    """
    item = file[name]
    if not isinstance(item, h5py.Dataset) or not item.shape:
        return ()
    if item.is_scale:
        return (name,)
    return tuple(_name_of(dim[0], scales) if len(dim) else "" for dim in item.dims)


def _name_of(scale: h5py.Dataset, known: dict[int, str]) -> str:
    address = h5py.h5o.get_info(scale.id).addr  # pyright: ignore[reportAttributeAccessIssue]
    if address not in known:
        known[address] = str(scale.name).rpartition("/")[2]
    return known[address]


def attributes(item: Any) -> dict[str, Any]:
    """Attributes as Python and NumPy values; texts without what a terminal or a picture would obey."""
    return {
        harmless(name): harmless_data(value.item() if isinstance(value, np.generic) else value)
        for name, value in item.attrs.items()
    }


def harmless_texts(values: np.ndarray) -> np.ndarray:
    """Texts of a dataset, decoded."""
    return np.vectorize(harmless, otypes=["U"])(np.char.decode(values, "utf-8", "replace"))


def harmless_data(value: Any) -> Any:
    """Nested data of a record with harmless texts."""
    if isinstance(value, dict):
        return {harmless(name): harmless_data(item) for name, item in value.items()}
    if isinstance(value, list):
        return [harmless_data(item) for item in value]
    return harmless(value) if isinstance(value, str) else value
