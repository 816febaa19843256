"""What a record of a run and one of a sweep have in common while they are open."""

import re
import tomllib
from collections.abc import Collection, Mapping
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5py
import numpy as np

from tribodyn.errors import TOO_MANY_FILES, InputError, harmless, no_descriptors
from tribodyn.record import schema
from tribodyn.record.soundness import UNREADABLE, blamed, check_sound, reason_of
from tribodyn.record.withheld_efficiency import samples_withheld

#: Dataset (time, pair) of the deflection along a pair's normal, its older name, and one beside both.
NORMAL, OLDER, BESIDE = "transmission_error_normal", "transmission_error", "transmission_error_rotational"
_SPEEDS = {f"contact_loss_{end}": f"contact_loss_speed_{end}" for end in ("from", "to")}
#: Of an assessment of a train, as of a pair.
_OF_INPUT = {
    "dynamic_factor_max_input_speed": "dynamic_factor_max_speed",
    "contact_loss_input_speed_from": "contact_loss_speed_from",
}
_OF_A_MESH = re.compile(r"(back_)?transmission_error_(rotational_)?(mean|peak_to_peak|max|min)")


def todays_name(name: Any, names: Collection[str]) -> Any:
    """Name of today of a dataset among the names of a file; others as they are."""
    if name not in names and schema.ANGLES.get(name) in names:
        return schema.ANGLES[name]
    return NORMAL if name == OLDER and BESIDE in names else name


def stored_name(name: Any, names: Collection[str]) -> Any:
    """Name among those of a file of a dataset that is asked for by its older name or by that of today."""
    name = todays_name(name, names)
    return OLDER if name == NORMAL and name not in names else name


def summary_of_today(summary: Mapping[str, Any], names: Collection[str]) -> dict[str, Any]:
    """The summary of a record whose file has these names, under the names of today."""
    if OLDER in names and BESIDE in names:
        return _without_normal(summary)
    if "dynamic_factor_max_speed" in summary:  # speeds at which contact is lost, elsewhere frequencies
        return {_SPEEDS.get(name, name): value for name, value in summary.items()}
    return {_OF_INPUT.get(name, name): value for name, value in summary.items()}


def _without_normal(summary: Mapping[str, Any]) -> dict[str, Any]:
    def name_of(name: str) -> str:
        match = _OF_A_MESH.fullmatch(name)
        if not match:
            return name
        return f"{match[1] or ''}transmission_error_{'' if match[2] else 'normal_'}{match[3]}"

    return {
        name_of(name): _without_normal(value) if isinstance(value, Mapping) else value
        for name, value in summary.items()
    }


class OpenRecord:
    """A record, open for reading; a context manager.

    Raises InputError if the file is missing, damaged, not such a record, or of a newer format.
    """

    _made_by = "run the scenario again"

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        #: What a legend calls the record: its file's name, unless somebody who has several gives another.
        self.label = harmless(self.path.stem.removesuffix(".partial"))
        #: Dimensions by dataset, and names of scales by address: HDF5 searches the file for each.
        self._known_dims: dict[str, tuple[str, ...]] = {}
        self._scales: dict[int, str] = {}
        self._file: Any = open_file(self.path)  # h5py types no item of a file
        try:
            self._check()
        except InputError:
            self._file.close()
            raise
        except UNREADABLE as error:
            self._file.close()
            raise self._damaged(error) from error

    def _check(self) -> None:
        """Raise InputError or one of `UNREADABLE` where the file is not what it should be."""
        raise NotImplementedError

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
        if cause := blamed(self.path, error):
            raise self._damaged(cause) from cause

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    @cached_property
    def _names(self) -> frozenset[str]:
        """Names in the file, of a dataset with two names the one that is listed."""
        listed = str(self._file.attrs.get("datasets", "")).split()
        return frozenset(name for name in self._file if schema.ANGLES.get(name) not in listed)

    def __contains__(self, name: object) -> bool:
        stored = stored_name(name, self._names)
        return stored in self._file and isinstance(self._file[stored], h5py.Dataset)

    def dims_of(self, name: str) -> tuple[str, ...]:
        """Names of a dataset's dimensions; none of a group, or of a number."""
        if name not in self._known_dims:
            item = self._file[stored_name(name, self._names)]
            dims: tuple[str, ...] = ()
            if isinstance(item, h5py.Dataset) and item.shape:
                axes = (self._name_of(dim[0]) if len(dim) else "" for dim in item.dims)
                dims = (name,) if item.is_scale else tuple(axes)
            self._known_dims[name] = dims
        return self._known_dims[name]

    def _name_of(self, scale: h5py.Dataset) -> str:
        address = h5py.h5o.get_info(scale.id).addr  # pyright: ignore[reportAttributeAccessIssue]
        if address not in self._scales:
            self._scales[address] = str(scale.name).rpartition("/")[2]
        return self._scales[address]

    def units(self, name: str) -> str:
        """Return the SI unit of a dataset."""
        return harmless(str(self._dataset(name).attrs["units"]))

    def long_name(self, name: str) -> str:
        """Return what a dataset means."""
        return harmless(str(self._dataset(name).attrs["long_name"]))

    @cached_property
    def attrs(self) -> dict[str, Any]:
        """Attributes of the file's root."""
        return attributes(self._file)

    @property
    def status(self) -> str:
        """`complete`, `partial` (being written, or its process was killed) or `failed`."""
        return str(self.attrs["status"])

    @property
    def message(self) -> str:
        """Why the record is not complete; of a sweep also how many cases failed."""
        return str(self.attrs["message"])

    @cached_property
    def scenario(self) -> dict[str, Any]:
        """The resolved scenario, of a sweep that of its first case; InputError where it is none."""
        try:
            return harmless_data(tomllib.loads(str(self.attrs["scenario"])))
        except (KeyError, ValueError, RecursionError) as error:
            raise self._damaged(error) from error

    def _dataset(self, name: str) -> h5py.Dataset:
        if name not in self:
            raise InputError("dataset", name, "no such dataset", f"one of {', '.join(self)}")  # pyright: ignore
        try:
            return self._file[stored_name(name, self._names)]
        except (KeyError, RuntimeError) as error:
            raise self._damaged(error) from error

    def _read(self, name: str, part: Any = ...) -> np.ndarray:
        """A part of a dataset, SI; efficiencies that cannot be are NaN."""
        dataset = self._dataset(name)
        try:
            values = np.asarray(dataset[part])
        except (OSError, RuntimeError) as error:
            raise self._damaged(error) from error
        if values.dtype.kind == "S":
            return np.vectorize(harmless, otypes=["U"])(np.char.decode(values, "utf-8", "replace"))
        return samples_withheld(name, values)

    def refused(self, rule: str, remedy: str) -> InputError:
        """What to say of a record that cannot be taken."""
        return InputError("record", str(self.path), rule, remedy)

    def _damaged(self, error: Exception) -> InputError:
        if no_descriptors(error):
            return self.refused(*TOO_MANY_FILES)
        return self.refused(f"the record is damaged: {reason_of(error)}", self._made_by)


def open_file(path: Path) -> h5py.File:
    """Open an HDF5 file for reading; InputError says what hinders it."""
    if not path.is_file():
        raise InputError("record", str(path), "no such file", "name the record of a run")
    try:
        check_sound(path)
        return h5py.File(path, "r")
    except OSError as error:
        why = "not an HDF5 file", "name the record of a run"
        if isinstance(error, PermissionError):
            why = "may not be read", "change its permissions"
        elif no_descriptors(error):
            why = TOO_MANY_FILES
        elif h5py.is_hdf5(path):
            why = f"damaged: {error}", "run the scenario again"
        raise InputError("record", str(path), *why) from error


def attributes(item: Any) -> dict[str, Any]:
    """Attributes as Python and NumPy values; texts without what a terminal or a picture would obey."""
    return {
        harmless(name): harmless_data(value.item() if isinstance(value, np.generic) else value)
        for name, value in item.attrs.items()
    }


def harmless_data(value: Any) -> Any:
    """Nested data of a record with harmless texts."""
    if isinstance(value, dict):
        return {harmless(name): harmless_data(item) for name, item in value.items()}
    if isinstance(value, list):
        return [harmless_data(item) for item in value]
    return harmless(value) if isinstance(value, str) else value
