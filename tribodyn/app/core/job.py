"""A verb of the command line as a job: a process of its own with progress, which can be cancelled."""

import os
import runpy
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Literal

from tribodyn.numerics.processes import child
from tribodyn.post.progress import LINES, MARK

#: Seconds that a verb has to conclude its record once it is cancelled.
TO_CONCLUDE = 20.0
#: Characters that are kept of what a verb prints.
MOST_KEPT = 200_000
#: Endings of what verbs write.
RESULTS = (".h5", ".html", ".png", ".svg", ".toml", ".csv", ".txt", ".json", ".wav", ".step", ".glb", ".fmu")

State = Literal["running", "done", "failed", "cancelled"]


class Job:
    """A verb with its words that runs in a folder, as ``tribodyn VERB WORDS`` there."""

    def __init__(self, verb: str, words: Sequence[str], folder: Path) -> None:
        self.verb, self.folder = verb, folder
        self.words = tuple(words)
        self.state: State = "running"
        self.fraction: float | None = None  # done; None: it has not said so
        self.said = ""  # what it is at, or its last line
        self.status: int | None = None  # at its end, as of the command line
        self.files: tuple[Path, ...] = ()  # that it wrote or changed in the folder
        self._output = ""
        self._cancelled = False
        self._over = threading.Event()
        self._before = self._seen()
        self._process = child.start(
            f"{__name__}:serve", str(folder.resolve()), verb, *words, environment={LINES: "1"}
        )
        threading.Thread(target=self._listen, daemon=True).start()

    @property
    def output(self) -> str:
        """What it printed, messages included."""
        return self._output

    def cancel(self) -> None:
        """Let it conclude its record, and end it where it does not; returns at once."""
        if self.state == "running" and not self._cancelled:
            self._cancelled = True
            with suppress(OSError):
                self._process.terminate()
            threading.Thread(target=self._end_at_last, daemon=True).start()

    def wait(self, limit: float | None = None) -> bool:
        """Wait for its end; False: it goes on after so many seconds."""
        return self._over.wait(limit)

    def _end_at_last(self) -> None:
        if not self._over.wait(TO_CONCLUDE):
            child.end(self._process)

    def _listen(self) -> None:
        """Take in what it writes until its end."""
        assert self._process.stdout is not None
        with suppress(OSError, ValueError):
            for line in self._process.stdout:
                self._take(line.decode("utf-8", errors="replace").rstrip("\n"))
        self.status = self._process.wait()
        child.end(self._process)
        after = self._seen()
        self.files = tuple(file for file in sorted(after) if self._before.get(file) != after[file])
        done: State = "done" if self.status == 0 else "failed"
        self.state = "cancelled" if self._cancelled and self.status != 0 else done
        if self.state == "done":
            self.fraction = 1.0
        self._over.set()

    def _take(self, line: str) -> None:
        if line.startswith(MARK):
            share, _, self.said = line[len(MARK) :].strip().partition(" ")
            self.fraction = float(share)
            return
        self._output = (self._output + line + "\n")[-MOST_KEPT:]
        self.said = line.strip() or self.said

    def _seen(self) -> dict[Path, tuple[int, int]]:
        """Results in the folder: when they were changed, and their size."""
        found = {}
        for file in self.folder.iterdir():
            with suppress(OSError):
                if file.suffix in RESULTS and file.is_file():
                    about = file.stat()
                    found[file] = about.st_mtime_ns, about.st_size
        return found


def serve(folder: str, *words: str) -> None:
    """Run a verb in a folder; in the process of a job. What it says to people comes with its output."""
    os.dup2(1, 2)
    sys.stderr = open(2, "w", encoding="utf-8", errors="replace", buffering=1, closefd=False)
    os.chdir(folder)
    sys.argv = ["tribodyn", *words]
    runpy.run_module("tribodyn", run_name="__main__")
