"""Lines of a scenario's text in which its keys stand."""

import re
import tomllib
from functools import lru_cache
from typing import Any

from tribodyn.input.messages import Key, value_at


@lru_cache(maxsize=256)
def line_of(text: str, key: str) -> int:
    """The line, from 1, in which a dotted key stands, or begins the table that it is missing in; 0: none.

    The key of a text that is no TOML is its line, as in ``line 12``.
    """
    if line := re.fullmatch(r"line (\d+)", key):
        return int(line[1])
    try:
        whole = tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return 0
    parts: Key = tuple(int(part) if part.isdecimal() else part for part in key.split("."))
    while parts and value_at(whole, parts) is None:
        parts = parts[:-1]
    if not parts:
        return 0
    low, high = 0, len(text.splitlines())  # the first so many lines do not have it, and do
    while high - low > 1:
        middle = (low + high) // 2
        begun, end = _begun(text, middle)
        if value_at(begun, parts) is None:
            low = max(middle, end - 1)
        else:
            high = middle
    return high


@lru_cache(maxsize=512)
def _begun(text: str, count: int) -> tuple[dict[str, Any], int]:
    """What so many lines say, and how many were read: a value that goes over several is read to its end."""
    lines = text.splitlines(keepends=True)
    for end in range(count, len(lines) + 1):
        try:
            return tomllib.loads("".join(lines[:end])), end
        except tomllib.TOMLDecodeError:
            continue
    return {}, len(lines)
