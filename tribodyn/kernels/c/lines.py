"""Lines of a C function, and how those are taken out whose variables nothing reads."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

_NAME = re.compile(r"[A-Za-z_]\w*")
_OPERATOR = re.compile(r" (?=(?:[-+*/?:]|&&|\|\|) )")
#: A line is no longer, if it can be broken.
LONGEST = 110


@dataclass(eq=False)
class CLine:
    """A statement, or the beginning or end of a block."""

    text: str
    defines: str = ""  # the variable that it declares or assigns, and does nothing else
    effect: str = ""  # what is left of it where nobody reads that
    returned: Any = None  # a value whose text follows when the function's type is known
    depth: int = 0


def names_in(text: str) -> set[str]:
    """Identifiers in a text."""
    return set(_NAME.findall(text))


def without_unused(lines: list[CLine]) -> list[CLine]:
    """The lines without those that nothing reads."""
    while True:
        read: set[str] = set()
        defined: set[str] = set()
        mentions = [names_in(line.text) for line in lines]
        for line, names in zip(lines, mentions, strict=True):
            read |= names - {line.defines}
            defined |= {line.defines}
        unused = defined - read - {""}
        left = []
        for line in lines:
            if line.defines not in unused:
                left.append(line)
            elif line.effect:
                left.append(CLine(line.effect, depth=line.depth))
        left = _without_empty_blocks(left)
        if len(left) == len(lines) and not unused:
            return left
        lines = left


def _without_empty_blocks(lines: list[CLine]) -> list[CLine]:
    left: list[CLine] = []
    for line in lines:
        if (
            line.text == "}"
            and left
            and left[-1].text.startswith(("if (", "for ("))
            and left[-1].text[-1] == "{"
        ):
            left.pop()
        elif line.text == "}" and left and left[-1].text.startswith("} else") and left[-1].text[-1] == "{":
            left[-1] = line
        else:
            left.append(line)
    return left


def folded(text: str, depth: int) -> Iterable[str]:
    """A line, broken after commas, or before operators, where it is long."""
    indent = "    " * depth
    if text.startswith("/*"):
        yield indent + text
        return
    while len(indent) + len(text) > LONGEST:
        room = LONGEST - len(indent)
        end = text.rfind(", ", 0, room) + 1
        if end < room // 2:
            found = [one.start() for one in _OPERATOR.finditer(text, 0, room)]
            end = found[-1] if found else end
        if end <= 0:
            break
        yield indent + text[:end]
        text = text[end + 1 :]
        indent = "    " * (depth + 1)
    yield indent + text
