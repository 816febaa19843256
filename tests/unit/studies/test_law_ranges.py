"""What `check` says of the ranges of film and friction law, before anything runs."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.numerics.elementary import law
from tribodyn.studies.gear_pair.check import check
from tribodyn.studies.gears import law_ranges
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.study import Checked
from tribodyn.tribology.closure import with_laws
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FrictionLaw


def checked(**changes: str) -> Checked:
    settings = {name.replace("__", "."): value for name, value in changes.items()}
    return check(load_scenario("involute-23-47", settings))


def test_it_says_which_limits_the_duty_exceeds():
    """W is as the torque."""
    light, heavy = (checked(operating__gear_torque=torque) for torque in ("3000 N*m", "6000 N*m"))
    factors = [
        {limit["limit"]: limit["factor"] for limit in one.data["laws"]["closure_exceeded"].values()}
        for one in (light, heavy)
    ]
    assert factors[1]["W ≤ 5e-4"] == pytest.approx(2.0 * factors[0]["W ≤ 5e-4"])
    said = [remark for remark in heavy.remarks if remark.startswith("Limits of the film law exceeded")]
    assert len(said) == 1
    assert "W ≤ 5e-4" in said[0]


def test_a_law_without_range_by_the_solved_contact_says_how_far_it_is_off():
    found = checked(friction__law="xu")
    laws = found.data["laws"]
    judged = FRICTION_LAWS["xu"].judged
    assert judged is not None
    assert [laws["friction_judged"][name] for name in ("low", "median", "high")] == list(judged.ratio)
    assert laws["friction_judged"]["limits"] == 0
    (table,) = (one for one in found.tables if one.title.startswith("Laws"))
    assert any("no range by the solved contact" in cell for row in table.rows for cell in row)


def test_a_law_of_ones_own_has_none():
    @law
    def a_tenth(contact, film, surfaces, parameters):
        return 0.1 + 0.0 * contact.sliding

    mine = FrictionLaw("a-tenth", "always 0.1", a_tenth)
    laws = check(with_laws(load_scenario("involute-23-47"), friction=mine)).data["laws"]
    assert laws["friction_range"] == "none stated"
    assert not {"friction_judged", "friction_exceeded"} & set(laws)


def test_contacts_of_the_nominal_duty(monkeypatch: pytest.MonkeyPatch):
    """At every place of the path, all load on one pair; without a load or a speed there is none."""
    places = [(0.4, 110.0, 0.2), (0.5, 120.0, 0.0), (0.7, 90.0, 0.6)]
    seen: list[Any] = []
    monkeypatch.setattr(law_ranges, "duty_range", lambda _: SimpleNamespace(places=places))
    monkeypatch.setattr(law_ranges, "nominal_line_load", lambda _: 3e5)
    monkeypatch.setattr(law_ranges, "local_contact", lambda *given: seen.append(given))
    monkeypatch.setattr(law_ranges, "range_shares", lambda contact, closure: ("film", "friction"))
    monkeypatch.setattr(law_ranges, "exceeded_limits", lambda case, *shares: {"shares": shares})
    closure: Any = "closure"
    for torque, speed in ((0.0, 5.0), (5.0, 0.0), (0.0, 0.0)):
        idle: Any = SimpleNamespace(operating=SimpleNamespace(gear_torque=torque, pinion_speed=speed))
        assert law_ranges._exceeded(idle, closure) == {}
    case: Any = SimpleNamespace(operating=SimpleNamespace(gear_torque=-5.0, pinion_speed=5.0))
    assert law_ranges._exceeded(case, closure) == {"shares": ("film", "friction")}
    ((load, curvature, entrainment, sliding, first, second),) = seen
    assert load == 3e5
    for k, (mean, curved, ratio) in enumerate(places):
        assert (entrainment[k], curvature[k]) == (mean, curved)
        assert sliding[k] == pytest.approx(ratio * mean)
        # the entrainment is the mean of both flanks' speeds, the sliding their difference
        assert (first[k] + second[k]) / 2.0 == pytest.approx(mean)
        assert first[k] - second[k] == pytest.approx(ratio * mean)
    assert np.all(first >= second)
