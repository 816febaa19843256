"""AGMA 2101 and 908: two worked examples of a textbook, and the two limits of the geometry.

Shigley's Mechanical Engineering Design, examples 14-4 (spur) and 14-5 (helical, 30°): 17 and 52 teeth, normal
diametral pitch 10, face 1.5 in, Q_v 6, 1800 rpm, 4 hp; the printed numbers, and those of AGMA 908's table
of I, from memory.
"""

import math

import pytest

from tribodyn.standards import agma

INCH, POUND, PSI = 25.4e-3, 4.4482216, 6894.757
MODULE = INCH / 10.0
SPUR = agma.AgmaPair(
    (17.0, 52.0),
    MODULE,
    math.radians(20.0),
    0.0,
    MODULE * 34.5,
    (MODULE * 9.5, MODULE * 27.0),
    1.5 * INCH,
    # teeth thinner by 0.024 modules, 0.012/tan 20°, as those of AGMA 908's tables
    (-0.033, -0.033),
    1.4,
    0.35,
)
TRANSVERSE = MODULE / math.cos(math.radians(30.0))
HELICAL = SPUR._replace(
    helix_angle=math.radians(30.0),
    centre_distance=TRANSVERSE * 34.5,
    tip_radii=(TRANSVERSE * 8.5 + MODULE, TRANSVERSE * 26.0 + MODULE),
)


def test_dynamic_factors_as_printed():
    """The textbook has the exponent 2/3, the standard 0.667: 0.0005 apart."""
    for feet, printed in ((801.1, 1.377), (925.0, 1.404)):
        assert agma.dynamic_factor(17 - 6, feet * 0.3048 / 60.0) == pytest.approx(printed, abs=1e-3)


def test_geometry_of_the_examples():
    """J of the textbook's curves, two digits, read with the eye; I and m_N of 14-5 by its formulas."""
    assert agma.bending_geometry_factor(SPUR, 0) == pytest.approx(0.30, abs=0.01)
    assert agma.bending_geometry_factor(SPUR, 1) == pytest.approx(0.40, abs=0.01)
    # the textbook has p_N/(0.95 Z) for F/L_min, and the radii of curvature at the pitch point
    assert agma.load_sharing_ratio(HELICAL) == pytest.approx(0.6895, rel=0.01)
    assert agma.pitting_geometry_factor(HELICAL) == pytest.approx(0.195, rel=0.01)


@pytest.mark.parametrize(("teeth", "printed"), [(21, 0.078), (26, 0.079), (35, 0.080), (55, 0.080)])
def test_pitting_geometry_of_the_table(teeth: int, printed: float):
    """Spur pairs of ratio 1, 20°, standard addenda."""
    tips = MODULE * (teeth / 2.0 + 1.0)
    pair = SPUR._replace(teeth=(teeth, teeth), centre_distance=MODULE * teeth, tip_radii=(tips, tips))
    assert agma.pitting_geometry_factor(pair) == pytest.approx(printed, abs=5.1e-4)


def test_stresses_and_safeties_of_example_14_4():
    """W_t 164.8 lbf, K_s 1.043 and 1.052, K_m 1.22, I 0.121, J 0.30; 240 and 200 HB, R 0.9, 10⁸ cycles."""
    load, common = 164.8 * POUND, 1.377 * 1.22
    bending = agma.bending_stress(load, 0.30, MODULE, 1.5 * INCH, common * 1.043)
    assert bending / PSI == pytest.approx(6417.0, rel=1e-3)
    contact = agma.contact_stress(load, 2300.0 * PSI**0.5, 0.121, 1.7 * INCH, 1.5 * INCH, common * 1.043)
    assert contact / PSI == pytest.approx(70360.0, rel=1e-3)
    allowed = agma.allowable_stresses(240.0)
    assert [stress / PSI for stress in allowed] == pytest.approx([31350.0, 106400.0], rel=2e-3)
    cycles = 1e8
    assert agma.bending_life_factor(cycles) == pytest.approx(0.977, abs=5e-4)
    assert agma.pitting_life_factor(cycles) == pytest.approx(0.948, abs=5e-4)
    life = agma.bending_life_factor(cycles), agma.pitting_life_factor(cycles)
    assert agma.safety(allowed[0], bending, life[0], 0.9) == pytest.approx(5.62, rel=3e-3)
    assert agma.safety(allowed[1], contact, life[1], 0.9) == pytest.approx(1.69, rel=3e-3)


def test_parts_of_the_geometry_by_hand():
    """I of the lowest point of single contact, and in which direction J goes."""
    # a spur pair has I of its lowest point of single contact: radii ρ_1 and C sin φ − ρ_1
    angle, pitch = math.radians(20.0), math.pi * MODULE * math.cos(math.radians(20.0))
    tip, base = MODULE * 9.5, MODULE * 8.5 * math.cos(angle)
    first = math.sqrt(tip**2 - base**2) - pitch
    second = MODULE * 34.5 * math.sin(angle) - first
    by_hand = math.cos(angle) / ((1.0 / first + 1.0 / second) * 17.0 * MODULE)
    assert agma.pitting_geometry_factor(SPUR) == pytest.approx(by_hand)
    # thicker teeth and larger fillets are stronger; helical teeth share the load
    assert agma.bending_geometry_factor(SPUR._replace(profile_shifts=(0.2, 0.0)), 0) > 0.31
    assert agma.bending_geometry_factor(HELICAL, 0) > 1.3 * agma.bending_geometry_factor(SPUR, 0)
