"""ISO/TS 6336-22 (ISO/TR 15144-1): a published design report of a helical stage, and limits of the formulas.

KISSsoft report of 2017: z 24/95, m_n 14 mm, α_n 20°, β 10°, b 360 mm, a 861 mm, 5000 kW at 1165.9 rpm.
"""

import math

import numpy as np
import pytest

from tribodyn.gears.rating.standard import path_of
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.standards import contact_path as paths
from tribodyn.standards import micropitting as films
from tribodyn.standards import scuffing
from tribodyn.standards.micropitting import Flanks, Load, Oil

HELIX, RACK = math.radians(10.0), math.radians(20.0)


def body(teeth, shift, tip):
    """A gear from its drawing, in the transverse section; the flanks end at the tip diameter, m."""
    normal = math.cos(HELIX)  # m_n/m_t
    return GearBody(
        teeth, shift * normal, normal, 1.25 * normal, 0.25 * normal, 0.36, 0.05, tip_radius=tip / 2.0
    )


DRIVE = Drive(
    14e-3 / math.cos(HELIX),
    math.atan(math.tan(RACK) / math.cos(HELIX)),
    body(24.0, 0.48, 380.747e-3),
    body(95.0, 0.6691, 1395.376e-3),
    centre_distance=0.861,
    helix_angle=HELIX,
)
STAGE = assemble(family("involute"), DRIVE)
PATH = path_of(STAGE)
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
    """From drawing data alone: helix, working angle, base circles, overlap."""
    assert PATH.contact_ratio == pytest.approx(1.463, abs=5e-4)
    assert PATH.overlap_ratio == pytest.approx(1.421, abs=5e-4)
    assert paths.loss_factor(PATH) == pytest.approx(0.106, abs=5e-4)
    assert paths.curvature_radii(PATH, 0.0)[0] == pytest.approx(41.865e-3, abs=1e-6)
    assert paths.equivalent_radius(PATH, 0.0) == pytest.approx(37.12e-3, abs=5e-6)
    assert paths.helical_load_factor(PATH.total_contact_ratio) == pytest.approx(1.274, abs=5e-4)
    assert paths.load_share(PATH, 0.0) == pytest.approx(0.889, abs=5e-4)


def test_forces_and_line_of_contact_of_the_published_stage():
    # printed: F_t 240 064, F_a 42 330, F_r 88 724 N (the torque is rounded), shortest line 483.685 mm
    sheet = geometry_sheet(STAGE, gear_torque=5e6 / SPEED * 95.0 / 24.0)
    for name, printed in {
        "tangential force on reference circle": 240_064.0,
        "radial force on reference circle": 88_724.0,
        "axial force": 42_330.0,
    }.items():
        assert sheet[name][0] == pytest.approx(printed, rel=2e-5), name
    assert sheet["minimum length of contact lines"][0] == pytest.approx(483.685, abs=5e-3)


def test_flash_temperature_of_the_published_stage():
    """Printed: greatest rise with X_Γ 0.889 at Γ 0.529, which is E; A has the same within 1e-3."""
    ends = np.array([0.0, PATH.length])
    assert paths.flash_share(PATH, ends) == pytest.approx([0.889, 0.889], abs=5e-4)
    tangent = PATH.base_radius[0] * math.tan(PATH.pressure_angle)
    last = paths.curvature_radii(PATH, PATH.length)[0] / tangent - 1.0
    assert last == pytest.approx(0.529, abs=5e-4)
    distance = np.linspace(0.0, PATH.length, 101)
    radius, speeds = paths.equivalent_radius(PATH, distance), paths.rolling_speeds(PATH, distance, SPEED)
    load = 1e6 * paths.flash_share(PATH, distance)
    width = np.sqrt(8.0 * load * radius / (math.pi * FLANKS.reduced_modulus))
    rise = scuffing.flash_rise(0.05, load, width, speeds, FLANKS.thermal_contact)
    assert rise[-1] == pytest.approx(np.max(rise), rel=1e-3)


def test_films_of_the_published_stage():
    # printed: X_R 0.712, μ_m 0.0300, θ_M 85.0 °C, p_H 783.1, p_dyn 1014.7 MPa, h 0.632 µm, λ 1.053 at A
    pitch = paths.equivalent_radius(PATH, paths.point_distances(PATH)[3])
    assert films.roughness_factor(0.6e-6, pitch) == pytest.approx(0.712, abs=5e-4)
    found = films.method_b(PATH, FLANKS, LOAD, OIL)
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
    found = films.method_b(PATH, FLANKS, LOAD, OIL)
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
    spur = PATH._replace(base_helix_angle=0.0, overlap_ratio=0.0)
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
        return films.method_b(PATH, FLANKS, LOAD._replace(**change), OIL).bulk_temperature - 353.15

    assert rise(lubrication="spray") == pytest.approx(1.2 * rise())
    assert rise(lubrication="submerged") == pytest.approx(0.2 * rise())
    relief = films.tip_relief_factor(PATH.tip_contact_ratios, adequate=True)
    assert rise(tip_relief=relief) == pytest.approx(rise() / relief)
    assert films.tip_relief_factor(PATH.tip_contact_ratios, adequate=False) == 1.0


def test_narrow_helical_gears_share_as_spur_gears_and_wide_ones_by_the_mean():
    distance, ends = paths.point_distances(PATH), 1.0 + 0.3 * 0.5
    narrow = PATH._replace(overlap_ratio=0.5)
    spread = ends / 3.0, 1.0, ends / 3.0  # at A, C and E; buttressing at the ends alone
    assert paths.load_share(narrow, distance)[[0, 3, 6]] == pytest.approx(spread)
    assert paths.flash_share(narrow, distance)[[0, 3, 6]] == pytest.approx(spread)
    wide = paths.load_share(PATH, distance)
    assert wide[[0, 3, 6]] * PATH.contact_ratio == pytest.approx([1.3, 1.0, 1.3])
    # from ε_β 0.8 to 1.2 linear: at 1.0 half of either
    middle = paths.load_share(PATH._replace(overlap_ratio=1.0), distance)
    assert middle[3] == pytest.approx((1.0 + 1.0 / PATH.contact_ratio) / 2.0)
    assert middle[0] == pytest.approx(1.3 * (1.0 / 3.0 + 1.0 / PATH.contact_ratio) / 2.0)
