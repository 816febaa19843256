"""Which internals of numba the kernels use, and what happens with a numba that lacks one."""

import ast
import subprocess
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest

import tribodyn
from tribodyn.kernels.native import internals

PACKAGE = Path(tribodyn.__file__).parent
#: Documented: numba.pydata.org, "Extending Numba" (its examples raise exceptions of `numba.core.errors`),
#: "Types", "Compiling".
DOCUMENTED = {"numba", "numba.core.errors", "numba.extending", "numba.types"}


def imported() -> set[tuple[str, str]]:
    """Names that the kernels import of numba's undocumented modules."""
    names = set()
    for file in (PACKAGE / "kernels").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "numba":
                names |= {(node.module or "", alias.name) for alias in node.names}
    return {(module, name) for module, name in names if module not in DOCUMENTED}


def test_all_internals_that_are_imported_are_listed():
    assert imported() <= {(internal.module, internal.name) for internal in internals.INTERNALS}


def test_this_numba_has_them():
    assert internals.missing() == ()


@pytest.mark.parametrize(
    ("listed", "lacking"),
    [
        (internals.Internal("numba.core.codegen", "NoSuchLibrary"), "numba.core.codegen.NoSuchLibrary"),
        (internals.Internal("numba.no_such_module", "thing"), "numba.no_such_module.thing"),
        (
            internals.Internal("numba.core.compiler", "compile_extra", ("no_such_parameter",)),
            "numba.core.compiler.compile_extra with the parameters no_such_parameter",
        ),
        (
            internals.Internal("numba.core.codegen", "JITCodeLibrary", members=("_no_such_member",)),
            "numba.core.codegen.JITCodeLibrary._no_such_member",
        ),
    ],
)
def test_what_is_lacking_is_named(monkeypatch, listed, lacking):
    monkeypatch.setattr(internals, "INTERNALS", (listed,))
    assert internals.missing.__wrapped__() == (lacking,)


def test_the_version_of_numba_is_bounded():
    project = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (numba,) = [line for line in project["dependencies"] if line.startswith("numba")]
    upper = [int(part) for part in numba.split("<")[1].split(".")]
    assert [int(part) for part in version("numba").split(".")[:2]] < upper


#: The kernel of the oscillator alone, which compiles in seconds.
SMALL = """
import sys
import numpy as np
from tribodyn.studies.backlash_oscillator.response import frequency_response
from tribodyn.studies.protocol.load import load_scenario

if "without" in sys.argv:
    import numba.core.codegen

    del numba.core.codegen.JITCodeLibrary
case = load_scenario("backlash-oscillator", {"frequency": [0.5, 0.7]})
response = frequency_response(case)
np.savez(sys.argv[1], single=np.stack([response.rms, response.mean]))
"""
SCRIPT = """
import sys
import numpy as np
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

if "without" in sys.argv:
    import numba.core.codegen

    del numba.core.codegen.JITCodeLibrary
model = prepare(load_scenario("crc-23-47-300", {})).model
state = static_equilibrium(model)
tolerances = tolerances_from(model, state, 1e-6, 10**6)
found = {"single": make_integrator("dopri5", model, 20, tolerances).integrate(state, 0, 1).samples}
batch = march([model, model], np.array([state, state]), cycles=1, window=1, samples=20, rtol=1e-6)
found["batch"] = batch.samples[1]
np.savez(sys.argv[1], **found)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "script", [SMALL, pytest.param(SCRIPT, marks=pytest.mark.soak)], ids=["small", "gears"]
)
def test_without_an_internal_kernels_run_all_the_same_and_say_so_once(tmp_path, monkeypatch, script):
    """One that numba's own compiler does without once it is imported."""
    import numpy as np

    said = {}
    for how in ("with", "without"):
        if how == "without":  # nothing on disk that this numba could not have made
            monkeypatch.setenv("TRIBODYN_CACHE", str(tmp_path / "empty"))
        command = [sys.executable, "-c", script, str(tmp_path / f"{how}.npz"), how]
        said[how] = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    assert "RuntimeWarning" not in said["with"]
    assert said["without"].count("RuntimeWarning: numba") == 1
    assert "lacks numba.core.codegen.JITCodeLibrary" in said["without"]
    assert not any(path.is_file() for path in (tmp_path / "empty").glob("kernels-*/*"))
    usual, plain = (np.load(tmp_path / f"{how}.npz") for how in ("with", "without"))
    scale = np.abs(usual["single"]).max(axis=0) + 1e-300
    assert np.max(np.abs(plain["single"] - usual["single"]) / scale) < 1e-10
    if "batch" in plain:  # one case of it is then what a single run is
        np.testing.assert_array_equal(plain["batch"], plain["single"])


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
