"""Efficiency where the gear drives: roles exchanged, the running model at rest, balances, the record."""

import numpy as np
import pytest

from tests.support.closures import LOCAL_LAWS, VECIANA, coulomb, of_case, under
from tests.support.pair_outputs import outputs
from tribodyn.record.reader import Record
from tribodyn.solve.initial import static_equilibrium
from tribodyn.studies.efficiency.along_path import cycle_efficiency, engage
from tribodyn.studies.efficiency.mesh_positions import SHARINGS, places
from tribodyn.studies.efficiency.published import torque_ratio
from tribodyn.studies.efficiency.run import efficiencies, prepare, quantities_of
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.train.schedule import interval_of
from tribodyn.validation.papers.veciana_study import involute_contact

TEETH, RADIUS, RATIO, ANGLE = 27.0, 27e-3, 2.0, np.radians(20.0)
DRIVES = ("efficiency-crc-23-47", "efficiency-cycloidal-23-47")


@pytest.fixture(scope="module", params=DRIVES)
def study(request):
    return prepare(load_scenario(request.param, {"operating.gear_torque": "-500 N*m"}))


@pytest.mark.parametrize("law", LOCAL_LAWS)
def test_a_pair_with_its_gears_exchanged(law):
    """The gear of one drive is the pinion of the other; same load, speed and film at the same place."""
    torque, speed, width = 400.0, 400.0, 0.04
    back = involute_contact(TEETH, RADIUS, RATIO, ANGLE)
    front = involute_contact(TEETH * RATIO, RADIUS * RATIO, 1.0 / RATIO, ANGLE)
    closure = under(law, VECIANA)
    found = torque_ratio(back, torque, speed, width, closure, gear_drives=True)
    other = torque_ratio(front, torque, speed / RATIO, width, closure)
    np.testing.assert_allclose(found.normal_load, other.normal_load[::-1], rtol=1e-12)
    np.testing.assert_allclose(found.torque_ratio, other.torque_ratio[::-1], rtol=1e-12)
    assert found.efficiency == pytest.approx(other.efficiency, rel=1e-13)


@pytest.mark.parametrize("mu", [0.05, 0.15])
def test_torque_ratio_is_the_balance_of_moments(mu):
    """Γ1/Γ2 = [1 − s μ (tan α + ψ)]/[i − s μ (i tan α − ψ)]: the terms of Veciana (56), friction reversed."""
    pair = involute_contact(TEETH, RADIUS, RATIO, ANGLE)
    found = torque_ratio(pair, 400.0, 400.0, 0.04, coulomb(mu), gear_drives=True)
    psi, s = pair.rotation, np.sign(pair.rotation)
    pinion, gear = 1 - s * mu * (np.tan(ANGLE) + psi), RATIO - s * mu * (RATIO * np.tan(ANGLE) - psi)
    np.testing.assert_allclose(found.torque_ratio, pinion / gear, rtol=1e-13)


@pytest.mark.parametrize("sharing", SHARINGS)
def test_balance_at_every_phase(study, sharing):
    duty = study.duty._replace(sharing=sharing, closure=of_case(study.case, "coulomb", coefficient=0.06))
    state = engage(places(study.cycle, study.path, np.linspace(0.003, 0.997, 61), sharing), duty)
    np.testing.assert_allclose(state.gear_torque, -500.0, rtol=1e-11)
    assert np.all(state.pinion_torque < 0.0)
    assert np.all(state.power_friction > 0.0)
    np.testing.assert_allclose(state.power_in, state.power_out + state.power_friction, rtol=1e-10)
    # friction opposes the sliding, and each gives its power to the other with its sign
    assert np.all(state.friction_force * state.sliding >= 0.0)
    means = cycle_efficiency(study.cycle, study.path, duty)
    assert means.efficiency == pytest.approx(means.power_in / means.power_out, abs=1e-12)
    assert 0.97 < means.efficiency < 1.0


def test_one_pair_at_a_time_has_constant_input_torque(study):
    """The gear's torque is given and the input: both methods of unit contact ratio are one."""
    found = efficiencies(study)
    assert found["efficiency_single_pair"] == pytest.approx(found["efficiency_torque_ratio"], abs=1e-8)


def test_the_running_model_at_rest_has_the_same_loads_and_friction(prepared):
    """Back flanks of the six-degree-of-freedom model, in bearings that do not give, at random phases."""
    stiff = {f"bearings.{body}.stiffness_{axis}": "1e13 N/m" for body in ("pinion", "gear") for axis in "xy"}
    same = {"operating.gear_torque": "-500 N*m", "friction.law": "coulomb", "friction.coefficient": 0.06}
    case = prepared("crc-23-47", **same, **stiff, **{"mesh.backlash": "0.05 mm"})
    cycle = case.cycle
    phase = np.random.default_rng(3).uniform(0.0, 1.0, 12)
    _, _, interval = interval_of(phase, case.model.schedule)
    states = [
        static_equilibrium(case.model, at, number)
        for at, number in zip(phase, interval.tolist(), strict=True)
    ]
    found = outputs(phase, np.stack(states), case.model)
    study = prepare(load_scenario("efficiency-crc-23-47", same))
    mesh = places(study.cycle, study.path, np.linspace(0.0, 1.0, 801))
    slow = engage(mesh, study.duty)
    carries, behind = slow.normal_load > 0.0, cycle.side < 0
    order = np.argsort(mesh.cycle.signed_distance[:, 0][carries])
    distance = mesh.cycle.signed_distance[:, 0][carries][order]
    loaded = found["normal_load"][:, behind] > 0.0
    assert np.any(np.sum(loaded, axis=1) == 2)
    at = -found["sliding_speed"][:, behind][loaded] / (10.0 * (1.0 + 23 / 47))
    off = np.abs(at) > 1e-4  # about the pitch point the running model turns friction over a width
    for name, values in (("normal_load", slow.normal_load), ("friction_force", slow.friction_force)):
        assert not np.any(found[name][:, ~behind])
        expected = np.interp(at[off], distance, values[carries][order])
        seen = found[name][:, behind][loaded][off]
        np.testing.assert_allclose(seen, expected, atol=2e-3 * np.max(np.abs(expected)))


def test_the_record_begins_where_a_pair_enters(tmp_path):
    """At the pinion's tip, which is the end of the table's path; from there it slides as in approach."""
    case = load_scenario(DRIVES[0], {"operating.gear_torque": "-500 N*m"})
    result = run(case, tmp_path / "back.h5")
    assert result.summary["driving_gear"] == "gear"
    assert result.summary["power_in_mean"] == pytest.approx(500.0 * 10.0 * 23 / 47, rel=1e-12)
    assert result.summary["efficiency"] == result.summary["efficiency_elastic"]
    with Record(result.path) as record:
        np.testing.assert_allclose(record["time"], record["pinion_angle"] / 10.0, rtol=1e-12)
        newest = record.pairs.index(1)
        sliding, load = record["sliding_speed"], record["normal_load"]
        assert np.all(np.isfinite(sliding[:-1, newest]))
        assert np.all(np.diff(sliding[:-1, newest]) > 0.0)
        assert sliding[0, newest] < 0.0
        # the pair that entered in this cycle is the older one of the next, which is like it
        older = record.pairs.index(0)
        assert sliding[-2, newest] == pytest.approx(sliding[0, older], abs=0.02 * np.nanmax(sliding))
        assert load[-1, newest] > 1.5 * load[0, newest]
        assert load[-1, older] == 0.0
        assert np.all(record["power_in"] < 0.0)
        assert np.all(record["transmission_error_rotational"] < 0.0)
        assert np.nanmin(record["transmission_error_normal"]) > 0.0
        efficiency = record["efficiency"]
        np.testing.assert_allclose(efficiency, record["power_in"] / record["power_out"], rtol=1e-10)


def test_friction_makes_the_difference_of_both_ways():
    """Without friction they are one; with it the loss is the same but for its square."""
    both = []
    for torque in ("500 N*m", "-500 N*m"):
        both.append(quantities_of(load_scenario(DRIVES[0], {"operating.gear_torque": torque})))
    forward, backward = both
    loss = 1.0 - forward["efficiency"]
    assert backward["efficiency"] == pytest.approx(forward["efficiency"], abs=2.0 * loss**2)
    assert backward["efficiency"] != forward["efficiency"]
    assert backward["normal_load_max"] == pytest.approx(forward["normal_load_max"], rel=0.02)


@pytest.mark.parametrize("torque", [500.0, -500.0])
def test_relief_acts_on_the_flanks_that_carry(torque: float):
    """Of the driving flanks alone it changes nothing where the gear drives, unless the file says both."""
    relief = {"drive.pinion.modification": {"tip_relief": "20 um", "tip_relief_length": "2 mm"}}
    both = {"drive.pinion.modification": {**relief["drive.pinion.modification"], "both_flanks": True}}

    def loads(modification):
        given = {"operating.gear_torque": f"{torque} N*m", "mesh.compliance": "fem", **modification}
        study = prepare(load_scenario("efficiency-crc-23-47", given))
        at = places(study.cycle, study.path, np.linspace(0.003, 0.997, 31), study.duty.sharing)
        return engage(at, study.duty).normal_load

    plain, one_flank, both_flanks = loads({}), loads(relief), loads(both)
    assert np.array_equal(one_flank, plain) == (torque < 0.0)
    assert not np.allclose(both_flanks, plain, rtol=1e-3)
