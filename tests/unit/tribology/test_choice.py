"""`law = "auto"`: the law nearest to the solved contact of those whose range holds at the duty."""

import pytest

from tests.support.short_studies import written_template
from tribodyn.errors import InputError
from tribodyn.studies.ehl.judgement import judgement
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.sweep.grid import Grid
from tribodyn.tribology.closure import with_laws
from tribodyn.tribology.law import AUTO

#: Duties of the template's pair at which different laws are nearest.
DUTIES = {
    "in the range of the mixed law": {},
    "rough, in the range of the standard": {"drive.roughness": "2 um", "drive.mean_roughness": "0.8 um"},
    "rough and light": {
        **{"drive.roughness": "2 um", "drive.mean_roughness": "0.8 um"},
        **{"operating.gear_torque": "60 N*m", "operating.oil_temperature": "60 degC"},
    },
}


@pytest.fixture(scope="module")
def scenario(tmp_path_factory):
    return written_template("efficiency", tmp_path_factory.mktemp("auto"))


@pytest.mark.parametrize("name", DUTIES)
def test_the_law_that_is_taken_is_within_its_factor_of_the_solved_contact(scenario, name):
    """What it states holds in nine of ten contacts; the median over a mesh is milder than these."""
    case = load_scenario(scenario, DUTIES[name])
    low, high = (float(part) for part in case.friction.chosen.split(": ")[1].split(" times")[0].split(" to "))
    found = judgement(case, positions=4).laws["friction", str(case.friction.law)]
    assert low <= found.median <= high


def test_different_duties_have_different_laws(scenario):
    taken = {name: load_scenario(scenario, duty) for name, duty in DUTIES.items()}
    assert [case.friction.law for case in taken.values()] == ["masjedi-khonsari", "iso-14179-1", "schlenk"]
    mixed = taken["in the range of the mixed law"]
    assert mixed.film.law is None  # its own
    for name, case in taken.items():
        assert ("at which no range holds" in case.film.chosen) == (name == "rough and light")


def test_cases_of_a_sweep_have_the_laws_of_the_scenario_as_written(scenario):
    roughness = ["drive.roughness=0.2,2um"]
    grid = Grid(str(scenario), roughness, {"drive.mean_roughness": "0.8 um"})
    assert [grid.case((i,)).friction.law for i in range(2)] == ["masjedi-khonsari"] * 2
    assert grid.base.chosen()["friction.law"].startswith("masjedi-khonsari, nearest")
    assert (
        load_scenario(scenario, DUTIES["rough, in the range of the standard"]).friction.law
        != "masjedi-khonsari"
    )


def test_a_law_named_later_was_not_chosen(scenario):
    case = load_scenario(scenario)
    assert case.friction.chosen
    assert with_laws(case, friction="xu").friction.chosen == ""


@pytest.mark.parametrize(
    ("overrides", "message"),
    [
        ({"operating.gear_torque": "0 N*m", "mesh.backlash": "0.05 mm"}, r'law = "auto".* no torque'),
        ({"friction.coefficient": 0.05}, r'friction\.coefficient = 0\.05: contradicts law = "auto"'),
        ({"drive.pinion.addendum": 0.1, "drive.gear.addendum": 0.1}, "drive"),  # the teeth do not meet
    ],
)
def test_what_auto_cannot_be_asked(tmp_path, overrides, message):
    scenario = written_template("gear-pair", tmp_path)
    with pytest.raises(InputError, match=message):
        load_scenario(scenario, {"friction.law": AUTO, **overrides})
