"""Oscillators that cannot be: refused with key and remedy, or failed with the reason."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.record.reader import open_record
from tribodyn.studies.pages import compare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

NAME = "backlash-oscillator"


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        ({"damping": -0.1}, r"damping = -0\.1: must be at least 0"),
        ({"stiffness_variation": 1.5}, r"stiffness_variation = 1\.5: must be at most 1"),
        ({"frequency": []}, r"frequency = \[\]: an empty list"),
        ({"frequency": [0.5, 0.5]}, "frequency = .*does not increase"),
        ({"frequency": [0.5, "fast"]}, r'frequency\.1 = "fast": not a plain number'),
        ({"frequency": [0.0, 0.5]}, r"frequency\.0 = 0\.0: must be greater than 0"),
        ({"frequency": 0.7}, r"frequency = 0\.7: not a list"),
        ({"frequency.to": 0.1}, r"ends at 0\.1 and starts at 0\.2"),
        ({"frequency.step": 5.0}, "longer than the range"),
        ({"frequency.step": 1e-9}, "more than 100000 frequencies"),
        ({"frequency.stop": 1.0}, r'frequency\.stop = 1\.0: unknown key; did you mean "step"'),
        ({"frequency": {"from": 0.2, "to": 1.0}}, r"frequency\.step: missing"),
        ({"solver.max_periods": 3}, r"solver\.max_periods = 3: must be at least 24"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_what_is_wrong_is_named(overrides, said):
    with pytest.raises(InputError, match=said):
        load_scenario(NAME, overrides)


UNBOUNDED = {"damping": 0.005, "mean_force": 50.0, "error_amplitude": 0.02, "stiffness_variation": 0.3}


def test_points_without_bounded_motion_are_said_and_the_others_kept(tmp_path):
    result = run(load_scenario(NAME, {**UNBOUNDED, "frequency": [1.5, 2.0, 2.5]}), tmp_path / "some.h5")
    assert result.status == "complete"
    assert result.summary["points_failed"] == 2
    assert "without bound" in result.summary["remark_1"]
    with open_record(result.path) as record:
        assert np.all(np.isnan(record["rms_displacement"][1]))
        assert np.all(record["stable"][[0, 2]] == 1.0)


def test_a_sweep_without_any_bounded_motion_fails(tmp_path):
    result = run(load_scenario(NAME, {**UNBOUNDED, "frequency": [2.0]}), tmp_path / "none.h5")
    assert result.status == "failed"
    assert "without bound" in result.message
    with open_record(result.path) as record:
        assert record.status == "failed"
        assert record.path.name == "none.partial.h5"


def test_sweeps_are_drawn_together_and_not_compared(tmp_path):
    for name in ("one", "two"):
        run(load_scenario(NAME, {"frequency": [0.5]}), tmp_path / f"{name}.h5")
    with open_record(tmp_path / "one.h5") as one, open_record(tmp_path / "two.h5") as two:
        with pytest.raises(InputError, match="draw them into one figure"):
            compare([one, two])
