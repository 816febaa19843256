"""Reference stiffness of ISO 6336-1: the standard's own example, its factors and its limits."""

import math

import pytest

from tribodyn.compliance.iso6336 import (
    ReferencePair,
    blank_factor,
    bodies_outside,
    outside,
    pair_of,
    rack_factor,
    reference_stiffness,
    theoretical_stiffness,
)
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import involute

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
IRON = STEEL.__class__("iron", 118e9, 0.3, 7200.0, 46.0, 470.0, 6e9)
PAIR = ReferencePair((18.0, 36.0), (0.0, 0.0), (1.2, 1.2), math.radians(20.0), 1.6, 300e3)


def transverse_contact_ratio(teeth, module, shift, angle, helix):
    """ε_α by ISO 21771 from the working centre distance, tips one module above the shifted circles."""
    transverse = math.atan(math.tan(angle) / math.cos(helix))
    reference = [z * module / math.cos(helix) / 2 for z in teeth]
    base = [r * math.cos(transverse) for r in reference]
    involute = math.tan(transverse) - transverse + 2 * sum(shift) * math.tan(angle) / sum(teeth)
    working = transverse
    for _ in range(50):
        working -= (math.tan(working) - working - involute) / math.tan(working) ** 2
    centres = sum(base) / math.cos(working)
    tips = [r + module * (1 + x) for r, x in zip(reference, shift, strict=True)]
    length = sum(math.sqrt(tip**2 - b**2) for tip, b in zip(tips, base, strict=True))
    length -= centres * math.sin(working)
    return length / (math.pi * module * math.cos(transverse) / math.cos(helix))


def test_example_1_of_iso_tr_6336_30():
    # printed: c'_th 17.856, c' 12.370, c_γα 17.465, c_γβ 14.845 N/(mm µm); rack D has h_fP = 1.4
    angle, helix = math.radians(20.0), math.radians(15.8)
    teeth, shift = (17.0, 103.0), (0.145, 0.0)
    ratio = transverse_contact_ratio(teeth, 8e-3, shift, angle, helix)
    pair = ReferencePair(teeth, shift, (1.4, 1.4), angle, ratio, 500e3, helix_angle=helix)
    stiffness = reference_stiffness(pair)
    assert stiffness.theoretical / 1e9 == pytest.approx(17.856, abs=5e-4)
    assert stiffness.single_pair / 1e9 == pytest.approx(12.370, abs=1e-3)
    # the example's tip diameters are rounded
    assert stiffness.mesh / 1e9 == pytest.approx(17.465, rel=5e-4)
    assert stiffness.mesh_face / 1e9 == pytest.approx(14.845, rel=5e-4)
    assert outside(pair) == []


def test_standard_rack_and_solid_steel_discs_leave_the_measured_correction():
    stiffness = reference_stiffness(PAIR)
    assert stiffness.single_pair == pytest.approx(0.8 * theoretical_stiffness((18.0, 36.0)))
    assert stiffness.single_pair / 1e9 == pytest.approx(12.7, abs=0.05)


def test_factors_of_the_rack():
    assert rack_factor((1.2, 1.2), math.radians(20.0)) == pytest.approx(1.0)
    assert rack_factor((1.4, 1.2), math.radians(20.0)) == pytest.approx(0.95)
    assert rack_factor((1.2, 1.2), math.radians(25.0)) == pytest.approx(1.1)


def test_factor_of_the_blank():
    assert blank_factor(1.0, 3.0) == 1.0
    assert blank_factor(0.5, 3.0) == pytest.approx(1.0 + math.log(0.5) / (5.0 * math.exp(0.6)))
    for web, rim in ((0.21, 1.02), (1.19, 4.0)):
        assert blank_factor(web, rim) == pytest.approx(1.0 + math.log(web) / (5.0 * math.exp(rim / 5.0)))
    assert blank_factor(0.1, 0.5) == blank_factor(0.2, 1.0)
    assert blank_factor(3.0, 2.0) == blank_factor(1.2, 2.0) > 1.0
    webbed = reference_stiffness(PAIR._replace(blank=blank_factor(0.3, 2.0)))
    assert webbed.single_pair / reference_stiffness(PAIR).single_pair == pytest.approx(blank_factor(0.3, 2.0))


def test_material_other_than_steel():
    iron = reference_stiffness(PAIR._replace(youngs_modulus=(206e9, 118e9)))
    # the standard's figure for steel on grey cast iron is 0.74
    assert iron.material == pytest.approx(0.74, abs=0.02)
    assert iron.theoretical == reference_stiffness(PAIR).theoretical


@pytest.mark.parametrize(("load", "reduced"), [(1600e3, 1.0), (100e3, 1.0), (50e3, 0.5**0.25), (0.0, 0.0)])
def test_low_loads(load, reduced):
    stiffness = reference_stiffness(PAIR._replace(line_load=load))
    assert stiffness.single_pair == pytest.approx(reduced * reference_stiffness(PAIR).single_pair)
    assert stiffness.mesh == pytest.approx(reduced * reference_stiffness(PAIR).mesh)


@pytest.mark.parametrize(
    ("key", "last", "beyond", "phrase"),
    [
        ("profile_shift", (0.2, 0.2), (0.1, 0.2), "less than its mate's 0.2"),
        ("profile_shift", (0.05, -0.55), (0.05, -0.56), "sum of profile shifts -0.51"),
        ("profile_shift", (1.1, 0.9), (1.11, 0.9), "sum of profile shifts 2.01"),
        ("pressure_angle", math.radians(15.0), math.radians(14.99), "pressure angle 14.99 deg"),
        ("pressure_angle", math.radians(25.0), math.radians(25.01), "pressure angle 25.01 deg"),
        ("contact_ratio", 1.2, 1.19, "contact ratio 1.19"),
        ("contact_ratio", 2.5, 2.51, "contact ratio 2.51"),
        ("line_load", 1600e3, 1601e3, "line load 1601 N/mm"),
    ],
)
def test_limits_are_those_of_the_standard(key, last, beyond, phrase):
    assert outside(PAIR._replace(**{key: last})) == []
    (found,) = outside(PAIR._replace(**{key: beyond}))
    assert phrase in found


def drive(pinion, gear):
    return assemble(involute.FAMILY, Drive(0.003, math.radians(20.0), pinion, gear))


def gear(teeth, shift=0.0, dedendum=1.25, bore=0.01, addendum=1.0):
    return GearBody(float(teeth), shift, addendum, dedendum, 0.25, 0.02, bore)


def test_pair_of_a_drive_is_ordered_by_teeth_and_loaded_on_the_reference_circle():
    first, second = gear(23, 0.2, 1.3), gear(47, -0.1, 1.2, 0.02)
    forth = pair_of(drive(first, second), (STEEL, IRON), 5e3)
    back = pair_of(drive(second, first), (IRON, STEEL), 5e3)
    assert forth.teeth == (23.0, 47.0)
    assert forth.youngs_modulus == (206e9, 118e9)
    assert forth.dedendum == (1.3, 1.2)
    for ours, turned in zip(forth, back, strict=True):
        assert ours == pytest.approx(turned)
    # T = F_n r_b; F_t = 2 T/d, whichever gear
    assert forth.line_load == pytest.approx(5e3 * math.cos(math.radians(20.0)) / 0.02)


def test_equal_numbers_of_teeth_are_ordered_by_shift():
    pair = pair_of(drive(gear(30, -0.2), gear(30, 0.3)), (STEEL, STEEL), 5e3)
    assert pair.profile_shift == (0.3, -0.2)
    assert outside(pair) == []


def test_bodies_and_tips_that_the_series_is_not_for():
    assert bodies_outside(drive(gear(23), gear(47))) == []
    (found,) = bodies_outside(drive(gear(23, bore=0.026), gear(47)))
    assert "rim of the pinion" in found
    (found,) = bodies_outside(drive(gear(23), gear(47, addendum=1.2)))
    assert "addendum of the gear 1.2" in found


def test_a_tip_that_only_the_profile_shift_moves_is_no_other_addendum():
    shifted = gear(20, 0.4), gear(40, -0.3)
    assert not any("addendum" in found for found in bodies_outside(drive(*shifted)))
    higher = drive(gear(20, 0.4, addendum=1.35), gear(40, -0.3, addendum=0.7))
    found = [sentence for sentence in bodies_outside(higher) if "addendum" in sentence]
    assert [sentence.partition(", ")[0] for sentence in found] == [
        "addendum of the pinion 1.35 modules",
        "addendum of the gear 0.7 modules",
    ]


def test_the_series_is_the_standards():
    """(82) with the coefficients of its table, at shifts of both gears that let every term count."""
    table = (0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182)
    for z1, z2, x1, x2 in ((17.0, 43.0, 0.6, 0.3), (23.0, 47.0, 0.9, -0.7), (13.0, 90.0, 0.4, 0.4)):
        terms = (1.0, 1 / z1, 1 / z2, x1, x1 / z1, x2, x2 / z2, x1**2, x2**2)
        flexibility = sum(c * term for c, term in zip(table, terms, strict=True))
        found = theoretical_stiffness((z1, z2), (x1, x2))
        assert found / 1e9 == pytest.approx(1.0 / flexibility, rel=1e-12)
