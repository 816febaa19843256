"""The bar of long work in Python: on a terminal, in a notebook, nowhere else."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.soak_parameters import all_in_soak
from tribodyn.errors import InputError
from tribodyn.numerics.processes.work import foretold
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load_scenario

DAMPING = "[0.02, 0.03, 0.05, 0.08]"
SWEEP = (
    f"import tribodyn as td\ntd.sweep('backlash-oscillator', {{'damping': {DAMPING}}}, progress=PROGRESS)\n"
)
JUDGE = "import tribodyn as td\ntd.compare_laws('crc-23-47', positions=4, progress=PROGRESS)\n"
#: What a notebook's kernel has: IPython is no dependency, and this says what the bar needs of it.
NOTEBOOK = """
import builtins, sys, types
class ZMQInteractiveShell: ...
class Handle:
    def update(self, bundle, raw): print('updated', 'text/html' in bundle and raw, bundle['text/plain'])
def display(bundle, raw, display_id): print('displayed', bundle['text/plain']); return Handle()
builtins.get_ipython = ZMQInteractiveShell
sys.modules['IPython'] = types.ModuleType('IPython')
sys.modules['IPython.display'] = types.ModuleType('IPython.display')
sys.modules['IPython.display'].display = display
"""
SLOWLY = """
import time
from tribodyn.post.progress import progress_of
with progress_of(None, 'slow work', 40, 'cases') as report:
    for done in range(21):
        report(done / 40)
        time.sleep(0.1)
"""


def on_a_terminal(program: str) -> str:
    """What a program writes to a terminal of 110 columns, without its colours."""
    pty = pytest.importorskip("pty")  # none on Windows
    leader, terminal = pty.openpty()
    environment = {**os.environ, "COLUMNS": "110", "TERM": "xterm"}
    process = subprocess.Popen(
        [sys.executable, "-c", program], stdin=terminal, stdout=terminal, stderr=terminal, env=environment
    )
    os.close(terminal)
    written = b""
    try:
        while piece := os.read(leader, 65536):
            written += piece
    except OSError:  # the other end is closed
        pass
    os.close(leader)
    assert process.wait() == 0, written
    return re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", written.decode())


def piped(program: str) -> str:
    """What a script writes whose output is kept."""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return done.stdout + done.stderr


def test_a_terminal_shows_what_is_done_the_rate_and_the_time_left():
    shown = on_a_terminal(SLOWLY)
    assert re.search(r"slow work .* \d+% ([6-9]|10)(\.\d+)? cases/s 0:00:0[2-5]", shown)


@pytest.mark.parametrize("program", all_in_soak([SWEEP, JUDGE], [SWEEP]))
def test_sweeps_and_judgements_show_theirs_and_scripts_none(program: str):
    shown = on_a_terminal(program.replace("PROGRESS", "None"))
    assert re.search(r"\d+%", shown)
    shorter = program.replace(DAMPING, "[0.08]")
    assert on_a_terminal(shorter.replace("PROGRESS", "False")) == ""
    assert piped(shorter.replace("PROGRESS", "None")) == ""


def test_a_notebook_shows_it_below_the_cell_and_the_last_one_stays():
    lines = [line for line in piped(NOTEBOOK + SLOWLY).splitlines() if line.strip()]
    assert lines[0].startswith("displayed")
    assert all(line.startswith("updated True") for line in lines[1:])
    assert 2 <= len(lines) <= 6  # at most two a second
    assert "100%" in lines[-1]
    assert "cases/s" in lines[-1]


LONG = """
from tribodyn.post.progress import progress_of
from tribodyn.cases.cost import Estimate, say_beforehand
with progress_of(PROGRESS, 'slow work'):
    say_beforehand(Estimate(seconds=59.0))
    say_beforehand(Estimate(3 * 2.0**20, 2048.0, 150.0))
"""


def test_what_takes_longer_than_a_minute_is_said_beforehand():
    said = "slow work: takes about 3 MiB of memory, a record of 2 KiB and 2.5 minutes of one core"
    assert piped(LONG.replace("PROGRESS", "None")) == f"{said}\n"
    assert piped(LONG.replace("PROGRESS", "False")) == ""
    assert said in " ".join(on_a_terminal(LONG.replace("PROGRESS", "None")).split())


@pytest.mark.parametrize(
    ("scenario", "keys"),
    [
        ("assessment-helical-24-95", {"assessment.speeds": 460}),
        # 30 runs of 14 meshes, each of them longer than a second
        ("wind-turbine-gearbox-assessment", {"assessment.speeds": 30}),
        ("design-quiet-range-18-36", {}),
    ],
)
def test_long_assessments_and_searches_say_so_before_they_begin(scenario: str, keys, tmp_path: Path):
    case, said = load_scenario(scenario, keys), list[str]()
    with foretold(said.append), pytest.raises(InputError, match="output"):
        STUDIES[case.kind].run(case, tmp_path / "no-such-folder" / "record.h5", allow_large=True)
    assert len(said) == 1
    assert re.fullmatch(r"takes about .* and [\d.]+ (s|minutes|hours) of one core", said[0])


def test_a_program_that_asks_for_lines_gets_the_share_done():
    said = piped("import os\nos.environ['TRIBODYN_PROGRESS'] = 'lines'" + SLOWLY)
    lines = [line.split(" ", 2) for line in said.splitlines()]
    assert {(mark, label) for mark, _, label in lines} == {("@progress", "slow work")}
    shares = [float(share) for _, share, _ in lines]
    assert shares == sorted(shares)
    assert shares[-1] == 0.5
