"""Longer work from the page: a run, a sweep, a search, an assessment or a map as the command line's verbs."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from nicegui import ui

from tribodyn.app.core.job import Job
from tribodyn.app.parts import JobsPart
from tribodyn.app.window import Window
from tribodyn.errors import InputError, OutputError

#: How often progress is looked at, s; lines of output that are shown.
_EACH, _LINES = 0.5, 60
#: Results that the page links to.
_PAGES = (".html", ".png", ".svg")


class Task(NamedTuple):
    """A verb, and what it has to be told; each as label and an example of the value."""

    verb: str
    asks: dict[str, tuple[str, str]]

    def words(self, file: str, given: Mapping[str, str]) -> list[str]:
        """Words behind the verb; InputError where one is missing."""
        name = Path(file).stem
        for key, (label, _) in self.asks.items():
            if not given.get(key, "").strip() and not label.endswith("?"):
                raise InputError(label, None, "is missing", "fill it in")
        values = {key: given.get(key, "").strip() for key in self.asks}
        if self.verb == "assess":
            return [file, "-o", f"{name}-assessment", "--force"]
        words = [file, "-o", f"{name}-{self.verb}.h5", "--force", "--report"]
        if self.verb == "sweep":
            words += ["--vary", f"{values['key']}={values['values']}"]
        if self.verb == "design" and values["key"]:
            words += ["--free", f"{values['key']}={values['values']}", "--minimise", values["quantity"]]
            words += ["--evaluations", values["evaluations"] or "40"]
        for option in ("torque", "speed"):
            if values.get(option):
                words += [f"--{option}", values[option]]
        return words


_KEY = ("Key", "drive.pinion.modification.tip_relief")
TASKS = {
    "Run": Task("run", {}),
    "Sweep": Task("sweep", {"key": _KEY, "values": ("Values", "0:20:4um")}),
    "Search": Task(
        "design",
        {
            "key": _KEY,
            "values": ("From and to", "0:30um"),
            "quantity": ("Minimise", "loaded_transmission_error"),
            "evaluations": ("Evaluations?", "40"),
        },
    ),
    "Assessment": Task("assess", {}),
    "Map of losses": Task(
        "map", {"torque": ("Torques?", "0:500:100N*m"), "speed": ("Speeds?", "500:3000:500rpm")}
    ),
}


class JobsDialog:
    """Starts work in the folder, shows how far it is, ends it, links to its reports."""

    def __init__(self, window: Window, address: str, say: Callable[[str], Any]) -> None:
        self.window, self.address, self.say = window, address, say
        self.jobs: list[tuple[str, Job]] = []
        self.inputs: dict[str, ui.input] = {}
        with ui.dialog().props('aria-label="Run"') as self.dialog, ui.card().classes("tb-dialog"):
            ui.label("Run").classes("tb-title").props("role=heading aria-level=2")
            ui.label("It reads the saved file, runs beside this page and writes into its folder.")
            self.choice = ui.select(list(TASKS), value="Run", label="What").classes("tb-wide-input")
            self.choice.on_value_change(lambda _: self._ask())
            self.asked = ui.column().classes("tb-wide-input")
            self.wrong = ui.label().classes("tb-error").props("role=alert")
            with ui.element("p").classes("tb-choice"):
                ui.button("Start", color=None, on_click=self._start).props("no-caps unelevated")
                ui.button("Close", color=None, on_click=self.dialog.close).props("no-caps flat")
            self.part = JobsPart()
            self.part.tell(cancel=self._cancel)
        self.timer = ui.timer(_EACH, self._show, active=False)

    def open(self) -> None:
        """Show the dialog."""
        self._ask()
        self.dialog.open()

    def close(self) -> None:
        """End what runs."""
        for _, job in self.jobs:
            if job.state == "running":
                job.cancel()

    def _ask(self) -> None:
        self.wrong.text = ""
        self.asked.clear()
        with self.asked:
            self.inputs = {
                key: ui.input(label.rstrip("?"), placeholder=example).classes("tb-wide-input")
                for key, (label, example) in TASKS[self.choice.value].asks.items()
            }

    def _start(self) -> None:
        document, folder = self.window.document, self.window.folder
        try:
            if not folder.holds(document.path):
                raise InputError("file", None, "this scenario is not saved in the folder", "save it first")
            if document.unsaved:
                document.save()
                self.window.show(["title", "form"])
            task = TASKS[self.choice.value]
            given = {key: str(entry.value or "") for key, entry in self.inputs.items()}
            words = task.words(folder.named(document.path), given)
            self.jobs.insert(
                0, (f"{self.choice.value} of {document.path.stem}", Job(task.verb, words, folder.root))
            )
        except (InputError, OutputError, OSError) as error:
            self.wrong.text = str(error)
            return
        self.wrong.text = ""
        self.timer.activate()
        self._show()

    def _cancel(self, said: Mapping[str, Any]) -> None:
        number = len(self.jobs) - int(said.get("number", 0))
        if 0 <= number < len(self.jobs):
            self.jobs[number][1].cancel()
            self._show()

    def _show(self) -> None:
        count = len(self.jobs)
        self.part.give(jobs=[self._drawn(count - k, *each) for k, each in enumerate(self.jobs)])
        if all(job.state != "running" for _, job in self.jobs):
            self.timer.deactivate()

    def _drawn(self, number: int, title: str, job: Job) -> dict[str, Any]:
        folder = self.window.folder
        pages = [file for file in job.files if file.suffix in _PAGES and folder.holds(file)]
        return {
            "number": number,
            "title": title,
            "state": job.state,
            "fraction": job.fraction,
            "said": job.said,
            "output": "\n".join(job.output.splitlines()[-_LINES:]) if job.state != "running" else "",
            "files": [
                {"name": folder.named(file), "link": f"{self.address}files/{folder.named(file)}"}
                for file in pages
            ],
        }
