"""Laws of friction beside Masjedi & Khonsari's: printed formulas in engineers' units, limits, ranges."""

import math

import numpy as np
import pytest

from tests.support.closures import LOCAL_LAWS, POINT, VECIANA, known, under
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.benedict_kelley import benedict_kelley
from tribodyn.tribology.friction.iso_14179_1 import iso_14179_1
from tribodyn.tribology.friction.niemann import niemann
from tribodyn.tribology.friction.xu import xu

#: Coefficients of friction (EHL, mixed EHL) over the slide-to-roll ratio: a separate prototype of the two
#: laws at Veciana's Table 2 (R 5 mm, V_e 5 m/s, p_H 2 GPa), with the literal reading of the mixed one.
PROTOTYPE = {
    0.001: (0.0002883893616581264, 0.0337927614628563),
    0.01: (0.0029617313808447685, 0.06555313216740749),
    0.1: (0.019175547194170844, 0.06634550381408157),
    0.3: (0.02431808659332673, 0.03254879032209337),
    0.5: (0.02154300838697624, 0.015824001094037685),
    1.0: (0.016122301062122445, 0.013386180580034669),
}


@pytest.mark.parametrize("ratio", PROTOTYPE)
def test_veciana_figure_1(ratio):
    radius, speed, pressure = 5e-3, 5.0, 2e9
    load = 2 * math.pi * radius * pressure**2 / VECIANA.surfaces.effective_modulus
    state = (load, 1 / radius, speed, ratio * speed, speed * (1 + ratio / 2), speed * (1 - ratio / 2))
    ehl, mixed = PROTOTYPE[ratio]
    assert known(under("xu", VECIANA), *state)[0] == pytest.approx(ehl, rel=1e-9)
    assert known(under("masjedi-khonsari-veciana", VECIANA), *state)[0] == pytest.approx(mixed, rel=1e-9)


def test_xu_is_the_printed_regression():
    b = (-8.916465, 1.03303, 1.036077, -0.354068, 2.812084, -0.100601, 0.752755, -0.390958, 0.620305)
    p, sr, v, nu, radius, s = 1.4, 0.23, 7.0, 12.0, 8e-3, 0.35  # GPa, 1, m/s, cP, m, µm
    x = sr * p * math.log10(nu)
    f = b[0] + b[3] * x + b[4] * math.exp(-x) + b[8] * math.exp(s)
    by_hand = math.exp(f) * p ** b[1] * sr ** b[2] * v ** b[5] * nu ** b[6] * radius ** b[7]
    assert xu(p * 1e9, radius, v, -sr * v, nu * 1e-3, s * 1e-6) == pytest.approx(by_hand, rel=1e-12)


def test_xu_has_no_friction_in_pure_rolling_and_none_at_a_vanishing_radius():
    assert xu(1e9, 5e-3, 5.0, 0.0, 0.01, 2e-7) < 1e-9
    # near a cycloid's pitch point: p_H ~ R^-1/2 at constant load
    assert xu(1e12, 5e-9, 1e-3, 1e-4, 0.01, 2e-7) < 1e-9


def test_benedict_kelley_in_british_units():
    """The original: 0.0127 log10[3.17e8 w/(η V_s V_Σ²)], w in lbf/in, η in cP, speeds in in/s."""
    load, eta, slid, rolled = 2000.0, 12.0, 90.0, 500.0
    british = 0.0127 * math.log10(3.17e8 * load / (eta * slid * rolled**2))
    inch, pound = 0.0254, 4.4482216
    ours = benedict_kelley(load * pound / inch, rolled * inch, slid * inch, eta * 1e-3, 0.0)
    assert ours == pytest.approx(british, rel=1e-3)


def test_benedict_kelley_grows_with_roughness_and_is_held_at_its_poles():
    def law(sliding, roughness):
        return benedict_kelley(4e5, 20.0, sliding, 0.01, roughness)

    assert law(2.0, 0.4e-6) == pytest.approx(law(2.0, 0.0) * 1.13 / 0.73, rel=1e-12)
    assert law(2.0, 5e-6) == pytest.approx(3 * law(2.0, 0.0), rel=1e-12)
    assert law(0.0, 0.0) == law(0.2, 0.0)
    assert benedict_kelley(1.0, 100.0, 50.0, 0.3, 0.0) == 0.0


def nominal(torque: float, rpm: float) -> NominalConditions:
    """Of the pair of Diez-Ibarbia et al.: 18/36 teeth, m 3 mm, b 26.7 mm; torque on the pinion, N m."""
    return NominalConditions(
        torque / 0.027,
        0.027,
        0.054,
        math.radians(20),
        rpm * math.pi / 30,
        0.0267,
        0.0106,
        820.0,
        0.8e-6,
        0.0651,
    )


def test_niemann_at_the_operating_conditions_of_diez_ibarbia():
    """Mean coefficients of OC1 … OC5, as printed with the paper's rows."""
    printed = {
        (159.1549, 1500): 0.04733,
        (39.7887, 6000): 0.02978,
        (159.1549, 3000): 0.0412,
        (636.6198, 1500): 0.05708,
        (159.1549, 6000): 0.03587,
    }
    for (torque, rpm), expected in printed.items():
        assert niemann(nominal(torque, rpm)) == pytest.approx(expected, rel=2e-3)


def test_iso_14179_1_by_hand():
    """K = 1000 T1 (z1 + z2)/(2 b r1² z2) of the standard, N/mm² with mm and N m."""
    torque, z1, z2, b, r1, rpm = 159.0, 18, 36, 26.7, 27.0, 1500.0
    load_intensity = 1000 * torque * (z1 + z2) / (2 * b * r1**2 * z2)
    speed = rpm * math.pi / 30 * r1 * 1e-3
    by_hand = (10.6e-3 / 820 * 1e6) ** -0.223 * load_intensity**-0.40 / (3.239 * speed**0.70)
    conditions = nominal(torque, rpm)
    assert conditions.load_intensity == pytest.approx(load_intensity * 1e6, rel=1e-12)
    assert iso_14179_1(conditions) == pytest.approx(by_hand, rel=1e-12)
    assert 0.01 < by_hand < 0.06


@pytest.mark.parametrize("law", ["xu", "benedict-kelley", "coulomb"])
def test_every_law_heats_its_own_contact(law):
    """The heat that makes the flash temperature is μ |v_s| p, whatever the law."""
    laws = under(law, **({"coefficient": 0.06} if law == "coulomb" else {}))
    once = known(laws, **POINT)
    more = known(laws, **{**POINT, "sliding": 2 * POINT["sliding"]})
    assert once.friction_coefficient > 0
    rise = more.flash_temperature_rise / once.flash_temperature_rise
    assert rise == pytest.approx(2 * more.friction_coefficient / once.friction_coefficient, rel=1e-9)
    assert once.hertz_pressure == known(under("none"), **POINT).hertz_pressure


@pytest.mark.parametrize("law", LOCAL_LAWS)
def test_signs_of_speeds_do_not_matter(law):
    state = {name: -POINT[name] for name in ("entrainment", "sliding", "pinion_speed", "gear_speed")}
    ours = known(under(law), **{**POINT, **state})
    np.testing.assert_allclose(ours, known(under(law), **POINT), rtol=1e-14)


@pytest.mark.parametrize("law", LOCAL_LAWS)
def test_nothing_overflows_at_the_ends(law):
    laws = under(law)
    with np.errstate(all="raise", under="ignore"):
        for load in (0.0, 1e-3, 1e9):
            for curvature in (1e-3, 1e9):
                for speed in (0.0, 1e3):
                    values = known(laws, load, curvature, speed, speed, speed, speed)
                    assert np.all(np.isfinite(values))
                    assert values[0] >= 0


def test_xu_on_flanks_as_rough_as_no_gear():
    """exp(S) runs away beyond 1 µm; it must not leave the numbers."""
    assert math.isfinite(xu(1e9, 0.01, 1.0, 0.1, 0.05, 1e-3))
