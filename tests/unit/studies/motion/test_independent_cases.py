"""What a case of a sweep starts from does not depend on the cases done before it in the same process."""

import importlib

import numpy as np
import pytest

from tribodyn.record.sweep_schema import FAILED
from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.batch import Chunk
from tribodyn.studies.protocol.load import load_scenario

evaluate = importlib.import_module("tribodyn.studies.motion.batch.evaluate")

MOVING_ERROR = {"harmonics": [{"order": 1, "amplitude": "8 um", "phase": "90 deg"}]}


@pytest.mark.parametrize("torque", ["100 N*m", "500 N*m"])
def test_a_moving_error_does_not_carry_one_speed_over_to_another(torque: str):
    keys = {"mesh.transmission_error": MOVING_ERROR, "operating.gear_torque": torque}
    cases = [
        load_scenario("jump-involute-23-47", {**keys, "operating.pinion_speed": f"{speed} rad/s"})
        for speed in (300, 500)
    ]
    settings = BATCH.settings(cases, None, "native")

    def starts(order: list[int]) -> dict[int, bytes]:
        evaluate._equilibria.cache_clear()
        ready = {i: prepare(cases[i]) for i in order}
        return {i: evaluate._start(ready[i], settings).tobytes() for i in order}

    assert starts([0, 1]) == starts([1, 0]) == {**starts([0]), **starts([1])}
    assert np.all(np.isfinite(np.frombuffer(starts([1])[1])))


def test_cases_that_all_fail_before_their_window_say_why():
    case = load_scenario("crc-23-47", {"solver.max_steps": 10})
    settings = BATCH.settings([case], 4, "native")
    rows = BATCH.evaluate(Chunk(np.arange(1), (case,)), settings, None)
    assert rows["status"].tolist() == [FAILED]
    assert "the limit of steps" in rows["message"][0]
