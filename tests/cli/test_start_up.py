"""What a plain run imports, and what it leaves alone."""

import json
import subprocess
import sys

import pytest

RUN = """
import json, sys
from tribodyn.cli import main
sys.argv = ["tribodyn", "run", "crc-23-47", "--set", "solver.cycles=2", "--json", "--force", *sys.argv[1:]]
try:
    main()
except SystemExit as end:
    assert not end.code, end.code
sys.stderr.write(json.dumps(sorted(sys.modules)))
"""


def modules_of_a_run(folder, *arguments):
    done = subprocess.run(
        [sys.executable, "-c", RUN, *arguments], cwd=folder, capture_output=True, text=True, check=True
    )
    return set(json.loads(done.stderr.splitlines()[-1]))


@pytest.mark.slow
def test_a_plain_run_imports_nothing_heavy_and_no_compiler_once_it_is_compiled(tmp_path):
    """The first run compiles, unless another test has; the second finds the machine code."""
    unwanted = {
        "jax",
        "diffrax",
        "pint",
        "matplotlib",
        "scipy.linalg",
        "scipy.interpolate",
        "scipy.integrate",
    }
    first = modules_of_a_run(tmp_path, "--no-plot")
    of_numba = {"scipy.linalg"} if "numba" in first else set()
    assert not first & unwanted - of_numba
    assert not modules_of_a_run(tmp_path, "--no-plot") & {*unwanted, "numba"}
