"""A search that is killed leaves a valid record, and goes on from it to the same answer."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

import tribodyn as td
from tests.support.cheap_searches import SEARCHED
from tribodyn.studies.design.candidates.pool import Pool

# every submitted candidate is a line in a file, and takes a moment
COUNTED = (
    "import time\nfrom tribodyn.studies.design import run\n"
    "class Counted(run.Pool):\n"
    "    def submit(self, several):\n"
    "        with open(sys.argv[-1], 'a') as file: print(str(several), file=file)\n"
    "        time.sleep(0.03)\n"
    "        return super().submit(several)\n"
    "run.Pool = Counted\n"
)
PROGRAM = (
    "import sys\nCOUNTED\nfrom tribodyn.cli import main\n"
    "log = sys.argv.pop()\nsys.argv = ['tribodyn', 'run', *sys.argv[1:]]\n"
).replace("COUNTED", COUNTED.replace("sys.argv[-1]", "log")) + "main()\n"

NAMES = ("objective_start", "objective", "best", "evaluations")
SEARCH = f"""{SEARCHED}[design]
free = [
    {{ key = "drive.pinion.profile_shift", from = -0.2, to = 0.5 }},
    {{ key = "drive.gear.profile_shift", from = -0.2, to = 0.5 }},
]
minimise = "loss"
subject_to = ["contact_ratio >= 1.5"]
evaluations = 24
"""


def begun(folder: Path, name: str, *words: str) -> "subprocess.Popen[str]":
    """A search of its own process, its submitted candidates in NAME.log."""
    command = [sys.executable, "-c", PROGRAM, "search.toml", "-o", f"{name}.h5", "--json", "--no-plot"]
    return subprocess.Popen([*command, *words, f"{name}.log"], cwd=folder, stdout=subprocess.PIPE, text=True)


def lines(path: Path) -> list[str]:
    return path.read_text(encoding="utf-8").splitlines()


def written(partial: Path) -> int:
    try:
        with h5py.File(partial) as file:
            return int(file["samples_written"][()])  # pyright: ignore
    except (OSError, KeyError):
        return 0


def kept(partial: Path) -> int:
    """Evaluations that a record holds: candidates, the start on every resolution, what is about the best."""
    with h5py.File(partial) as file:
        starts = np.isfinite(file["start_figures"][:, 0]).any(axis=-1).sum()  # pyright: ignore
        moved = sum(np.isfinite(file[f"objective_{end}"][...]).sum() for end in ("lower", "upper"))  # pyright: ignore
    return written(partial) + int(starts + moved)


def rows(path: Path) -> np.ndarray:
    """Objective and free keys of every candidate, in an order of their own."""
    with h5py.File(path) as file:
        names = [name for name in file if str(name).startswith("free_")]
        table = np.stack([file[name][...] for name in (*names, "objective", "refinement")], axis=1)  # pyright: ignore
    return table[np.lexsort(table.T)]


@pytest.mark.soak
def test_a_killed_search_goes_on_to_the_same_answer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "search.toml").write_text(SEARCH, encoding="utf-8")
    submitted: list[str] = []

    class Counted(Pool):
        def submit(self, several: Any) -> Any:
            submitted.append(str(several))
            return super().submit(several)

    monkeypatch.setattr("tribodyn.studies.design.run.Pool", Counted)
    whole = td.design(tmp_path / "search.toml", output=tmp_path / "whole.h5")
    said = {name: getattr(whole, name) for name in NAMES}
    partial = tmp_path / "killed.partial.h5"
    going_on, finer = ("--resume",), said["evaluations"] + 1
    # killed thrice: what went on can be killed too, and the last stage
    for least, words in ((4, ()), (10, going_on), (finer, going_on)):
        process = begun(tmp_path, "killed", *words)
        started = time.monotonic()
        while written(partial) < least:
            assert process.poll() is None
            assert time.monotonic() - started < 300
            time.sleep(0.01)
        process.kill()
        process.communicate()
        assert process.returncode == -signal.SIGKILL
    left, asked = kept(partial), len(lines(tmp_path / "killed.log"))
    assert finer < left < len(submitted)
    again = begun(tmp_path, "killed", "--resume")
    found = json.loads(again.communicate(timeout=300)[0])
    assert again.returncode == 0
    for name in NAMES:
        assert found[name] == said[name], name
    for name in ("figures_start", "figures_best", "constraints_best"):
        assert found["summary"][name] == pytest.approx(whole.summary[name], rel=1e-12), name
    np.testing.assert_array_equal(rows(tmp_path / "killed.h5"), rows(tmp_path / "whole.h5"))
    # what the record held was not evaluated again: neither candidates nor the start, on any resolution
    assert len(lines(tmp_path / "killed.log")) - asked == len(submitted) - left
    assert len(set(submitted)) == len(submitted)
    with h5py.File(tmp_path / "killed.h5") as one, h5py.File(tmp_path / "whole.h5") as other:
        for name in ("objective_lower", "objective_upper", "start_figures"):
            np.testing.assert_array_equal(one[name][...], other[name][...], err_msg=name)  # pyright: ignore
