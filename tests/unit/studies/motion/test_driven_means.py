"""Means of a run under a motor's torque, by the time it takes; reversed loads; the energy without load."""

import numpy as np
import pytest

import tribodyn as td
from tests.support.states import PAIR, WORK_DAMPING, WORK_FRICTION, WORK_IN
from tribodyn.gears.motion.running import energy_residual
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

DRIVEN = {
    "operating.source": "torque",
    "operating.pinion_speed": "100 rad/s",
    "operating.speed_regulation": "0.5 N*m*s/rad",
    "friction.law": "none",
    "solver.cycles": 4,
    "output.samples_per_cycle": 12,
}


def test_mean_powers_are_works_over_time(tmp_path):
    """The window's last interval counts as much as the others, also while the speed changes."""
    driven = {**DRIVEN, "operating.pinion_torque": "500 N*m"}
    result = run(load_scenario("crc-23-47", driven), tmp_path / "driven.h5")
    with Record(result.path) as record:
        window = slice(-1 - 12, None, 12)
        time, work = np.diff(record["time"][window])[0], np.diff(record["work_in"][window])[0]
        assert np.ptp(record["velocity"][-13:, 4]) > 1e-3
        assert result.summary["power_in_mean"] == pytest.approx(work / time, rel=1e-12)
        assert result.summary["mesh_frequency"] == pytest.approx(1.0 / time, rel=1e-12)


def test_a_sweep_has_the_mean_powers_of_its_run(tmp_path):
    """Both ends of the window lie behind the engagement there, which takes work from the drive."""
    table = {"time": {"unit": "ms", "values": [0, 30]}, "torque": {"unit": "N*m", "values": [100, 2000]}}
    keys = {
        "mesh.compliance": "constant",
        "mesh.stiffness": "9e8 N/m",
        "mesh.formulation": "energy-consistent",
        "operating.gear_torque_table": table,
        "friction.law": "none",
        "solver.cycles": 8,
    }
    at_speed = {**keys, "operating.pinion_speed": "100 rad/s"}
    alone = run(load_scenario("crc-23-47", at_speed), tmp_path / "alone.h5").summary
    speed = {"operating.pinion_speed": ["100 rad/s"]}
    swept = td.sweep("crc-23-47", speed, keys, transient=8, output=tmp_path / "swept.h5")
    assert float(swept.power_in_mean[0]) == pytest.approx(alone["power_in_mean"], rel=1e-7)


def test_a_load_reversed_without_back_flanks(tmp_path):
    """Without backlash there are driving flanks only, whatever the load does."""
    table = {"time": {"unit": "ms", "values": [0, 3]}, "torque": {"unit": "N*m", "values": [0, -550]}}
    reversed_load = {**DRIVEN, "operating.source": "speed", "operating.gear_torque_table": table}
    del reversed_load["operating.speed_regulation"]
    result = run(load_scenario("crc-23-47", reversed_load), tmp_path / "reversed.h5")
    assert result.status == "complete"
    assert result.summary["contact_loss_fraction"] > 0
    assert np.isfinite(result.summary["transmission_error_mean"])


def test_energy_residual_without_load():
    """Friction that feeds the vibration and damping that takes it: the drive does next to nothing."""
    first, last = np.zeros(PAIR.states), np.zeros(PAIR.states)
    last[[WORK_IN, WORK_FRICTION, WORK_DAMPING]] = 1e-9, -2.0, 1.5
    assert energy_residual(first, last, 0.5 + 1e-9 + 2e-7, PAIR) == pytest.approx(-1e-7, rel=1e-6)
    last[[WORK_IN, WORK_FRICTION]] = 3.0, 0.5
    assert energy_residual(first, last, 1.0 - 3e-7, PAIR) == pytest.approx(1e-7, rel=1e-6)
