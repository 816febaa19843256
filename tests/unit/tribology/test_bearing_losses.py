"""Friction of rolling bearings: numbers by hand, borders of the formulas, methods beside one another."""

import math

import numpy as np
import pytest

from tribodyn.standards.rolling_bearings import static_factors
from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.iso_bearings import iso_14179_1, iso_14179_2
from tribodyn.tribology.losses.loss import OilState
from tribodyn.tribology.losses.methods import BEARING_METHODS
from tribodyn.tribology.losses.palmgren import palmgren
from tribodyn.tribology.losses.skf import skf

RPM = math.pi / 30.0
OIL = OilState(0.027, 860.0)  # 31.4 mm²/s
BALL, ROLLER, TAPERED = "deep-groove-ball", "cylindrical-roller", "tapered-roller"
ANGLES = {
    TAPERED: 14.0,
    "spherical-roller": 10.0,
    "self-aligning-ball": 10.0,
    "angular-contact-ball": 40.0,
    "four-point-contact-ball": 35.0,
}


def bearing(kind: str, **more) -> BearingInOil:
    """A bearing 45 × 100 × 25."""
    angle = math.radians(ANGLES.get(kind, 0.0))
    sizes = {"bore": 45e-3, "outside_diameter": 100e-3, "width": 25e-3, "static_rating": 31.5e3}
    factors = static_factors(kind, contact_angle=angle)
    return BearingInOil(kind, 72.5e-3, contact_angle=angle, static_factors=factors, **sizes | more)


EVERY = [(method, kind) for method, known in BEARING_METHODS.items() for kind in known.series]


def test_moments_of_the_load_by_hand():
    """N and mm: 0.0003 · 5000 N · 60 mm = 90 N mm; 0.0005 (2/20)^0.55 · 2000 · 60 = 16.9 N mm."""

    def loaded(radial, axial, *bearing, **more):
        return palmgren(BearingInOil(*bearing, **more), 100.0, OIL, radial, axial).loaded

    assert loaded(5000.0, 0.0, ROLLER, 60e-3) == pytest.approx(0.09)
    assert loaded(2000.0, 0.0, BALL, 60e-3, static_rating=20e3) == pytest.approx(0.01691, rel=1e-3)
    unrated = palmgren(BearingInOil(BALL, 60e-3), 100.0, OIL, 2000.0, 0.0)
    assert unrated.loaded == 0.0
    assert unrated.exceeded == ("without static_rating no loss under load",)
    angle = math.radians(14.0)
    expected = 0.0004 * 2.0 * (0.4 / math.tan(angle)) * 2000.0 * 0.053
    assert loaded(3000.0, 2000.0, TAPERED, 53e-3, contact_angle=angle) == pytest.approx(expected)


def test_part_2_by_hand():
    """A 22209 under 4 kN: 0.00015 · 4000^1.35 · 72.5^0.3 N mm; without load f_0 = 4."""
    found = iso_14179_2(bearing("spherical-roller", series="222"), 1500 * RPM, OIL, 4000.0, 0.0)
    assert found.loaded == pytest.approx(1e-3 * 0.00015 * 4000**1.35 * 72.5**0.3)
    flow = 0.027 / 860.0 * 1e6 * 1500
    assert found.idle == pytest.approx(1e-10 * 4.0 * flow ** (2 / 3) * 72.5**3)
    pushed = iso_14179_2(bearing(ROLLER, series="3"), 0.0, OIL, 5000.0, 1000.0)
    assert pushed.loaded == pytest.approx((0.00035 * 5000 + 0.002 * 1000) * 0.0725)
    assert pushed.idle == pytest.approx(1.6e-8 * 2.2 * 72.5**3)
    assert iso_14179_2(bearing(ROLLER), 1.0, OIL, 1000.0, 501.0).exceeded
    four = iso_14179_2(bearing("four-point-contact-ball"), 1.0, OIL, 1000.0, 800.0)
    share = max(1.0 * 1000.0 + 2 * 0.29 * 800.0, 1000.0) / 31.5e3
    assert four.loaded == pytest.approx(0.001 * share**0.33 * (3.6 * 1000 + 1.5 * 800) * 0.0725)


def test_part_1_is_a_coefficient_of_friction_at_the_bore():
    found = iso_14179_1(bearing("spherical-roller", count=2), 100.0, OIL, 3000.0, 4000.0)
    assert found.loaded == pytest.approx(2 * 0.5 * 0.0018 * 5000.0 * 45e-3)


def test_axial_load_of_spherical_rollers_has_no_step():
    """Y_2 F_a = F_r: 1.35 F_r from either side."""
    held = bearing("spherical-roller")
    edge = 4000.0 * math.tan(held.contact_angle) / 0.67
    found = iso_14179_2(held, 100.0, OIL, 4000.0, np.array([edge * (1 - 1e-9), edge * (1 + 1e-9)])).loaded
    assert found[1] == pytest.approx(found[0], rel=1e-7)
    whole = iso_14179_2(held, 100.0, OIL, 0.0, edge).loaded
    assert whole == pytest.approx(found[0], rel=1e-6)


@pytest.mark.parametrize(("method", "kind"), EVERY)
def test_every_method_at_rest_in_arrays_and_beside_others(method, kind):
    """Finite at standstill, arrays as numbers, and within a factor of 4 of the mean of all methods."""
    speeds, viscosities = np.array([0.0, 1.0, 157.0, 500.0]), np.array([0.3, 0.1, 0.027, 0.008])
    radial, axial = np.array([0.0, 4000.0, 3000.0, 1000.0]), np.array([0.0, 0.0, 600.0, 300.0])
    if kind == "toroidal-roller":
        axial = 0.0 * axial
    oil = OilState(viscosities, 860.0)
    formula, held = BEARING_METHODS[method].formula, bearing(kind, oil_level=20e-3, bath_factor=1e-4)
    found = formula(held, speeds, oil, radial, axial)
    for part in (found.idle, found.loaded):
        assert part.shape == (4,)
        assert np.all(np.isfinite(part))
        assert np.all(part >= 0.0)
    for number in range(4):
        one = formula(
            held, speeds[number], OilState(viscosities[number], 860.0), radial[number], axial[number]
        )
        assert (one.idle, one.loaded) == pytest.approx((found.idle[number], found.loaded[number]))
    others = [
        known.formula(bearing(kind), 1500 * RPM, OIL, 3000.0, 0.0)
        for known in BEARING_METHODS.values()
        if kind in known.series
    ]
    totals = [float(torque.idle + torque.loaded) for torque in others]
    own = formula(bearing(kind), 1500 * RPM, OIL, 3000.0, 0.0)
    assert 0.25 < float(own.idle + own.loaded) / np.exp(np.mean(np.log(totals))) < 4.0


#: Coefficients of friction by which catalogues estimate M = 0.5 µ P d at about P = 0.1 C in good conditions
#: (SKF general catalogue, "Estimating the frictional moment").
ESTIMATES = {
    BALL: 0.0015,
    "self-aligning-ball": 0.0010,
    "angular-contact-ball": 0.0020,
    "four-point-contact-ball": 0.0024,
    ROLLER: 0.0011,
    TAPERED: 0.0018,
    "spherical-roller": 0.0018,
    "toroidal-roller": 0.0016,
}


@pytest.mark.parametrize("kind", list(ESTIMATES))
def test_skf_against_the_catalogues_own_estimate(kind):
    """All series of a bearing 45 × 100 under 6 kN at 1500 rpm: M = 0.5 µ P d within a factor of 2.5."""
    method = BEARING_METHODS["skf"]
    estimate = 0.5 * ESTIMATES[kind] * 6000.0 * 45e-3
    for series in method.series[kind] or ("",):
        held = bearing(kind, series=series)
        found = method.formula(held, 1500 * RPM, OilState(0.017, 850.0), 6000.0, 0.0)
        assert 0.4 < float(found.loaded) / estimate < 2.5, series


def test_skf_by_hand():
    """A 6309 under 4 and 0.5 kN at 1800 rpm in oil of 10.4 mm²/s, in N mm."""
    dm, n, viscosity = 72.5, 1800.0, 10.4
    sine = math.sin(math.radians(24.6 * (500 / 31.5e3) ** 0.24))
    rolling = 3.7e-7 * dm**1.96 * (4000 + 1.7 / sine * 500) ** 0.54
    rolling *= (viscosity * n) ** 0.6 / (1 + 1.84e-9 * (n * dm) ** 1.28 * viscosity**0.64)
    rolling *= math.exp(-3e-8 * viscosity * n * 145 * math.sqrt(3.1 / (2 * 55)))
    weight = math.exp(-2.6e-8 * (n * viscosity) ** 1.4 * dm)
    sliding = 2.84e-3 * dm**-0.145 * (4000.0**5 + 92.8 * dm**1.5 / sine * 500.0**4) ** (1 / 3)
    sliding *= weight * 0.12 + (1 - weight) * 0.05
    oil = OilState(10.4e-6 * 860.0, 860.0)
    found = skf(bearing(BALL, series="63"), n * RPM, oil, 4000.0, 500.0)
    assert found.loaded == pytest.approx(1e-3 * (rolling + sliding), rel=1e-9)
    assert found.idle == 0.0
    synthetic = skf(bearing(BALL, series="63"), n * RPM, oil._replace(synthetic=True), 4000.0, 500.0)
    assert synthetic.loaded < found.loaded


def test_a_bath_wets_what_it_covers():
    """Full: t of H = d_m, f_t = 1. The moment falls with the level, and without a level there is none."""
    found = [
        float(skf(bearing(ROLLER, oil_level=level, bath_factor=2e-4), 157.0, OIL, 0.0, 0.0).idle)
        for level in (0.0, 1e-3, 20e-3, 72.5e-3, 90e-3)
    ]
    assert found[0] == 0.0
    assert found == sorted(found)
    assert found[3] == found[4]
    n, dm, slim = 157.0 / RPM, 72.5, 145 / 55
    slender = 5 * 0.65 * 25 / dm
    resistance = 2.789e-10 * slender**3 - 2.786e-4 * slender**2 + 0.0195 * slender + 0.6439
    pushed = 4 * 2e-4 * 0.65 * 5.1 * slim * 1e-12 * resistance * 25 * dm**4 * n**2
    angle = 2 * math.acos(-0.4 / 0.6)
    wetted = 0.36 * dm**2 * (angle - math.sin(angle)) * 0.05 * 5.1 * slim
    viscosity = 0.027 / 860 * 1e6
    sheared = 1.093e-7 * n**2 * dm**3 * (n * dm**2 / viscosity) ** -1.379 * wetted
    assert found[3] == pytest.approx(1e-3 * (pushed + sheared), rel=1e-9)


def test_contact_seals_and_pairs():
    sealed = skf(bearing(BALL, seal="RS1", seal_diameter=50e-3), 0.0, OIL, 0.0, 0.0)
    assert sealed.idle == pytest.approx(1e-3 * (0.018 * 50**2.25 + 15))
    single, pair = (
        skf(bearing(TAPERED, rows=rows, both_ways=rows == 2), 157.0, OIL, radial, axial).loaded
        for rows, radial, axial in ((1, 2000.0, 0.0), (2, 4000.0, 0.0))
    )
    assert pair == pytest.approx(2 * single)
    pushed = skf(bearing(TAPERED, rows=2, both_ways=True), 157.0, OIL, 4000.0, 900.0).loaded
    alone = skf(bearing(TAPERED), 157.0, OIL, 2000.0, 900.0).loaded
    assert pushed == pytest.approx(alone + single)
