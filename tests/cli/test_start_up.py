"""What a plain run imports, and what it leaves alone."""

import json
import subprocess
import sys

import pytest

RUN = """
import json, sys
from tribodyn.cli import main
sys.argv = ["tribodyn", "run", "crc-23-47", "--set", "solver.cycles=2", "--json", *sys.argv[1:]]
try:
    main()
except SystemExit as end:
    assert not end.code, end.code
sys.stderr.write(json.dumps(sorted(sys.modules)))
"""


@pytest.mark.slow
def test_a_run_without_pictures_imports_neither_jax_nor_scipy_nor_pint(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", RUN, "--no-plot"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    modules = set(json.loads(done.stderr.splitlines()[-1]))
    unwanted = {
        "jax",
        "diffrax",
        "pint",
        "matplotlib",
        "scipy.linalg",
        "scipy.interpolate",
        "scipy.integrate",
    }
    assert not modules & unwanted
