"""Signals end a verb with one line that says what is kept and how to go on, and leave no lock."""

import os
import pty
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.support.short_studies import shortened, written_template

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="signals of POSIX"),
]

#: The command line; a signal that whoever runs the tests ignores is heeded.
HEEDED = (
    "import signal, sys\nfor n in (signal.SIGINT, signal.SIGHUP): signal.signal(n, signal.SIG_DFL)\n"
    "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
)
MAIN = "\nfrom tribodyn.cli import main\nmain()\n"
#: A contact is being solved, at a path or for a table.
SOLVING = (
    "import {module} as module\nsolve = module.{name}\n"
    "def noted(*given, **more):\n    open('begun', 'w').close()\n    return solve(*given, **more)\n"
    "module.{name} = noted\n"
)
PATH = SOLVING.format(module="tribodyn.studies.ehl.along_path", name="solved_at")
TABLE = SOLVING.format(module="tribodyn.tribology.ehl.table", name="solve_one")
SOLVED_LAWS = ("--set", "film.law=solved", "--set", "friction.law=solved")
LONG = ("--set", "solver.cycles=20000", "--set", "output.samples_per_cycle=20")
STATUS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 143}
#: Verb and its options, what is done before, what shows that it is at work, what is said.
VERBS: dict[str, tuple[tuple[str, ...], str, str, str]] = {
    "run": (("run", "crc-23-47", *LONG), "", "crc-23-47.partial.h5", "samples: crc-23-47.partial.h5"),
    "sweep": (
        ("sweep", "crc-23-47", "--vary", "operating.gear_torque=100:500:1N*m", "-o", "swept.h5"),
        "",
        "swept.partial.h5",
        "the cases done so far: swept.partial.h5, --resume goes on",
    ),
    "design": (
        ("design", "design-shift-23-47", "--evaluations", "100000", "-o", "found.h5"),
        "",
        "found.partial.h5",
        "evaluations so far: found.partial.h5, --resume goes on",
    ),
    "assess": (
        ("assess", "drive.toml", *shortened("assessment"), "-o", "out"),
        "",
        "out/assessment-parts/*.h5",
        "; the parts done so far: out/assessment-parts, the same call goes on",
    ),
    "ehl": (
        ("run", "ehl-involute-23-47"),
        PATH,
        "begun",
        "; nothing is recorded yet, the same call begins anew",
    ),
    "table": (
        ("run", "crc-23-47", *SOLVED_LAWS),
        TABLE,
        "begun",
        "; nothing is kept of the table of solved contacts, the same call solves them anew",
    ),
}


def begun(
    folder: Path, words: tuple[str, ...], before: str = "", cache: Path | None = None, **how
) -> "subprocess.Popen[str]":
    own = {"PYTHONPATH": str(Path(__file__).parents[2]), "OPENBLAS_NUM_THREADS": "1"}
    if cache is not None:
        own["TRIBODYN_CACHE"] = str(cache)
    return subprocess.Popen(
        [sys.executable, "-P", "-c", HEEDED + before + MAIN, *words],
        cwd=folder,
        text=True,
        env={**os.environ, **own},
        **{"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, **how},
    )


def wait(condition: Callable[[], object], process: "subprocess.Popen[str]") -> None:
    started = time.monotonic()
    while not condition():
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() - started < 300
        time.sleep(0.02)


def left(folder: Path) -> list[str]:
    """Locks and scratch files that are still there."""
    return [path.name for path in folder.rglob("*") if path.suffix in (".lock", ".tmp") or "~" in path.name]


@pytest.mark.parametrize(
    ("verb", "asked"),
    [
        ("run", signal.SIGHUP),
        ("sweep", signal.SIGHUP),
        ("design", signal.SIGHUP),
        ("assess", signal.SIGINT),
        ("ehl", signal.SIGINT),
        ("table", signal.SIGINT),
        *(
            pytest.param(verb, asked, marks=pytest.mark.soak)
            for verb in ("assess", "ehl", "table")
            for asked in (signal.SIGHUP, signal.SIGTERM)
        ),
    ],
)
def test_a_verb_says_what_is_kept(verb: str, asked: signal.Signals, tmp_path: Path):
    words, before, sign, said = VERBS[verb]
    written_template("assessment", tmp_path).rename(tmp_path / "drive.toml")
    # another test may have solved the table's contacts: only a cache of its own is certainly empty
    process = begun(tmp_path, words, before, tmp_path / "cache" if verb == "table" else None)
    wait(lambda: list(tmp_path.glob(sign)), process)
    process.send_signal(asked)
    _, complaint = process.communicate(timeout=60)
    *beforehand, last = complaint.splitlines()  # long parts say beforehand what they take, nothing else does
    assert process.returncode == STATUS[asked], complaint
    assert all(line.endswith("of one core") or "of one core each" in line for line in beforehand), complaint
    assert last.startswith("interrupted" if asked is signal.SIGINT else "terminated")
    assert last.endswith(said)
    assert left(tmp_path) == []


def test_a_terminal_that_is_closed(tmp_path: Path):
    """What is written to it fails then; the record is concluded nevertheless."""
    ours, theirs = pty.openpty()
    process = begun(tmp_path, ("run", "crc-23-47", *LONG), stdin=theirs, stdout=theirs, stderr=theirs)
    os.close(theirs)
    partial = tmp_path / "crc-23-47.partial.h5"
    wait(partial.exists, process)
    os.close(ours)
    process.send_signal(signal.SIGHUP)
    assert process.wait(60) == 143
    assert left(tmp_path) == []


def test_nohup_is_obeyed(tmp_path: Path):
    ignored = "signal.signal(signal.SIGHUP, signal.SIG_IGN)\n"
    process = begun(tmp_path, ("run", "crc-23-47", *LONG), ignored)
    wait((tmp_path / "crc-23-47.partial.h5").exists, process)
    process.send_signal(signal.SIGHUP)
    time.sleep(0.3)
    assert process.poll() is None
    process.kill()
    process.communicate()


#: Where a start waits: while modules are imported, and when words are read.
STARTS = {
    "imports": "import tribodyn.cli\nclass Slow:\n    def find_spec(self, name, *_):\n"
    "        if name == 'tribodyn.cli.app':\n            WAIT\n"
    "sys.meta_path.insert(0, Slow())\n",
    "words": "import typer.core\nparsed = typer.core.TyperGroup.parse_args\n"
    "def slow(*given):\n    WAIT\n    return parsed(*given)\ntyper.core.TyperGroup.parse_args = slow\n",
}


@pytest.mark.parametrize(("start", "asked"), [("imports", signal.SIGINT), ("words", signal.SIGTERM)])
def test_a_start_that_is_interrupted(start: str, asked: signal.Signals, tmp_path: Path):
    """No traceback of imports, and no end without a word."""
    slow = STARTS[start].replace("WAIT", "open('begun', 'w').close(); import time; time.sleep(100)")
    process = begun(tmp_path, ("show", "none.h5"), slow)
    wait((tmp_path / "begun").exists, process)
    process.send_signal(asked)
    _, said = process.communicate(timeout=60)
    expected = "interrupted\n" if asked is signal.SIGINT else "terminated by a signal\n"
    assert (process.returncode, said) == (STATUS[asked], expected)
