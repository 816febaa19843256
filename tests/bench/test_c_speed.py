"""Speed of C code, as the ratio to the native kernel of the same functions."""

import ctypes
from pathlib import Path
from time import process_time

import numpy as np
import pytest

from tests.support.c_code import address, called, compiled
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import with_shared_code
from tribodyn.kernels.c import CEntry, translated
from tribodyn.kernels.native import kernel, packed
from tribodyn.solve.initial import initial_state
from tribodyn.solve.right_hand_side import work_array
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario

pytestmark = pytest.mark.bench

TIMES = 5000


@kernel
def _many(times, phase, interval, y, model, work, dy):
    total = 0.0
    for i in range(times):
        total += derivatives(phase + 1e-4 * (i % 100), 2.0, interval, y, model, work, dy)[0]
    return total


@pytest.mark.parametrize("name", ["crc-23-47", "two-stage-reducer", "helical-23-47"])
def test_c_is_as_fast_as_the_native_kernel(name: str, tmp_path: Path, capsys):
    """With -O3, products and sums rounded each for itself."""
    model = with_shared_code(prepare(load_scenario(name)).model)
    y, work = initial_state(model, "static"), work_array(model)
    dy = np.zeros_like(y)
    example = 1, 0.1, 0, y, model, work, dy
    source = translated({"many": CEntry(_many, example)}, {"model": model}).source
    library = compiled(source, tmp_path, options=("-O3",))
    native, place = packed(model), address(library, "model")
    taken: dict[str, list[float]] = {"native": [], "C": []}
    for _ in range(9):
        begun = process_time()
        expected = _many(TIMES, 0.1, 0, y, native, work, dy)
        taken["native"].append(process_time() - begun)
        begun = process_time()
        (found,) = called(library.many, TIMES, 0.1, 0, y, place, work, dy, result=ctypes.c_double)
        taken["C"].append(process_time() - begun)
        assert found == pytest.approx(expected, rel=1e-11)
    ratio = min(taken["C"]) / min(taken["native"])
    with capsys.disabled():
        print(f"\n{name}: native {min(taken['native']) / TIMES * 1e6:.2f} us, C {ratio:.2f} times that")
    assert ratio < 1.3
