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
from tempfile import TemporaryDirectory
from time import perf_counter

from tools.machine import measured_on
from tools.marked_block import put

PICTURE = [sys.executable, "-m", "tribodyn", "run", "crc-23-47", "--force"]
RUN = [*PICTURE, "--no-plot"]
LIBRARIES = [sys.executable, "-c", "import numpy, h5py, pydantic"]
LOOP = [sys.executable, "-c", "x = 0\nfor i in range(10_000_000):\n    x += i"]
COMMANDS = {"run": RUN, "picture": PICTURE, "libraries": LIBRARIES, "loop": LOOP}


def times_of(command: list[str], folder: Path, **variables: str) -> tuple[float, float]:
    """Seconds of processor time and by the clock of a command, with Python's bytecode kept as usual."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    before, begun = os.times(), perf_counter()
    subprocess.run(command, cwd=folder, env=environment | variables, check=True, stdout=subprocess.DEVNULL)
    after, ended = os.times(), perf_counter()
    processor = after.children_user + after.children_system - before.children_user - before.children_system
    return processor, ended - begun


def least(folder: Path, repeats: int) -> dict[str, tuple[float, float]]:
    """Minimum processor time and time by the clock of each of `COMMANDS`, which take turns."""
    times = {name: [] for name in COMMANDS}
    for _ in range(repeats):
        for name, command in COMMANDS.items():
            times[name].append(times_of(command, folder))
    return {name: (min(one[0] for one in of), min(one[1] for one in of)) for name, of in times.items()}


def table(repeats: int) -> str:
    """Table of the page."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        times_of(PICTURE, folder)  # compiles, and fills the caches
        found = least(folder, repeats)
        empty = folder / "cache"
        first = times_of(RUN, folder, TRIBODYN_CACHE=str(empty))
    libraries, loop = found["libraries"][0], found["loop"][0]
    rows = [
        "| | s of processor time | s by the clock | over `import numpy, h5py, pydantic` "
        "| over 10^7 additions in pure Python |",
        "|---|--:|--:|--:|--:|",
    ]
    runs = {"kernel compiled before": found["run"], "with its picture": found["picture"], "first run": first}
    for said, (processor, clock) in runs.items():
        ratios = f"{processor / libraries:.2g} | {processor / loop:.2g}"
        rows.append(f"| {said} | {processor:.2f} | {clock:.2f} | {ratios} |")
    return "\n".join([*rows, "", f"{measured_on()}; minima of {repeats}."])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--into", type=Path, help="page whose marked block `start` receives the table")
    parser.add_argument("--repeats", type=int, default=5)
    chosen = parser.parse_args()
    text = table(chosen.repeats)
    print(f"\n{text}\n")
    if chosen.into:
        put(chosen.into, "start", text)


if __name__ == "__main__":
    main()
