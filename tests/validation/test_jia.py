"""Jia et al. (2022): the rows that geometry alone decides, and the honest state of the others."""

import math

import pytest

from tribodyn.geometry.parabolic import greatest_coefficient, published_limits
from tribodyn.geometry.path import kinematics
from tribodyn.scenario.load import family, load_scenario
from tribodyn.validation import validate
from tribodyn.validation.rows import published

GEOMETRY = [f"jia/{name}" for name in ("k1-max", "k2-max", "k-min", "cr-novel", "cr-involute", "hertz-pitch")]


@pytest.fixture(scope="module")
def rows():
    return {row.id: row for row in validate("jia-2022")}


def test_every_row_is_there_and_none_fails(rows):
    assert set(rows) == set(published("jia-2022"))
    assert [row.id for row in rows.values() if row.verdict == "fail"] == []


@pytest.mark.parametrize("key", GEOMETRY)
def test_closed_forms_are_within_tolerance(rows, key):
    row = rows[key]
    assert row.verdict == "pass"
    assert abs(row.computed / row.published - 1) <= row.tolerance
    assert row.computed == pytest.approx(published("jia-2022")[key]["independent"], rel=1e-4)


def test_what_needs_a_load_contact_model_does_not_pass(rows):
    for key, row in rows.items():
        if key not in GEOMETRY:
            assert row.verdict == "reported" or row.computed is not None


def test_limits_of_the_geometry_stand_beside_the_papers(rows):
    # 0.486 and 0.461: limits from the actual tip points, found separately from the equations of the paper
    assert "below 0.486" in rows["jia/k1-max"].note
    assert "below 0.461" in rows["jia/k2-max"].note


@pytest.mark.parametrize("teeth", [17.0, 29.0, 60.0])
def test_published_limits_are_the_equalities_of_42(teeth):
    least, most = published_limits(teeth)

    def sine(k):
        return (1 - 2 * k) / (2 * math.sqrt(k * (1 - k)))

    assert sine(most) == pytest.approx(math.sin(math.pi / (2 * teeth)), rel=1e-12)
    assert sine(least) == pytest.approx((1 - 2 * least) / (1 - least), rel=1e-12)


@pytest.mark.parametrize(("half", "name"), [(1, "k1"), (-1, "k2")])
def test_at_the_geometrys_limit_the_flank_stands_still_at_the_mates_tip(half, name):
    """The condition of Jia's (18), (15) against the speeds of the contact along the flanks."""
    from tribodyn.geometry.drive import tip_radius
    from tribodyn.geometry.path import contact_limits

    case = load_scenario("jia-parabolic-17-29")
    limit = greatest_coefficient(case.drive, half)
    drive = case.drive._replace(shape=case.drive.shape._replace(**{name: limit}))
    path = family(case.family).working_path(drive)
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    at = kinematics(path, end if half > 0 else start)
    speed = at.gear_speed if half > 0 else at.pinion_speed
    assert speed == pytest.approx(0.0, abs=1e-9)
