"""Modules that lie in the current folder, under the names of all that the program imports, never run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.cheap_searches import SEARCH
from tests.support.forked_verbs import ForkedVerbs
from tests.support.short_studies import shortened, written_template
from tests.support.soak_parameters import all_in_soak
from tribodyn.post.page import document

#: Modules of Python, of the packages that are used, and of those that Python imports by itself.
NAMES = sorted(
    {
        *(name for name in sys.stdlib_module_names if not name.startswith("_")),
        *("_distutils_hack", "_strptime", "_pydecimal", "_pydatetime", "sitecustomize", "usercustomize"),
        *"dask distributed ezdxf h5py jax llvmlite matplotlib numba numpy pandas PIL pint".split(),
        *"platformdirs psutil pydantic rich scipy tomli_w tornado typer click cloudpickle contourpy".split(),
        *"diffrax equinox msgpack yaml zict".split(),
    }
)
#: Commands in order, in one folder.
VERBS: tuple[tuple[str, ...], ...] = (
    ("run", "irefc", "-o", "one.h5", "--set", "output.samples_per_cycle=8"),
    ("run", "irefc", "-o", "two.h5", "--set", "output.samples_per_cycle=10", "--plot", "--force"),
    ("run", "search.toml", "-o", "search.h5", "--no-plot", "--force"),
    ("design", "search.toml", "-o", "design.h5", "--force", "--no-plot"),
    ("show", "one.h5"),
    ("plot", "one.h5", "two.h5"),
    ("report", "one.h5", "-o", "one.html", *(["--pdf"] if document.browser() else [])),
    ("compare", "one.h5", "two.h5"),
    ("sweep", "efficiency-involute-18-36", "--vary", "operating.gear_torque=100:200:50N*m", "-o", "sweep.h5"),
    ("check", "crc-23-47"),
    ("gear", "involute-18-36", "-o", "drawings"),
    ("compare-laws", "crc-23-47", "--positions", "4", "-o", "judged.png"),
    ("assess", "drive.toml", *shortened("assessment"), "-o", "assessed"),
    ("list",),
    ("init", "mine"),
    ("schema",),
    ("validate", "efremenkov-2024"),
)
#: Of these a drawing, a search in several processes and a check, in `make test`.
SOME = (*VERBS[1:3], ("check", "crc-23-47"))
#: The same from Python, in a thread, where a process that looks through records is kept.
SCRIPT = """
import sys, threading
import numpy as np
import tribodyn as td
from tests.support.closures import LIU_NI
from tribodyn.tribology.ehl import table

def work():
    td.open("one.h5")
    td.design("search.toml")
    td.run("irefc", {"output.samples_per_cycle": 8})
    table._WORTH, table.usable_cores = 1, lambda: 2
    contact = table.contact_of(LIU_NI)
    duty = np.log([2e5, 2.0, 100.0, 0.3])
    assert np.isfinite(table.solve_all(contact, np.stack([duty, duty]))).all()
    done.append(True)

done = []
thread = threading.Thread(target=work)
thread.start()
thread.join()
sys.exit(not done)
"""
CLUSTER = ("sweep", "efficiency-involute-18-36", "--vary", "operating.gear_torque=100:200:50N*m")


@pytest.fixture(scope="module")
def planted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a module of every name, which leaves a line in a file and ends."""
    folder = tmp_path_factory.mktemp("planted")
    marker = folder.parent / f"{folder.name}-executed"
    text = f"import os\nwith open({str(marker)!r}, 'a') as file: file.write(__name__ + '\\n')\nos._exit(99)\n"
    for name in NAMES:
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    starts_processes = "numerics/processes"
    (folder / "tribodyn" / starts_processes).mkdir(parents=True)
    for part in ("", "numerics/", f"{starts_processes}/"):
        (folder / "tribodyn" / part / "__init__.py").write_text(text, encoding="utf-8")
    for part in ("__main__.py", f"{starts_processes}/child.py"):
        (folder / "tribodyn" / part).write_text(text, encoding="utf-8")
    written_template("assessment", folder).rename(folder / "drive.toml")
    (folder / "search.toml").write_text(SEARCH, encoding="utf-8")
    return folder


def executed(planted: Path) -> list[str]:
    marker = planted.parent / f"{planted.name}-executed"
    return marker.read_text(encoding="utf-8").split() if marker.exists() else []


def fresh(planted: Path, *command: str, path: str = "") -> "subprocess.CompletedProcess[str]":
    """Run a command of a new process in the folder."""
    own = str(Path(__file__).parents[2])
    environment = {**os.environ, "PYTHONPATH": f"{own}{path}"}
    environment.pop("PYTHONSAFEPATH", None)
    return subprocess.run(command, cwd=planted, env=environment, capture_output=True, text=True, check=False)


def test_what_is_planted_would_run(planted: Path):
    """Python itself does run it where it is asked to."""
    ended = fresh(planted, sys.executable, "-c", "import json")
    assert ended.returncode == 99
    assert executed(planted)
    (planted.parent / f"{planted.name}-executed").unlink()


@pytest.mark.slow
@pytest.mark.parametrize("verbs", all_in_soak([SOME, VERBS], [SOME]), ids=["some", "all"])
def test_no_verb_runs_it(verbs: tuple[tuple[str, ...], ...], planted: Path, forked: ForkedVerbs):
    for words in verbs:
        ended = forked(*words, folder=planted)
        assert ended.returncode == 0, f"{words}: {ended.stderr}"
        assert executed(planted) == [], words


@pytest.mark.soak
def test_no_function_runs_it(planted: Path, forked: ForkedVerbs):
    """From a program that does not itself import from there."""
    if not (planted / "one.h5").exists():
        forked(*VERBS[0], folder=planted)
    ended = fresh(planted, sys.executable, "-P", "-c", SCRIPT)
    assert ended.returncode == 0, ended.stderr
    assert executed(planted) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", all_in_soak([VERBS[0], CLUSTER], [VERBS[0]]), ids=["a drawing", "a cluster"]
)
def test_no_new_process_runs_it(words, planted: Path):
    """The command as it is installed; `python -m` itself imports from the current folder before we begin."""
    more = ("--engine", "dask", "--workers", "1", "-o", "cluster.h5") if words is CLUSTER else ("--force",)
    program = "import sys\nfrom tribodyn.cli import main\nif __name__ == '__main__': sys.exit(main())\n"
    script = planted.parent / "tribodyn-command"
    script.write_text(program, encoding="utf-8")
    ended = fresh(planted, sys.executable, str(script), *words, *more)
    assert ended.returncode == 0, ended.stderr
    assert executed(planted) == []
