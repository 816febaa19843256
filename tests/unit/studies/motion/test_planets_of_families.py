"""Planetary stages of other families than the involute: one planet's tooth for sun and ring."""

from typing import Any

import pytest

from tests.support.planet_sets import planet_set
from tests.support.soak_parameters import all_in_soak
from tests.support.train_scenarios import case_of_table
from tests.support.turning_outlines import assert_teeth_touch
from tribodyn.errors import InputError
from tribodyn.studies.motion.prepare import prepare

CYCLOIDS = {"approach_circle": "24 mm", "recess_circle": "24 mm"}
#: Families whose path is alike on both sides of the pitch point: keys of the stage.
SHARED: dict[str, dict[str, Any]] = {
    "cycloidal": {"shape": CYCLOIDS},
    "s-gear": {"shape": {"form_factor": 1.6, "exponent": 1.8}},
    "circular-arc": {
        "pressure_angle": "18 deg",
        "shape": {"approach_diameter": "60 mm", "recess_diameter": "60 mm"},
    },
    "spline": {
        "shape": {
            "angles": [f"{angle} deg" for angle in (23, 22, 21, 20, 21, 22, 23)],
            "path_length": "18 mm",
        }
    },
}
#: Of a path that stands still.
POINTS = {name: {"unit": "mm", "values": [0.0, 0.0, 0.0, 1.0]} for name in "xy"}


def stage(family: str, keys: dict[str, Any], **changes: Any) -> dict[str, Any]:
    table = planet_set(family=family, **keys, **changes)
    table["gear"]["ring"]["addendum"] = 0.8
    if "pressure_angle" not in keys:
        del table["stage"][0]["pressure_angle"]
    return table


#: What is held, input and output: planets or ring drive.
ENDS = (("ring", ("sun", "carrier")), ("sun", ("ring", "carrier")), ("carrier", ("sun", "ring")))


@pytest.mark.parametrize(
    ("family", "held", "ends"),
    all_in_soak(
        [(family, *ends) for family in SHARED for ends in ENDS],
        lambda case: case[0] == "cycloidal" or case[1] == "ring",
        names=3,
    ),
)
def test_teeth_of_sun_planets_and_ring_touch_where_they_are_said_to(family: str, held: str, ends: Any):
    assert_teeth_touch(prepare(case_of_table(stage(family, SHARED[family], held=held, ends=ends))).case)


@pytest.mark.parametrize(
    ("family", "keys", "key", "says"),
    [
        (
            "crc",
            {"pressure_angle": "24 deg"},
            "stage.0.family",
            "use involutes, or paths alike",
        ),
        ("parabolic", {"shape": {"k1": 0.3, "k2": 0.3}}, "stage.0.family", "the ring needs others"),
        ("cycloidal", {"shape": CYCLOIDS | {"recess_circle": "27 mm"}}, "stage.0.family", "of equal circles"),
        (
            "cycloidal",
            {"shape": CYCLOIDS, "centre_distance": "81 mm"},
            "stage.0.centre_distance",
            "one centre",
        ),
        ("s-gear", {"shape": {"form_factor": 0.6, "exponent": 1.8}}, "stage.0.shape.form_factor", "above 1"),
        ("points", {"pressure_angle": "20 deg", "shape": {"points": POINTS}}, "stage.0.shape.points", ""),
    ],
)
def test_planets_that_sun_and_ring_cannot_share(family: str, keys: dict[str, Any], key: str, says: str):
    with pytest.raises(InputError) as refused:
        case_of_table(stage(family, keys))
    assert refused.value.key == key
    assert says in str(refused.value)
