"""Array types of signatures: true where they are checked, free of cost where they are not."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from tribodyn.numerics.shapes import Array, Float

ROOT = Path(__file__).parents[3]


def run(*arguments):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


def test_what_goes_in_and_out_has_the_shape_of_the_signature():
    done = run("-m", "tests.support.shape_checks", "tests.support.shape_samples")
    assert done.returncode == 0, done.stderr[-4000:]


def test_nobody_pays_for_types_that_are_not_checked():
    check = (
        "import sys, tribodyn.geometry.path; "
        "print(*{'jax', 'jaxtyping', 'beartype'} & {name.split('.')[0] for name in sys.modules})"
    )
    done = run("-c", check)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == []


def test_stand_ins_can_be_combined_like_types():
    assert (Float[Array, "segment node"], Float[Array, ""]) == (np.ndarray, float)
    assert isinstance(None, Float[Array, " pair"] | None)
