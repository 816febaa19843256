"""A scenario, a sweep and a search where the system offers no more than Windows does.

Python is the one that runs the tests, less what Python lacks on Windows: no copies of processes, no locks, no
users, no groups of processes, no affinity, no `/proc`. The processes that are started lack it as well.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.support.cheap_searches import SEARCH
from tests.support.forked_verbs import ForkedVerbs
from tribodyn.numerics.processes.work import usable_cores

#: Found by Python at its start: takes away what other systems lack, and says in a file that it did.
LESS = """
import builtins, io, os, signal, sys

for name in ("fork", "forkpty", "register_at_fork", "geteuid", "getegid", "getgroups"):
    delattr(os, name)
for name in ("sched_getaffinity", "sched_setaffinity", "killpg", "getpgid", "getpgrp", "setsid", "statvfs"):
    delattr(os, name)
for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC"):
    delattr(os, name)
for name in ("SIGHUP", "SIGALRM", "setitimer", "alarm", "pthread_sigmask"):
    delattr(signal, name)
for name in ("fcntl", "pwd", "grp", "termios", "tty", "pty", "resource"):
    sys.modules[name] = None
opened = io.open

def elsewhere(file, *given, **more):
    if isinstance(file, (str, os.PathLike)) and str(file).startswith(("/proc", "/sys")):
        raise FileNotFoundError(2, "no such file", str(file))
    return opened(file, *given, **more)

with open(os.environ["STARTED"], "a") as file:
    file.write(" ".join(sys.orig_argv[-3:]).replace("\\n", " ") + "\\n")
builtins.open = io.open = elsewhere
"""
VERBS = (
    ("run", "crc-23-47", "--set", "solver.cycles=2", "-o", "run.h5"),
    ("sweep", "crc-23-47", "--vary", "operating.gear_torque=100:500:200N*m", "-o", "sweep.h5"),
    ("run", "search.toml", "-o", "search.h5", "--no-plot"),
    ("show", "search.h5"),
)
#: The verbs in one process, then a record in a thread, then one that hangs.
PROGRAM = """
import json, os, sys, threading
from pathlib import Path

assert not hasattr(os, "fork")
from tribodyn.cli import main

for words in json.loads(sys.argv[1]):
    sys.argv = ["tribodyn", *words]
    try:
        main()
    except SystemExit as end:
        assert not end.code, words
import tribodyn as td
from tribodyn.record import soundness

soundness._own.clear()
found = []
thread = threading.Thread(target=lambda: found.append(td.open("run.h5").summary["efficiency"]))
thread.start()
thread.join()
assert found
soundness.TIME_LIMIT = soundness.START_LIMIT = 1.0
os.mkfifo("pipe")
assert "did not end" in soundness.through_a_child(open, Path("pipe"))  # which waits for a writer
"""


def datasets(path: Path) -> dict[str, np.ndarray]:
    with h5py.File(path) as file:
        return {name: item[...] for name, item in file.items() if isinstance(item, h5py.Dataset)}


@pytest.mark.slow
def test_a_scenario_a_sweep_and_a_search(tmp_path: Path, forked: ForkedVerbs):
    less, there, here = (tmp_path / name for name in ("less", "there", "here"))
    for folder in (less, there, here):
        folder.mkdir()
        (folder / "search.toml").write_text(SEARCH, encoding="utf-8")
    (less / "sitecustomize.py").write_text(LESS, encoding="utf-8")
    started = tmp_path / "started"
    path = os.pathsep.join([str(less), str(Path(__file__).parents[2])])
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(VERBS)],
        cwd=there,
        env={**os.environ, "PYTHONPATH": path, "STARTED": str(started), "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr
    processes = started.read_text(encoding="utf-8")
    assert "tribodyn.record.soundness:serve" in processes
    if usable_cores() > 1:
        assert "tribodyn.cli.pictures:serve" in processes
        assert "tribodyn.studies.design.candidates.evaluation:serve" in processes
        assert (there / "run-overview.png").exists()
    for words in VERBS[:3]:
        assert forked(*words, folder=here).returncode == 0
    for name in ("run.h5", "sweep.h5", "search.h5"):
        less, whole = datasets(there / name), datasets(here / name)
        assert less.keys() == whole.keys()
        for what in less:
            if "time" not in what or what == "time":
                np.testing.assert_array_equal(less[what], whole[what], err_msg=f"{name} {what}")
