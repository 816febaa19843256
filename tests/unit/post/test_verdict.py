"""The verdict: sentences that follow from the numbers of a summary."""

import re
from types import SimpleNamespace
from typing import Any, cast

import pytest

from tribodyn.post.verdict import LINES, advised, lost, moved, of_gears, outside, pressed
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

GOOD: dict[str, Any] = {
    "transmission_error_peak_to_peak": 12e-6,
    "dynamic_factor": 1.2,
    "contact_loss_fraction": 0.0,
    "hertz_pressure_max": 1.1e9,
    "film_min": 0.6e-6,
    "film_parameter_min": 3.4,
    "power_in_mean": 40e3,
    "power_friction_mean": 200.0,
    "friction_coefficient_mean": 0.04,
}


def laws(film_outside: float, friction_outside: float, **more: Any) -> dict[str, Any]:
    """A summary of the mixed laws, outside their limits in some shares."""
    found: dict[str, Any] = {"film_outside": film_outside, "friction_outside": friction_outside}
    for what, registry in (("film", FILM_LAWS), ("friction", FRICTION_LAWS)):
        judged = registry["masjedi-khonsari"].judged
        assert judged is not None
        assert judged.outside is not None
        names = ("low", "median", "high")
        found[f"{what}_law"] = "masjedi-khonsari"
        found[f"{what}_judged"] = dict(zip(names, judged.ratio, strict=True)) | {
            f"{name}_outside": value for name, value in zip(names, judged.outside, strict=True)
        }
    return found | more


def said(summary: dict[str, Any]) -> str:
    """All lines, as one text."""
    return "\n".join(of_gears(cast(Any, SimpleNamespace(summary=summary))))


def test_a_sound_run_says_what_moves_presses_and_is_lost_and_nothing_to_do():
    text = said(GOOD | laws(0.0, 0.0))
    assert "12 µm" in text
    assert "1.20 times" in text
    assert "contact is never lost" in text
    assert "1.1 GPa" in text
    assert "3.4 times the roughness: a full film" in text
    assert "200 W of 40 kW, 0.5 %" in text
    assert "To do" not in text
    assert len(text.splitlines()) <= LINES


def test_a_start_that_has_not_faded_is_said_before_what_follows_from_it():
    remark = "The motion has not settled."
    assert said(GOOD | laws(0.3, 0.3, settling_remark=remark)).splitlines()[1] == remark


def test_a_range_of_one_value_is_written_once():
    judged = {"low": 1.187, "median": 1.19, "high": 1.193, "at_duty": 1.0}
    text = said(GOOD | laws(0.0, 0.0) | {"film_judged": judged, "friction_judged": {}})
    assert "expect 0.84 times the printed film" in text


@pytest.mark.parametrize("what", ["film", "friction"])
def test_a_law_in_doubt_says_by_how_much_and_why(what: str):
    """The printed value over the ratio to the solved contact outside the limits."""
    limit = {"film": "roughness factor of the film ≤ 2", "friction": "Newtonian stress ≥ 0.1 Λ_lim p"}[what]
    key = {"film": "closure_exceeded", "friction": "friction_exceeded"}[what]
    exceeded = {"1": {"limit": "W ≥ 2e-5", "share": 1.0}, "2": {"limit": f"{limit} (judged)", "share": 0.4}}
    summary = laws(0.4 * (what == "film"), 0.4 * (what == "friction"), **{key: exceeded})
    doubt, *others = outside(summary)
    times = re.search(r"probably ([\d.]+) times what is printed \(([\d.]+) to ([\d.]+)\)", doubt)
    assert times
    assert doubt.startswith(f"{what.capitalize()} in doubt")
    ratios = [summary[f"{what}_judged"][f"{name}_outside"] for name in ("median", "high", "low")]
    assert [float(part) for part in times.groups()] == pytest.approx([1.0 / r for r in ratios], rel=0.2)
    assert "in 40 % of the" in doubt
    assert "load is low" not in doubt
    assert others[0].startswith("By solved contacts")
    assert what not in others[0].replace("friction law", "")
    assert f'{what}.law = "solved"' in next(iter(advised(summary)))
    engaged = summary | {"engagement_remark": "K_v 1.47 is the knock of pairs that engage at once."}
    assert next(iter(advised(engaged))).endswith(
        "the first time. K_v 1.47 is the knock of pairs that engage at once."
    )


def test_what_to_do_goes_by_what_is_worst():
    apart = GOOD | {"contact_loss_fraction": 0.2, "dynamic_factor": 3.0, "film_parameter_min": 0.3}
    assert "keeps the teeth together" in next(iter(advised(apart)))
    assert "apart for 20 % of the time" in next(iter(moved(apart)))
    loud = apart | {"contact_loss_fraction": 0.0}
    assert "resonance" in next(iter(advised(loud)))
    engaged = loud | {"engagement_remark": 'mesh.compliance = "fem" tells.'}
    assert 'fem" tells' in next(iter(advised(engaged)))
    knocking = loud | {"engagement_remark": "K_v 1.47 is the knock of pairs that engage at once."}
    assert "engagement raises the tooth forces" in next(iter(moved(knocking)))
    rough = loud | {"dynamic_factor": 1.1}
    assert "smoother flanks" in next(iter(advised(rough)))
    assert "carry much of the load" in next(iter(pressed(rough)))


def test_too_few_slices_are_named():
    few = "mesh.slices = 5 is too few for the motion: friction takes more."
    assert list(advised({"slice_remark": few})) == [f"To do: {few}"]
    assert not list(advised({"slice_remark": "15 slices along the face: twice as many change nothing."}))


def test_what_is_not_known_is_left_out():
    assert said({}) == ""
    assert not list(lost({"power_in_mean": 0.0, "power_friction_mean": 1.0}))
    assert list(pressed({"hertz_pressure_max": 1e9})) == ["The flanks press with up to 1 GPa."]
