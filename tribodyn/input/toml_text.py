"""Keys put into the text of a TOML file, which otherwise stays as it is, comments included."""

import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

import tomli_w

_HEADER = re.compile(r"[ \t]*\[(?P<keys>[^\[\]]+)\][ \t]*(#.*)?")
_BARE = re.compile(r"[A-Za-z0-9_-]+")


def with_keys(text: str, values: Mapping[tuple[str, ...], str]) -> tuple[str, bool]:
    """The text with texts by key; and whether its comments are kept: else it is written anew.

    A name of a model on the way becomes a table that is ``like`` it. Raises tomllib.TOMLDecodeError.
    """
    wanted = tomllib.loads(text)
    kept = True
    for key, value in values.items():
        put_key(wanted, key, value)
        text, placed = _with_key(text, key, value, wanted)
        kept = kept and placed
    return text, kept


def put_key(data: dict[str, Any], key: Sequence[str], value: Any) -> None:
    """Put a value into tables, which are made; a name of a model on the way becomes a table like it."""
    for part in key[:-1]:
        inner = data.setdefault(part, {})
        if isinstance(inner, str):
            inner = data[part] = {"like": inner}
        data = inner
    data[key[-1]] = value


def _with_key(text: str, key: tuple[str, ...], value: str, wanted: dict[str, Any]) -> tuple[str, bool]:
    """The text with one key, as `wanted` has it, in the first of its places at which that is so."""
    lines = text.split("\n")
    written = json.dumps(value, ensure_ascii=False)
    tables: list[tuple[tuple[str, ...], int]] = [((), -1)]
    tables += [
        (_keys(found["keys"]), number)
        for number, line in enumerate(lines)
        if (found := _HEADER.fullmatch(line.rstrip("\r")))
    ]
    holding = [each for each in tables if key[: len(each[0])] == each[0]]
    for table, number in sorted(holding, key=lambda each: -len(each[0])):
        rest = key[len(table) :]
        after = number + 1  # the last line that says something of the same table
        for at in range(number + 1, len(lines)):
            if _HEADER.fullmatch(lines[at].rstrip("\r")) or lines[at].lstrip().startswith("[["):
                break
            for changed in _changed(lines[at], rest, written):
                if _is(found := "\n".join([*lines[:at], *changed, *lines[at + 1 :]]), wanted):
                    return found, True
            if _keys(lines[at].partition("=")[0])[:1] == rest[:1]:
                after = at + 1
        line = f"{'.'.join(map(_word, rest))} = {written}"
        if _is(found := "\n".join([*lines[:after], line, *lines[after:]]), wanted):
            return found, True
    return tomli_w.dumps(deepcopy(wanted)), False


def _changed(line: str, rest: Sequence[str], written: str) -> list[list[str]]:
    """What may stand in the place of a line: the key with its new value; a model's name as `like`."""
    name, equals, _ = line.partition("=")
    if not equals:
        return []
    keys = _keys(name)
    if keys == tuple(rest):
        return [[f"{name.rstrip()} = {written}"]]
    if keys and keys == tuple(rest[: len(keys)]):
        inner = ".".join(map(_word, rest))
        return [[f"{name.rstrip()}.like ={line.partition('=')[2]}", f"{inner} = {written}"]]
    return []


def _keys(dotted: str) -> tuple[str, ...]:
    """Parts of a dotted key whose parts are bare or in quotes without dots."""
    return tuple(part.strip().strip("\"'") for part in dotted.split("."))


def _word(part: str) -> str:
    return part if _BARE.fullmatch(part) else json.dumps(part, ensure_ascii=False)


def _is(text: str, wanted: dict[str, Any]) -> bool:
    try:
        return tomllib.loads(text) == wanted
    except tomllib.TOMLDecodeError:
        return False
