"""Longer work from the page: a run, a sweep, a search, an assessment or a map as the command line's verbs."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from tribodyn.app.core.job import Job, State
from tribodyn.errors import InputError
from tribodyn.studies import STUDIES

Words = Sequence[str]
_KEY = ("Key", "drive.pinion.modification.tip_relief")


class VerbTask(NamedTuple):
    """A verb, and what it has to be told: label and example of each value. A label with ? may stay empty."""

    verb: str
    asks: dict[str, tuple[str, str]]

    def steps(self, file: str, given: Mapping[str, str]) -> list[list[str]]:
        """Words of the verbs to call, one after the other; InputError where a value is missing."""
        for key, (label, example) in self.asks.items():
            if not given.get(key, "").strip() and not label.endswith("?"):
                raise InputError(label, None, "is missing", f"write it like {example}")
        values = {key: given.get(key, "").strip() for key in self.asks}
        name = file.removesuffix(".toml").replace("/", "-").lstrip("-")
        file = f"./{file}"  # a name that begins with - is no option
        if self.verb == "assess":
            return [["assess", file, "-o", f"{name}-assessment", "--force"]]
        record = f"{name}-{self.verb}.h5"
        words = [self.verb, file, "-o", record, "--force"]
        if self.verb == "sweep":
            page = ["report", record, "-o", f"{name}-sweep.html", "--force"]
            return [[*words, "--vary", f"{values['key']}={values['values']}"], page]
        words.append("--report")
        if self.verb == "design":
            words += ["--free", f"{values['key']}={values['values']}", "--minimise", values["quantity"]]
            words += ["--evaluations", values["evaluations"] or "40"]
        for option in ("torque", "speed"):
            if values.get(option):
                words += [f"--{option}", values[option]]
        return [words]


TASKS = {
    "Run": VerbTask("run", {}),
    "Sweep": VerbTask("sweep", {"key": _KEY, "values": ("Values", "0:20:4um")}),
    "Search": VerbTask(
        "design",
        {
            "key": _KEY,
            "values": ("From and to", "0:30um"),
            "quantity": ("Minimise", "transmission_error_peak_to_peak"),
            "evaluations": ("Evaluations?", "40"),
        },
    ),
    "Assessment": VerbTask("assess", {}),
    "Map of losses": VerbTask(
        "map", {"torque": ("Torques?", "0:500:100N*m"), "speed": ("Speeds?", "500:3000:500rpm")}
    ),
}


def tasks_of(kind: str) -> list[str]:
    """Names of the tasks that a kind of study has: it is run or assessed, not both."""
    own = STUDIES[kind].verb if kind in STUDIES else "run"
    return [name for name, task in TASKS.items() if task.verb not in {"run", "assess"} - {own}]


class TaskRun:
    """Verbs that run in a folder one after the other, until one fails or all are done."""

    def __init__(self, title: str, steps: Sequence[Words], folder: Path) -> None:
        self.title, self.folder = title, folder
        self._left = [list(words) for words in steps]
        self._share = 1.0 / len(steps)
        self._jobs: list[Job] = []
        self._go_on()

    def _go_on(self) -> None:
        verb, *words = self._left.pop(0)
        self._jobs.append(Job(verb, words, self.folder))

    @property
    def state(self) -> State:
        """How it stands; begins the next verb where the one before it is done."""
        state = self._jobs[-1].state
        if state == "done" and self._left:
            self._go_on()
            return "running"
        return state

    @property
    def fraction(self) -> float | None:
        """Share that is done; None where the verb does not say it."""
        last = self._jobs[-1].fraction
        return None if last is None else self._share * (len(self._jobs) - 1 + last)

    @property
    def said(self) -> str:
        """What it is at, or its last line."""
        return self._jobs[-1].said

    @property
    def output(self) -> str:
        """What all verbs printed."""
        return "".join(job.output for job in self._jobs)

    @property
    def files(self) -> list[Path]:
        """What was written, those of a folder that a verb made too."""
        made = [self.folder / word for job in self._jobs for word in job.words]
        inside = [page for folder in made if folder.is_dir() for page in sorted(folder.glob("*.html"))]
        return list(dict.fromkeys([*(file for job in self._jobs for file in job.files), *inside]))

    def cancel(self) -> None:
        """End it."""
        self._left.clear()
        self._jobs[-1].cancel()
