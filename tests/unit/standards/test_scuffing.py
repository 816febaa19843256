"""ISO/TS 6336-20 and -21: factors as tabulated, Blok against the adapted form, FZG strengths."""

import math

import numpy as np
import pytest

from tribodyn.standards import contact_path as paths
from tribodyn.standards import fzg, scuffing
from tribodyn.standards.micropitting import Oil
from tribodyn.standards.scuffing import ScuffingMesh

STEEL = 2.0 / (2.0 * (1.0 - 0.09) / 206e9)
#: B_M of ISO/TR 13989-1, annex A, 435 N/(mm^½ m^½ s^½ K).
CONTACT = 435.0 * math.sqrt(1e3)


def test_factors_as_tabulated():
    # ISO/TR 13989-2: X_M 50.0 of steel, table 2: X_αβ 0.978 (20°, β 0), 0.966 (20°, β 20°)
    assert scuffing.thermal_flash_factor(STEEL, CONTACT) == pytest.approx(50.0, abs=0.15)
    angle = math.radians(20.0)
    assert scuffing.pressure_angle_factor(angle, angle, 0.0) == pytest.approx(0.978, abs=5e-4)
    assert scuffing.pressure_angle_factor(angle, angle, angle) == pytest.approx(0.966, abs=1.5e-3)


def test_blok_is_the_adapted_form_for_spur_gears():
    # ISO/TR 13989-1 (A.5), (A.6): μ X_M X_G w^¾ √v/a^¼ in N/mm, m/s, mm
    path = fzg.test_path()
    distance = np.array([0.1, 0.4, 0.9]) * path.length
    load, speed, friction = 300e3, 200.0, 0.05
    radius = paths.equivalent_radius(path, distance)
    normal = load / math.cos(path.pressure_angle)  # tangential at the working pitch circle
    width = np.sqrt(8.0 * normal * radius / (math.pi * STEEL))
    found = scuffing.flash_rise(
        friction, normal, width, paths.rolling_speeds(path, distance, speed), (CONTACT, CONTACT)
    )
    u, gamma = (
        path.ratio,
        paths.curvature_radii(path, distance)[0] / (path.base_radius[0] * math.tan(path.pressure_angle))
        - 1.0,
    )
    angles = 1.22 * math.sin(path.pressure_angle) ** 0.25 / math.sqrt(math.cos(path.pressure_angle))
    geometry = 0.51 * angles * math.sqrt(u + 1.0) * np.abs(np.sqrt(1.0 + gamma) - np.sqrt(1.0 - gamma / u))
    geometry /= ((1.0 + gamma) * (u - gamma)) ** 0.25
    pitch_speed = speed * path.pitch_radius[0]
    adapted = friction * 50.0 * geometry * 300.0**0.75 * math.sqrt(pitch_speed) / 91.5**0.25
    # what the adapted form leaves out, cos^¾ of the angle among it, is worth a few per cent
    np.testing.assert_allclose(found, adapted, rtol=0.05)
    np.testing.assert_allclose(found / found[0], adapted / adapted[0], rtol=1e-6)


def test_a_driven_tooth_without_relief_is_struck_before_the_pitch_point():
    """Another program's FZG pair, C_eff 18 µm: 47, 31, 29, 33 K at A, B, D, E, where Blok gives others."""
    path = fzg.test_path()
    places = paths.point_distances(path)
    found = scuffing.flash_approach(places[3] - places, path.length, 18e-6)
    assert found[0] == pytest.approx(47.0 / 46.05 * (31.94 + 29.94 + 34.24) / (31 + 29 + 33), rel=0.015)
    assert found[0] == pytest.approx(1.0 + 18.0 / 50.0 * (0.68 / 1.37) ** 3, abs=2e-3)
    assert found[3:] == pytest.approx(1.0)
    beyond = scuffing.flash_approach(np.array([2.0 * path.length]), path.length, 50e-6)
    assert beyond == pytest.approx([2.0])


def test_strength_of_an_oil_from_its_load_stage():
    assert fzg.scuffing_torque(12) == pytest.approx(534.5, rel=5e-3)  # ISO 14635-1: load stage 12
    assert fzg.scuffing_temperature(12.0, 0.85) - 273.15 == pytest.approx(80.0 + 2.25 * 0.85 * 144.0)
    higher = fzg.scuffing_integral_temperature(12.0, 1.0, 220e-6)
    assert higher > fzg.scuffing_integral_temperature(11.0, 1.0, 220e-6)
    assert scuffing.flash_safety(500.0, 400.0, 350.0) == pytest.approx(3.0)
    assert scuffing.integral_safety(573.15, 423.15) == pytest.approx(2.0)


def test_permissible_film_is_that_of_the_annex():
    # ISO/TR 15144-1, figure A.1, read off for VG 220 at Ra 0.5 µm: 0.40 at load stage 5, 0.145 at 10
    nu_40, nu_100, density = 220.0, 19.0, 890.0

    def double(value):
        return np.log10(np.log10(value + 0.7))

    def viscosity(temperature):
        slope = (double(nu_40) - double(nu_100)) / np.log10(373.15 / 313.15)
        at = double(nu_40) - slope * np.log10(temperature / 313.15)
        return (10.0 ** (10.0**at) - 0.7) * 1e-6 * (density - 0.7 * (temperature - 289.15))

    def pressure_viscosity(temperature):
        at_38 = 2.657e-8 * viscosity(311.15) ** 0.1348
        return at_38 * (1.0 + 516.0 * (1.0 / temperature - 1.0 / 311.15))

    oil = Oil(viscosity, pressure_viscosity)
    films = [fzg.permissible_specific_film(stage, oil) for stage in (5, 8, 10)]
    assert films == sorted(films, reverse=True)
    assert films[0] == pytest.approx(0.40, rel=0.2)
    assert films[-1] == pytest.approx(0.145, rel=0.2)


def test_shares_of_bulk_and_flash_in_the_integral_temperature():
    path = fzg.test_path()
    torque = fzg.scuffing_torque(12)
    mesh = ScuffingMesh(torque / 36e-3 / 20e-3, 8.3, 0.02, 363.15, 0.5e-6, STEEL, CONTACT, math.radians(20.0))
    found = scuffing.integral_temperature(path, mesh)
    assert found.integral == pytest.approx(found.bulk + 1.5 * found.flash_rise)
    assert found.bulk - 363.15 == pytest.approx(0.7 * found.flash_rise)
    assert found.integral > 363.15


def test_mean_flash_over_the_path_is_continuous_over_the_cases():
    for first, second in ((0.5, 0.5), (1.0, 0.6), (0.6, 1.0), (1.2, 0.8)):
        near = scuffing.contact_ratio_factor(first - 1e-9, second)
        assert scuffing.contact_ratio_factor(first + 1e-9, second) == pytest.approx(near, rel=0.02)
    assert scuffing.approach_factor(1.0, 1.5) == pytest.approx(1.0)
    assert scuffing.approach_factor(1.0, 3.0) == pytest.approx(0.6)
    assert scuffing.approach_factor(1.0, 0.5) == 1.0


def test_tip_relief_factor_has_its_ends():
    """X_Ca of ISO/TR 13989-2 (32) with ε_max 0.8: 1.0608 without relief, 1.6464 with the effective one."""
    assert scuffing.tip_relief_factor((0.8, 0.6), 0.0) == pytest.approx(1.0608)
    assert scuffing.tip_relief_factor((0.6, 0.8), 1.0) == pytest.approx(1.6464)
    assert scuffing.tip_relief_factor((0.8, 0.6), 3.0) == pytest.approx(1.6464)
    # K_A F_t/b 200 N/mm on c' 14 and c_γ 20 N/(mm µm)
    assert scuffing.effective_tip_relief(200e3, (14e9, 20e9), helical=False) == pytest.approx(
        14.286e-6, rel=1e-4
    )
    assert scuffing.effective_tip_relief(200e3, (14e9, 20e9), helical=True) == pytest.approx(10e-6)


def test_micropitting_reference_of_material_pairs():
    """ISO/TR 15144-1, annex A: a planet of case-hardened steel on a through-hardened ring has 0.75."""
    assert fzg.material_factor(["case-hardened", "through-hardened"]) == pytest.approx(0.75)
    assert fzg.material_factor(["nitrided", "case-hardened"]) == pytest.approx(1.25)
    assert fzg.material_factor([]) == 1.0
