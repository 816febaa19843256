"""From the file that the user wrote to one table with everything in it.

Names of model files and of CSV tables are replaced by their content, overrides are applied (through those
names: ``drive.pinion.profile_shift`` changes what a drive's file says), and for every part it is remembered
which file it came from.
"""

import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, printable_path, quoted
from tribodyn.geometry.families import FAMILIES
from tribodyn.input import bounds, sources
from tribodyn.input.csv_files import read_curve
from tribodyn.input.messages import Key, Origins, value_at
from tribodyn.input.names import key_in
from tribodyn.input.quantity import LIKE, Reference, Table, csv_file, defaults_written_out
from tribodyn.input.schema import expanded, family_shapes, matches, references

OVERRIDES = "--set"


class Resolved(NamedTuple):
    """A scenario as one table, where its parts came from, and which references could not be followed."""

    data: dict[str, Any]
    origins: Origins
    errors: list[InputError]


TableOf = Callable[[Mapping[str, Any]], type[Table]]
"""Gives the schema of a scenario's data, which may be incomplete."""


def resolve(path: Path, overrides: Mapping[str, Any], table_of: TableOf) -> Resolved:
    """Return the scenario in a file with references, overrides and defaults put in.

    Overrides are values by dotted key; a string is read as TOML where it is TOML, else taken as it stands.
    """
    return resolve_table(sources.read_toml(path), path, overrides, table_of)


def resolve_table(
    written: dict[str, Any], path: Path, overrides: Mapping[str, Any], table_of: TableOf
) -> Resolved:
    """Return a scenario's data as `resolve` does; what it names is looked for as from a file at `path`."""
    data = defaults_written_out(written, table_of(written))
    origins = Origins(str(path))
    scenario = _References(data, origins, path, {}, ())
    try:
        scenario = _marked(scenario, table_of)
        for dotted, value in sorted(overrides.items(), key=lambda item: item[0].count(".")):
            _override(scenario, dotted, value)
            if any(mark.folder == sources.SCENARIOS for mark in scenario.marks.values()):
                scenario = _marked(scenario, table_of)
    except InputError as error:
        raise origins.locate(error) from None
    errors: list[InputError] = []
    scenario = _marked(scenario, table_of)
    for key in scenario.keys():
        try:
            _put_content(scenario, key)
        except InputError as error:
            errors.append(origins.locate(error))
    data = defaults_written_out(data, table_of(data))
    errors += [origins.locate(error) for error in bounds.broken_bounds(data)]
    return Resolved(data, origins.over(data), errors)


class _References(NamedTuple):
    """A scenario's data on the way, where its parts came from, its file, and which keys may name files."""

    data: dict[str, Any]
    origins: Origins
    path: Path
    marks: Mapping[tuple[str, ...], Reference]  # by pattern of a key, see `schema.expanded`
    shapes: tuple[tuple[str, ...], ...]  # likewise, of what families of teeth need

    def keys(self) -> Iterator[Key]:
        """Go through the keys that may name files; those of a family last, when its name is known."""
        for pattern in self.marks:
            yield from expanded(pattern, self.data)
        yield from self._of_family()

    def at(self, key: Key) -> Reference | None:
        """What the value at a key may name."""
        named = (mark for pattern, mark in self.marks.items() if matches(pattern, key))
        return next(named, None) or self._of_family().get(key)

    def _of_family(self) -> dict[Key, Reference]:
        """The points that the family of each pair of gears needs."""
        marks: dict[Key, Reference] = {}
        for shape in (key for pattern in self.shapes for key in expanded(pattern, self.data)):
            name = value_at(self.data, (*shape[:-1], "family"))
            if isinstance(name, str) and name in FAMILIES:
                paths = [one.name for one in FAMILIES[name].parameters if one.kind == "path"]
                marks |= {(*shape, path): csv_file("x", "y") for path in paths}
        return marks


def _marked(scenario: _References, table_of: TableOf) -> _References:
    """Say which keys may name files; a scenario within this one is opened first, for it has such keys too."""
    scenario = _read_off(scenario, table_of(scenario.data))
    marks = scenario.marks
    inner = [key for key, mark in marks.items() if mark.folder == sources.SCENARIOS]
    for key in inner:
        _put_content(scenario, key)
    return _read_off(scenario, table_of(scenario.data)) if inner else scenario


def _read_off(scenario: _References, table: type[Table]) -> _References:
    return scenario._replace(marks=references(table), shapes=family_shapes(table))


def unresolved_keys(errors: Iterable[InputError]) -> set[str]:
    """Return the keys whose values are missing because a file was not found; complained of already."""
    return {error.key.removesuffix(f".{LIKE}") for error in errors}


def toml_value(text: str) -> Any:
    """Return what `text` means: a TOML value if it is one, else the text itself."""
    try:
        data = bounds.parsed(f"value = {text}")
    except (tomllib.TOMLDecodeError, bounds.TooMuch):
        return text
    return data["value"] if len(data) == 1 else text


def _override(scenario: _References, dotted: str, value: Any) -> None:
    """Put one override in, and remember that it is one."""
    key = key_in(scenario.data, dotted)
    if not _put(scenario, key, toml_value(value) if isinstance(value, str) else value):
        rule = f"{'.'.join(map(str, key[:-1]))} is not a table"
        for depth, part in enumerate(key):
            if isinstance(part, int) and isinstance(some := value_at(scenario.data, key[:depth]), list):
                name = ".".join(map(str, key[:depth]))
                rule = f"there is no {name}.{part}: {name} has {len(some)}, counted from 0"
        raise InputError(dotted, quoted(value), rule, "see the keys with: tribodyn schema", OVERRIDES)
    scenario.origins.put(key, OVERRIDES)


def _put(scenario: _References, key: Key, value: Any) -> bool:
    """Put a value in; tables on the way are made, references on the way are opened. False: no table there."""
    place: Any = scenario.data
    for depth, part in enumerate(key[:-1], start=1):
        if key[depth:] != (LIKE,):  # another model to be like takes the place of the first
            _put_content(scenario, key[:depth])
        if isinstance(place, dict):
            place = place.setdefault(str(part), {})
        elif isinstance(place, list) and isinstance(part, int) and part < len(place):
            place = place[part]
        else:
            place = None
    last = key[-1]
    if isinstance(place, dict):
        place[str(last)] = value
    elif isinstance(place, list) and isinstance(last, int) and last < len(place):
        place[last] = value
    else:
        return False
    return True


def _put_content(scenario: _References, key: Key) -> None:
    """Where the value at `key` names a file, put the file's content in its place."""
    holder, mark = value_at(scenario.data, key[:-1]), scenario.at(key)
    if not isinstance(holder, dict) or mark is None:
        return
    name = holder.get(key[-1])
    if isinstance(name, dict) and LIKE in name and mark.folder:
        _put_under(scenario, key, mark.folder)
        return
    if not isinstance(name, str):
        return
    referring, dotted = _referring(scenario, key), ".".join(map(str, key))
    if mark.folder:
        _put_model(scenario, key, sources.find_model(name, mark.folder, dotted, referring), mark.folder)
    else:
        file = referring.parent / name
        if not sources.is_file(file):
            if mark.reader is not None:
                rule = f"no such file: {printable_path(file)}"
                raise InputError(dotted, quoted(name), rule, f"give a {mark.what}")
            columns = ",".join(f"{column} [unit]" for column in mark.columns or mark.as_tables)
            remedy = f"give a CSV file that begins with {columns}{', or a record' if mark.record else ''}"
            raise InputError(dotted, quoted(name), f"no such file: {printable_path(file)}", remedy)
        if mark.reader is not None:
            curve = mark.reader(file, dotted)
        elif mark.record is not None and file.suffix == ".h5":
            curve = mark.record(file, dotted)
        else:
            curve = read_curve(file, dotted, mark.columns, mark.as_tables)
        if mark.as_tables:
            holder[key[-1]] = _tables(curve)
        elif mark.reader is not None:
            holder[key[-1]] = curve
        else:
            column = curve[mark.columns[0]]
            holder[key[-1]] = _quantities(column) if mark.as_list else curve
        scenario.origins.put(key, str(file))


def _quantities(column: Mapping[str, Any]) -> list[Any]:
    """Values of a column as a scenario has them: texts with the unit; numbers where it is [1] or []."""
    unit = column["unit"].strip()
    return [number if unit in ("", "1") else f"{number!r} {unit}" for number in column["values"]]


def _tables(curve: Mapping[str, Any]) -> list[dict[str, Any]]:
    """A table of each row; the columns are its keys."""
    rows = zip(*map(_quantities, curve.values()), strict=True)
    return [dict(zip(curve, row, strict=True)) for row in rows]


def _put_model(source: _References, key: Key, file: Path, folder: str, above: tuple[Path, ...] = ()) -> None:
    """Put the content of a model's file in; `above` are the files that are like it."""
    value_at(source.data, key[:-1])[key[-1]] = content = sources.read_toml(file)
    source.origins.put(key, str(file))
    if LIKE in content:
        _put_under(source, key, folder, (*above, file.resolve()))


def _put_under(scenario: _References, key: Key, folder: str, above: tuple[Path, ...] = ()) -> None:
    """Put the content of the model that the table at `key` is like under what the table says itself."""
    origins = scenario.origins
    table = value_at(scenario.data, key)
    dotted = ".".join(map(str, (*key, LIKE)))
    name = table[LIKE]
    holder = value_at(scenario.data, key[:-1])
    holder[key[-1]] = name  # until it is found: what is missing in the table then is no mistake of its own
    if not isinstance(name, str):
        raise InputError(dotted, quoted(name), "not the name of a model", "write a name in quotes")
    file = sources.find_model(name, folder, dotted, _referring(scenario, (*key, LIKE)))
    leaves = [(leaf, value, origins.of((*key, *leaf))) for leaf, value in _leaves(table) if leaf != (LIKE,)]
    if file.resolve() in above:
        raise InputError(dotted, quoted(name), "is like itself", "name another file")
    _put_model(scenario, key, file, folder, above)
    for leaf, value, written_in in leaves:
        at = (*key, *leaf)
        if not _put(scenario, at, value):
            rule = f"{'.'.join(map(str, at[:-1]))} is not a table in {printable_path(file)}"
            raise InputError(".".join(map(str, at)), quoted(value), rule, "write the whole table", written_in)
        origins.put(at, written_in)


def _referring(scenario: _References, key: Key) -> Path:
    """Return the file that names another at `key`; what --set names, the scenario might have named."""
    written_in = scenario.origins.of(key)
    return scenario.path if written_in == OVERRIDES else Path(written_in)


def _leaves(table: Mapping[str, Any], above: Key = ()) -> list[tuple[Key, Any]]:
    """Return keys and values of everything in a table that is no table, or one that is like a model."""
    leaves: list[tuple[Key, Any]] = []
    for name, value in table.items():
        inner = isinstance(value, dict) and LIKE not in value
        leaves += _leaves(value, (*above, name)) if inner else [((*above, name), value)]
    return leaves
