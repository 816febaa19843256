"""What happens with a numba, or under variables, by which kernels cannot be compiled."""

import subprocess
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

import tribodyn

PACKAGE = Path(tribodyn.__file__).parent


def test_the_version_of_numba_is_bounded():
    project = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (numba,) = [line for line in project["dependencies"] if line.startswith("numba")]
    upper = [int(part) for part in numba.split("<")[1].split(".")]
    assert [int(part) for part in version("numba").split(".")[:2]] < upper


WITHOUT = """
import numba.core.codegen
import tribodyn as td

del numba.core.codegen.JITCodeLibrary
try:
    td.run("backlash-oscillator", output="record.h5")
except td.InputError as error:
    print(error)
"""


def test_a_numba_that_lacks_an_internal_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path / "empty"))
    ended = subprocess.run(
        [sys.executable, "-c", WITHOUT], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert ended.stdout.startswith(f"numba = {version('numba')}: cannot compile kernels: ")
    assert ended.stdout.endswith("install a version within the bounds of tribodyn's pyproject.toml\n")


SETTINGS = {
    "NUMBA_DISABLE_JIT": "NUMBA_DISABLE_JIT = 1: switches off the compiler by which kernels are made; "
    "unset it",
    "NUMBA_NUM_THREADS": "NUMBA_NUM_THREADS = 0: numba cannot be imported with it; "
    "unset it, or set it to 1 or more",
}
SET = """
import sys
import tribodyn as td
from tribodyn.cli import main
try:
    td.run("crc-23-47", {"solver.cycles": 2}, output="python.h5")
except td.InputError as error:
    print(error, file=sys.stderr)
sys.argv = ["tribodyn", "run", "crc-23-47", "--no-plot"]
main()
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", SETTINGS)
def test_a_variable_under_which_nothing_is_compiled_is_one_line(name, tmp_path, monkeypatch):
    """From Python and on the command line, a second time too."""
    monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv(name, SETTINGS[name].split(":")[0][-1])
    ended = subprocess.run(
        [sys.executable, "-c", SET], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ended.stderr.splitlines() == [SETTINGS[name]] * 2
    assert ended.returncode == 2
