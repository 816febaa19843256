"""Drawn shafts on bearings of every type: equilibrium, lives, safety; sizes that no bearing has."""

from typing import Any

import pytest

from tests.support.drawn_shafts import OVERHUNG, ROLLER
from tribodyn.errors import InputError
from tribodyn.gears.rating.bearings import bearing_part
from tribodyn.input.tables.drawn_bearing_rules import broken_bearing_of_shaft
from tribodyn.input.tables.drawn_bearings import BearingOfShaft
from tribodyn.interface.scenario import scenario
from tribodyn.studies.motion.train.assessable import shafts as shafts_of

RATED = {"dynamic_rating": "60 kN", "static_rating": "50 kN"}
BALLS = {"elements": 13, "element_diameter": "12 mm", "pitch_diameter": "66 mm"}
BARRELS = {
    "elements": 18,
    "element_diameter": "10 mm",
    "pitch_diameter": "66 mm",
    "roller_length": "9 mm",
}
ANGULAR = BALLS | RATED | {"type": "angular-contact-ball", "contact_angle": "40 deg"}
TYPES: dict[str, dict[str, Any]] = {
    "O": ANGULAR | {"arrangement": "O", "row_distance": "20 mm", "preload": "5 um"},
    "X": ANGULAR | {"arrangement": "X", "row_distance": "20 mm", "preload": "5 um"},
    "15": ANGULAR | {"arrangement": "O", "row_distance": "20 mm", "contact_angle": "15 deg"},
    "four": BALLS | RATED | {"type": "four-point-contact-ball", "contact_angle": "35 deg"},
    "aligning": BALLS | RATED | {"type": "self-aligning-ball", "contact_angle": "12 deg"},
    "spherical": BARRELS | RATED | {"type": "spherical-roller", "contact_angle": "12 deg"},
    "tapered": BARRELS
    | RATED
    | {
        "type": "tapered-roller",
        "contact_angle": "14 deg",
        "arrangement": "O",
        "row_distance": "20 mm",
    },
}
FLOATING = {
    "toroidal": BARRELS | RATED | {"type": "toroidal-roller", "raceway_radius": "120 mm"},
    "needle": BARRELS | RATED | {"type": "needle-roller", "rows": 2, "row_distance": "12 mm"},
    "sliding": TYPES["spherical"] | {"locating": False},
    "roller": ROLLER | RATED,
    "floating": TYPES["tapered"] | {"locating": False},
}
#: A 6206.
CATALOGUE = {
    "type": "deep-groove-ball",
    "bore": "30 mm",
    "outside_diameter": "62 mm",
    "static_rating": "11.2 kN",
    "dynamic_rating": "20.3 kN",
}
MOTION = {"mesh.slices": 7, "friction.law": "none", "bearings": "rigid-1e9"}


def rated(first: dict[str, Any], second: dict[str, Any]) -> dict[str, dict[str, float]]:
    shaft = OVERHUNG | {"bearing": [first | {"position": "15 mm"}, second | {"position": "85 mm"}]}
    box = scenario("helical-23-47", MOTION | {"shaft": {"pinion": shaft}})
    return bearing_part(shafts_of(box), box.pair.lubricant)["bearings"]


@pytest.mark.parametrize("name", TYPES)
def test_a_locating_bearing_takes_the_thrust_and_is_rated(name: str):
    """Beside a bearing that floats, in statics; lives by rows and by loads are of one size."""
    other = list(FLOATING)[list(TYPES).index(name) % len(FLOATING)]
    found = rated(TYPES[name], FLOATING[other])
    thrust, floating = found["pinion-1"], found["pinion-2"]
    assert thrust["axial_load"] == pytest.approx(scenario_thrust(), rel=5e-3)
    assert floating["axial_load"] < 5e-3 * floating["radial_load"]
    assert thrust["static_safety"] > 1.0
    for numbers in found.values():
        assert 0.05 < numbers["reference_life"] / numbers["rating_life"] < 30.0
    if name in ("aligning", "spherical"):
        assert thrust["tilting_moment"] < 1e-6


def test_a_bearing_by_its_catalogue_beside_the_same_by_its_inside():
    """A 6206 has nine balls of 9.525 mm on 46 mm."""
    inside = {key: CATALOGUE[key] for key in ("type", "static_rating", "dynamic_rating")} | {
        "elements": 9,
        "element_diameter": "9.525 mm",
        "pitch_diameter": "46 mm",
    }
    found, known = (rated(bearing, FLOATING["roller"])["pinion-1"] for bearing in (CATALOGUE, inside))
    assert found == pytest.approx(known, rel=0.02, abs=1e-3)


def scenario_thrust() -> float:
    box = scenario("helical-23-47", MOTION | {"shaft": {"pinion": OVERHUNG}})
    ends = bearing_part(shafts_of(box), None)["bearings"]
    return abs(ends["pinion-1"]["axial_load"] - ends["pinion-2"]["axial_load"])


def refused(bearing: dict[str, Any]) -> list[InputError]:
    table = BearingOfShaft.model_validate(bearing | {"position": "15 mm"})
    return list(broken_bearing_of_shaft("bearing.0", table))


@pytest.mark.parametrize("bearing", [*TYPES.values(), *FLOATING.values(), CATALOGUE])
def test_bearings_of_every_type_are_taken(bearing: dict[str, Any]):
    assert not refused(bearing)


@pytest.mark.parametrize(
    ("bearing", "key", "words"),
    [
        (CATALOGUE | {"elements": 9}, "elements", "contradicts bore and outside_diameter"),
        (CATALOGUE | {"static_rating": "200 kN"}, "static_rating", "which no bearing of 30 x 62 mm has"),
        (CATALOGUE | {"outside_diameter": "30 mm"}, "outside_diameter", "not larger than the bore"),
        ({key: CATALOGUE[key] for key in ("type", "bore", "static_rating")}, "outside_diameter", "missing"),
        (
            {key: CATALOGUE[key] for key in ("type", "bore", "outside_diameter")},
            "static_rating",
            "estimated from it",
        ),
        (CATALOGUE | {"type": "needle-roller"}, "bore", "no estimate of needle roller"),
        (CATALOGUE | {"type": "spherical-roller"}, "contact_angle", "missing"),
        (CATALOGUE | {"type": "spherical-roller", "contact_angle": "90 deg"}, "contact_angle", "thrust"),
        (ANGULAR, "thrust", "missing"),
        (ANGULAR | {"arrangement": "O"}, "row_distance", 'and arrangement = "O" needs it'),
        (TYPES["O"] | {"thrust": "+z"}, "thrust", "no effect"),
        (TYPES["O"] | {"arrangement": "tandem"}, "thrust", "missing"),
        (
            TYPES["O"] | {"arrangement": "tandem", "thrust": "+z", "locating": False},
            "locating",
            "rings come apart",
        ),
        (ANGULAR | {"thrust": "+z", "row_distance": "20 mm"}, "row_distance", "no effect"),
        (TYPES["O"] | {"row_distance": "2 mm"}, "row_distance", "less than the rolling elements need"),
        (TYPES["O"] | {"row_distance": "20 m"}, "row_distance", "draw two bearings"),
        (FLOATING["roller"] | {"roller_length": "14 cm"}, "roller_length", "more than 10 times"),
        (TYPES["O"] | {"contact_angle": "50 deg"}, "contact_angle", "above 45 deg"),
        (TYPES["O"] | {"clearance": "5 um"}, "clearance", "no effect"),
        (TYPES["O"] | {"preload_force": "300 N"}, "preload", "contradicts preload_force"),
        (FLOATING["needle"] | {"preload_force": "300 N"}, "preload_force", "no effect"),
        (
            TYPES["15"] | {"preload_force": "400 kN"},
            "preload_force",
            "MPa before any load",
        ),
        (TYPES["O"] | {"preload": "0.2 mm"}, "preload", "MPa before any load"),
        (TYPES["tapered"] | {"preload": "0.9 mm"}, "preload", "MPa before any load"),
        (TYPES["tapered"] | {"preload": "3 mm"}, "preload", "more than 10% of the rolling elements"),
        (TYPES["spherical"] | {"clearance": "-0.3 mm"}, "clearance", "MPa before any load"),
        (TYPES["four"] | {"clearance": "1 mm"}, "clearance", "more than 3% of the rolling elements"),
        (TYPES["spherical"] | {"contact_angle": "3 deg"}, "roller_length", "run into each other"),
        (TYPES["spherical"] | {"elements": 22}, "elements", "fit side by side"),
        (FLOATING["toroidal"] | {"raceway_radius": "30 mm"}, "raceway_radius", "not larger"),
        (FLOATING["needle"] | {"rows": 1}, "row_distance", "no effect"),
        (FLOATING["toroidal"] | {"force": "in-time"}, "force", 'no law for type = "toroidal-roller"'),
        (FLOATING["floating"] | {"force": "in-time"}, "force", "no law for a pair whose rings slide"),
        (BARRELS | {"type": "toroidal-roller"}, "raceway_radius", "missing"),
        ({"stiffness_x": "1e8 N/m", "arrangement": "O"}, "arrangement", "type is missing"),
    ],
)
def test_one_message_of_what_is_wrong(bearing: dict[str, Any], key: str, words: str):
    (error,) = refused(bearing)
    assert error.key == f"bearing.0.{key}"
    assert words in str(error)
