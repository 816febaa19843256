"""Bad input to the verbs, in processes of their own: one line, exit status 2, nothing written or lost."""

import os
from pathlib import Path

import h5py
import pytest

from tests.support.forked_verbs import ForkedVerbs
from tests.support.verbs import ROOT, in_a_process, sets

SHORT = (*sets("solver.cycles=1", "output.samples_per_cycle=16"), "--no-plot")


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


COMMANDS = {
    "bad value": (
        ("run", "crc-23-47", "--set", "operating.pinion_speed=10", *SHORT),
        ("--set: operating.pinion_speed = 10:", '"10 rad/s"'),
    ),
    "geometry": (
        ("run", "crc-23-47", "--set", "drive.pinion.bore_radius=34 mm", *SHORT),
        ("--set: drive.pinion.bore_radius = 34 mm:", "use less"),
    ),
    "unknown scenario": (("run", "crc-23-48", *SHORT), ('scenario = "crc-23-48":', '"crc-23-47"?')),
    "record exists": (("run", "crc-23-47", "-o", "there.h5", *SHORT), ("output = there.h5:", "--force")),
    "remains of a run": (("run", "crc-23-47", "-o", "dead.h5", *SHORT), ("output = dead.h5:", "--force")),
    "no such folder": (("run", "crc-23-47", "-o", "no/such.h5", *SHORT), ("output = no/such.h5:", "create")),
    "show nothing": (("show", "nothing.h5"), ("record = nothing.h5: no such file",)),
    "show text": (("show", "text.h5"), ("record = text.h5: not an HDF5 file",)),
    "run a record": (("run", "record.h5"), ('scenario = "record.h5": a record', "tribodyn show record.h5")),
    "sweep a record": (("sweep", "record.h5", "--vary", "solver.rtol=1,2"), ("tribodyn show record.h5",)),
    "a range to vary": (
        ("sweep", "crc-23-47", "--vary", "operating.pinion_speed=500-6000rpm"),
        ("a range without a number of values or a step", "write 500:6000/20rpm"),
    ),
    "plot nothing": (("plot", "nothing.h5"), ("record = nothing.h5: no such file",)),
    "init over a file": (("init", "mine"), ("mine.toml: the file exists", "--force")),
    "init into nowhere": (("init", "no/where"), ('name = "no/where.toml": the folder does not exist',)),
    "validate nothing": (("validate", "liu-ni-2202"), ("liu-ni-2022",)),
}


@pytest.mark.parametrize(("arguments", "said"), COMMANDS.values(), ids=list(COMMANDS))
def test_one_line_and_nothing_touched(
    tmp_path: Path, arguments: tuple[str, ...], said: tuple[str, ...], forked: ForkedVerbs
):
    (tmp_path / "folder").mkdir()
    for name in ("there.h5", "dead.partial.h5", "text.h5", "mine.toml"):
        (tmp_path / name).write_text("precious", encoding="utf-8")
    with h5py.File(tmp_path / "record.h5", "w") as record:
        record.attrs["format"] = "tribodyn-record"
    before = contents(tmp_path)
    ended = forked(*arguments, folder=tmp_path)
    assert ended.returncode == 2, ended.stderr
    assert ended.stdout == ""
    (line,) = ended.stderr.splitlines()
    for part in said:
        assert part in line
    assert contents(tmp_path) == before


@pytest.mark.skipif(hasattr(os, "geteuid") and os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_cannot_be_written_to(tmp_path: Path):
    folder = tmp_path / "closed"
    folder.mkdir(mode=0o555)
    ended = in_a_process("run", "crc-23-47", "-o", "closed/a.h5", *SHORT, folder=tmp_path)
    assert ended.returncode == 2
    (line,) = ended.stderr.splitlines()
    assert line.startswith("output = closed/a.h5: the folder cannot be written to")
    assert contents(tmp_path) == {}


@pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="no folder that even root may not write to")
def test_a_folder_in_which_no_file_can_be_made(tmp_path: Path):
    ended = in_a_process("run", "crc-23-47", "-o", "/proc/a.h5", *SHORT, folder=tmp_path)
    assert ended.returncode == 2
    (line,) = ended.stderr.splitlines()
    assert line.startswith("output = /proc/a.h5: ")
    assert "choose another" in line


def test_a_simulation_that_gives_up_says_when_and_keeps_what_it_has(tmp_path: Path, forked: ForkedVerbs):
    few = sets("solver.cycles=3", "solver.max_steps=100")
    ended = forked("run", "crc-23-47", *SHORT, *few, folder=tmp_path)
    assert ended.returncode == 3, ended.stderr
    (line,) = ended.stderr.splitlines()
    assert "the simulation failed: stopped at t = " in line
    assert "crc-23-47.partial.h5" in line
    assert set(contents(tmp_path)) == {"crc-23-47.partial.h5"}
    shown = forked("show", "crc-23-47.partial.h5", folder=tmp_path)
    assert shown.returncode == 0
    assert "failed" in shown.stdout


def test_a_bug_is_one_line_unless_the_traceback_is_asked_for(tmp_path: Path):
    (tmp_path / "h5py.py").write_text("raise RuntimeError('broken\\ninstallation')", encoding="utf-8")
    broken = f"{tmp_path}{os.pathsep}{ROOT}"
    ended = in_a_process("show", "a.h5", folder=tmp_path, PYTHONPATH=broken)
    assert ended.returncode == 1
    (line,) = ended.stderr.splitlines()
    assert line.startswith("a bug in tribodyn: RuntimeError: broken installation; set TRIBODYN_TRACEBACK=1")
    asked = in_a_process("show", "a.h5", folder=tmp_path, PYTHONPATH=broken, TRIBODYN_TRACEBACK="1")
    assert asked.returncode == 1
    assert "Traceback" in asked.stderr
