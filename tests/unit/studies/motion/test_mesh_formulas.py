"""`losses.mesh`: the loss of loaded meshes by a standard's formula, at points of operation."""

import numpy as np
import pytest

from tests.support.three_gearboxes import GEARBOXES
from tribodyn.cases.loss_part import OperatingPoints
from tribodyn.errors import InputError
from tribodyn.studies.motion.losses.part import LOSSES
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation.books.stplus_fzg_c import SCENARIO

FZG = {
    "title": "FZG type C",
    "kind": "gear-pair",
    "drive": SCENARIO["drive"],
    "lubricant": SCENARIO["lubricant"],
    "operating": {"gear_torque": "195 N*m", "pinion_speed": "1500 rpm", "oil_temperature": "60 degC"},
    "bearings": "rigid-1e9",
    "mesh": {"compliance": "constant", "stiffness": "2e8 N/m", "damping_ratio": 0.05},
    "friction": {"law": "coulomb", "coefficient": 0.05},
    "losses": {"mesh": "iso-14179-2"},
}


def lost(case, load=1.0, pace=1.0):
    nominal = LOSSES.nominal(case)
    points = OperatingPoints(
        np.array([load]), pace * np.array([nominal.input_speed]), np.array([nominal.oil_temperature])
    )
    return LOSSES.at(case, points)


def of_formula(found) -> list[str]:
    """Limits that a formula exceeds, without those of the film law."""
    return [limit for limit in found.exceeded[0] if not limit.startswith("range of the film law")]


def test_another_programs_loss_of_the_fzg_pair():
    """STplus 11.1F: 177.9 W, mean friction 0.045."""
    case = load_data(FZG, "fzg").case
    found = lost(case)
    assert [source.method for source in found.sources] == ["iso-14179-2"]
    assert float(found.power([157.08])[0, 0]) == pytest.approx(177.9, rel=1e-3)
    assert float(found.meshes["friction_coefficient_mean"][0, 0]) == pytest.approx(0.045, abs=5e-4)
    assert not of_formula(found)
    light = lost(case, load=0.1, pace=-0.01)
    assert [limit[:9] for limit in of_formula(light)] == ["pitch lin", "load per "]
    assert 0.0 < light.total()[0] < found.total()[0]


def test_all_meshes_of_a_set_and_both_directions():
    case = load_data(GEARBOXES["planetary"] | {"losses": {"mesh": "schlenk"}}, "set").case
    forth, back, still = lost(case), lost(case, load=-1.0), lost(case, pace=0.0)
    assert {source.method for source in forth.sources} == {"schlenk"}
    suns = ["sun" in source.element for source in forth.sources]
    assert np.ptp(forth.drag[0, suns]) < 1e-6 * forth.total()[0]
    assert back.total()[0] == pytest.approx(forth.total()[0], rel=0.03)
    assert forth.total()[0] < still.total()[0] < 10.0 * forth.total()[0]


def test_a_run_tells_the_formulas_loss_by_term(tmp_path):
    case = load_data(FZG | {"solver": {"cycles": 2}, "output": {"samples_per_cycle": 40}}, "fzg").case
    summary = run(case, tmp_path / "run.h5").summary
    losses = summary["losses"]
    assert losses["terms"]["P_VZP"] == pytest.approx(177.9, rel=1e-3)
    assert losses["elements"]["1"]["method"] == "iso-14179-2"
    assert losses["power_in"] == pytest.approx(losses["power_out"] + losses["power_lost"], rel=1e-12)
    assert summary["power_friction_mean"] == pytest.approx(0.05 / 0.045 * 177.9, rel=0.05)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("crc-23-47", 'formula of involutes.*"crc"'),
        ("efficiency-oil-18-36", "points of operation of gear pairs and trains"),
        ("assessment-helical-24-95", "points of operation of gear pairs and trains"),
    ],
)
def test_where_there_is_no_formula(name: str, words: str):
    with pytest.raises(InputError, match=rf"(?s)losses.mesh.*{words}"):
        load_scenario(name, {"losses.mesh": "schlenk"})
