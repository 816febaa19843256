"""Sensors on the bearings of drawn shafts that carry several gears; what they may be on."""

import math
from pathlib import Path

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.record.sensors import read_sensed
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run

SHORT = {
    "solver.cycles": 4,
    "output.samples_per_cycle": 32,
    "mesh.slices": 3,
    "friction.law": "coulomb",
    "friction.coefficient": 0.05,
}


def sensor(at: str, direction: str) -> dict:
    return {
        "name": f"{at}-{direction}",
        "kind": "force",
        "at": at,
        "direction": direction,
        "rate": "12 kHz",
        "filter": "none",
    }


def test_bearings_of_a_middle_shaft_carry_the_thrust_of_both_meshes(tmp_path: Path):
    sensors = [sensor(f"middle-{number}", "z") for number in (1, 2)]
    case = load_scenario("industrial-reducer", {**SHORT, "sensor": sensors})
    run(case, tmp_path / "run.h5")
    with Record(tmp_path / "run.h5") as record:
        bearings = np.asarray(record.geometry["seat_shaft"]) == 1
        at_rest = float(np.sum(record.geometry["seat_force"][bearings, 2]))
        thrust = sum(np.mean(signal.values) for signal in read_sensed(record).signals)
    torques = 75e3 / (1480 * math.pi / 30.0), 75e3 / (1480 * math.pi / 30.0) * 83 / 19
    # T tan β/r of the driver, r = m z/(2 cos β)
    first, second = (
        torque * math.sin(math.radians(helix)) / (module * teeth / 2.0)
        for torque, helix, module, teeth in ((torques[0], 15, 3.5e-3, 19), (torques[1], 12, 5e-3, 21))
    )
    assert at_rest == pytest.approx(second - first, rel=0.01)
    assert thrust == pytest.approx(second - first, rel=0.02)


def test_a_sensor_names_bearings_that_are_there(tmp_path: Path):
    case = load_scenario("industrial-reducer", {**SHORT, "sensor": [sensor("middle-3", "x")]})
    with pytest.raises(InputError, match="middle-3") as raised:
        run(case, tmp_path / "run.h5")
    assert "middle-2" in str(raised.value)
