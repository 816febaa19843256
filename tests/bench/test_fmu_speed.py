"""A communication step of the FMU of a pair, in a program in C."""

import json
import subprocess
from pathlib import Path
from time import process_time

import numpy as np

from tests.support.fmus import PAIR, compiled_harness, fmpy, fmu_of
from tribodyn.dynamics.parameters import with_shared_code
from tribodyn.exchange.format import TORQUE
from tribodyn.kernels.native import packed
from tribodyn.solve.march import by_time
from tribodyn.solve.march.time_outputs import outputs, time_outputs
from tribodyn.solve.right_hand_side import work_array
from tribodyn.studies.motion.drivetrain.in_time import in_time
from tribodyn.studies.protocol.load import load_scenario

#: Communication step, s; steps.
STEP, STEPS = 1e-5, 3000
#: Processor time of a step at most, µs: as the package promises.
LIMIT = 10.0


def _in_python() -> float:
    """Processor time of a step of our own machine code, its outputs included, µs."""
    gearbox = in_time(load_scenario(PAIR), TORQUE, TORQUE)
    model, start = with_shared_code(gearbox.model), next(iter(gearbox.starts.values()))
    control = by_time.time_control(model, start, gearbox.rtol, gearbox.max_steps)
    work, buffer = work_array(model), by_time.time_buffer(model.layout)
    out, shortest = np.zeros(len(time_outputs(model))), np.inf
    for _ in range(4):  # the first one compiles
        y, clock = gearbox.starts[gearbox.start_speed].copy(), by_time.begun_clock(model, start, control)
        fixed = [packed(each) for each in (control, model, y, clock, work, buffer)]
        begun = process_time()
        for step in range(1, STEPS + 1):
            by_time.advance(step * STEP, *fixed)
            outputs(*fixed[1:], out)
        shortest = min(shortest, process_time() - begun)
    return 1e6 * shortest / STEPS


def test_a_step_of_a_pair_takes_less_than_ten_microseconds(tmp_path: Path):
    """Of 10 µs, all outputs read; and no longer than the same steps by our own kernels."""
    path = fmu_of(PAIR, {})
    described = fmpy.read_model_description(path)
    library = Path(fmpy.extract(path)) / "binaries" / "x86_64-linux" / "unit.so"
    torque = next(each.start for each in described.modelVariables if each.name == "input_torque")
    words = [compiled_harness(tmp_path), library, described.guid, STEP, STEPS, 1, torque]
    ran = subprocess.run(
        [str(word) for word in (*words, len(described.modelVariables))],
        env={},
        capture_output=True,
        text=True,
        check=True,
    )
    taken = json.loads(ran.stdout)["step_us"]
    assert taken < LIMIT
    assert taken < _in_python()
