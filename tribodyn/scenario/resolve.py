"""From the file that the user wrote to one table with everything in it.

Names of model files and of CSV tables are replaced by their content, overrides are applied (through those
names: ``drive.pinion.profile_shift`` changes what a drive's file says), and for every part it is remembered
which file it came from.
"""

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, printable, quoted
from tribodyn.scenario.messages import Key, Origins
from tribodyn.scenario.quantity import defaults_written_out
from tribodyn.scenario.sources import find_model, is_file, read_curve, read_toml
from tribodyn.studies.kinds import table_of

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

#: In the table of a model: the name of a file that says everything which the table does not.
LIKE = "like"

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


def unresolved_keys(errors: Iterable[InputError]) -> set[str]:
    """Return the keys whose values are missing because a file was not found; complained of already."""
    return {error.key.removesuffix(f".{LIKE}") for error in errors}


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
        if key[depth:] != (LIKE,):  # another model to be like takes the place of the first
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
    if not isinstance(holder, dict):
        return
    if isinstance(holder.get(key[-1]), dict) and LIKE in holder[key[-1]] and key in MODEL_FILES:
        _put_under(data, origins, path, key)
        return
    if not isinstance(holder.get(key[-1]), str):
        return
    name: str = holder[key[-1]]
    referring, dotted = _referring(origins, path, key), ".".join(map(str, key))
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
        curve = read_curve(file, dotted, due)
        holder[key[-1]] = curve if key in CURVES else _quantities(curve[due[0]])
    else:
        return
    origins.put(key, str(file))


def _put_under(data: dict[str, Any], origins: Origins, path: Path, key: Key) -> None:
    """Put the content of the model that the table at `key` is like under what the table says itself."""
    table = _at(data, key)
    dotted = ".".join(map(str, (*key, LIKE)))
    name = table[LIKE]
    holder = _at(data, key[:-1])
    holder[key[-1]] = name  # until it is found: what is missing in the table then is no mistake of its own
    if not isinstance(name, str):
        raise InputError(dotted, quoted(name), "not the name of a model", "write a name in quotes")
    file = find_model(name, MODEL_FILES[key], dotted, _referring(origins, path, (*key, LIKE)))
    said_in = {leaf: origins.of((*key, *leaf)) for leaf in _leaves(table)}
    holder[key[-1]] = _merged(read_toml(file), {name: value for name, value in table.items() if name != LIKE})
    origins.put(key, str(file))
    for leaf, where in said_in.items():
        origins.put((*key, *leaf), where)


def _referring(origins: Origins, path: Path, key: Key) -> Path:
    """Return the file that names another at `key`; what --set names, the scenario might have named."""
    said_in = origins.of(key)
    return path if said_in == OVERRIDES else Path(said_in)


def _merged(under: dict[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    """Put one table over another, key by key."""
    merged = dict(under)
    for name, value in over.items():
        below: Any = merged.get(name)
        both = isinstance(below, dict) and isinstance(value, dict) and LIKE not in value
        merged[name] = _merged(below, value) if both else value
    return merged


def _leaves(table: Mapping[str, Any], above: Key = ()) -> list[Key]:
    """Return the keys of everything in a table that is no table."""
    found: list[Key] = []
    for name, value in table.items():
        found += _leaves(value, (*above, name)) if isinstance(value, dict) else [(*above, name)]
    return found


def _quantities(column: Mapping[str, Any]) -> list[str]:
    """Write a column as the list of quantities that it stands for."""
    return [f"{value!r} {column['unit']}" for value in column["values"]]


def _at(data: Any, key: Iterable[str | int]) -> Any:
    """Return what stands at `key`, or None."""
    for part in key:
        data = data.get(part) if isinstance(data, dict) else None
    return data
