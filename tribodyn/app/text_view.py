"""The scenario as text beside the form, its messages with lines, and remedies that a button takes."""

import asyncio
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from tribodyn.app.core.document import Document
from tribodyn.app.core.offers.lines import line_of
from tribodyn.app.core.offers.remedies import Remedy, remedies_of
from tribodyn.app.parts import MOST_TEXT, MessagesPart, TextPart
from tribodyn.app.window import DesignWindow
from tribodyn.errors import InputError


class TextView:
    """Text and messages of a window's scenario.

    Parameters
    ----------
    window
        Whose scenario is shown.
    go
        Shows a field of the form.
    complain
        Shows why something could not be done; None: it was done.
    """

    def __init__(
        self,
        window: DesignWindow,
        go: Callable[[str], Any],
        complain: Callable[[InputError | None], None],
    ) -> None:
        self.window, self.go, self.complain = window, go, complain
        self._shown: Document | None = None
        self.remedies: dict[str, tuple[Remedy, ...]] = {}
        self._tried = ""
        self._trying: asyncio.Task[None] | None = None
        self._taken = 0
        self.messages = MessagesPart()
        self.messages.tell(go=self._go, mend=self._mend)
        self.part = TextPart()
        self.part.tell(show=lambda said: self.show(bool(said["open"])), text=self._write)

    def show(self, is_open: bool) -> None:
        """Show the text in place of the form, or the form again."""
        if self.window.refused:
            self.window.refused = False
            self.bring_back()
        self.window.as_text = is_open
        self.window.show(["form"])

    def bring_back(self) -> None:
        """Show the text as it stands in place of one that was refused."""
        self.complain(None)
        self.part.run_method("put", self.window.document.text)

    def say(self, errors: Iterable[tuple[str, str, str]], known: Iterable[str]) -> None:
        """Show what is wrong; `known` are the keys of the form's fields."""
        errors, window, document = list(errors), self.window, self.window.document
        own = [(key, line) for key, line, _ in errors if line.startswith(f"{document.path}: ")]
        if document is not self._shown:
            self._shown = document
            # a broken one has no form
            window.as_text = window.as_text or any(key.startswith("line ") for key, _ in own)
        text = document.text if window.as_text else ""
        lines = {
            line: line_of(document.text, key)
            for key, line in own
            if window.as_text or key.startswith("line ")
        }
        said = [
            {
                "key": key if key in known else "",
                "text": line,
                "line": lines.get(line, 0),
                "remedies": [one.text for one in self.remedies.get(line, ())],
            }
            for key, line, _ in errors
        ]
        wrong = sorted(set(lines.values()) - {0})
        self.part.give(open=window.as_text, text=text, taken=self._taken, wrong=wrong)
        spoken = {
            name: [{"text": line, "old": old} for line, old in window.sentences(name).items()]
            for name in ("warnings", "remarks")
        }
        self.messages.give(errors=said, doubtful=window.doubtful, **spoken)
        if said and document.text != self._tried and (self._trying is None or self._trying.done()):
            self._trying = asyncio.create_task(self._try_remedies())

    async def _try_remedies(self) -> None:
        """Find remedies beside the page; each is tried, which takes a while."""
        while (document := self.window.document).text != self._tried and not self.window.closed:
            self._tried = document.text
            trial = Document(document.text, document.path)
            self.remedies = await asyncio.to_thread(remedies_of, trial)
        self.window.show(["late"])

    def _go(self, said: Mapping[str, Any]) -> None:
        line = int(said.get("line") or 0)
        if not line:
            self.go(str(said["path"]))
            return
        if not self.window.as_text:
            self.show(True)
        self.part.run_method("go", line)

    def _mend(self, said: Mapping[str, Any]) -> None:
        """Take a remedy of a message."""
        offered = self.remedies.get(str(said.get("text")), ())
        number = int(said.get("number", 0))
        if not 0 <= number < len(offered):
            return
        try:
            offered[number].take(self.window.document)
        except InputError as error:
            self.complain(error)
            return
        self.complain(None)
        self.window.changed(["form", "title"])

    def _write(self, said: Mapping[str, Any]) -> None:
        """Take the text as it was typed."""
        document, text = self.window.document, str(said.get("text", ""))
        if length := int(said.get("length") or 0):
            rule = f"has {length} characters, and the page takes {MOST_TEXT}"
            self.window.refused = True
            self.window.show(["title"])
            self.complain(InputError("text", None, rule, "save, edit the file elsewhere, and open it again"))
            return
        self._taken = int(said.get("number", 0))
        document.set_text(text)
        self.complain(None)
        self.window.changed(["form", "title"])
