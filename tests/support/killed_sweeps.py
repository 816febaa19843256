"""Sweeps that are stopped at any moment and go on: the same bits as one that was left alone."""

import random
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import h5py
import numpy as np

from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import WAITING

#: A moving error whose damping made the start of a steady state depend on the speed.
MOVING_ERROR = 'mesh.transmission_error={harmonics=[{order=1,amplitude="8 um",phase="90 deg"}]}'
#: What is swept -> words of the command line.
WAYS: dict[str, tuple[str, ...]] = {
    "steady": (),
    "followed": ("--direction", "both"),
    "transient": ("--transient", "40"),
}
#: Where -> words of the command line.
ENGINES: dict[str, tuple[str, ...]] = {
    "native 1": ("--workers", "1"),
    "native 2": ("--workers", "2"),
    "dask 1": ("--engine", "dask", "--workers", "1"),
    "dask 3": ("--engine", "dask", "--workers", "3"),
}
# Chunks of few cases: something lies between nothing and everything. Dask's workers import the main
# program too, without its arguments.
_SWEEP = (
    "from tribodyn.studies.motion import batch\nbatch.MOST_IN_CHUNK = {most_in_chunk}\n"
    "from tribodyn.cli import main\nif __name__ == '__main__':\n    main()\n"
)


def differences(first: Path, second: Path) -> list[str]:
    """Names of datasets that are not equal, bit for bit."""
    with h5py.File(first) as a, h5py.File(second) as b:
        names = {name for name in a if isinstance(a[name], h5py.Dataset)}
        if names != {name for name in b if isinstance(b[name], h5py.Dataset)}:
            return ["which datasets there are"]
        return [name for name in sorted(names) if a[name][...].tobytes() != b[name][...].tobytes()]  # pyright: ignore


def swept(words: Sequence[str], output: Path, most_in_chunk: int) -> None:
    """Run a sweep to its end in a process of its own."""
    command = _command(words, output, most_in_chunk)
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=output.parent)
    assert done.returncode == 0, done.stderr


def killed_until_done(words: Sequence[str], output: Path, most_in_chunk: int, draw: random.Random) -> int:
    """Run a sweep, kill it at a random moment, resume, until it ends by itself; return the kills."""
    kills, partial = 0, output.with_suffix(".partial.h5")
    while not output.exists():
        resume = ("--resume",) if partial.exists() else ()
        more = draw.randint(1, 12)
        before = _waiting(partial)
        process = subprocess.Popen(
            _command((*words, *resume), output, most_in_chunk),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            cwd=output.parent,
        )
        while process.poll() is None and (before is None or (_waiting(partial) or 0) > before - more):
            time.sleep(0.02)
            before = _waiting(partial) if before is None else before
        time.sleep(draw.uniform(0.0, 0.2))
        if process.poll() is None:
            process.kill()
        _, said = process.communicate()
        assert process.returncode in (0, -signal.SIGKILL), said.decode()
        kills += process.returncode != 0
    return kills


def _waiting(partial: Path) -> int | None:
    """Cases that wait; None before the record is laid out."""
    try:
        with SweepRecord(partial) as record:
            return int(np.sum(record["status"] == WAITING))
    except Exception:  # it is being made, or just concluded
        return None


def _command(words: Sequence[str], output: Path, most_in_chunk: int) -> list[str]:
    script = output.parent / "sweep_in_small_chunks.py"
    script.write_text(_SWEEP.format(most_in_chunk=most_in_chunk), encoding="utf-8")
    return [sys.executable, str(script), "sweep", *words, "-o", str(output)]
