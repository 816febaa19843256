"""What is done with the scenario as a whole: open, save, undo, pin, run, link."""

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import ui

from tribodyn.app.core.document import Document
from tribodyn.app.examples import EXAMPLES
from tribodyn.app.folder import measured_endings, scenario_endings
from tribodyn.app.job_view import JobsDialog
from tribodyn.app.kept import KeptWork
from tribodyn.app.parts import BarPart, BringPart, PageDialog, TourPart
from tribodyn.app.window import DesignWindow
from tribodyn.errors import InputError, OutputError, quoted
from tribodyn.input.sources import SCENARIOS, is_file, names, shipped

#: Characters of a state that the address of the page holds, of an address that a server takes, and of a word
#: of a command (of Linux, 128 KiB).
_LONGEST_STATE, _LONGEST_ADDRESS, _LONGEST_WORD = 30_000, 60_000, 130_000


class Bar:
    """The bar at the top and its dialogs.

    Parameters
    ----------
    window
        What the page works on.
    address
        Of the page.
    kept
        Documents that the browser goes back to.
    few
        Whether files, jobs and tour are left out.
    go
        Shows a field of the form.
    """

    def __init__(
        self,
        window: DesignWindow,
        address: str,
        kept: KeptWork,
        *,
        few: bool,
        go: Callable[[str], Any],
    ) -> None:
        self.window, self.address, self.kept, self.few, self.go = window, address, kept, few, go
        self._shown: Document | None = None
        self._key, self._linked = "", ()
        self._gone_back = self._as_text = False
        self.tour: TourPart | None = None
        self.part = BarPart()
        self.part.give(few=few)
        self.part.tell(act=self._act)
        self.jobs = None if few else JobsDialog(window, address, kept, self.say)

    def show(self) -> None:
        """Show the name, and what can be done."""
        document = self.window.document
        self.part.give(
            name=self.window.folder.named(document.path),
            unsaved=document.unsaved,
            undo=document.can_undo or self.window.refused,
            redo=document.can_redo,
        )
        if document is not self._shown:
            # of every document that was opened the browser's history has an entry
            is_new, self._shown = self._shown is not None and not self._gone_back, document
            self._key, self._gone_back = self.kept.keep(document), False
            self.part.run_method("keep", self._query(), is_new)
        elif self.window.as_text != self._as_text:
            self.part.run_method("keep", self._query(), False)
        self._as_text = self.window.as_text

    def keep_state(self) -> None:
        """Let the address hold the state, so that it outlives this server where it is short."""
        document = self.window.document
        state = document.path, document.text, document.variants
        if self._linked != state:
            self._linked = state
            self.part.run_method("keep", self._query(), False)

    def _query(self) -> str:
        link = self._link()
        state = f"state={link}&" if len(link) < _LONGEST_STATE else ""
        text = "&text=1" if self.window.as_text else ""
        return f"?{state}at={self._key}{text}{'&few=1' if self.few else ''}"

    def _link(self) -> str:
        document, folder = self.window.document, self.window.folder
        return document.link(f"./{folder.named(document.path)}" if folder.holds(document.path) else "")

    def _go_back(self, key: str) -> None:
        """Show the document that was open before, where the browser goes back to it, or forth again."""
        document = self.kept.copy(key)
        if document is None:
            self.say("This server does not keep that state any more.")
            return
        self._gone_back = True
        self.window.open(document)

    def busy(self, late: tuple[str, ...]) -> None:
        """Show what is being computed."""
        self.part.give(busy=list(late))

    def at_work(self, text: str) -> None:
        """Say what takes long."""
        self.part.give(work=text)

    def say(self, text: str) -> None:
        """Say what has been done, or why it was not."""
        self.part.run_method("say", text)

    def _act(self, said: Mapping[str, Any]) -> Any:
        actions = {
            "open": self._open,
            "undo": self._undo,
            "redo": lambda: self._step(self.window.document.redo()),
            "pin": self._pin,
            "save": self._save,
            "save-as": self._save_as,
            "link": self._show_link,
            "back": lambda: self._go_back(str(said.get("at", ""))),
            "jobs": lambda: self.jobs and self.jobs.open(),
            "tour": lambda: self.tour and self.tour.run_method("show", 0),
        }
        return actions.get(str(said.get("name")), lambda: None)()

    def _undo(self) -> None:
        """Take back a text that was refused, else what was changed last."""
        if self.window.refused:
            self.window.refused = False
            self.window.show(["text", "title"])
            return
        self._step(self.window.document.undo())

    def _step(self, moved: bool) -> None:
        if moved:
            self.window.changed(["form", "title"])

    def _pin(self) -> None:
        self.window.pin()
        self.say(f"Kept as {self.window.pinned_name}; what is changed now is drawn over it.")

    def _save(self) -> None:
        folder, path = self.window.folder, self.window.document.path
        if folder.holds(path):
            self._write(None)
        elif self.few:
            self._write(folder.new_file(path.name, ".toml"))
        else:
            self._save_as()

    def _write(self, path: Path | None, *, force: bool = False) -> str:
        """Save; why it was not saved, or nothing."""
        try:
            saved = self.window.document.save(path, force=force)
        except (InputError, OutputError) as error:
            self.say(str(error))
            return str(error)
        self.window.show(["title", "form"])
        self.say(f"Saved {self.window.folder.named(saved)}")
        return ""

    def _save_as(self) -> None:
        with PageDialog("Save as") as dialog, ui.card().classes("tb-dialog"):
            ui.label("Save as").classes("tb-title").props("role=heading aria-level=2")
            name = ui.input("Name in this folder", value=self.window.document.path.name).classes(
                "tb-wide-input"
            )
            replace = ui.checkbox("Replace a file of that name")
            wrong = ui.label().classes("tb-error").props("role=alert")

            def save() -> None:
                try:
                    path = self.window.folder.new_file(name.value or "", ".toml")
                    if is_file(path) and not replace.value:
                        rule, remedy = "is there already", "tick Replace, or choose another name"
                        raise InputError("file", quoted(path.name), rule, remedy)
                    wrong.text = self._write(path, force=bool(replace.value))
                except InputError as error:
                    wrong.text = str(error)
                if not wrong.text:
                    dialog.close()

            name.on("keydown.enter", save)
            with ui.element("p").classes("tb-choice"):
                ui.button("Save", color=None, on_click=save).props("no-caps unelevated")
                ui.button("Cancel", color=None, on_click=dialog.close).props("no-caps flat")

    def _show_link(self) -> None:
        address = f"{self.address}?state={self._link()}"
        what = "It opens here while the server runs; later, or on another machine: tribodyn app 'LINK'."
        if len(address) > _LONGEST_ADDRESS:
            what = "It is too long for an address. It opens by: tribodyn app 'LINK'."
        if len(address) > _LONGEST_WORD:
            what = "It is too long for an address and for a command: save the scenario, and pass the file on."
        with PageDialog("Link") as dialog, ui.card().classes("tb-dialog"):
            ui.label("Link").classes("tb-title").props("role=heading aria-level=2")
            ui.label(
                f"It holds this scenario and its variants. {what} It names no file of yours but this one."
            )
            text = ui.input("Link", value=address).props("readonly").classes("tb-wide-input")
            with ui.element("p").classes("tb-choice"):
                copy = ui.button("Copy", color=None).props("no-caps unelevated")
                copy.on_click(lambda: self.part.run_method("copy", text.value))
                ui.button("Close", color=None, on_click=dialog.close).props("no-caps flat")

    def _open(self) -> None:
        folder = self.window.folder
        endings = scenario_endings()
        with PageDialog("Open") as dialog, ui.card().classes("tb-dialog"):
            ui.label("Open").classes("tb-title").props("role=heading aria-level=2")
            wrong = ui.label().classes("tb-error").props("role=alert")
            if self.window.document.unsaved:
                shown = folder.named(self.window.document.path)
                ui.label(f"{shown} has changes that are not saved. The browser's Back brings them back.")

            def open_named(name: str, path: Path | str, field: str = "", hint: str = "") -> None:
                try:
                    self.window.open(Document.open(path))
                except InputError as error:
                    wrong.text = str(error)
                    return
                dialog.close()
                self.say(hint or f"Opened {name}")
                if field:
                    self.go(field)

            ui.label("Examples").classes("tb-title").props("role=heading aria-level=3")
            for one in EXAMPLES:
                with ui.element("p").classes("tb-choice"):
                    button = ui.button(one.task, color=None).props("no-caps outline")
                    button.on_click(partial(open_named, one.task, one.scenario, one.field, one.hint))
                    ui.label(one.hint)
            files = folder.listed(endings)
            ui.label("Files of this folder").classes("tb-title").props("role=heading aria-level=3")
            if not files:
                ui.label("There are none yet.")
            with ui.element("ul").classes("tb-files"):
                for name in files:
                    with ui.element("li"):
                        button = ui.button(name, color=None).props("no-caps flat dense")
                        button.on_click(partial(open_named, name, folder.file(name, endings)))

            def brought(name: str) -> None:
                if name.lower().endswith(tuple(endings)):
                    open_named(name, folder.file(name, endings))
                    return
                dialog.close()
                self.say(f"{name} lies in the folder now. Run … › Measured gear puts a gear into a scenario.")

            def refused(text: str) -> None:
                wrong.text = text

            bring = BringPart(self.address, [*endings, *measured_endings()])
            bring.tell(
                brought=lambda said: brought(str(said["text"])),
                refused=lambda said: refused(str(said["text"])),
            )
            ui.label("All shipped scenarios").classes("tb-title").props("role=heading aria-level=3")
            choice = ui.select(names(shipped(SCENARIOS)), label="Shipped scenario", with_input=True).classes(
                "tb-wide-input"
            )
            choice.on_value_change(lambda event: event.value and open_named(event.value, event.value))
            ui.button("Cancel", color=None, on_click=dialog.close).props("no-caps flat")
