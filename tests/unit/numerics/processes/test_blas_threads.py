"""One thread of BLAS solves small systems, however many the program around lets it take."""

import json
import os
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

import pytest

from tests.support.short_studies import written_template
from tribodyn.numerics.processes import libraries
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.processes.work import usable_cores

# Processor time of the threads that BLAS began, s: the witness that needs no word of BLAS itself.
PROGRAM = """
import json, os, sys, threading, time
import numpy as np, scipy.linalg
import tribodyn as td
from tribodyn.numerics.processes.libraries import one_blas_thread

others = set(os.listdir("/proc/self/task")) - {str(threading.get_native_id())}
blocks = {"numpy": lambda: a @ a, "scipy": lambda: scipy.linalg.lu_factor(a)}
a = np.random.default_rng(0).random((500, 500))

def spent():
    time.sleep(0.2)  # they wait for more work, busily, for a moment
    stats = [open(f"/proc/self/task/{one}/stat").read().rpartition(")")[2].split() for one in others]
    return sum(int(one[11]) + int(one[12]) for one in stats) / os.sysconf("SC_CLK_TCK")

def spent_by(function, count=1):
    before = spent()
    for _ in range(count):
        function()
    return spent() - before

def solve_both():
    return {name: spent_by(function, 20) for name, function in blocks.items()}

found = {"before": solve_both()}
with one_blas_thread():
    found["inside"] = solve_both()
for kind, (scenario, overrides) in json.loads(sys.argv[1]).items():
    found[kind] = spent_by(lambda: td.run(scenario, overrides))
found["after"] = solve_both()
print(json.dumps(found))
"""
#: Studies whose systems are large enough for threads, coarse.
STUDIES = {
    "ehl": {"output.positions": 4},
    "load-contact": {"output.positions_per_cycle": 8, "mesh.slices": 21},
}


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="reads the times of threads from /proc")
@pytest.mark.skipif(usable_cores() < 2, reason="BLAS begins no threads on one core")
def test_threads_of_blas_rest_while_studies_run_and_are_there_again(tmp_path: Path):
    studies = {kind: (str(written_template(kind, tmp_path)), keys) for kind, keys in STUDIES.items()}
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(studies)],
        env={**os.environ, "OPENBLAS_NUM_THREADS": "2"},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    found = json.loads(done.stdout)
    if not all(found["before"].values()):
        pytest.skip("this BLAS begins no threads of its own")
    assert all(found["after"].values())
    assert found["inside"] == {"numpy": 0.0, "scipy": 0.0}
    assert {kind: found[kind] for kind in STUDIES} == dict.fromkeys(STUDIES, 0.0)


def test_blocks_of_several_threads_end_with_the_last():
    """One that ends first does not give threads back under another, nor keep them from the program after."""
    with one_blas_thread():
        pass  # finds the libraries
    library = libraries._known["numpy.linalg._umath_linalg"]
    if library is None:
        pytest.skip("this BLAS is not known")
    set_before = library.threads()
    library.set_threads(2)
    if library.threads() != 2:
        pytest.skip("this BLAS takes one thread only")
    entered, leave, seen = threading.Event(), threading.Event(), []

    def first() -> None:
        with one_blas_thread():
            entered.set()
            leave.wait(10)

    other = threading.Thread(target=first)
    try:
        other.start()
        entered.wait(10)
        with suppress(ZeroDivisionError), one_blas_thread(), one_blas_thread():
            leave.set()
            other.join()
            seen.append(library.threads())
            raise ZeroDivisionError
        seen.append(library.threads())
    finally:
        leave.set()
        library.set_threads(set_before)
    assert seen == [1, 2]
