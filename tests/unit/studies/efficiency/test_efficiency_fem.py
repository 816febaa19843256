"""Efficiency studies by the load contact model: the model's own efficiency, balances, the paper's figures."""

import numpy as np
import pytest

from tests.support.closures import of_case
from tribodyn.errors import InputError
from tribodyn.geometry.modification import UNMODIFIED
from tribodyn.record.reader import Record
from tribodyn.studies.efficiency.along_path import cycle_efficiency, engage
from tribodyn.studies.efficiency.mesh_positions import places
from tribodyn.studies.efficiency.run import efficiencies, prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.papers.diez_ibarbia_study import load_contact

INVOLUTE = "efficiency-involute-18-36"
FEM = {"mesh.compliance": "fem"}


@pytest.fixture(scope="module")
def study():
    return prepare(load_scenario(INVOLUTE, FEM))


def coulomb(study, mu):
    return study.duty._replace(closure=of_case(study.case, "coulomb", coefficient=mu))


@pytest.mark.parametrize("way", [1, -1], ids=["pinion drives", "gear drives"])
@pytest.mark.parametrize("mu", [0.01, 0.0473, 0.1])
def test_with_coulomb_friction_it_is_the_load_contact_models_efficiency(study, mu, way):
    """Two quadratures over one mesh cycle: crowded Gauss nodes here, equal steps there."""
    duty = coulomb(study, mu)
    duty = duty._replace(gear_torque=way * duty.gear_torque)
    found = cycle_efficiency(study.cycle, study.path, duty, flanks=study.flanks).efficiency
    other = load_contact(study.flanks.flexible, duty.gear_torque, mu, positions=960).efficiency
    assert found == pytest.approx(other, abs=1e-6)


# Diez-Ibarbia et al. at x = 0: a separate prototype's load contact model and Höhn, %: published.json.
@pytest.mark.parametrize(
    ("speed", "torque", "model", "by_hoehn"),
    [
        ("1500 rpm", "318.3 N*m", 99.127, 99.145),
        ("6000 rpm", "79.58 N*m", 99.465, 99.462),
        ("1500 rpm", "1273.2 N*m", 98.883, 98.969),
    ],
)
def test_operating_conditions_of_the_paper(speed, torque, model, by_hoehn):
    overrides = {"operating.pinion_speed": speed, "operating.gear_torque": torque, **FEM}
    found = efficiencies(prepare(load_scenario(INVOLUTE, overrides)))
    assert 100 * found["efficiency_elastic"] == pytest.approx(model, abs=0.005)
    assert 100 * found["efficiency_hoehn"] == pytest.approx(by_hoehn, abs=0.002)


@pytest.mark.parametrize("sharing", ["uniform", "single-pair"])
def test_other_load_sharings_know_only_the_path(study, sharing):
    """The same as on a table by the energy method, which has no corner contact."""
    duty = study.duty._replace(sharing=sharing)
    plain = prepare(load_scenario(INVOLUTE))
    found = cycle_efficiency(study.cycle, study.path, duty, flanks=study.flanks).efficiency
    assert found == pytest.approx(cycle_efficiency(plain.cycle, plain.path, duty).efficiency, abs=1e-11)


@pytest.mark.parametrize("law", ["coulomb", "masjedi-khonsari"])
def test_torque_and_power_balance_corners_included(study, law):
    values = {"coefficient": 0.06} if law == "coulomb" else {}
    duty = study.duty._replace(closure=of_case(study.case, law, **values))
    mesh = places(study.cycle, study.path, np.linspace(0.003, 0.997, 61), "elastic", study.flanks)
    state = engage(mesh, duty)
    np.testing.assert_allclose(state.gear_torque, duty.gear_torque, rtol=1e-9)
    np.testing.assert_allclose(state.power_in, state.power_out + state.power_friction, rtol=1e-9)
    start, end = study.flanks.flexible.assembly.roll_limits
    beyond = (mesh.roll < start) | (mesh.roll > end)
    assert np.any(state.normal_load[beyond] > 0)
    assert np.all(state.central_film_thickness[state.normal_load > 0] > 0)


@pytest.mark.parametrize(
    "modified",
    [
        {
            **{f"drive.{gear}.modification.tip_relief": "12 um" for gear in ("pinion", "gear")},
            **{f"drive.{gear}.modification.tip_relief_length": "3 mm" for gear in ("pinion", "gear")},
        },
        {"mesh.misalignment.in_plane": "1 arcmin", "mesh.slices": 11},
    ],
    ids=["tips", "tilt"],
)
def test_of_modified_flanks_it_is_the_load_contact_models_efficiency(modified):
    """One coefficient of friction: the same loads as the load contact model's, slices and all."""
    study = prepare(load_scenario(INVOLUTE, {**FEM, **modified}))
    duty = coulomb(study, 0.06)
    found = cycle_efficiency(study.cycle, study.path, duty, flanks=study.flanks).efficiency
    flexible, modifications, slices, coupled = study.flanks
    other = load_contact(flexible, duty.gear_torque, 0.06, 240, modifications, slices, coupled)
    assert found == pytest.approx(other.efficiency, abs=3e-6)
    plain = load_contact(flexible, duty.gear_torque, 0.06, 240)
    if slices == 1:
        assert abs(found - plain.efficiency) > 3e-5
    else:
        assert other.contact_ratio != pytest.approx(plain.contact_ratio, abs=1e-3)
        mesh = places(study.cycle, study.path, np.array([0.3, 0.7]), "elastic", study.flanks)
        even = places(
            study.cycle,
            study.path,
            np.array([0.3, 0.7]),
            "elastic",
            study.flanks._replace(modifications=UNMODIFIED),
        )
        tilted, level = engage(mesh, duty), engage(even, duty)
        assert np.max(tilted.hertz_pressure) > 1.1 * np.max(level.hertz_pressure)


def test_the_quadrature_resolves_where_corners_begin_to_carry(study):
    coarse, fine = (
        cycle_efficiency(study.cycle, study.path, study.duty, n, study.flanks).efficiency for n in (20, 120)
    )
    assert coarse == pytest.approx(fine, abs=1e-6)


def test_its_record_has_the_corners_and_reads_like_any_other(tmp_path):
    done = run(load_scenario(INVOLUTE, FEM), tmp_path / "study.h5")
    assert done.summary["contact_ratio"] == pytest.approx(1.611, abs=1e-3)
    # effective contact ratio at 159 N·m on the pinion, by a separate prototype: 1.733 ± 0.02
    assert done.summary["contact_ratio_effective"] == pytest.approx(1.733, abs=0.02)
    with Record(done.path) as record:
        load = record["normal_load"]
        touching = np.mean(np.sum(load[:-1] > 0, axis=1))
        assert touching == pytest.approx(done.summary["contact_ratio_effective"], abs=0.02)
        np.testing.assert_allclose(record["power_in"], record["power_out"] + record["power_friction"])
        assert np.all(np.isfinite(record["transmission_error_rotational"]))


@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        ({"mesh.hertz": "load-dependent"}, r"mesh\.hertz.*contains the Hertz contact"),
        ({"mesh.foundation": "ring"}, r"mesh\.foundation.*contains the gear bodies"),
        ({"mesh.compliance": "fame"}, r"mesh\.compliance"),
        ({"drive.gear.bore_radius": "0 mm"}, "bore_radius"),
    ],
)
def test_what_does_not_fit_is_refused(overrides, said):
    with pytest.raises(InputError, match=said):
        prepare(load_scenario(INVOLUTE, FEM | overrides))
