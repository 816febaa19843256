"""One contact has one film: whatever study prints it and whatever law gives it, the bands around it meet."""

import pytest

import tribodyn as td
from tribodyn.post.report import on_closures

PAIR = {
    "drive": {"like": "diez-ibarbia-18-36"},
    "lubricant": "iso-vg-220-mineral",
    "operating": {"pinion_speed": "1500 rpm", "gear_torque": "200 N*m", "oil_temperature": "60 degC"},
}
MOVING = {"bearings": "stiff-2e9", "mesh": {"compliance": "energy", "damping_ratio": 0.1}}
#: Kind -> what it needs beside the pair.
KINDS = {
    "efficiency": {"friction": {"law": "auto"}},
    "load-contact": {"output": {"positions_per_cycle": 12}},
    "wear": {
        "mesh": {"slices": 1},
        "wear": {"law": "archard", "coefficient": "9.65e-19 m**2/N", "revolutions": 1e3},
        "output": {"positions_per_cycle": 16},
    },
    "gear-pair": {
        **MOVING,
        "friction": {"law": "auto"},
        "solver": {"cycles": 3},
        "output": {"samples_per_cycle": 40},
    },
}


def band(summary, what="film"):
    """Lowest and highest film that a summary leaves possible, m: the printed one over its ratios."""
    judged = summary[f"{what}_judged"]
    doubt = "_outside" if summary[f"{what}_outside"] >= 0.2 and "at_duty" not in judged else ""
    film = summary.get("film_min_unworn", summary["film_min"])
    return film / judged[f"high{doubt}"], film / judged[f"low{doubt}"]


@pytest.fixture(scope="module")
def solved():
    return td.run(
        {"title": "one", "kind": "ehl", **PAIR, "output": {"positions": 6}, "contact": {"step": 0.25}}
    ).summary


@pytest.mark.parametrize("kind", KINDS)
def test_the_film_of_every_kind_is_that_of_the_solved_contact(kind, solved):
    found = td.run({"title": "one", "kind": kind, **PAIR, **KINDS[kind]}).summary
    low, high = band(found)
    assert low < 1.1 * solved["central_film_min"]
    assert high > solved["central_film_min"] / 1.1
    if "film_chosen" in found:
        assert any("nearest to the contact solved at this duty" in line for line in on_closures(found))
