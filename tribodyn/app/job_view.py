"""Longer work from the page: what is asked for it, how far it is, and its results."""

from collections.abc import Callable, Mapping
from typing import Any

from nicegui import ui

from tribodyn.app.core.document import Document
from tribodyn.app.core.form import form_of
from tribodyn.app.folder import measured_endings
from tribodyn.app.kept import KeptWork
from tribodyn.app.parts import JobsPart, PageDialog
from tribodyn.app.tasks import TASKS, TaskRun, refusals_of
from tribodyn.app.window import DesignWindow
from tribodyn.errors import InputError, OutputError, quoted

#: How often progress is looked at, s; lines of output that are shown.
_EACH, _LINES = 0.5, 60
#: Fields that may be varied.
_NUMBERS = ("quantity", "number", "whole")
#: Results that the page links to.
_PAGES = (".html", ".png", ".svg")


class JobsDialog:
    """Starts work in the folder, shows how far it is, ends it, links to its reports."""

    def __init__(self, window: DesignWindow, address: str, kept: KeptWork, say: Callable[[str], Any]) -> None:
        self.window, self.address, self.kept, self.say = window, address, kept, say
        self.inputs: dict[str, ui.input] = {}
        self.kind, self.task = "", ""  # of the study, and what was asked for, when it was open last
        self.dialog: PageDialog | None = None
        self.timer = ui.timer(_EACH, self._show, active=False)

    def open(self) -> None:
        """Show the dialog, with what suits this kind of study; it is made anew, as others of the page are."""
        if self.dialog is not None:
            self.dialog.delete()
        kind, before = self.window.document.kind, self.kind
        refusals, self.kind = refusals_of(kind), kind
        suitable = [name for name, reason in refusals.items() if not reason]
        if kind != before or self.task not in suitable:
            self.task = suitable[0]
        with PageDialog("Run") as self.dialog, ui.card().classes("tb-dialog"):
            ui.label("Run").classes("tb-title").props("role=heading aria-level=2")
            ui.label("It reads the saved file, runs beside this page and writes into its folder.")
            choice = ui.select(suitable, value=self.task, label="What").classes("tb-wide-input")
            choice.on_value_change(lambda chosen: self._ask(chosen.value))
            if others := [f"{name}: {reason}." for name, reason in refusals.items() if reason]:
                ui.label(" ".join(["Not here:", *others])).classes("tb-quiet")
            self.asked = ui.column().classes("tb-wide-input")
            self.wrong = ui.label().classes("tb-error tb-room").props("role=alert")
            with ui.element("p").classes("tb-choice"):
                ui.button("Start", color=None, on_click=self._start).props("no-caps unelevated")
                ui.button("Close", color=None, on_click=self.dialog.close).props("no-caps flat")
            self.part = JobsPart()
            self.part.tell(cancel=self._cancel, resume=self._go_on, open=self._open)
        self._ask(self.task)
        self.timer.activate()

    def _ask(self, task: str) -> None:
        """Ask what a task takes."""
        self.task, self.wrong.text = task, ""
        self.asked.clear()
        with self.asked:
            self.inputs = {
                key: ui.input(
                    label.rstrip("?"),
                    placeholder=example,
                    autocomplete=_KNOWN[key](self) if key in _KNOWN else None,
                )
                .props("stack-label")
                .classes("tb-wide-input")
                for key, (label, example) in TASKS[task].asks.items()
            }

    def _numbers(self) -> list[str]:
        """Keys of the scenario's numbers."""
        fields = [field for group in form_of(self.window.document) for field in group.fields]
        return [field.path for field in fields if field.kind in _NUMBERS]

    def _measured(self) -> list[str]:
        """Files of the folder that may hold a measured gear."""
        return self.window.folder.listed(measured_endings())

    def _gears(self) -> list[str]:
        """Names of the gears."""
        gears = self.window.document.value("gear")
        return list(gears) if isinstance(gears, Mapping) else ["pinion", "gear"]

    def _start(self) -> None:
        document, folder = self.window.document, self.window.folder
        try:
            if not folder.holds(document.path):
                raise InputError("file", None, "this scenario is not saved in the folder", "save it first")
            if document.unsaved:
                document.save()
                self.window.show(["title", "form"])
            task = TASKS[self.task]
            given = {key: str(entry.value or "") for key, entry in self.inputs.items()}
            if given.get("file"):
                given["file"] = folder.named(folder.file(given["file"], measured_endings()))
            if given.get("name"):
                given["name"] = folder.named(folder.new_file(given["name"], ".toml"))
            steps = task.steps(folder.named(document.path), given)
            title = f"{self.task} of {folder.named(document.path).removesuffix('.toml')}"
            self._refuse_running(title)
            self.kept.begin(TaskRun(title, steps, folder.root))
        except (InputError, OutputError, OSError) as error:
            self.wrong.text = str(error)
            return
        self._follow()

    def _refuse_running(self, title: str) -> None:
        if any(one.title == title and one.state == "running" for one in self.kept.tasks):
            raise InputError("What", quoted(title), "is running", "wait for its end, or cancel it")

    def _follow(self) -> None:
        """Show how far tasks are until all are over."""
        self.wrong.text = ""
        self.timer.activate()
        self._show()

    def _cancel(self, said: Mapping[str, Any]) -> None:
        for task in self.kept.tasks:
            if task.number == said.get("number"):
                task.cancel()
        self._show()

    def _go_on(self, said: Mapping[str, Any]) -> None:
        """Go on with a task that was ended."""
        try:
            for task in self.kept.tasks:
                if task.number == said.get("number") and task.can_go_on:
                    self._refuse_running(task.title)
                    task.go_on()
        except (InputError, OSError) as error:
            self.wrong.text = str(error)
            return
        self._follow()

    def _open(self, said: Mapping[str, Any]) -> None:
        """Open a scenario that a task has written."""
        folder = self.window.folder
        try:
            self.window.open(Document.open(folder.file(str(said.get("name")), [".toml"])))
        except InputError as error:
            self.wrong.text = str(error)
            return
        if self.dialog is not None:
            self.dialog.close()

    def _show(self) -> None:
        drawn = list(map(self._drawn, self.kept.tasks))
        self.part.give(jobs=drawn)
        # as they were drawn: one may have ended since
        if all(task["state"] != "running" for task in drawn):
            self.timer.deactivate()

    def _drawn(self, job: TaskRun) -> dict[str, Any]:
        folder = self.window.folder
        pages = [file for file in job.files if file.suffix in _PAGES and folder.holds(file)]
        return {
            "number": job.number,
            "title": job.title,
            "state": job.state,
            "ending": job.ending,
            "resumable": job.can_go_on,
            "fraction": job.fraction,
            "said": job.said,
            "output": "\n".join(job.output.splitlines()[-_LINES:]) if job.state != "running" else "",
            "files": [
                {"name": folder.named(file), "link": f"{self.address}files/{folder.named(file)}"}
                for file in pages
            ],
            "records": [folder.named(file) for file in job.files if file.suffix == ".h5"],
            "scenarios": [folder.named(file) for file in job.files if file.suffix == ".toml"],
        }


#: What is asked for -> what there is to choose from.
_KNOWN = {"key": JobsDialog._numbers, "file": JobsDialog._measured, "gear": JobsDialog._gears}
