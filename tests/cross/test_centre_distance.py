"""A pair half a millimetre off its tight mesh in every study of gears: base circles carry the torque."""

import math

import numpy as np
import pytest

from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.studies import STUDIES
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load

#: The drive of 18-36: module 3 mm, 20 degrees, so that a_0 = 81 mm.
OFF = {"drive.centre_distance": "81.5 mm"}
WORKING = math.acos(81.0 / 81.5 * math.cos(math.radians(20)))
BASE = 3e-3 * 36 / 2 * math.cos(math.radians(20))


def test_dynamics_are_of_the_operating_line_of_action():
    case = load("involute-18-36", OFF).case
    inv = [math.tan(angle) - angle for angle in (WORKING, math.radians(20))]
    backlash = 3e-3 * math.cos(math.radians(20)) * 54 * (inv[0] - inv[1])
    assert case.pair.mesh.backlash == pytest.approx(backlash, rel=1e-9)
    cycle = prepare(case).cycle
    back = np.asarray(cycle.gap)[..., np.asarray(cycle.side) < 0]
    assert back == pytest.approx(backlash, rel=1e-9)
    assert np.asarray(cycle.pressure_angle) == pytest.approx(WORKING, rel=1e-12)
    assert float(cycle.gear_pitch_radius) * math.cos(WORKING) == pytest.approx(BASE, rel=1e-12)
    loads = quasi_static(cycle, case.pair.operating.gear_torque).normal_load.sum(axis=-1)
    assert loads == pytest.approx(case.pair.operating.gear_torque / BASE, rel=1e-9)


def test_the_efficiency_is_that_of_its_loss_factor():
    given = OFF | {"friction.law": "coulomb", "friction.coefficient": 0.01}
    loaded = load("efficiency-involute-18-36", given)
    found = STUDIES["efficiency"].quantities_of(loaded.case)
    tips = [math.sqrt(r**2 - b**2) for r, b in ((30e-3, BASE / 2), (57e-3, BASE))]
    length = 81.5e-3 * math.sin(WORKING)
    pitch = 3e-3 * math.pi * math.cos(math.radians(20))
    pinion = (tips[0] - length / 3) / pitch
    gear = (tips[1] - length * 2 / 3) / pitch
    hoehn = math.pi * 1.5 / 18 * (1 - pinion - gear + pinion**2 + gear**2)
    assert found["contact_ratio"] == pytest.approx(pinion + gear, rel=1e-9)
    assert found["efficiency_hoehn"] == pytest.approx(1 - 0.01 * hoehn, rel=1e-9)
    assert found["efficiency_uniform"] == pytest.approx(1 - 0.01 * hoehn, abs=2e-5)


@pytest.mark.soak
@pytest.mark.parametrize("name", ["involute-18-36", "involute-18-36-fem", "load-contact-18-36"])
def test_it_runs(name, tmp_path):
    loaded = load(name, OFF)
    result = loaded.study.run(loaded.case, tmp_path / "off.h5")
    assert result.status == "complete"
