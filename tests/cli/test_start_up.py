"""What help, a plain run and a sweep import, and what they leave alone."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tribodyn.record.sweep_reader import SweepRecord

PROGRAM = """
import json, sys
from tribodyn.cli import main
sys.argv = ["tribodyn", *sys.argv[1:]]
try:
    main()
except SystemExit as end:
    assert not end.code, end.code
sys.stderr.write(json.dumps(sorted(sys.modules)))
"""
HEAVY = {*"numpy scipy jax diffrax numba pydantic pint h5py matplotlib rich".split()}
OF_A_RUN = {*"jax diffrax pint matplotlib scipy.linalg scipy.interpolate scipy.integrate".split()}


def imported(folder: Path, *words: str) -> set[str]:
    """Modules that a verb imports in a process of its own."""
    command = [sys.executable, "-c", PROGRAM, *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return set(json.loads(done.stderr.splitlines()[-1]))


@pytest.mark.parametrize("verb", ["", "sweep", "validate"])
def test_help_imports_nothing_heavy(verb: str, tmp_path: Path):
    of_options = {"pydantic"} if verb else set()  # typer's own
    assert not imported(tmp_path, *verb.split(), "--help") & HEAVY - of_options


@pytest.mark.slow
def test_a_plain_run_imports_nothing_heavy_and_no_compiler_once_it_is_compiled(tmp_path: Path):
    """The first run compiles, unless another test has; the second finds the machine code."""
    words = ("run", "crc-23-47", "--set", "solver.cycles=2", "--force", "--no-plot")
    first = imported(tmp_path, *words)
    of_numba = {"scipy.linalg"} if "numba" in first else set()
    assert not first & OF_A_RUN - of_numba
    assert not imported(tmp_path, *words) & {*OF_A_RUN, "numba"}


def test_a_sweep_imports_neither_jax_nor_dask_nor_matplotlib(tmp_path: Path):
    words = ("crc-23-47", "--vary", "operating.pinion_speed=100:300:100rad/s", "-o", "s.h5")
    found = imported(tmp_path, "sweep", *words)
    assert not found & {"jax", "dask", "distributed", "matplotlib", "xarray", "pint"}
    with SweepRecord(tmp_path / "s.h5") as record:
        assert set(record["solution"]) == {"period-1"}
        assert (record["multiplier_max"] < 1).all()
