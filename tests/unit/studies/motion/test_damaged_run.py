"""A run with damaged teeth: its energy, its orders, its friction."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mesh.teeth.damage.gear import damaged_gear
from tribodyn.mesh.teeth.fields import LEADING
from tribodyn.mesh.teeth.table import places_of
from tribodyn.studies.motion.prepare import prepare

TEETH, SAMPLES, SCUFFED = 18, 40, 12
DAMAGE = [
    {"gear": "pinion", "tooth": 5, "kind": "crack", "depth": "1.7 mm"},
    {"gear": "pinion", "tooth": SCUFFED, "kind": "scuffing", "factor": 2.0, "height": 0.6, "length": "2 mm"},
    {"gear": "pinion", "tooth": 15, "kind": "broken-tip", "height": 0.85},
]
SPALL = {"gear": "gear", "tooth": 9, "kind": "spall", "depth": "0.2 mm", "height": 0.5, "length": "2 mm"}
SHORT = {"solver.revolutions": 6, "output.samples_per_cycle": SAMPLES, "output.window": "all"}


@pytest.fixture(scope="module")
def run():
    return td.run("crack-18-36", SHORT | {"damage": DAMAGE}, progress=False)


def test_energy_closes(run):
    changes = SHORT | {"damage": [*DAMAGE, SPALL | {"width": "10 mm"}], "solver.revolutions": 2}
    whole = td.run("crack-18-36", changes, progress=False)
    assert run.summary["energy_residual"] < 1e-6
    assert whole.summary["energy_residual"] < 1e-6


def test_teeth_of_the_pinion_make_its_orders_and_no_others(run):
    """Of the last two revolutions, one of the gear: every second line, of the pinion's, and no other."""
    error = run.data["transmission_error_rotational"].values[:-1]
    lines = np.abs(np.fft.rfft(error[-2 * TEETH * SAMPLES :])) / error[-2 * TEETH * SAMPLES :].size * 2.0
    of_pinion, others = lines[2::2], lines[1::2]
    sidebands = np.delete(of_pinion, np.arange(TEETH - 1, len(of_pinion), TEETH))
    assert sidebands.max() > 1e-7
    assert others.max() < 1e-3 * sidebands.max()


def test_friction_is_raised_where_the_flank_is_scuffed(run):
    coefficient, load = (run.data[name].values for name in ("friction_coefficient", "normal_load"))
    cycle = np.arange(len(coefficient)) // SAMPLES % TEETH  # the tooth that entered last
    touches = (cycle == SCUFFED - 1) | (cycle == SCUFFED)
    raised = (coefficient * (load > 0.0)).max(axis=1) > 0.05 * (1.0 + 1e-9)
    assert np.any(raised)
    assert not np.any(raised & ~touches)
    assert np.nanmax(coefficient) == pytest.approx(0.1, rel=1e-2)


def test_finite_elements_solve_the_cracked_tooth():
    """The same crack by both compliances of the mesh: alike where a load is high on the flank."""
    added = []
    for compliance in ("energy", "fem"):
        case = prepare(td.scenario("crack-18-36", {"mesh.compliance": compliance}))
        places = places_of(case.assembly, case.warm_pairs[0].mesh, case.cycle)[0].driver
        gear = damaged_gear(case.assembly, case.warm_pairs[0].materials, "pinion", solved=compliance == "fem")
        own = case.warm_pairs[0].teeth[0][0].in_mesh(gear).fields(4, LEADING, places)
        share = np.linspace(0.5, 1.0, 5)
        height = (places.distance - places.distance[0]) / (places.distance[-1] - places.distance[0])
        added.append(np.interp(share, height, own.compliance[0]))
        channel = case.model.meshes[0].teeth.driver.channel[..., 1, 0]
        assert channel.max() == pytest.approx(own.compliance.max(), rel=0.02)
    np.testing.assert_allclose(added[0], added[1], rtol=0.12)
