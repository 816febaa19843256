"""Losses of helical pairs: the closed form of even lines of contact, either gear driving, records."""

import math

import numpy as np
import pytest

from tests.support.helical_pair import HELICAL
from tribodyn.errors import InputError
from tribodyn.record.reader import Record
from tribodyn.studies.efficiency.run import quantities_of, run
from tribodyn.studies.protocol.load import load_scenario

SCENARIO = f"""
kind = "efficiency"
{HELICAL}
[mesh]
load_sharing = "uniform"
slices = 11

[friction]
law = "coulomb"
coefficient = 1e-4
"""


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "helical.toml"
    path.write_text(SCENARIO)
    return lambda **changes: load_scenario(path, {key.replace("__", "."): v for key, v in changes.items()})


def by_hand(addendum=3.0):
    """H_v from the tooth numbers: P = μ F_n (ω_1 + ω_2) ξ̄, ξ̄ = (ξ_A² + ξ_E²)/(2 g_α), lengths in mm."""
    helix, rack = math.radians(20.0), math.radians(20.0)
    transverse = math.atan(math.tan(rack) / math.cos(helix))
    pitch = [3.0 * z / math.cos(helix) / 2.0 for z in (23, 47)]
    base = [r * math.cos(transverse) for r in pitch]
    recess, approach = (
        math.sqrt((r + addendum) ** 2 - b**2) - b * math.tan(transverse)
        for r, b in zip(pitch, base, strict=True)
    )
    mean = (recess**2 + approach**2) / (2.0 * (recess + approach))
    lean = math.cos(math.asin(math.sin(helix) * math.cos(rack)))
    # power over T_1 ω_1, with F_n = T_1/(r_b1 cos β_b)
    return mean * (1.0 + 23.0 / 47.0) / (base[0] * lean)


def test_even_lines_have_the_closed_form_with_the_square_of_the_width(case):
    errors = []
    for slices in (11, 22):
        found = quantities_of(case(mesh__slices=slices))
        assert found["loss_factor"] == pytest.approx(by_hand(), rel=1e-9)
        errors.append((1.0 - found["efficiency_uniform"]) / (1e-4 * by_hand()) - 1.0)
        assert abs(found["energy_residual"]) < 1e-12
    assert abs(errors[1]) < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def test_a_pair_that_touches_by_its_overlap_alone(case):
    """ε_α = 0.94: sections of the face touch one after the other, and all of it is never out of contact."""
    short = {"drive__pinion__addendum": 0.5, "drive__gear__addendum": 0.5}
    found = quantities_of(case(mesh__slices=44, **short))
    assert found["contact_ratio"] < 1.0 < found["total_contact_ratio"]
    assert found["loss_factor"] == pytest.approx(by_hand(1.5), rel=1e-9)
    assert (1.0 - found["efficiency_uniform"]) / (1e-4 * by_hand(1.5)) == pytest.approx(1.0, abs=5e-3)
    with pytest.raises(InputError, match=r"total contact ratio is 0\.\d+, so that a pair parts"):
        quantities_of(case(**short, drive__pinion__face_width="1 mm", drive__gear__face_width="1 mm"))


def test_the_loss_is_the_same_whichever_gear_drives(case):
    """Friction, of order μ, is all that tells them apart."""
    driven = quantities_of(case(operating__gear_torque="-300 N*m"))
    assert driven["driving_gear"] == "gear"
    driving = quantities_of(case())
    assert driven["efficiency"] == pytest.approx(driving["efficiency"], abs=1e-7)


def test_a_small_helix_has_the_losses_of_the_spur_pair(case):
    """With overlap and elasticity: slices enter one by one, and the spur pair at once."""
    spur = quantities_of(case(drive__helix_angle="0 deg", mesh__load_sharing="elastic", mesh__slices="auto"))
    small = quantities_of(
        case(drive__helix_angle="0.01 deg", mesh__load_sharing="elastic", mesh__slices="auto")
    )
    assert 1.0 - small["efficiency"] == pytest.approx(1.0 - spur["efficiency"], rel=0.01)


def test_a_record_has_pairs_and_the_line_load_of_their_slices(case, tmp_path):
    result = run(case(friction__coefficient=0.05, mesh__load_sharing="elastic"), tmp_path / "found.h5")
    with Record(result.path) as record:
        load, line = record["normal_load"][:], record["line_load"][:]
        axial, arm = record["axial_force"][:], record.summary
    assert line.shape == (*load.shape, 11)
    assert arm["normal_load_max"] >= np.max(load) > 0.0
    # Σ F sin β_b: with constant base helix the share of the whole load
    lean = math.asin(math.sin(math.radians(20.0)) * math.cos(math.radians(20.0)))
    np.testing.assert_allclose(np.abs(axial), np.sum(load, axis=1) * math.sin(lean), rtol=1e-9)


def test_one_pair_alone_cannot_carry(case):
    with pytest.raises(InputError, match="slice by slice"):
        quantities_of(case(mesh__load_sharing="single-pair"))


@pytest.mark.parametrize("torque", ["300 N*m", "-300 N*m"])
def test_curves_of_pairs_go_on_from_cycle_to_cycle(case, tmp_path, torque):
    """The last sample is the first one; the pairs are then one older, and go on where they were before."""
    changes = {"operating__gear_torque": torque, "mesh__load_sharing": "elastic", "mesh__slices": 15}
    result = run(case(**changes), tmp_path / "found.h5")
    with Record(result.path) as record:
        load, deflection = record["normal_load"][:], record["transmission_error_normal"][:]
    np.testing.assert_allclose(load[-1], load[0], rtol=1e-9, atol=1e-9 * np.max(load))
    np.testing.assert_allclose(load[-1, :-1], load[-2, 1:], atol=0.02 * np.max(load))
    assert not np.any(np.isnan(deflection[load > 0.2 * np.max(load)]))


def test_teeth_of_a_thermal_network_give_off_the_losses(case):
    """Σ G_i (θ_i − θ_oil) is the friction loss of all slices; the oil stays as it is given."""
    network = {"model": "network", "pinion_oil": "20 W/K", "gear_oil": "40 W/K"}
    warm = {f"temperature__{key}": value for key, value in network.items()}
    sheet = {"lubricant": "iso-vg-220-mineral"}
    found = quantities_of(case(**sheet, **warm, friction__coefficient=0.05, mesh__load_sharing="elastic"))
    assert found["heat_generated"] == pytest.approx(found["power_friction_mean"], rel=1e-3)
    oil = found["oil_temperature"]
    given_off = 20.0 * (found["bulk_temperature_pinion"] - oil) + 40.0 * (
        found["bulk_temperature_gear"] - oil
    )
    assert given_off == pytest.approx(found["heat_generated"], rel=1e-6)
