"""An open scenario: its text with comments, edited key by key, with undo, variants and a link that holds it.

A value that stands in a model's file is changed in the scenario: ``drive = "spur-25-51"`` becomes a table
that is `like` the model and says what differs.
"""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import tomlkit

from tribodyn.app.core.link import packed, unpacked
from tribodyn.app.core.messages import Message, data_of, findings
from tribodyn.errors import InputError, quoted
from tribodyn.input import sources
from tribodyn.input.edit import Models, put, table_added, taken_out, with_values, written_out
from tribodyn.input.messages import Key, value_at
from tribodyn.input.names import key_in
from tribodyn.input.quantity import LIKE, defaults_written_out
from tribodyn.input.resolve import Resolved, resolve_table, toml_value
from tribodyn.input.schema import expanded, references
from tribodyn.numerics.files.output_files import write_output
from tribodyn.studies import DEFAULT, handed_over
from tribodyn.studies.protocol.load import filled, table_of

#: States that undo goes back to, at most; older ones are forgotten.
MOST_STATES = 500
#: Where a value that no file says is from.
BY_DEFAULT = "default"


@dataclass(frozen=True)
class Variant:
    """A state that is kept to compare with."""

    name: str
    text: str


class _State(NamedTuple):
    """A text in the history, and the key whose dragging made it; "": none."""

    text: str
    dragged: str = ""


class Document:
    """An open scenario.

    Parameters
    ----------
    text : of the file, TOML; a broken one is kept too, and said by `messages`
    path : where the file lies, or is to lie: what it names is looked for from there
    saved : whether the text stands in that file
    """

    def __init__(self, text: str, path: Path, *, saved: bool = False) -> None:
        self.path = path
        self.variants: tuple[Variant, ...] = ()
        self._states, self._at = [_State(text)], 0
        self._saved = text if saved else None

    @classmethod
    def open(cls, name: str | Path) -> "Document":
        """Open a file, one of another program too, or a shipped scenario; InputError where that fails."""
        path = sources.find_scenario(str(name))
        if path.suffix.lower() in ("", ".toml"):
            return cls(sources.read_text(path, sources.MOST_TOML), path, saved=True)
        return cls(handed_over.read_scenario(path).toml, path.with_suffix(".toml"))

    @classmethod
    def new(cls, kind: str, path: Path) -> "Document":
        """A commented scenario of a kind to begin with, as ``tribodyn init`` writes it; "": the usual one."""
        return cls(filled(kind or DEFAULT, path.stem), path)

    @classmethod
    def of_link(cls, link: str, folder: Path) -> "Document":
        """The document that a link holds, as a file of the folder; InputError where it is no such link."""
        name, texts = unpacked(link)
        path = sources.shipped("scenarios") / name
        own = name.startswith("./") or not path.is_file()
        document = cls(texts.pop("", ""), folder / name if own else path)
        document.variants = tuple(Variant(name, text) for name, text in texts.items())
        return document

    def copy(self) -> "Document":
        """Another one as this one is, with its history."""
        other = Document(self.text, self.path)
        other.variants, other._saved = self.variants, self._saved
        other._states, other._at = list(self._states), self._at
        return other

    def link(self, name: str = "") -> str:
        """Text and variants, compressed to characters that an address may have.

        `name` is that of the file in a folder, ``./sub/drive.toml``; without it a shipped one may be meant.
        """
        return packed(name or self.path.name, {"": self.text} | {one.name: one.text for one in self.variants})

    @property
    def text(self) -> str:
        """The text as it stands."""
        return self._states[self._at].text

    @property
    def unsaved(self) -> bool:
        """Whether the text differs from what was opened or saved last."""
        return self.text != self._saved

    @property
    def has_file(self) -> bool:
        """Whether it was opened from its file, or saved there."""
        return self._saved is not None

    @property
    def can_undo(self) -> bool:
        """Whether there is a state before this one."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether a state was undone."""
        return self._at + 1 < len(self._states)

    @property
    def kind(self) -> str:
        """The kind of study."""
        return str(self.written().get("kind", DEFAULT))

    @property
    def title(self) -> str:
        """What the scenario shows."""
        return str(self.written().get("title", ""))

    def written(self) -> dict[str, Any]:
        """What the file says; nothing where it is no TOML."""
        return self._read.written

    @property
    def resolved(self) -> Resolved:
        """What the file says with models, tables and defaults put in, and where each value is from."""
        return self._read.resolved

    def value(self, key: str) -> Any:
        """The value in effect as TOML has it: the file's, the model's or the default; None: there is none."""
        whole = self.resolved.data
        return value_at(whole, key_in(whole, key))

    def source(self, key: str) -> str:
        """Where the value is from: "" of this file, `BY_DEFAULT`, or the model's file."""
        written, whole = self.written(), self.resolved.data
        if value_at(written, key_in(written, key)) is not None:
            return ""
        place = key_in(whole, key)
        origin = self.resolved.origins.of(place)
        known = origin != str(self.path) and value_at(whole, place) is not None
        return origin if known else BY_DEFAULT

    def set(self, key: str, value: Any, *, drag: bool = False) -> None:
        """Give a key a value; a text is read as TOML where it is TOML, else taken as it stands.

        Changes of one key by dragging are undone together. Raises InputError where the key leads to no
        table; what is wrong with the value is said by `messages`.
        """
        value = toml_value(value) if isinstance(value, str) else value
        place = key_in(self.resolved.data, key)
        self._go_on(with_values(self._sound(), {place: value}, self._models()), key if drag else "")

    def set_text(self, text: str) -> None:
        """Replace the whole text, as from an editor."""
        self._go_on(text)

    def unset(self, key: str) -> None:
        """Write nothing at a key: the model's value or the default is in effect then."""
        changed = tomlkit.parse(self._sound())
        if taken_out(changed, key_in(self.written(), key)):
            self._go_on(tomlkit.dumps(changed))

    def append(self, key: str, table: Mapping[str, Any]) -> str:
        """Add a table to a list of tables, such as ``stage``; return its key, ``stage.2``.

        A list that a model has is written out, with the table behind it.
        """
        changed = tomlkit.parse(self._sound())
        place = key_in(self.resolved.data, key)
        written_out(changed, (*place, 0), self._models())
        if isinstance(value_at(changed, place), list):
            number = table_added(changed, place, table)
        else:
            put(changed, place, [dict(table)], self._models())
            number = 0
        self._go_on(tomlkit.dumps(changed))
        return f"{key}.{number}"

    def take_out(self, key: str) -> None:
        """Take out a table; of a list that a model has the others are written out."""
        changed = tomlkit.parse(self._sound())
        place = key_in(self.resolved.data, key)
        written_out(changed, place, self._models())
        if taken_out(changed, place):
            self._go_on(tomlkit.dumps(changed))

    def rows(self, key: str) -> list[Any]:
        """Tables of a list as they are written, here or in a model."""
        found = self._models().raw(key_in(self.resolved.data, key))
        return found if isinstance(found, list) else []

    def undo(self) -> bool:
        """Go back to the state before; False: there is none."""
        return self._move(-1)

    def redo(self) -> bool:
        """Go to the state that was undone; False: there is none."""
        return self._move(1)

    def messages(self) -> tuple[Message, ...]:
        """What is wrong with the scenario, in the words of the command line; laws are not chosen for it."""
        return self._read.messages

    def pin(self, name: str = "") -> Variant:
        """Keep this state to compare with, under a name; one of that name is replaced."""
        name = name or f"variant {1 + len(self.variants)}"
        variant = Variant(name, self.text)
        self.variants = (*(one for one in self.variants if one.name != name), variant)
        return variant

    def unpin(self, name: str) -> None:
        """Forget a variant."""
        self.variants = tuple(one for one in self.variants if one.name != name)

    def restore(self, name: str) -> None:
        """Go on from a variant; can be undone."""
        variant = next((one for one in self.variants if one.name == name), None)
        if variant is None:
            rule = f"there is: {', '.join(one.name for one in self.variants) or 'none'}"
            raise InputError("variant", quoted(name), "no such variant", rule)
        self._go_on(variant.text)

    def save(self, path: Path | None = None, *, force: bool = False) -> Path:
        """Write the file and return its path; files that it names beside itself are named from there.

        A file that is there is replaced where it is the document's own and nobody has changed it meanwhile,
        or by `force`. InputError else, and for a file of the package; OutputError where there is no room.
        """
        target = path or self.path
        if sources.is_shipped(target):
            rule = "a scenario of the package"
            raise InputError("output", quoted(str(target)), rule, "save it in a folder of your own")
        text = self.text
        if target.parent.resolve() != self.path.parent.resolve():
            text = self._named_from(target)
        own = self.has_file and target.resolve() == self.path.resolve()
        if own and not force and self._changed_by_others():
            rule, remedy = (
                "was changed elsewhere since it was opened",
                "save it under another name, or open it",
            )
            raise InputError("output", quoted(str(target)), rule, remedy)
        write_output(target, sources.laid_out_like(self.path, text), force=force or own)
        self.path = target
        if text != self.text:
            self._go_on(text)
        self._saved = text
        self.__dict__.pop("_read", None)
        return target

    def _changed_by_others(self) -> bool:
        try:
            return sources.read_text(self.path, sources.MOST_TOML) != self._saved
        except InputError:
            return sources.is_file(self.path)

    def _named_from(self, target: Path) -> str:
        """The text with the files that it names by paths, named from another file."""
        if self._read.broken:
            return self.text
        names: dict[Key, str] = {}
        written = self.written()
        for pattern in references(table_of(written)):
            for key in expanded(pattern, written):
                for place in (key, (*key, LIKE)):
                    name = value_at(written, place)
                    file = self.path.parent / name if isinstance(name, str) else None
                    if file is None or not file.is_file() or Path(name).is_absolute():
                        continue
                    named = os.path.relpath(file.resolve(), target.parent.resolve())
                    names[place] = Path(named).as_posix()
        return with_values(self.text, names, self._models())

    def _models(self) -> Models:
        data = defaults_written_out(self.written(), table_of(self.written()))
        return Models(data, table_of(self.resolved.data), self.path)  # of scenarios within this one, too

    def _sound(self) -> str:
        """The text; InputError where it is no TOML."""
        if self._read.broken:
            raise self._read.broken
        return self.text

    def _go_on(self, text: str, dragged: str = "") -> None:
        """Add a state behind the present one, or put it in its place while one key is dragged."""
        now = self._states[self._at]
        if text == now.text:
            if not dragged:  # what is dragged from now on is a step of its own
                self._states[self._at] = _State(text)
            return
        kept = self._states[: self._at + (not dragged or now.dragged != dragged)]
        self._states = [*kept, _State(text, dragged)][-MOST_STATES:]
        self._at = len(self._states) - 1
        self.__dict__.pop("_read", None)

    def _move(self, by: int) -> bool:
        if not 0 <= self._at + by < len(self._states):
            return False
        self._at += by
        self.__dict__.pop("_read", None)
        return True

    @cached_property
    def _read(self) -> "_Read":
        """What the text says, read once."""
        written, broken = data_of(self.text, self.path)
        found = findings(written, self.path) if broken is None else None
        if found is None:
            return _Read({}, resolve_table({}, self.path, {}, table_of), Message.each(broken), broken)
        return _Read(written, found.resolved, Message.each(found.error), None)


class _Read(NamedTuple):
    """A text as it was read."""

    written: dict[str, Any]
    resolved: Resolved
    messages: tuple[Message, ...]
    broken: InputError | None
