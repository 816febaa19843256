"""A scenario being written: its lines with comments, the names of its parts, what was assumed and changed."""

import json
import re
import unicodedata
from collections.abc import Iterable

from tribodyn.errors import printable
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import Sheet

#: Characters of a name.
_LONGEST = 48
UNKNOWN = "not in the file: a typical value"


def text(value: str) -> str:
    """A text as TOML writes it."""
    return json.dumps(printable(value), ensure_ascii=False)


def texts(values: Iterable[str]) -> str:
    """A list of texts as TOML writes it."""
    return f"[{', '.join(map(text, values))}]"


class Draft:
    """What is known of the scenario so far."""

    def __init__(self, sheet: Sheet) -> None:
        self.sheet = sheet
        self.model = sheet.model
        self.lines: list[str] = []
        self.assumed: list[str] = []
        self.changed: list[str] = []
        self.bodies: set[int] = set()  # ids of masses that are a [[body]]
        self.modified_spur = False  # flanks whose contact finite elements alone follow
        self._names: dict[int, str] = {}
        self._table = ""

    def name(self, part: Component, named: str = "") -> str:
        """The name of a part in the scenario, made of its own; no two parts have the same."""
        if part.number not in self._names:
            wanted = named or _plain(part.name) or f"{_plain(part.type)}-{part.number}"
            taken = set(self._names.values())
            tries = (wanted, f"{wanted}-{_plain(part.type)}", f"{wanted}-{part.number}")
            self._names[part.number] = next(each for each in tries if each not in taken)
        return self._names[part.number]

    def named(self, part: Component) -> str | None:
        """The name of a part, if it has one."""
        return self._names.get(part.number)

    def table(self, header: str, comment: str = "") -> None:
        """Begin a table, "[gear.pinion]" or "[[stage]]"."""
        self._table = header.strip("[]")
        self.lines += ["", _line(header, comment)]

    def put(self, key: str, value: str | None, comment: str = "") -> None:
        """Write a key, whose value is as TOML has it; none: nothing."""
        if value is not None:
            self.lines.append(_line(f"{key} = {value}", comment))

    def assume(self, key: str, value: str, comment: str = UNKNOWN) -> None:
        """Write a key that a scenario needs and the file does not say."""
        self.put(key, value, comment)
        self.assumed.append(f"{self._table}{'.' if self._table else ''}{key} = {value}: {comment}")

    def suggest(self, key: str, value: str, comment: str = UNKNOWN) -> None:
        """Leave a key that the file does not say as a comment."""
        self.lines.append(_line(f"# {key} = {value}", comment))

    def change(self, part: Component, what: str) -> None:
        """Note what the scenario says in another way than the file."""
        self.changed.append(f"{part}: {what}")

    def toml(self) -> str:
        """The scenario."""
        return "\n".join(self.lines).strip() + "\n"


def _line(start: str, comment: str) -> str:
    return f"{start:<40}  # {printable(comment)}" if comment else start


def _plain(name: str) -> str:
    """A name of letters, digits and hyphens."""
    plain = unicodedata.normalize("NFKD", name.split("@")[0].replace("ß", "ss"))
    plain = plain.encode("ascii", "ignore").decode().lower()
    return re.sub(r"[^a-z0-9_]+", "-", plain).strip("-_")[:_LONGEST].strip("-_")
