"""The verdict: a sentence on accurate teeth, and one on the samples of what is not known."""

from typing import Any

from tribodyn.gears.rating.limits import on_limits, over_samples

LIMITS: dict[str, Any] = {
    "dynamic_factor": {"value": 1.3, "limit": 1.5, "kept": True},
    "micropitting": {"value": 1.2, "limit": 1.0, "kept": True},
}


def said(limits: dict[str, Any], **counts: Any) -> list[tuple[bool, str]]:
    return on_limits({"limits": limits, **({"sample_counts": counts} if counts else {})})


def test_without_samples_there_is_one_sentence():
    assert said(LIMITS) == [(True, "All 2 limits hold.")]


def test_samples_have_a_sentence_of_their_own():
    values = {"dynamic_factor": [1.2, 1.6, float("nan"), 1.7], "micropitting": [0.9, 1.1, 1.2, 1.3]}
    limits = over_samples(LIMITS, values)
    assert (limits["dynamic_factor"]["exceed"], limits["dynamic_factor"]["samples"]) == (2, 3)
    assert limits["micropitting"]["exceed"] == 1
    accurate, varied = said(limits, samples=4, contact_lost=1, contact_loss_speed_from=188.5)
    assert accurate == (True, "All 2 limits hold with accurate teeth.")
    assert not varied[0]
    for part in (
        "1 of 4 samples loses contact, from 1800 rpm",
        "limits not kept: Dynamic factor K_v (2 of 3), Micropitting S_λ (1 of 4).",
    ):
        assert part in varied[1]


def test_samples_that_keep_everything_are_said_too():
    limits = over_samples(LIMITS, {"dynamic_factor": [1.2, 1.3], "micropitting": [1.1, 1.1]})
    _, varied = said(limits, samples=2, contact_lost=0)
    assert varied == (True, "With what is not known varied: all 2 samples keep the limits and contact.")
