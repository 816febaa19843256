"""Many processes on one empty cache: each reads a whole file or none, and none ends badly."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROCESSES, ROUNDS, FILES = 8, 20, 5
#: What a process writes: itself again and again, so that a mixture of two would show.
SIZE = 60_000


#: Forks the processes; by itself, because no threads of others may be there.
WRITERS = """
import os, sys
from tribodyn.numerics.files.cache import keep, read_kept

processes, rounds, files, size = map(int, sys.argv[1:])
children = []
for number in range(processes):
    child = os.fork()
    if child == 0:
        status = 1
        try:
            for turn in range(rounds):
                name = f"file-{turn % files}"
                keep("races", name, bytes([number]) * size)
                found = read_kept("races", name)
                assert found is not None and len(found) == size and len(set(found)) == 1
            status = 0
        finally:
            os._exit(status)
    children.append(child)
print(*(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children))
"""


def test_no_reader_sees_half_a_file(tmp_path: Path):
    command = [sys.executable, "-c", WRITERS, *map(str, (PROCESSES, ROUNDS, FILES, SIZE))]
    environment = {**os.environ, "TRIBODYN_CACHE": str(tmp_path / "cache"), "PYTHONPATH": str(ROOT)}
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["0"] * PROCESSES, ended.stderr
    left = sorted(path.name for path in (tmp_path / "cache" / "races").iterdir())
    assert left == [f"file-{i}" for i in range(FILES)]


@pytest.mark.soak
def test_eight_processes_run_on_an_empty_cache(tmp_path: Path):
    """Twenty runs each, of which the first compile the same kernels at the same time; results are equal."""
    program = (
        "import sys\nfrom pathlib import Path\nfrom tribodyn.studies.protocol.load import load_scenario\n"
        "from tribodyn.studies.protocol.run import run\n"
        "folder = Path(sys.argv[1])\n"
        f"for i in range({ROUNDS}):\n"
        "    case = load_scenario('involute-23-47', {'solver.cycles': 2, 'output.samples_per_cycle': 40})\n"
        "    done = run(case, folder / f'{sys.argv[2]}-{i}.h5')\n"
        "    print(done.status, repr(done.summary['transmission_error_peak_to_peak']))\n"
    )
    environment = {**os.environ, "TRIBODYN_CACHE": str(tmp_path / "cache"), "OPENBLAS_NUM_THREADS": "1"}
    running = [
        subprocess.Popen(
            [sys.executable, "-W", "error", "-c", program, str(tmp_path), str(number)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=environment,
        )
        for number in range(PROCESSES)
    ]
    said = [process.communicate() for process in running]
    assert [process.returncode for process in running] == [0] * PROCESSES, said
    lines = [line for out, _ in said for line in out.splitlines()]
    assert len(lines) == PROCESSES * ROUNDS
    assert len(set(lines)) == 1
    assert lines[0].startswith("complete ")
    assert not list((tmp_path / "cache").rglob("*.tmp"))
