"""Energy that friction gives to the vibration: measured, said, and no efficiency made of it."""

import numpy as np
import pytest

from tests.support.states import PAIR, WORK_FRICTION, WORK_SLIDING
from tribodyn.gears.motion.steady import friction_work_on_vibration, warning_of
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

BEARINGS = [f"bearings.{gear}.stiffness_{axis}" for gear in ("pinion", "gear") for axis in "xy"]
SOFT = {key: "3e6 N/m" for key in BEARINGS}
SHORT = {"solver.cycles": 8, "output.samples_per_cycle": 20}


def test_dynamic_sliding_is_the_default():
    assert load_scenario("s-gear-23-47").friction.sliding == "dynamic"


@pytest.mark.parametrize("name", ["crc-23-47", "involute-23-47"])
def test_published_drives_keep_the_published_sliding(name):
    assert load_scenario(name).friction.sliding == "kinematic"


def test_soft_bearings_under_kinematic_sliding_make_no_efficiency(tmp_path):
    result = run(load_scenario("crc-23-47", {**SOFT, **SHORT}), tmp_path / "run.h5")
    assert result.status == "complete"
    assert result.summary["efficiency"] is None
    assert "above 1" in result.summary["efficiency_withheld"]
    assert result.summary["friction_work_on_vibration"] > 1.0
    assert 'friction.sliding = "dynamic"' in result.summary["warning"]


def test_the_same_with_dynamic_sliding_has_one(tmp_path):
    case = load_scenario("crc-23-47", {**SOFT, **SHORT, "friction.sliding": "dynamic"})
    summary = run(case, tmp_path / "run.h5").summary
    assert 0.98 < summary["efficiency"] < 1.0
    assert summary["friction_work_on_vibration"] < 0.0
    assert summary["warning"] is None


def test_a_warning_reaches_the_terminal(forked, tmp_path):
    soft = [part for key in BEARINGS for part in ("--set", f"{key}=3e6 N/m")]
    short = ["--set", "solver.cycles=8", "--set", "output.samples_per_cycle=20", "--no-plot"]
    done = forked("run", "crc-23-47", *soft, *short, folder=tmp_path)
    assert done.returncode == 0
    assert "warning: friction feeds the vibration with more than 1 %" in done.stderr
    assert "warning: withheld: efficiency" in done.stderr
    assert "Friction feeds the vibration" in done.stdout


@pytest.mark.parametrize(
    ("nominal", "taken", "share"), [(10.0, 5.0, 0.5), (10.0, 12.0, -0.2), (-1.0, 2.0, -3.0)]
)
def test_the_share_is_of_the_rotations_loss(nominal, taken, share):
    work = np.zeros(PAIR.states)
    work[WORK_SLIDING], work[WORK_FRICTION] = nominal, taken
    assert friction_work_on_vibration(work, PAIR) == pytest.approx(share)
    assert bool(warning_of(share, "dynamic")) == (share > 0.01)


def test_without_friction_there_is_nothing_to_share():
    assert friction_work_on_vibration(np.zeros(PAIR.states), PAIR) is None
    assert warning_of(None, "kinematic") is None
