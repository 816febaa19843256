"""What `check` says of the ranges of film and friction law, before anything runs."""

import pytest

from tribodyn.numerics.elementary import law
from tribodyn.studies.motion.check import check
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.study import CheckResult
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FrictionLaw


def checked(**changes: str) -> CheckResult:
    settings = {name.replace("__", "."): value for name, value in changes.items()}
    return check(load_scenario("involute-23-47", settings))


def test_it_says_which_limits_the_duty_exceeds():
    """W is as the torque."""
    light, heavy = (checked(operating__gear_torque=torque) for torque in ("3000 N*m", "6000 N*m"))
    factors = [
        {limit["limit"]: limit["factor"] for limit in result.data["laws"]["closure_exceeded"].values()}
        for result in (light, heavy)
    ]
    assert factors[1]["W ≤ 5e-4"] == pytest.approx(2.0 * factors[0]["W ≤ 5e-4"])
    said = [remark for remark in heavy.remarks if remark.startswith("Limits of the film law exceeded")]
    assert len(said) == 1
    assert "the load is high in 100 %" in said[0]


def test_a_law_without_range_by_the_solved_contact_says_how_far_it_is_off():
    found = checked(friction__law="xu")
    laws = found.data["laws"]
    judged = FRICTION_LAWS["xu"].judged
    assert judged is not None
    assert [laws["friction_judged"][name] for name in ("low", "median", "high")] == list(judged.ratio)
    assert laws["friction_judged"]["limits"] == 0
    (table,) = (table for table in found.tables if table.title.startswith("Laws"))
    low, _, high = judged.ratio
    assert any(f"{low:.2g} to {high:.2g}" in cell for row in table.rows for cell in row)


def test_a_law_of_ones_own_has_none():
    @law
    def a_tenth(contact, film, surfaces, parameters):
        return 0.1 + 0.0 * contact.sliding

    mine = FrictionLaw("a-tenth", "always 0.1", a_tenth)
    laws = check(load_scenario("involute-23-47").under_laws(friction=mine)).data["laws"]
    assert laws["friction_range"] == "none stated"
    assert not {"friction_judged", "friction_exceeded"} & set(laws)
