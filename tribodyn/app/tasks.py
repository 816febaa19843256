"""Longer work from the page as verbs of the command line: a run, a sweep, a search, a map, an import."""

import itertools
import re
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from tribodyn.app.core.job import Job, State
from tribodyn.errors import InputError
from tribodyn.studies import DEFAULT, STUDIES

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
        if self.verb == "import":
            made = f"{(values['name'] or f'{name}-measured').removesuffix('.toml')}.toml"
            return [
                ["import", f"./{values['file']}", "--into", file, "--gear", values["gear"], "-o", f"./{made}"]
            ]
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
    "Measured gear": VerbTask(
        "import",
        {
            "file": ("File", "pinion.gde"),
            "gear": ("Gear", "pinion"),
            "name": ("New scenario?", "mine-measured"),
        },
    ),
}


def refusals_of(kind: str) -> dict[str, str]:
    """Why a kind of study has a task not, by the task's name; "": it has it. The study's own comes first."""
    study = STUDIES[kind if kind in STUDIES else DEFAULT]
    verb, gears = study.verb, study.mounted_gears() is not None
    is_map = study.losses() is not None or verb == "map"
    made = {"assess": "is assessed, not run", "map": "is a map already"}
    found = {
        "Run": "" if verb == "run" else f"a scenario of kind {kind} {made.get(verb, f'has the verb {verb}')}",
        "Sweep": "" if study.swept() else f"nothing that kind {kind} computes is kept by sweeps",
        "Search": "" if study.swept() or study.kind == "design" else f"kind {kind} has nothing to search by",
        "Assessment": "" if verb == "assess" else "of scenarios of the kinds assessment and train-assessment",
        "Map of losses": "" if is_map else "of gear pairs and trains, and of kind map",
        "Measured gear": "" if gears else "of gear pairs and trains",
    }
    return dict(sorted(found.items(), key=lambda one: TASKS[one[0]].verb != verb))


_NUMBERS = itertools.count(1)
#: The line in which a verb that was ended says that its record can go on.
_GOES_ON = re.compile(r"\bgoes on$", re.MULTILINE)


class TaskRun:
    """Verbs that run in a folder one after the other, until one fails or all are done."""

    def __init__(self, title: str, steps: Sequence[Words], folder: Path) -> None:
        self.title, self.folder, self.number = title, folder, next(_NUMBERS)
        self._steps = [list(words) for words in steps]
        self._jobs: list[Job] = []
        self._begin()

    def _begin(self) -> None:
        self.ending = False
        self._begin_next()
        threading.Thread(target=self._follow, daemon=True).start()

    def _begin_next(self) -> None:
        verb, *words = self._steps[len(self._jobs)]
        self._jobs.append(Job(verb, words, self.folder))

    def _follow(self) -> None:
        """Begin each verb when the one before it is done, whether a page looks or not."""
        while self._jobs[-1].wait() and self._has_more():
            self._begin_next()

    def _has_more(self) -> bool:
        return self._jobs[-1].state == "done" and len(self._jobs) < len(self._steps) and not self.ending

    @property
    def state(self) -> State:
        """How it stands."""
        return "running" if self._has_more() else self._jobs[-1].state

    @property
    def can_go_on(self) -> bool:
        """Whether it was ended, and what it has done so far need not be done again."""
        return self.state in ("cancelled", "failed") and bool(_GOES_ON.search(self._jobs[-1].output))

    @property
    def fraction(self) -> float | None:
        """Share that is done; None where the verb does not say it."""
        last = self._jobs[-1].fraction
        return None if last is None else (len(self._jobs) - 1 + last) / len(self._steps)

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
        """End it; the verb has a while to conclude its record."""
        self.ending = True
        self._jobs[-1].cancel()

    def go_on(self) -> None:
        """Go on from what was done before it was ended."""
        words = self._steps[len(self._jobs) - 1]
        words[:] = ["--resume" if word == "--force" else word for word in words]
        del self._jobs[-1]
        self._begin()
