"""Quasi-static efficiency along the path: balance with friction, limits, other methods, records."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.support.closures import LOCAL_LAWS, of_case
from tribodyn.errors import InputError
from tribodyn.geometry.families import family
from tribodyn.mesh.equilibrium import contacts
from tribodyn.mesh.quasi_static import mean_efficiency
from tribodyn.record.reader import Record
from tribodyn.standards.loss_factors import equal_loads
from tribodyn.studies.efficiency.along_path import MeshDuty, cycle_efficiency, engage
from tribodyn.studies.efficiency.mesh_positions import SHARINGS, places
from tribodyn.studies.efficiency.published import path_contact, tip_contact_ratios, torque_ratio
from tribodyn.studies.efficiency.run import PreparedEfficiency, efficiencies
from tribodyn.studies.efficiency.run import prepare as prepare_study
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.papers.veciana_study import cycloid_contact

DRIVES = ("efficiency-crc-23-47", "efficiency-involute-18-36", "efficiency-cycloidal-23-47")


@pytest.fixture(scope="module")
def studies():
    return {name: prepare_study(load_scenario(name)) for name in DRIVES}


def under(study: PreparedEfficiency, law: str, mu: float = 0.06) -> MeshDuty:
    values = {"coefficient": mu} if law == "coulomb" else {}
    return study.duty._replace(closure=of_case(study.case, law, **values))


def with_coefficient(study: PreparedEfficiency, mu: float) -> MeshDuty:
    return under(study, "coulomb", mu)


@pytest.mark.parametrize("name", DRIVES)
@pytest.mark.parametrize("sharing", SHARINGS)
@pytest.mark.parametrize("law", ["coulomb", *LOCAL_LAWS])
def test_torque_and_power_balance_with_friction(studies, name, sharing, law):
    study = studies[name]
    duty = under(study, law)._replace(sharing=sharing)
    phase = np.linspace(0.003, 0.997, 61)
    mesh = places(study.cycle, study.path, phase, sharing)
    state = engage(mesh, duty)
    np.testing.assert_allclose(state.gear_torque, duty.gear_torque, rtol=1e-11)
    assert np.all(state.normal_load >= 0)
    # what goes in comes out or is lost in sliding, at every phase
    np.testing.assert_allclose(state.power_in, state.power_out + state.power_friction, rtol=1e-10)
    # the friction on the pinion takes the power from the mesh: F_f ω_p (−L_p + w L_g) = −μ F |v_s|
    ratio = study.cycle.pinion_pitch_radius / study.cycle.gear_pitch_radius
    seen = contacts(mesh.cycle, duty.gear_torque, duty.pinion_speed, duty.closure)
    arms = (seen.friction_arm[1] * ratio - seen.friction_arm[0])[:, 0]
    np.testing.assert_allclose(
        np.sum(state.friction_force * arms, axis=-1) * duty.pinion_speed,
        -state.power_friction,
        rtol=1e-9,
        atol=1e-9 * state.power_in.max(),
    )
    found = cycle_efficiency(study.cycle, study.path, duty)
    assert 0.9 < found.efficiency < 1.0
    assert found.power_in - found.power_out - found.power_friction == pytest.approx(
        0, abs=1e-10 * found.power_in
    )


@pytest.mark.parametrize("name", DRIVES)
def test_no_friction_no_loss(studies, name):
    study = studies[name]
    found = cycle_efficiency(study.cycle, study.path, under(study, "none"))
    assert found.efficiency == pytest.approx(1.0, abs=1e-13)


def test_uniform_sharing_is_hoehns_integral_at_small_friction(studies):
    """To first order in μ: 1 − η = μ H_v."""
    study = studies["efficiency-involute-18-36"]
    mu = 1e-5
    found = cycle_efficiency(study.cycle, study.path, with_coefficient(study, mu)._replace(sharing="uniform"))
    factor = equal_loads(*tip_contact_ratios(family("involute"), study.case.drive), 18, 2.0)
    assert (1 - found.efficiency) / mu == pytest.approx(factor, rel=1e-4)


def test_elastic_sharing_is_the_differentiable_one_at_small_friction(studies):
    """`mean_efficiency` leaves friction out of the loads: the same to first order in μ."""
    study = studies["efficiency-crc-23-47"]
    mu = 1e-4
    found = cycle_efficiency(study.cycle, study.path, with_coefficient(study, mu)).efficiency
    other = mean_efficiency(study.cycle, study.duty.gear_torque, mu)
    assert 1 - found == pytest.approx(1 - float(other), rel=2e-4)


def test_single_pair_is_the_torque_ratio(studies):
    """Constant output torque against constant input torque: the same up to the loss squared."""
    study = studies["efficiency-involute-18-36"]
    found = efficiencies(study)
    loss = 1 - found["efficiency_single_pair"]
    assert abs(found["efficiency_single_pair"] - found["efficiency_torque_ratio"]) < loss**2
    assert found["efficiency_hoehn"] == pytest.approx(found["efficiency_loss_factor"], abs=1e-12)
    assert found["efficiency_elastic"] > found["efficiency_uniform"]


@pytest.mark.parametrize("law", ["coulomb", "masjedi-khonsari", "xu"])
def test_a_cycloidal_path_gives_veciana_closed_form(studies, law):
    study = studies["efficiency-cycloidal-23-47"]
    radius, diameter = 34.5e-3, 69e-3
    duty = under(study, law, 0.07)
    common = (duty.gear_torque * 23 / 47, duty.pinion_speed, 0.02, duty.closure)
    circle = 23.5e-3 / diameter
    for exact_speeds in (True, False):
        ours = torque_ratio(path_contact(study.path, 23, exact_speeds=exact_speeds, averaged=False), *common)
        closed = torque_ratio(
            cycloid_contact(23, radius, 47 / 23, circle, circle, exact_speeds=exact_speeds), *common
        )
        np.testing.assert_allclose(ours.torque_ratio, closed.torque_ratio, rtol=1e-8)
        assert ours.efficiency == pytest.approx(float(closed.efficiency), abs=1e-10)


@pytest.mark.parametrize("law", LOCAL_LAWS)
def test_torque_ratio_and_single_pair_agree_on_vanishing_radii(studies, law):
    """Both average the contact at the pitch point over its own width."""
    study = studies["efficiency-cycloidal-23-47"]
    found = efficiencies(replace(study, duty=under(study, law)))
    loss = 1 - found["efficiency_single_pair"]
    assert abs(found["efficiency_single_pair"] - found["efficiency_torque_ratio"]) < loss**2


def test_the_quadrature_resolves_a_vanishing_radius(studies):
    study = studies["efficiency-cycloidal-23-47"]
    coarse, fine = (cycle_efficiency(study.cycle, study.path, study.duty, n).efficiency for n in (20, 120))
    assert coarse == pytest.approx(fine, abs=1e-6)


def test_efficiency_agrees_with_independent_prototypes(studies):
    """Quasi-static efficiency of the CRC drive by a separate prototype: 0.9883."""
    study = studies["efficiency-crc-23-47"]
    assert cycle_efficiency(study.cycle, study.path, study.duty).efficiency == pytest.approx(0.9883, abs=5e-5)


def test_a_pair_that_does_not_cover_a_pitch_cannot_carry_alone():
    study = prepare_study(load_scenario("efficiency-involute-18-36", {"drive.gear.addendum": 0.5}))
    assert study.cycle.roll_start > -math.pi / 18
    with pytest.raises(InputError, match="does not cover half a pitch"):
        places(study.cycle, study.path, np.array([0.5]), "single-pair")
    assert "efficiency_single_pair" not in efficiencies(study)


def test_a_mean_law_needs_a_radius_at_the_pitch_point():
    with pytest.raises(InputError, match=r"friction\.law.*vanish"):
        prepare_study(load_scenario("efficiency-cycloidal-23-47", {"friction.law": "niemann"}))


def test_record_of_a_study_and_of_a_dynamic_run(tmp_path):
    """The study's record reads like a run's; slow dynamics have the efficiency of the study."""
    still = run(load_scenario("efficiency-crc-23-47"), tmp_path / "still.h5")
    assert still.status == "complete"
    with Record(still.path) as record:
        assert record.status == "complete"
        out, lost, put_in = (record[f"power_{name}"] for name in ("out", "friction", "in"))
        np.testing.assert_allclose(put_in, out + lost, rtol=1e-10)
        assert np.all(record["sliding_speed"][0][np.isfinite(record["sliding_speed"][0])] != 0)
        assert record.mesh_cycle["contact_ratio"] == pytest.approx(1.5233, abs=5e-4)
    moving = run(load_scenario("crc-23-47", {"solver.cycles": "4"}), tmp_path / "moving.h5")
    with Record(moving.path) as record:
        put_in, lost, out = (np.ptp(record[f"work_{name}"][-201:]) for name in ("in", "friction", "out"))
    assert 1 - lost / put_in == pytest.approx(moving.summary["efficiency"], abs=2e-5)
    assert out / put_in < 1 - lost / put_in + 1e-4
    assert moving.summary["efficiency"] == pytest.approx(still.summary["efficiency"], abs=3e-4)
