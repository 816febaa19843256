"""Keys that have two names: those of a gearbox, and in a file of one pair of gears those of its shafts.

A scenario keeps the name that it is written with, in its record too. Whoever looks for a key in it, or puts a
value in, finds it under either name, and messages speak as the file does.
"""

import re
from collections.abc import Collection, Mapping
from typing import Any

#: Name in terms of pinion and gear -> name of the field.
OF_PAIR = {
    "pinion_speed": "input_speed",
    "gear_speed": "output_speed",
    "pinion_torque": "input_torque",
    "gear_torque": "output_torque",
    "gear_torque_table": "output_torque_table",
    "gear_torque_harmonics": "output_torque_harmonics",
}
_TO_PAIR = {name: of_pair for of_pair, name in OF_PAIR.items()}
_WORD = re.compile(rf"\b({'|'.join((*OF_PAIR, *_TO_PAIR))})\b")


def named_in(known: Collection[Any], key: Any) -> Any:
    """The name under which a key is among those `known`, dotted or not; a key of no other name as it is."""
    if not isinstance(key, str) or key in known:
        return key
    *above, last = key.split(".")
    other = ".".join((*above, OF_PAIR.get(last) or _TO_PAIR.get(last) or last))
    return other if other in known else key


def key_in(data: Any, dotted: str) -> tuple[str | int, ...]:
    """A dotted key as the parts of which it is made, with the names that a scenario's data have."""
    found: list[str | int] = []
    for name in dotted.split("."):
        part = int(name) if name.isdecimal() else named_in(data, name) if isinstance(data, dict) else name
        found.append(part)
        try:
            data = data[str(part) if isinstance(data, dict) else part]
        except (KeyError, IndexError, TypeError):
            data = None
    return tuple(found)


def under_one_name(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table with the names of its fields; one that has a key under both names keeps both."""
    both = {name for name, field in OF_PAIR.items() if field in table}
    return {name if name in both else OF_PAIR.get(name, name): value for name, value in table.items()}


def same_key(key: str) -> str:
    """A dotted key under the name of its field."""
    above, dot, last = key.rpartition(".")
    return f"{above}{dot}{OF_PAIR.get(last, last)}"


def speaks_of_pair(data: Mapping[str, Any]) -> bool | None:
    """Whether a scenario names speed and load by pinion and gear, as with neither if it has a drive.

    None where it has both sorts of names, or says nothing of what it is about.
    """
    tables = [data.get("operating"), *(data["duty"] if isinstance(data.get("duty"), list) else ())]
    there = {name for table in tables if isinstance(table, Mapping) for name, value in table.items() if value}
    of_pair, of_gearbox = (bool(there & names.keys()) for names in (OF_PAIR, _TO_PAIR))
    if of_pair is of_gearbox:
        return True if "drive" in data and not of_pair else None
    return of_pair


def worded(text: Any, of_pair: bool | None) -> Any:
    """A text with the names that a file has; of one that has both, and what is no text, as it is."""
    if of_pair is None:
        return text
    names = _TO_PAIR if of_pair else OF_PAIR
    return _WORD.sub(lambda word: names.get(word[1], word[1]), text) if isinstance(text, str) else text
