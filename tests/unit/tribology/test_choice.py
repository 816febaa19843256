"""`law = "auto"`: the law nearest to the contact as it is solved at the duty."""

import math

import numpy as np
import pytest

from tests.support.random_duties import departures, drawn, excess
from tests.support.short_studies import written_template
from tribodyn.errors import InputError
from tribodyn.grid.grid import Grid
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.tribology import choice
from tribodyn.tribology.closure import law_input, with_laws
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import AUTO

#: Duties of the template's pair.
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


def test_the_law_that_is_taken_is_the_nearest_or_next_to_it():
    """A pair of 18 and 36 teeth whose standard law is 40 % low, though its range holds."""
    of_lab = {
        "drive": {"like": "diez-ibarbia-18-36"},
        "lubricant": {
            **{"title": "oil", "source": "data sheet", "type": "mineral"},
            **{"viscosity_40": "150 mm**2/s", "viscosity_100": "15 mm**2/s"},
            **{"density_15": "0.88 g/cm**3", "pressure_viscosity": "20 1/GPa"},
        },
        "operating": {**{"pinion_speed": "1500 rpm", "gear_torque": "200 N*m", "oil_temperature": "60 degC"}},
    }
    lab = load_data({"title": "lab", "kind": "efficiency", "friction": {"law": "auto"}, **of_lab}, "lab").case
    found = departures(lab, 5)
    for what in ("film", "friction"):
        assert excess(lab, found, what) < 1.13  # 1.1, and what five places know of the way
    assert found["friction"]["iso-14179-1"] > 0.4
    assert lab.friction.law == "schlenk"


def test_a_law_that_gives_nothing_is_the_furthest():
    """At a hundred times the speed of the shipped pair friction of a law may be 0."""
    law = load_scenario("spur-25-51", {"operating.pinion_speed": "150000 rpm"}).friction
    assert law.law in FRICTION_LAWS
    assert law.ratio is None or min(law.ratio) > 0.0
    nothing = choice.LawAtDuty(FRICTION_LAWS["none"], math.nan, (0.0, 0.0, 0.5), solved=True)
    assert nothing.distance == math.inf


@pytest.mark.soak
def test_the_law_that_is_taken_at_200_duties():
    far: dict[str, int] = {"film": 0, "friction": 0}
    for seed in range(200):
        case = drawn(seed)
        found = departures(case)
        for what in far:
            far[what] += bool(found) and excess(case, found, what) > 1.1
    assert max(far.values()) <= 20


def test_a_range_holds_only_where_all_of_it_does(scenario):
    """Rough flanks are beyond the authors' range of the mixed law everywhere, whatever its judged limits."""
    case = load_scenario(scenario, DUTIES["rough and light"])
    contact, given = choice._along(case), law_input(case)
    found = {law.law.name: law for law in choice._candidates(FILM_LAWS, given, contact, np.full(5, np.nan))}
    assert found["masjedi-khonsari"].inside == 0.0
    assert "outside its range in 100 % of the way" in found["masjedi-khonsari"].reason


def test_where_no_contact_is_solved_the_ratios_of_gears_stand_in(scenario):
    case = load_scenario(scenario, {"operating.gear_torque": "1e-6 N*m"})
    assert case.friction.ratio is None
    assert "nearest to solved contacts of gears" in case.friction.chosen


def test_different_duties_have_different_laws(scenario):
    taken = [load_scenario(scenario, duty).friction for duty in DUTIES.values()]
    assert len({friction.law for friction in taken}) > 1
    for friction in taken:
        low, middle, high = friction.ratio
        assert low <= middle <= high


def test_cases_of_a_sweep_have_the_laws_of_the_scenario_as_written(scenario):
    roughness = ["drive.roughness=0.2,2um"]
    grid = Grid(str(scenario), roughness, {"drive.mean_roughness": "0.8 um"})
    written = load_scenario(scenario, {"drive.mean_roughness": "0.8 um"})
    cases = [grid.case((i,)) for i in range(2)]
    assert [case.friction.law for case in cases] == [written.friction.law] * 2
    assert [case.film.law for case in cases] == [written.film.law] * 2
    assert grid.chosen == written.chosen()
    # whatever was found at the duty as written, of the others only what holds for gears in general
    assert "at_duty" not in grid.base.laws()["friction_judged"]


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
