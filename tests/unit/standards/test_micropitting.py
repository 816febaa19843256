"""ISO/TS 6336-22 (ISO/TR 15144-1): a published design report of a helical stage, and limits of the formulas.

KISSsoft report of 2017: z 24/95, m_n 14 mm, α_n 20°, β 10°, b 360 mm, a 861 mm, 5000 kW at 1165.9 rpm.
"""

import math

import numpy as np
import pytest

from tribodyn.standards import contact_path as paths
from tribodyn.standards import micropitting as films
from tribodyn.standards.contact_path import ContactPath
from tribodyn.standards.micropitting import Flanks, Load, Oil

TEETH, HELIX = (24.0, 95.0), math.radians(10.0)
TRANSVERSE = math.atan(math.tan(math.radians(20.0)) / math.cos(HELIX))
BASE = [z * 14e-3 / math.cos(HELIX) / 2.0 * math.cos(TRANSVERSE) for z in TEETH]
PATH = ContactPath(
    TEETH,
    (BASE[0], BASE[1]),
    (380.747e-3 / 2.0, 1395.376e-3 / 2.0),
    math.acos(sum(BASE) / 0.861),
    math.asin(math.sin(HELIX) * math.cos(math.radians(20.0))),
)
OVERLAP = 0.360 * math.sin(HELIX) / (math.pi * 14e-3)
SPEED = 1165.9 * math.pi / 30.0
FLANKS = Flanks(0.6e-6, 226_374e6, (13_780.0, 13_780.0))
LOAD = Load(5e6 / SPEED, SPEED, 0.360, 353.15, 1.25, 1.092, 1.069, 1.15)


def viscosity(temperature):
    """ν by ASTM D341 through 220 and 19 mm²/s, ρ = 890 − 0.7 (T − 289): written out for this test."""

    def double(value):
        return np.log10(np.log10(value + 0.7))

    slope = (double(220.0) - double(19.0)) / np.log10(373.15 / 313.15)
    at = double(220.0) - slope * np.log10(temperature / 313.15)
    return (10.0 ** (10.0**at) - 0.7) * 1e-6 * (890.0 - 0.7 * (temperature - 289.15))


def pressure_viscosity(temperature):
    return 2.657e-8 * viscosity(311.15) ** 0.1348 * (1.0 + 516.0 * (1.0 / (temperature - 0.15) - 1.0 / 311.0))


OIL = Oil(viscosity, pressure_viscosity)


def test_path_of_the_published_stage():
    assert paths.loss_factor(PATH) == pytest.approx(0.106, abs=5e-4)
    assert paths.curvature_radii(PATH, 0.0)[0] == pytest.approx(41.865e-3, abs=1e-6)
    assert paths.equivalent_radius(PATH, 0.0) == pytest.approx(37.12e-3, abs=5e-6)
    total = PATH.contact_ratio + OVERLAP
    assert paths.helical_load_factor(total) == pytest.approx(1.274, abs=5e-4)
    assert paths.mean_share_with_buttressing(PATH, 0.0, OVERLAP) == pytest.approx(0.889, abs=5e-4)


def test_films_of_the_published_stage():
    # printed: X_R 0.712, μ_m 0.0300, θ_M 85.0 °C, p_H 783.1, p_dyn 1014.7 MPa, h 0.632 µm, λ 1.053 at A
    pitch = paths.equivalent_radius(PATH, paths.point_distances(PATH)[3])
    assert films.roughness_factor(0.6e-6, pitch) == pytest.approx(0.712, abs=5e-4)
    found = films.method_b(PATH, FLANKS, LOAD, OIL, OVERLAP)
    assert found.friction_coefficient == pytest.approx(0.0300, abs=5e-5)
    assert found.bulk_temperature - 273.15 == pytest.approx(85.0, abs=0.05)
    assert found.pressure[0] / 1e6 == pytest.approx(1014.7, rel=3e-4)  # the report rounds E_r and X_Y
    assert found.pressure[0] / math.sqrt(LOAD.factor) / 1e6 == pytest.approx(783.1, rel=3e-4)
    assert found.film_thickness[0] * 1e6 == pytest.approx(0.632, abs=1e-3)
    assert found.specific_film[0] == pytest.approx(1.053, abs=2e-3)
    assert np.argmin(found.specific_film) == 0


def test_above_the_range_of_the_pressure_viscosity_there_is_no_film():
    """The standard's straight line of α over 1/T reaches zero at 783 K."""
    hot = np.array([700.0, 782.0, 784.0, 1200.0])
    found = films.film_thickness(1e9, 10e-3, 5.0, (370.0, hot), OIL, FLANKS.reduced_modulus)
    assert np.all(found[:2] > 0.0)
    np.testing.assert_array_equal(found[2:], 0.0)


def test_either_method_gives_the_same_film_from_the_same_pressure():
    found = films.method_b(PATH, FLANKS, LOAD, OIL, OVERLAP)
    distance = paths.point_distances(PATH)
    same = films.at_places(
        found.pressure,
        paths.equivalent_radius(PATH, distance),
        paths.rolling_speeds(PATH, distance, SPEED),
        found.friction_coefficient,
        found.bulk_temperature,
        FLANKS,
        OIL,
    )
    np.testing.assert_allclose(same.specific_film, found.specific_film)


def test_spur_gears_share_by_thirds_and_one_pair_carries_all_between():
    spur = PATH._replace(base_helix_angle=0.0)
    share = paths.load_share(spur, paths.point_distances(spur))
    np.testing.assert_allclose(share, [1 / 3, 1 / 2, 1, 1, 1, 1 / 2, 1 / 3])
    assert paths.load_share(spur, 0.0, 9.0) == pytest.approx(7 / 15)
    distance = np.linspace(0.0, spur.length, 7)
    rates = paths.rolling_speeds(spur, distance, SPEED)
    radii = paths.curvature_radii(spur, distance)
    np.testing.assert_allclose(rates[0] / rates[1], radii[0] / radii[1] * spur.ratio)
    pitch = paths.rolling_speeds(spur, paths.point_distances(spur)[3], SPEED)
    assert pitch[0] == pytest.approx(pitch[1])


def test_the_bulk_rises_with_the_way_the_oil_comes_and_less_with_relief():
    def rise(**change):
        return films.method_b(PATH, FLANKS, LOAD._replace(**change), OIL, OVERLAP).bulk_temperature - 353.15

    assert rise(lubrication="spray") == pytest.approx(1.2 * rise())
    assert rise(lubrication="submerged") == pytest.approx(0.2 * rise())
    relief = films.tip_relief_factor(PATH.tip_contact_ratios, adequate=True)
    assert rise(tip_relief=relief) == pytest.approx(rise() / relief)
    assert films.tip_relief_factor(PATH.tip_contact_ratios, adequate=False) == 1.0
