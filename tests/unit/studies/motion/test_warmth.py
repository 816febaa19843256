"""In a lumped network the meshes of a train heat one oil: what leaves it is what all of them lose."""

import pytest

from tests.support.warmed_reducer import NETWORK, temperatures_of
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run


def test_quasi_static_losses_heat_one_oil():
    prepared = prepare(load_scenario("two-stage-reducer", NETWORK))
    losses = [heat.mesh_loss for heat in prepared.thermal]
    oil, gears = temperatures_of(losses)
    for heat, pair, (pinion, gear) in zip(prepared.thermal, prepared.warm_pairs, gears, strict=True):
        assert heat.temperatures.oil == pytest.approx(oil, abs=0.1)
        assert heat.temperatures.pinion == pytest.approx(pinion, abs=0.1)
        assert heat.temperatures.gear == pytest.approx(gear, abs=0.1)
        assert pair.lubricant.temperature == pytest.approx(0.5 * (pinion + gear), abs=0.1)


def test_a_run_settles_at_the_losses_of_its_motion(tmp_path):
    keys = {**NETWORK, "solver.cycles": 12, "output.samples_per_cycle": 40}
    keys |= {"friction.law": "coulomb", "friction.coefficient": 0.05}
    found = run(load_scenario("two-stage-reducer", keys), tmp_path / "warm.h5").summary["meshes"]
    oil, gears = temperatures_of([mesh["power_friction_mean"] for mesh in found.values()])
    for mesh, own in zip(found.values(), gears, strict=True):
        assert mesh["oil_temperature"] == pytest.approx(oil, abs=0.3)
        assert mesh["bulk_temperature"] == pytest.approx(sum(own) / 2.0, abs=0.3)
