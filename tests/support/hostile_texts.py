"""Texts that a picture, a page or a terminal could take for something else, and records full of them."""

import shutil
import tomllib
from pathlib import Path
from typing import Any

import h5py
import tomli_w

#: A formula that is none, marks of HTML and of templates, letters no font has, other directions, two
#: lines; and a text that is too long. The first begins as what a legend leaves out.
HOSTILE = "_$\\badmacro$ ${x}^$ 🦷漢 </script><b onload=a>&quot; %s {0}\u05d0\n2nd"
LONG = "long $x_{ " * 1000
#: Keys of a scenario under which there is a text for people.
TEXTS = {"title", "source", "assumptions"}
#: Texts of a summary that stand for something.
CODES = {"trust", "mode"}


def hostile_copy(record: Path, folder: Path, text: str) -> Path:
    """A copy of a record, under a hostile name, in which every text for people is this one."""
    path = folder / "_a $\\badmacro$ b.h5"
    shutil.copy(record, path)
    with h5py.File(path, "r+") as file:
        scenario = _with_texts(tomllib.loads(str(file.attrs["scenario"])), text)
        file.attrs["scenario"] = tomli_w.dumps(scenario)
        file.attrs["message"] = text
        for name, value in file["summary"].attrs.items():
            if isinstance(value, str) and name not in CODES and not name.endswith("units"):
                file["summary"].attrs[name] = text
        file.visititems(lambda _, item: _describe(item, text))
    return path


def _describe(item: Any, text: str) -> None:
    if "long_name" in item.attrs and not item.name.startswith("/mesh_cycle"):
        item.attrs["long_name"] = text
        if h5py.check_string_dtype(item.dtype) is None:  # a column of texts with a unit is refused
            item.attrs["units"] = text


def _with_texts(table: Any, text: str) -> Any:
    if isinstance(table, list):
        return [_with_texts(item, text) for item in table]
    if not isinstance(table, dict):
        return table
    return {
        key: text if key in TEXTS and isinstance(value, str) else _with_texts(value, text)
        for key, value in table.items()
        if key != "operating"
    } | {key: table[key] for key in ("operating",) if key in table}  # its source is a word of a choice
