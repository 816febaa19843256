"""What `tribodyn run` takes as a process, relative to other processes in the same run.

python -m tools.time_from_start --into docs/measurements.md

Processor time of whole processes, the minimum of several. The others are a start of Python with the libraries
that a run stands on, and a loop of additions in pure Python.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from tempfile import TemporaryDirectory

from tools.marked_block import generate, measured_on, parser_of, spent, table

PICTURE = [sys.executable, "-m", "tribodyn", "run", "crc-23-47", "--force"]
RUN = [*PICTURE, "--no-plot"]
LIBRARIES = [sys.executable, "-c", "import numpy, h5py, pydantic"]
LOOP = [sys.executable, "-c", "x = 0\nfor i in range(10_000_000):\n    x += i"]
COMMANDS = {"run": RUN, "picture": PICTURE, "libraries": LIBRARIES, "loop": LOOP}


def times_of(command: list[str], folder: Path, **variables: str) -> tuple[float, float]:
    """Seconds of processor time and by the clock of a command, with Python's bytecode kept as usual."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    given = {"cwd": folder, "env": environment | variables, "stdout": subprocess.DEVNULL}
    before = getrusage(RUSAGE_CHILDREN)  # finer than os.times, whose ticks are a tenth of the shortest start
    clock, _ = spent(lambda: subprocess.run(command, check=True, **given))
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, clock


def least(folder: Path, repeats: int) -> dict[str, tuple[float, float]]:
    """Minimum processor time and time by the clock of each of `COMMANDS`, which take turns."""
    times = {name: [] for name in COMMANDS}
    for _ in range(repeats):
        for name, command in COMMANDS.items():
            times[name].append(times_of(command, folder))
    return {name: (min(p for p, _ in of), min(clock for _, clock in of)) for name, of in times.items()}


def start(given: argparse.Namespace) -> str:
    """Table of the page."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        times_of(PICTURE, folder)  # compiles, and fills the caches
        found = least(folder, given.repeats)
        empty = folder / "cache"
        first = times_of(RUN, folder, TRIBODYN_CACHE=str(empty))
    libraries, loop = found["libraries"][0], found["loop"][0]
    head = ["", "s of processor time", "s by the clock", "over `import numpy, h5py, pydantic`"]
    head += ["over 10^7 additions in pure Python"]
    runs = {"kernel compiled before": found["run"], "with its picture": found["picture"], "first run": first}
    rows = [
        [name, f"{p:.2f}", f"{clock:.2f}", f"{p / libraries:.2g}", f"{p / loop:.2g}"]
        for name, (p, clock) in runs.items()
    ]
    return f"{table(head, rows, 'lrrrr')}\n\n{measured_on()}; minima of {given.repeats}."


if __name__ == "__main__":
    parser = parser_of(__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    generate(__doc__, parser=parser, start=start)
