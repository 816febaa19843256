"""Miner's sum, safety and life over load spectra: closed forms on one straight line of permissible stress."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tribodyn.standards.fatigue import Bin, StressCurve, damage, life_share, safety
from tribodyn.standards.metals import TREATMENTS, Treatment, bending_factors, contact_factors

#: Falls as N^(−1/p) between its ends.
SLOPE = 8.0
LINE = StressCurve((1e4, 1e8), (800e6, 800e6 * 1e4 ** (-1.0 / SLOPE)))


def test_a_line_has_its_points_and_its_inverse():
    for cycles in (1e4, 3e5, 1e8):
        assert LINE.endured(LINE.at(cycles)) in (pytest.approx(cycles, rel=1e-9), math.inf)
    assert LINE.at(10.0) == 800e6
    assert LINE.at(1e12) == LINE.stress[-1]
    assert LINE.endured(801e6) == 0.0
    assert math.isinf(LINE.endured(LINE.stress[-1]))


@given(st.floats(0.5, 1.0), st.floats(0.05, 0.95))
def test_the_safety_over_a_spectrum_is_that_of_the_equivalent_load(second: float, share: float):
    """On one line n_1 s_1^p + n_2 s_2^p counts; both loads are damaging at the safety found."""
    bins = [Bin(400e6, share * 1e6), Bin(400e6 * second, (1.0 - share) * 1e6)]
    equivalent = 400e6 * (share + (1.0 - share) * second**SLOPE) ** (1.0 / SLOPE)
    expected = LINE.at(1e6) / equivalent
    if 400e6 * second * expected > LINE.stress[-1] and 400e6 * expected < LINE.stress[0]:
        assert safety(bins, LINE) == pytest.approx(expected, rel=1e-8)
        assert damage(bins, LINE, safety(bins, LINE)) == pytest.approx(1.0, rel=1e-7)


def test_life_is_the_inverse_of_the_damage_at_the_required_safety():
    bins = [Bin(300e6, 4e5), Bin(500e6, 1e5)]
    assert life_share(bins, LINE, 1.0) == pytest.approx(
        1.0 / (4e5 / LINE.endured(300e6) + 1e5 / LINE.endured(500e6))
    )
    assert life_share(bins, LINE, 1.2) < life_share(bins, LINE, 1.0)
    assert math.isinf(life_share([Bin(1e6, 1e9)], LINE, 1.0))
    assert life_share([Bin(900e6, 1.0)], LINE, 1.0) == 0.0


def test_life_factors_between_their_points_have_the_exponents_of_the_standard():
    """Exponents 0.0756 and 0.0306 of Z_NT, 0.115 and 0.02 of Y_NT of case-hardened steel."""
    contact, root = contact_factors("case-hardened"), bending_factors("case-hardened")
    assert contact.at(1e6) == pytest.approx((5e7 / 1e6) ** 0.0756, rel=1e-3)
    assert contact.at(1e9) == pytest.approx((5e7 / 1e9) ** 0.0306, rel=1e-3)
    assert root.at(1e5) == pytest.approx((3e6 / 1e5) ** 0.1144, rel=1e-3)
    assert root.at(1e9) == pytest.approx((3e6 / 1e9) ** 0.02, rel=1e-3)


#: ISO 6336-2, table 2 (no pitting), and ISO 6336-3, table 1, from memory: Z_NT at 10⁵ cycles and where it is
#: 1; Y_NT of a few cycles, up to how many, and all 1 from 3·10⁶; 0.85 at 10¹⁰.
_TABLES = {
    "normalized": (1.6, 5e7, 2.5, 1e4),
    "ductile-iron": (1.6, 5e7, 2.5, 1e4),  # pearlitic and bainitic; ferritic is as grey iron
    "through-hardened-carbon": (1.6, 5e7, 2.5, 1e4),
    "through-hardened": (1.6, 5e7, 2.5, 1e4),
    "case-hardened": (1.6, 5e7, 2.5, 1e3),
    "induction-hardened": (1.6, 5e7, 2.5, 1e3),
    "grey-iron": (1.3, 2e6, 1.6, 1e3),
    "nitrided": (1.3, 2e6, 1.6, 1e3),
    "nitrided-through-hardened": (1.3, 2e6, 1.6, 1e3),
    "nitrocarburized": (1.1, 2e6, 1.1, 1e3),
}


@pytest.mark.parametrize("treatment", TREATMENTS)
def test_life_factors_of_every_treatment(treatment: Treatment):
    contact, bent = contact_factors(treatment), bending_factors(treatment)
    most, knee, static, until = _TABLES[treatment]
    assert [contact.at(n) for n in (1e3, 1e5, knee, 1e10)] == pytest.approx([most, most, 1.0, 0.85])
    assert [bent.at(n) for n in (1.0, until, 3e6, 1e10)] == pytest.approx([static, static, 1.0, 0.85])
    middle = math.sqrt(1e5 * knee)  # straight in both logarithms
    assert contact.at(middle) == pytest.approx(math.sqrt(most))
