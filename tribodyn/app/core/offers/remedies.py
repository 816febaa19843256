"""Remedies of messages that one key settles: offered where the message is gone with it."""

import re
from collections.abc import Iterator
from typing import NamedTuple

from tribodyn.app.core.document import Document
from tribodyn.errors import InputError

#: What a remedy says: a key with a value, or a key to leave out.
_VALUE = r'"[^"]*"|true|false|[+-]?\d[\d.]*(?:e[+-]?\d+)?'
_SETTING = re.compile(rf"\b([a-z_]\w*(?:\.\w+)*) = ({_VALUE})(?=[\s,;)]|$)")
_LEAVING = re.compile(r"\bleave (?:(it)|([a-z_]\w*(?:\.\w+)*)) out\b")
#: What a message says of a key that is missing: an example, choices, or that it is a text.
_EXAMPLE = re.compile(rf"add \w+ = (?:one of )?({_VALUE}|text)")
#: Messages for which remedies are looked for, and remedies of each.
MOST_MESSAGES, MOST_REMEDIES = 4, 3
#: How often what is wrong besides is put out of the way: one message may hide another.
_ROUNDS = 3


class Remedy(NamedTuple):
    """A key that is set, or taken out."""

    key: str
    value: str  # as it is written in TOML; "": it is taken out

    @property
    def text(self) -> str:
        """What a button says."""
        return f"Set {self.key} = {self.value}" if self.value else f"Leave {self.key} out"

    def take(self, document: Document) -> None:
        """Change the document so."""
        if self.value:
            document.set(self.key, self.value)
        else:
            document.unset(self.key)


def remedies_of(document: Document) -> dict[str, tuple[Remedy, ...]]:
    """Remedies of messages by their text, each tried: with it that message is gone, and no other has come.

    A value is also held against the rules that the other messages hide.
    """
    before = {one.text for one in document.messages()}

    def mends(remedy: Remedy, text: str) -> bool:
        trial = Document(document.text, document.path)
        try:
            remedy.take(trial)
        except InputError:
            return False
        if not {one.text for one in trial.messages()} <= before - {text}:
            return False
        return not remedy.value or _stands(trial, remedy.key)

    found = {}
    for message in document.messages()[:MOST_MESSAGES]:
        ways = list(_named(message.key, message.remedy, document))[:MOST_REMEDIES]
        first = (next((one for one in way if mends(one, message.text)), None) for way in ways)
        found[message.text] = tuple(one for one in first if one is not None)
    return found


def _stands(trial: Document, key: str) -> bool:
    """Whether the value of a key is not refused where what is wrong besides is put out of the way."""
    for _ in range(_ROUNDS):
        messages = trial.messages()
        if not messages:
            return True
        if any(one.key == key for one in messages):
            return False
        for one in messages:
            example = _EXAMPLE.match(one.remedy)
            try:
                trial.set(one.key, example[1]) if example else trial.unset(one.key)
            except InputError:
                return False
    return False


def _named(key: str, remedy: str, document: Document) -> Iterator[list[Remedy]]:
    """What a remedy names, each with the places that it may mean, the nearest to the message's key first."""

    def places(name: str) -> list[str]:
        above = key.split(".")
        near = [".".join([*above[:depth], name]) for depth in range(len(above), -1, -1)]
        beside = [
            f"{table}.{name}" for table, value in document.resolved.data.items() if isinstance(value, dict)
        ]
        return list(dict.fromkeys([*near, *beside]))

    if example := _EXAMPLE.match(remedy):
        if re.fullmatch(_VALUE, example[1]) and " one of " not in example[0]:
            yield [Remedy(key, example[1])]
        return
    for name, value in _SETTING.findall(remedy):
        yield [Remedy(place, value) for place in places(name)]
    for itself, name in _LEAVING.findall(remedy):
        yield [Remedy(place, "") for place in ([key] if itself else places(name))]
