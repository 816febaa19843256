"""Figures of cases without a record: those of the study, and of the teeth."""

import pytest

import tribodyn as td
from tribodyn.geometry.limits.limits import LIMITS
from tribodyn.studies import STUDIES, study_of
from tribodyn.studies.protocol.evaluated import evaluated, evaluated_quantities


@pytest.mark.parametrize(
    "kind", [name for name, study in STUDIES.items() if study.has_gears and study.swept()]
)
def test_teeth_have_their_distances_in_every_study_of_gears(kind):
    units = {
        quantity.name: quantity.si for quantity in evaluated_quantities(study_of({"kind": kind})).values()
    }
    assert units["contact_ratio"] == "1"
    assert {name: units[name] for name in LIMITS} == LIMITS


def test_distances_stand_beside_the_figures_of_the_study():
    case = td.scenario("efficiency-involute-18-36")
    (found,) = evaluated(study_of({"kind": case.kind}), [case])
    assert isinstance(found, dict)
    distances = td.constraints("efficiency-involute-18-36")
    assert {name: found[name] for name in distances} == distances
    assert found["contact_ratio"] == pytest.approx(distances["contact_ratio_above_1"] + 1.0)
    assert 0.9 < found["efficiency"] < 1.0


def test_a_search_of_motions_may_bound_the_teeth():
    found = td.scenario(
        {
            "title": "of teeth",
            "kind": "design",
            "scenario": {"like": "crc-23-47"},
            "design": {
                "free": [{"key": "drive.pinion.addendum", "from": 0.9, "to": 1.1}],
                "minimise": "loss",
                "subject_to": ["contact_ratio >= 1.4", "tip_thickness_pinion >= 0.9 mm"],
            },
        }
    )
    names = [constraint.quantity for constraint in found.constraints]
    assert names == ["contact_ratio", "tip_thickness_pinion"]
    assert found.constraints[1].limit == pytest.approx(0.9e-3)
