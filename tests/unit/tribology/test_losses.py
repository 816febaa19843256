"""Load-independent losses: formulas by hand in engineers' units, limits, orders of power."""

import itertools
import math
from dataclasses import replace

import pytest

from tribodyn.tribology.losses.bearing_drag import ShaftBearings, palmgren
from tribodyn.tribology.losses.churning import changenet_velex, iso_14179_1
from tribodyn.tribology.losses.of_pair import BearingDragData, LossData, losses_of_pair
from tribodyn.tribology.losses.wheel import Wheel
from tribodyn.tribology.losses.windage import anderson_loewenthal, dawson

RPM = math.pi / 30.0
#: Module 3 mm, 53 teeth.
WHEEL = Wheel(750 * RPM, 79.5e-3, 82.5e-3, 75.75e-3, 24e-3, 3e-3, 53.0, 40e-3)
OIL = (0.030, 850.0)


def test_changenet_velex_by_hand():
    """Re = ω R b/ν = 5288 at 0.0241 Pa·s: the first regime; thicker oil stays in it with Re^−0.21."""
    power = changenet_velex(WHEEL, *OIL, 1e-3).power
    radius, width, depth = 79.5e-3, 24e-3, 37e-3
    theta = math.acos(1 - depth / radius)
    surface = radius**2 * (2 * theta - math.sin(2 * theta)) + 2 * radius * width * theta
    surface += 2 * 53 * 6.75e-3 * width * theta / math.pi
    froude = (750 * RPM) ** 2 * radius / 9.80665
    reynolds = 750 * RPM * radius * width / (0.030 / 850)
    assert reynolds < 6000
    moment = 1.366 * (depth / 0.159) ** 0.45 * (1e-3 / 0.159**3) ** 0.1 * froude**-0.6 * reynolds**-0.21
    assert power == pytest.approx(0.5 * 850 * (750 * RPM) ** 3 * surface * radius**3 * moment, rel=1e-9)
    thick = changenet_velex(WHEEL, 0.060, 850.0, 1e-3).power
    assert thick / power == pytest.approx(2**0.21, rel=1e-9)


def test_in_the_second_regime_viscosity_has_no_effect():
    fast = WHEEL._replace(speed=3000 * RPM)
    thin, thinner = (changenet_velex(fast, one, 850.0, 1e-3).power for one in (0.03, 0.01))
    assert thin == pytest.approx(thinner)
    # ω³ Fr^−0.88: ω^1.24
    faster = changenet_velex(fast._replace(speed=6000 * RPM), 0.01, 850.0, 1e-3).power
    assert faster / thinner == pytest.approx(2**1.24)


def test_regimes_of_churning_join_without_a_step():
    powers = [changenet_velex(WHEEL._replace(speed=n * RPM), *OIL, 1e-3).power for n in range(800, 1600, 4)]
    assert max(abs(b / a - 1) for a, b in itertools.pairwise(powers)) < 0.03


def test_a_gear_that_does_not_dip_churns_nothing():
    assert changenet_velex(WHEEL._replace(immersion=0.0), *OIL, 1e-3).power == 0.0
    assert iso_14179_1(WHEEL._replace(immersion=0.0), *OIL).power == 0.0


def test_churning_of_both_formulas_is_of_the_same_order():
    one, other = changenet_velex(WHEEL, *OIL, 1e-3).power, iso_14179_1(WHEEL, *OIL).power
    assert 0.2 < one / other < 5.0


def test_iso_14179_1_by_hand():
    """In kW, mm, rpm, mm²/s."""
    power = iso_14179_1(WHEEL, *OIL).power
    dip, viscosity = 40 / 165, 0.03 / 850 * 1e6
    rough = (7.93 - 4.648 / 3) / math.sqrt(math.tan(math.radians(10)))
    teeth = 7.37 * dip * viscosity * 750**3 * 165**4.7 * 24 * rough / (0.2 * 1e26)
    sides = 1.474 * dip * viscosity * 750**3 * 165**5.7 / (0.2 * 1e26)
    assert power == pytest.approx(1e3 * (teeth + sides), rel=1e-9)


def test_windage_of_both_formulas_is_of_the_same_order_and_grows_alike():
    large = Wheel(10000 * RPM, 150e-3, 154e-3, 151e-3, 30e-3, 4e-3, 75.0)
    one, other = dawson(large).power, anderson_loewenthal(large).power
    assert 0.5 < one / other < 2.0
    assert dawson(large._replace(speed=2 * large.speed)).power / one == pytest.approx(2**2.9)
    assert anderson_loewenthal(large._replace(speed=2 * large.speed)).power / other == pytest.approx(2**2.8)
    assert not dawson(large).exceeded
    assert dawson(WHEEL).exceeded


def test_drag_of_bearings_by_hand():
    """d_m 60 mm, 1500 rpm, 100 mm²/s: (1.5e5)^⅔ = 2823; 1e-7 · 2 · 2823 · 216000 = 122 N mm; 19 W."""
    shaft = ShaftBearings(1500 * RPM, 60e-3, 2.0, 1)
    assert palmgren(shaft, 0.085, 850.0).power == pytest.approx(19.16, rel=2e-3)
    assert palmgren(replace(shaft, count=2), 0.085, 850.0).power == pytest.approx(2 * 19.16, rel=2e-3)
    # below ν n = 2000 the moment is constant, and both formulas meet there: 2000^⅔ = 158.7, printed as 160
    slow, slower = (palmgren(replace(shaft, speed=n * RPM), 0.085, 850.0).power for n in (16.0, 8.0))
    assert slow / slower == pytest.approx(2.0)
    joint = [palmgren(replace(shaft, speed=n * RPM), 0.085, 850.0).power for n in (19.99, 20.01)]
    assert joint[1] / joint[0] == pytest.approx(1.0, abs=0.01)


def test_only_what_is_asked_for_is_lost():
    both = (WHEEL._replace(speed=1500 * RPM, immersion=0.0), WHEEL)
    assert losses_of_pair(LossData(), both, *OIL) == {}
    asked = LossData(churning="iso-14179-1", bearings="palmgren", gear_immersion=40e-3)
    drag = BearingDragData(60e-3, 2.0, 2)
    found = losses_of_pair(replace(asked, drag=(None, drag)), both, *OIL)
    assert set(found) == {"churning", "bearings"}
    assert found["churning"].power == iso_14179_1(WHEEL, *OIL).power
    assert found["bearings"].power == palmgren(ShaftBearings(WHEEL.speed, 60e-3, 2.0, 2), *OIL).power
