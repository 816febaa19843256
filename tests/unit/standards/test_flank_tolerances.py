"""Flank tolerances of ISO 1328-1:2013: worked by hand for one gear, and the rules that hold for all."""

import math

import pytest

from tribodyn.errors import InputError
from tribodyn.standards.allowances import centre_distance_allowance, thickness_allowances
from tribodyn.standards.flank_tolerances import flank_tolerances, flank_tolerances_1995, outside, rounded


def test_a_gear_of_class_5_by_hand():
    """m 4 mm, d 100 mm, b 25 mm: every root of it is whole."""
    found = flank_tolerances(5, 4e-3, 100e-3, 25e-3)
    by_hand = {
        "single_pitch": 0.1 + 1.6 + 5,
        "total_pitch": 0.2 + 5.5 + 2.8 + 12,
        "profile_form": 2.2 + 5,
        "profile_slope": 1.6 + 0.1 + 4,
        "helix_form": 0.7 + 2.25 + 4,
        "helix_slope": 0.5 + 1.75 + 4,
    }
    for name, micrometres in by_hand.items():
        assert getattr(found, name) == pytest.approx(1e-6 * micrometres, rel=1e-12)
    assert found.total_profile == pytest.approx(1e-6 * math.hypot(7.2, 5.7))
    assert found.total_helix == pytest.approx(1e-6 * math.hypot(6.95, 6.25))
    assert found.runout == pytest.approx(0.9 * found.total_pitch)


def test_a_factor_of_the_root_of_two_from_class_to_class():
    for grade in range(1, 11):
        fine, coarse = (flank_tolerances(number, 3e-3, 75e-3, 30e-3) for number in (grade, grade + 1))
        assert [b / a for a, b in zip(fine, coarse, strict=True)] == pytest.approx([math.sqrt(2)] * 9)


def test_rounding():
    assert [1e6 * rounded(1e-6 * value) for value in (12.4, 12.6, 9.2, 5.3, 4.87)] == pytest.approx(
        [12, 13, 9, 5.5, 4.9]
    )


def test_ranges():
    assert outside(25, 3e-3, 75e-3, 30e-3) == []
    assert len(outside(4, 0.4e-3, 1.6e-3, 3e-3)) == 4


def test_tolerances_of_1995_by_hand():
    """m 10 to 16, d 280 to 560, b 250 to 400 mm: geometric means 12.649, 395.98, 316.23 mm; class 5."""
    found = flank_tolerances_1995(5, 14e-3, 341e-3, 360e-3)
    by_hand = {
        "single_pitch": 0.3 * (12.649 + 0.4 * 19.899) + 4.0,
        "total_pitch": 0.3 * 12.649 + 1.25 * 19.899 + 7.0,
        "profile_form": 2.5 * 3.5566 + 0.17 * 19.899 + 0.5,
        "total_helix": 0.1 * 19.899 + 0.63 * 17.783 + 4.2,
    }
    for name, micrometres in by_hand.items():
        assert getattr(found, name) == pytest.approx(1e-6 * micrometres, rel=1e-4)
    assert found.runout == pytest.approx(0.8 * found.total_pitch)
    exact = flank_tolerances_1995(5, 4e-3, 100e-3, 25e-3, ranges=False)
    assert exact.single_pitch == pytest.approx((0.3 * (4.0 + 4.0) + 4.0) * 1e-6)


def test_allowances_at_the_limits_of_their_ranges():
    """DIN 3967: the upper limit belongs to the range; ISO 286: js7 at 120 and just above."""
    assert thickness_allowances("cd25", 0.125) == pytest.approx((-70e-6, -110e-6))
    assert thickness_allowances("cd25", 0.1251) == pytest.approx((-95e-6, -145e-6))
    assert thickness_allowances("h21", 0.05) == pytest.approx((0.0, -5e-6))
    assert centre_distance_allowance(7, 0.12) == pytest.approx(17.5e-6)
    assert centre_distance_allowance(7, 0.1201) == pytest.approx(20e-6)
    for code in ("z25", "cd31", "cd", "25"):
        with pytest.raises(InputError, match="DIN 3967"):
            thickness_allowances(code, 0.1)
    with pytest.raises(InputError, match="from 5 to 11"):
        centre_distance_allowance(4, 0.1)
