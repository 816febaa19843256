"""What is wrong with a scenario that is being edited, in the words of the command line, key by key."""

import copy
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from tribodyn.errors import InputError, InputErrors
from tribodyn.input.messages import Origins
from tribodyn.input.resolve import Resolved, resolve_table
from tribodyn.input.sources import toml_of
from tribodyn.studies.protocol.load import SoundScenario, sound, table_of


class Message(NamedTuple):
    """One thing that is wrong."""

    key: str  # dotted; of a text that is no TOML the line
    text: str  # the whole line of the command line
    value: str = ""  # what was given
    rule: str = ""  # what is wrong with it
    remedy: str = ""  # what to write instead
    file: str = ""  # that the value stands in

    @property
    def short(self) -> str:
        """What to say beside the field."""
        return f"{self.rule}; {self.remedy}" if self.remedy else self.rule

    @classmethod
    def each(cls, error: Exception | None) -> "tuple[Message, ...]":
        """The mistakes of an error, one message each; of one that is no InputError its text."""
        if error is None:
            return ()
        if isinstance(error, InputErrors):
            return tuple(message for one in error.errors for message in cls.each(one))
        if not isinstance(error, InputError):
            return (cls("", str(error), rule=str(error)),)
        value = "" if error.value is None else str(error.value)
        return (cls(error.key, str(error), value, error.rule, error.remedy, error.file),)


class TextFindings(NamedTuple):
    """A scenario's data with everything that they name, what is wrong with them, and else its tables."""

    resolved: Resolved
    error: InputError | None
    sound: SoundScenario | None


def data_of(text: str, path: Path) -> tuple[dict[str, Any], InputError | None]:
    """The data of a scenario's text, and why it is no TOML."""
    try:
        return toml_of(text, path), None
    except InputError as error:
        return {}, error


def findings(written: Mapping[str, Any], path: Path) -> TextFindings:
    """Hold a scenario's data against schema and rules; what they name is looked for as from a file there."""
    try:
        resolved = resolve_table(copy.deepcopy(dict(written)), path, {}, table_of)
    except InputError as error:  # of a scenario within this one
        return TextFindings(Resolved(dict(written), Origins(str(path)), [error]), error, None)
    try:
        found = sound(Resolved(copy.deepcopy(resolved.data), *resolved[1:]), path)
    except InputError as error:
        return TextFindings(resolved, error, None)
    return TextFindings(resolved, None, found)
