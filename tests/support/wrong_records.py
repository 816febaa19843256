"""Records in which one thing is wrong: every attribute and dataset, each by each kind of wrong thing."""

import shutil
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import h5py
import numpy as np
import tomli_w

#: What stands in the place of an attribute, or of a value of the scenario.
WRONG_VALUES: dict[str, Any] = {
    "NUL": np.bytes_(b"a\0b"),
    "text": "a",
    "no text": "",
    "long text": "x" * 20_000,
    "number": 7,
    "negative": -3,
    "not a number": float("nan"),
    "infinite": float("inf"),
    "large": 1e308,
    "small": 5e-324,
    "true": True,
    "array": np.arange(3.0),
    "texts": ["a", "b"],
    "empty": np.zeros(0),
    "table": np.zeros((2, 2, 2)),
}
#: What a dataset becomes, by its values.
WRONG_ARRAYS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "not a number": lambda values: np.full_like(values, np.nan),
    "infinite": lambda values: np.full_like(values, np.inf),
    "large": lambda values: np.full_like(values, 1e308),
    "negative": lambda values: -np.abs(values) - 1.0,
    "zero": np.zeros_like,
    "alternating": lambda values: (values.T * np.resize([1e300, -1e300], len(values))).T,
}


class Change(NamedTuple):
    """One change of a record: what is changed, and the kind of wrong thing that stands there then."""

    place: str
    kind: str
    make: Callable[[h5py.File], None]

    def __str__(self) -> str:
        return f"{self.place}: {self.kind}"


def changes(record: Path) -> list[Change]:
    """All changes of a record."""
    found: list[Change] = []
    with h5py.File(record) as file:
        places: list[Any] = [file]
        file.visititems(lambda _, item: places.append(item))
        for item in places:
            name = str(item.name)
            for attribute in item.attrs:
                if attribute not in ("DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME"):
                    found += _of_attribute(name, attribute)
            if name != "/":
                found.append(Change(name, "missing", _without(name)))
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and item.shape:
                found += [Change(name, kind, _array(name, make)) for kind, make in WRONG_ARRAYS.items()]
            elif isinstance(item, h5py.Dataset) and item.dtype.kind in "iu":
                found += [
                    Change(name, str(number), _whole(name, number)) for number in (-1, 0, 99, 2**31 - 1)
                ]
        for key in _keys(tomllib.loads(str(file.attrs["scenario"]))):
            found += [Change(f"scenario {'.'.join(key)}", kind, _key(key, kind)) for kind in _IN_TOML]
            found.append(Change(f"scenario {'.'.join(key)}", "missing", _key(key, None)))
    return found


def drawn(record: Path, count: int, seed: int) -> list[Change]:
    """Some of the changes."""
    return Random(seed).sample(changes(record), count)


def changed(record: Path, path: Path, change: Change) -> Path:
    """A copy of a record with one change."""
    shutil.copy(record, path)
    with h5py.File(path, "r+") as file:
        change.make(file)
    return path


_IN_TOML: dict[str, Any] = {
    "text": "a",
    "number": 7,
    "negative": -3.5,
    "not a number": float("nan"),
    "list": [1, "a"],
    "table": {"a": 1},
    "quantity": "1e308 km",
}


def _of_attribute(item: str, name: str) -> Iterator[Change]:
    def put(value: Any) -> Callable[[h5py.File], None]:
        def make(file: h5py.File) -> None:
            file[item].attrs[name] = value

        return make

    for kind, value in WRONG_VALUES.items():
        yield Change(f"{item} @{name}", kind, put(value))
    yield Change(f"{item} @{name}", "missing", lambda file: file[item].attrs.__delitem__(name))


def _without(name: str) -> Callable[[h5py.File], None]:
    return lambda file: file.__delitem__(name)


def _array(name: str, wrong: Callable[[np.ndarray], np.ndarray]) -> Callable[[h5py.File], None]:
    def make(file: h5py.File) -> None:
        dataset: Any = file[name]
        dataset[...] = wrong(dataset[...])

    return make


def _whole(name: str, value: int) -> Callable[[h5py.File], None]:
    def make(file: h5py.File) -> None:
        dataset: Any = file[name]
        dataset[...] = np.array(value).astype(dataset.dtype)

    return make


def _keys(table: dict[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    for key, value in table.items():
        yield (*above, key)
        if isinstance(value, dict):
            yield from _keys(value, (*above, key))


def _key(key: tuple[str, ...], kind: str | None) -> Callable[[h5py.File], None]:
    def make(file: h5py.File) -> None:
        data = tomllib.loads(str(file.attrs["scenario"]))
        table = data
        for part in key[:-1]:
            table = table[part]
        if kind is None:
            del table[key[-1]]
        else:
            table[key[-1]] = _IN_TOML[kind]
        file.attrs["scenario"] = tomli_w.dumps(data)

    return make
