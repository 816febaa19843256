"""The process that draws the overview of a run: its picture is the same, and its failure costs nothing."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.cli import pictures

RUN = """
import json, sys
import tribodyn.cli.pictures as pictures
from tribodyn.cli import main
if "broken" in sys.argv:
    pictures.TARGET = ("builtins:exec", sys.argv.pop())
    sys.argv.pop()
sys.argv = ["tribodyn", "run", "irefc", "--set", "output.samples_per_cycle=8", "--json", *sys.argv[1:]]
try:
    main()
except SystemExit as end:
    assert not end.code, end.code
sys.stderr.write(json.dumps("matplotlib" in sys.modules))
"""


def run(folder: Path, *words: str) -> tuple[list[str], bool]:
    """Pictures of a run, and whether its own process imported matplotlib."""
    done = subprocess.run(
        [sys.executable, "-c", RUN, *words], cwd=folder, capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)["pictures"], json.loads(done.stderr.splitlines()[-1])


@pytest.mark.slow
@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="one core: the process that runs draws")
def test_the_overview_is_drawn_by_another_process_as_by_its_own(tmp_path):
    assert run(tmp_path, "-o", "one.h5") == (["one-overview.png"], False)
    assert run(tmp_path, "-o", "two.h5", "broken", "pass") == (["two-overview.png"], True)
    here, there = ((tmp_path / f"{name}-overview.png").read_bytes() for name in ("one", "two"))
    assert len(here) > 10_000
    assert here == there


def test_it_ends_with_the_process_that_began_it(monkeypatch):
    """A command that fails before it has anything to draw leaves nothing behind."""
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)
    pictures.begin(("run", "no-such-scenario"))
    process = pictures._begun.pop()._process
    said, _ = process.communicate(timeout=300)  # closes its input, as the end of this process would
    assert (said, process.returncode) == (b"", -signal.SIGKILL)
