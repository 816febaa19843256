"""Bounds of a scenario's data: depths of tables, numbers of keys, lengths of texts, sizes of numbers.

A scenario may come from a stranger: what no simulation needs is refused before anything is made of it.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from tribodyn.errors import InputError, harmless, printable, quoted
from tribodyn.input.messages import Key
from tribodyn.input.units import EXTREME, is_extreme

#: Tables and lists inside each other, keys of a table, characters of a key and of a text.
DEEPEST, MOST_KEYS, LONGEST_KEY, LONGEST_TEXT = 32, 1000, 200, 20_000
#: Whole numbers that every part of a computation can hold.
LEAST_WHOLE, GREATEST_WHOLE = -(2**63), 2**63 - 1

# names joined by dots on one line, and names in quotes beside a dot: a parser's time goes like the square of
# their number
_DOTTED = re.compile(rf"(?<![\w-])[\w-]++(?:[ \t]*+\.[ \t]*+[\w-]++){{{DEEPEST}}}")
_QUOTED = re.compile(r"""["'][ \t]*+\.|\.[ \t]*+["']""")


class TooMuch(ValueError):
    """TOML beyond these bounds; says which."""


def parsed(text: str) -> dict[str, Any]:
    """Parse TOML; raises tomllib.TOMLDecodeError where it is none, `TooMuch` where it is out of bounds."""
    too_deep = f"more than {DEEPEST} tables or lists inside each other"
    if any(_is_long_key(line) for line in text.split("\n")):
        raise TooMuch(too_deep)
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except RecursionError:
        raise TooMuch(too_deep) from None
    except ValueError:
        raise TooMuch("a whole number with thousands of digits") from None
    if _depth(data) > DEEPEST:
        raise TooMuch(too_deep)
    return data


def _is_long_key(line: str) -> bool:
    """Whether a line joins more names by dots than tables may lie inside each other."""
    if line.count(".") < DEEPEST:
        return False
    return bool(_DOTTED.search(line)) or sum(1 for _ in _QUOTED.finditer(line)) >= DEEPEST


def _depth(data: Any) -> int:
    """Tables and lists inside each other; raises `TooMuch` where one of the tables has too many keys."""
    depth, level = -1, [data]
    while level:
        depth += 1
        most = max(len(item) if isinstance(item, dict) else 0 for item in level)
        if most > MOST_KEYS:
            raise TooMuch(f"a table of {most} keys, at most {MOST_KEYS} are read")
        inside = (item.values() if isinstance(item, dict) else item for item in level)
        level = [item for items in inside for item in items if isinstance(item, (dict, list))]
    return depth


#: Rule and remedy of a text that a terminal would obey.
OBEYED = "holds a control character or a mark that turns the direction of writing", "remove it"


def broken_bounds(value: Any, key: Key = ()) -> Iterator[InputError]:
    """Go through what is out of bounds in a scenario's data, or would be obeyed by a terminal."""
    if isinstance(value, Mapping):
        for name, item in value.items():
            if len(str(name)) > LONGEST_KEY:
                rule = f"a key of {len(str(name))} characters"
                yield InputError(_dotted((*key, name)), None, rule, "remove it")
            elif harmless(str(name)) != name:
                yield InputError(_dotted((*key, name)), None, *OBEYED)
            else:
                yield from broken_bounds(item, (*key, name))
    elif isinstance(value, (list, tuple)):
        for place, item in enumerate(value):
            if isinstance(item, (Mapping, list, tuple)) or _broken(item) is not None:
                yield from broken_bounds(item, (*key, place))
    elif (broken := _broken(value)) is not None:
        yield InputError(_dotted(key), quoted(value), *broken)


def _broken(value: Any) -> tuple[str, str] | None:
    """Rule and remedy of a single value that is out of bounds."""
    if isinstance(value, str):
        if len(value) > LONGEST_TEXT:
            return f"a text of {len(value)} characters", f"write at most {LONGEST_TEXT}"
        if harmless(value) != value:
            return OBEYED
    elif isinstance(value, int) and not LEAST_WHOLE <= value <= GREATEST_WHOLE:
        return "a whole number beyond 64 bits", "write a smaller number"
    elif isinstance(value, float) and is_extreme(value) and value - value == 0.0:
        return EXTREME, "write another number"
    return None


def _dotted(key: Key) -> str:
    text = printable(".".join(map(str, key)))
    return text if len(text) <= LONGEST_KEY else text[:LONGEST_KEY] + "..."
