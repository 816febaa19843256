"""Höhn's loss factor and the integral behind it."""

import math

import pytest

from tribodyn.geometry.drive import tip_radius
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.standards.loss_factors import equal_loads, hoehn
from tribodyn.studies.efficiency.published import tip_contact_ratios
from tribodyn.validation.papers.diez_ibarbia_study import SHIFTS, drive, shifted


def test_formula_overstates_the_loss_where_a_tip_contact_ratio_exceeds_one():
    """By 3.4 % at x = 0.7 with constant contact ratio."""
    tips = tip_contact_ratios(FAMILY, shifted(drive(), "S2", 0.7))
    assert tips[0] > 1
    assert hoehn(*tips, 18, 2.0) / equal_loads(*tips, 18, 2.0) == pytest.approx(1.034, abs=1e-3)


def test_tip_contact_ratios_by_the_involute_formula():
    """(17): ε1 = [√(R1² − r_b1²) − r1 sin φ]/p_b."""
    base = drive()
    first, second = tip_contact_ratios(FAMILY, base)
    pitch = math.pi * 3e-3 * math.cos(math.radians(20))
    for value, radius, tip in ((first, 27e-3, 30e-3), (second, 54e-3, 57e-3)):
        rb = radius * math.cos(math.radians(20))
        length = math.sqrt(tip**2 - rb**2) - radius * math.sin(math.radians(20))
        assert value == pytest.approx(length / pitch, rel=1e-12)


@pytest.mark.parametrize(
    ("scenario", "shift", "radii"),
    [
        ("S1", 0.2, (30.0, 57.0)),
        ("S2", 0.1, (30.3, 56.74875979520235)),
        ("S2", 0.7, (32.1, 55.430063070954375)),
        ("S3", 0.5, (31.5, 55.5)),
    ],
)
def test_tip_circles_of_the_shift_scenarios(scenario, shift, radii):
    pair = shifted(drive(), scenario, shift)
    ours = tuple(1e3 * float(tip_radius(pair, side)) for side in ("pinion", "gear"))
    # the expected radii of S2 keep a contact ratio rounded to 1.611, 1e-4 less than the pair's own
    assert ours == pytest.approx(radii, rel=1e-5 if scenario == "S2" else 1e-12)
    if scenario == "S2":
        assert sum(tip_contact_ratios(FAMILY, pair)) == pytest.approx(1.6111060667858816, rel=1e-12)


def test_no_shift_is_no_change():
    base = drive()
    for name in SHIFTS:
        assert tip_contact_ratios(FAMILY, shifted(base, name, 0.0)) == pytest.approx(
            tip_contact_ratios(FAMILY, base), rel=1e-13
        )
