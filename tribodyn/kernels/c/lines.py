"""Lines of a C function, and how those are taken out whose variables nothing reads."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

_NAME = re.compile(r"[A-Za-z_]\w*")
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
        elif line.text == "}" and left and left[-1].text == "} else {":
            left[-1] = line
        else:
            left.append(line)
    return left


def folded(text: str, depth: int) -> Iterable[str]:
    """A line, broken at spaces where it is long."""
    indent = "    " * depth
    if len(indent) + len(text) <= LONGEST or text.startswith(("//", "/*")):
        yield indent + text
        return
    deeper = indent + "    "
    row = indent
    for word in text.split(" "):
        if len(row) + 1 + len(word) > LONGEST and row.strip():
            yield row
            row = deeper
        row += word if not row.strip() else f" {word}"
    yield row
