"""Shipped trains: their teeth touch in their places, and they repeat when they are said to."""

import pytest

from tests.support.train_scenarios import train_case
from tests.support.turning_outlines import assert_teeth_touch
from tribodyn.input.sources import find_scenario
from tribodyn.studies.motion.assembly import assemblies

PERIODS = {
    "idler-train": 1,
    "two-stage-reducer": 3,
    "two-stage-reducer-hunting": 61,
    "two-pinions-bull-gear": 1,
}


@pytest.mark.parametrize("name", PERIODS)
def test_a_shipped_train(name: str):
    case = train_case(find_scenario(name))
    assert case.period == PERIODS[name]
    assert_teeth_touch(case)
    for mesh, pair in zip(case.meshes, assemblies(case), strict=True):
        width = float(pair.common_width * pair.path.gear_pitch_radius)
        # tangential load over width as industrial gears carry it, N/mm
        assert 100.0 < mesh.pair.operating.gear_torque / width / 1e3 < 300.0
