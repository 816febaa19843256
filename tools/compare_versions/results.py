"""What a case left behind, as one flat table per file: the JSON it printed, its records, its exit status."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tools.compare_versions.versions import MADE

#: Differ from run to run, or say which version ran; the scenario's text is compared by what it leads to.
VOLATILE = frozenset(
    {
        "created",
        "wall_time",
        "tribodyn_version",
        "code_sha256",
        "scenario",
        "scenario_sha256",
        "model",
        "record",
        "pictures",
    }
)
#: Attributes that HDF5's dimension scales keep themselves with; `dims` says the same in names.
SCALES = frozenset({"DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME", "_Encoding", "_Netcdf4Dimid"})

#: Name of a quantity -> array of numbers, or text.
Table = dict[str, "np.ndarray | str"]


def read(folder: Path) -> dict[str, Table]:
    """Return the tables of a case by file; "printed" holds the JSON of stdout and the exit statuses."""
    made = json.loads((folder / MADE).read_text(encoding="utf-8"))
    table: Table = {"exit status": " ".join(map(str, made["status"]))}
    printed = (folder / "stdout").read_text(encoding="utf-8")
    try:
        table |= _of_json(json.loads(printed), "")
    except json.JSONDecodeError:
        table["message"] = printed + (folder / "stderr").read_text(encoding="utf-8")
    tables = {"printed": table}
    for path in sorted(folder.glob("*.h5")):
        with h5py.File(path) as file:
            tables[path.name] = _of_record(file)
    return tables


def _of_json(value: Any, name: str) -> Iterator[tuple[str, "np.ndarray | str"]]:
    """Flatten: names joined by ``/``; a list of numbers is one array, rows of a table go by their id."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in VOLATILE:
                yield from _of_json(item, f"{name}/{key}" if name else key)
    elif isinstance(value, list) and not (value and all(_is_number(item) for item in value)):
        for number, item in enumerate(value):
            own = item.get("id", number) if isinstance(item, dict) else number
            yield from _of_json(item, f"{name}/{own}")
    elif isinstance(value, list):
        yield name, np.asarray([np.nan if item is None else item for item in value])
    elif _is_number(value):
        yield name, np.asarray(value)
    elif isinstance(value, str):
        yield name, value
    else:
        yield name, "null"


def _is_number(value: object) -> bool:
    return isinstance(value, int | float | bool)


def _of_record(file: h5py.File) -> Table:
    """Datasets by path; an attribute as ``path@name``; a dataset's dimension scales as ``path@dims``."""
    table: Table = {}

    def visit(path: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset):
            table[path] = _values(item[()])
            scales = [
                ",".join(str(scale.name).rpartition("/")[2] for scale in dim.values()) for dim in item.dims
            ]
            table[f"{path}@dims"] = " ".join(scales)
        for name, value in item.attrs.items():
            if name not in SCALES | VOLATILE and not name.endswith("_version"):
                table[f"{path}@{name}"] = _values(value)

    visit("", file)
    file.visititems(visit)
    return table


def _values(value: Any) -> "np.ndarray | str":
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, str | h5py.Empty):
        return str(value)
    array = np.asarray(value)
    if array.dtype.names:
        return str(array.tolist())
    if array.dtype.kind in "SOU":
        # a record that a failed run left holds bytes that nobody wrote
        texts = (
            text.decode(errors="replace") if isinstance(text, bytes) else str(text) for text in array.flat
        )
        return "\n".join(texts)
    return array
