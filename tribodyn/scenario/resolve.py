"""From the file that the user wrote to one table with everything in it.

Names of model files and of CSV tables are replaced by their content, overrides are applied (through those
names: ``drive.pinion.profile_shift`` changes what a drive's file says), and for every part it is remembered
which file it came from.
"""

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.scenario.kinds import table_of
from tribodyn.scenario.messages import Key, Origins
from tribodyn.scenario.schema import defaults_written_out
from tribodyn.scenario.sources import find_model, is_file, printable, quoted, read_curve, read_toml

#: Keys whose string names a file of `models/`, and the folder there; a drive comes before what it names.
MODEL_FILES: dict[Key, str] = {
    ("drive",): "drives",
    ("drive", "material"): "materials",
    ("drive", "pinion", "material"): "materials",
    ("drive", "gear", "material"): "materials",
    ("lubricant",): "lubricants",
    ("bearings",): "bearings",
}

#: Keys whose string names a CSV file, and the columns that are due.
CURVES: dict[Key, tuple[str, str]] = {
    ("drive", "shape", "points"): ("x", "y"),
    ("operating", "gear_torque_table"): ("time", "torque"),
    ("mesh", "table"): ("roll_angle", "stiffness"),
    ("mesh", "transmission_error", "table"): ("roll_angle", "error"),
}

_GEARS = ("pinion", "gear")
CURVES |= {("drive", gear, "modification", "profile_error"): ("roll_angle", "error") for gear in _GEARS}

#: Keys whose string names a CSV file that stands for a list of quantities, and the column that is due.
LISTS: dict[Key, str] = {("drive", gear, "modification", "pitch_errors"): "error" for gear in _GEARS}

OVERRIDES = "--set"


class Resolved(NamedTuple):
    """A scenario as one table, where its parts came from, and which references could not be followed."""

    data: dict[str, Any]
    origins: Origins
    errors: list[InputError]


def resolve(path: Path, overrides: Mapping[str, Any]) -> Resolved:
    """Return the scenario in `path` with references, overrides and defaults put in.

    Parameters
    ----------
    path : Path
        The scenario file.
    overrides : mapping
        Dotted key to value; a string is read as TOML where it is TOML, else taken as it stands.
    """
    return resolve_table(read_toml(path), path, overrides)


def resolve_table(written: dict[str, Any], path: Path, overrides: Mapping[str, Any]) -> Resolved:
    """Return a scenario's data as `resolve` does; what it names is looked for as from a file at `path`."""
    data = defaults_written_out(written, table_of(written))
    origins = Origins(str(path))
    for dotted, value in sorted(overrides.items(), key=lambda item: item[0].count(".")):
        try:
            _override(data, origins, path, dotted, value)
        except InputError as error:
            raise origins.locate(error) from None
    errors: list[InputError] = []
    for key in (*MODEL_FILES, *CURVES, *LISTS):
        try:
            _put_content(data, origins, path, key)
        except InputError as error:
            errors.append(origins.locate(error))
    return Resolved(defaults_written_out(data, table_of(data)), origins, errors)


def toml_value(text: str) -> Any:
    """Return what `text` means: a TOML value if it is one, else the text itself."""
    try:
        data = tomllib.loads(f"value = {text}")
    except tomllib.TOMLDecodeError:
        return text
    return data["value"] if len(data) == 1 else text


def _override(data: dict[str, Any], origins: Origins, path: Path, dotted: str, value: Any) -> None:
    """Put one override in; tables on the way are made, references on the way are opened."""
    key: Key = tuple(int(part) if part.isdecimal() else part for part in dotted.split("."))
    place: Any = data
    for depth, part in enumerate(key[:-1], start=1):
        _put_content(data, origins, path, key[:depth])
        if isinstance(place, dict):
            place = place.setdefault(str(part), {})
        elif isinstance(place, list) and isinstance(part, int) and part < len(place):
            place = place[part]
        else:
            place = None
    last = key[-1]
    if isinstance(place, dict):
        place[str(last)] = toml_value(value) if isinstance(value, str) else value
    elif isinstance(place, list) and isinstance(last, int) and last < len(place):
        place[last] = toml_value(value) if isinstance(value, str) else value
    else:
        above = ".".join(map(str, key[:-1]))
        raise InputError(
            dotted, quoted(value), f"{above} is not a table", "see the keys with: tribodyn schema", OVERRIDES
        )
    origins.put(key, OVERRIDES)


def _put_content(data: dict[str, Any], origins: Origins, path: Path, key: Key) -> None:
    """Where the value at `key` names a file, put the file's content in its place."""
    holder = _at(data, key[:-1])
    if not isinstance(holder, dict) or not isinstance(holder.get(key[-1]), str):
        return
    name: str = holder[key[-1]]
    said_in = origins.of(key)
    # what --set names is meant as the scenario would name it
    referring = path if said_in == OVERRIDES else Path(said_in)
    dotted = ".".join(map(str, key))
    if key in MODEL_FILES:
        file = find_model(name, MODEL_FILES[key], dotted, referring)
        holder[key[-1]] = read_toml(file)
    elif key in CURVES or key in LISTS:
        file = referring.parent / name
        due = CURVES.get(key) or (LISTS[key],)
        if not is_file(file):
            columns = ",".join(f"{column} [unit]" for column in due)
            raise InputError(
                dotted,
                quoted(name),
                f"no such file: {printable(str(file))}",
                f"give a CSV file that begins with {columns}",
            )
        columns = read_curve(file, dotted, due)
        holder[key[-1]] = columns if key in CURVES else _quantities(columns[due[0]])
    else:
        return
    origins.put(key, str(file))


def _quantities(column: Mapping[str, Any]) -> list[str]:
    """Write a column as the list of quantities that it stands for."""
    return [f"{value!r} {column['unit']}" for value in column["values"]]


def _at(data: Any, key: Iterable[str | int]) -> Any:
    """Return what stands at `key`, or None."""
    for part in key:
        data = data.get(part) if isinstance(data, dict) else None
    return data
