"""Whole assessments of one load spectrum, each of its duties assessed in turn: one safety, one life."""

from pathlib import Path
from typing import Any

import pytest

from tests.support.short_studies import SHORT, written_template
from tribodyn.studies.assessment.run import assessed
from tribodyn.studies.protocol.load import load_scenario

DUTIES = [
    {"share": 0.7, "power": "60 kW", "pinion_speed": "1500 rpm"},
    {"share": 0.3, "power": "15 kW", "pinion_speed": "600 rpm"},
]
#: Shafts out of line by this: the load leans more on one end of the face the smaller it is.
LEANING = {"mesh.misalignment.in_plane": "0.2 mrad"}
SMALL = {
    "assessment.speeds": 8,
    "assessment.torque_shares": [0.5, 1.0],
    "assessment.samples": 0,
    "assessment.friction_laws": ["niemann"],
}


def test_safety_and_life_by_the_standard_do_not_depend_on_the_duty_that_is_assessed(tmp_path: Path):
    scenario = written_template("assessment", tmp_path)
    found: list[dict[str, Any]] = []
    for number in (1, 2):
        keys = SHORT["assessment"] | SMALL | LEANING | {"duty": DUTIES, "operating.duty": number}
        found.append(assessed(load_scenario(scenario, keys), tmp_path / str(number))[2])
    one, other = found
    assert one["duty"] != other["duty"]
    # K_Hβ of each duty, the contact of which is analysed at its torque
    assert one["face_load_factor"] != pytest.approx(other["face_load_factor"], rel=0.02)
    for name in ("S_H", "S_F", "life_pitting", "life_bending"):
        for gear in ("pinion", "gear"):
            assert one["iso"][name][gear] == pytest.approx(other["iso"][name][gear], rel=1e-6), name
    for summary in found:
        said = " ".join(summary["assumed"].values())
        assert "The simulation runs the duty that is assessed alone, one of 2" in said
