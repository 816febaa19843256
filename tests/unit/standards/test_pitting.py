"""Contact and root stress by the standard: limits, identities, and another program's spur pair."""

import math

import pytest

from tribodyn.standards import bending, pitting
from tribodyn.standards.contact_path import ContactPath
from tribodyn.standards.metals import BENDING, CONTACT, GRADES, TREATMENTS, Metal, slip_layer, stress_number

STEEL = 206e9 / (1 - 0.3**2)
CASE = Metal("case-hardened", 1500e6, 430e6, 6.9e9, 900e6)
SOFT = Metal("through-hardened", 700e6, 300e6, 2.5e9, 600e6)


def mesh(**changes) -> pitting.PittingMesh:
    """z 19/104, m 4 mm, x 0.5/0.15, b 48.64 mm, 535.93 N m at 980 rpm: an open program's example."""
    angle = math.radians(21.531902292465457)
    base = 71.41663917972905e-3 / 2, 390.9121302469379e-3 / 2
    path = ContactPath((19.0, 104.0), base, (44e-3, 212.6e-3), angle)
    given = {
        "path": path,
        "reference_radius": (38e-3, 208e-3),
        "normal_pressure_angle": math.radians(20.0),
        "helix_angle": 0.0,
        "face_width": 48.64e-3,
        "pinion_torque": 535.9299104114843,
        "pinion_speed": 980 * math.pi / 30,
        "effective_modulus": STEEL,
        "viscosity_40": 220e-6,
        "roughness": (4e-6, 4e-6),
    }
    return pitting.PittingMesh(**given | changes)


def test_a_spur_pair_has_another_programs_factors():
    found = pitting.geometry(mesh())
    assert found.contact_ratio == pytest.approx(0.906214912960638, rel=1e-6)
    assert found.zone == pytest.approx(2.3959406670899934, rel=1e-9)
    assert found.single_pair == pytest.approx((1.00554704549864, 1.0), rel=1e-6)
    assert found.nominal == pytest.approx(875.3827378988153e6, rel=2e-4)  # its Z_E is 189.8
    assert pitting.tangential_load(mesh()) == pytest.approx(14103.41869503906, rel=1e-9)


def test_the_nominal_stress_is_hertz_pressure_at_the_pitch_point_times_the_contact_ratio_factor():
    given, found = mesh(), pitting.geometry(mesh())
    first, second = (base * math.tan(given.path.pressure_angle) for base in given.path.base_radius)
    normal = given.pinion_torque / given.path.base_radius[0] / given.face_width
    hertz = math.sqrt(normal * (1 / first + 1 / second) * STEEL / (2 * math.pi))
    assert found.nominal == pytest.approx(hertz * found.contact_ratio, rel=1e-9)


def test_a_ring_presses_less_than_an_external_gear_of_as_many_teeth():
    tight = math.radians(20.0)
    base = [m * math.cos(tight) for m in (36e-3, 93e-3)]
    external = ContactPath((36.0, 93.0), (base[0], base[1]), (38e-3, 95e-3), tight)
    ring = ContactPath((36.0, -93.0), (base[0], -base[1]), (38e-3, -91e-3), tight)
    common = {"reference_radius": (36e-3, 93e-3), "helix_angle": 0.0}
    outside, inside = (pitting.geometry(mesh(path=path, **common)) for path in (external, ring))
    of_curvature = math.sqrt((1 / 36 - 1 / 93) / (1 / 36 + 1 / 93))
    shared = inside.contact_ratio / outside.contact_ratio
    assert inside.nominal / outside.nominal == pytest.approx(of_curvature * shared, rel=1e-9)
    assert inside.single_pair[1] == 1.0


def test_the_overlap_takes_spur_factors_into_those_of_wide_helical_gears():
    assert pitting.contact_ratio_factor(1.6, 0.0) == pytest.approx(math.sqrt(0.8))
    assert pitting.contact_ratio_factor(1.6, 1.0) == pytest.approx(1 / math.sqrt(1.6))
    assert pitting.contact_ratio_factor(1.6, 3.0) == pitting.contact_ratio_factor(1.6, 1.0)


def test_only_the_softer_gear_hardens_at_work():
    assert pitting.work_hardening(mesh(), (CASE, CASE)) == (1.0, 1.0)
    first, second = pitting.work_hardening(mesh(), (CASE, SOFT))
    assert first == 1.0
    assert 1.0 < second < 1.2
    assert pitting.work_hardening(mesh(), (SOFT, CASE)) == (second, 1.0)


@pytest.mark.parametrize("treatment", TREATMENTS)
@pytest.mark.parametrize("grade", GRADES)
def test_better_grades_stand_more_and_hardness_is_held_in_its_range(treatment, grade):
    for table in (CONTACT, BENDING):
        line, (low, high) = table[treatment][grade], table[treatment][grade].hardness
        assert stress_number(line, 1e12) == stress_number(line, high * 9.80665e6)
        assert stress_number(line, 1e3) == stress_number(line, low * 9.80665e6)
        middle = 0.5 * (low + high) * 9.80665e6
        weaker = table[treatment]["ML"]
        assert stress_number(line, middle) >= 0.999 * stress_number(weaker, middle)


def gear(**changes) -> bending.BendingGear:
    given = {
        "section": bending.RootSection(8e-3, 9e-3, 1.3e-3, math.radians(24.0)),
        "normal_module": 4e-3,
        "normal_pressure_angle": math.radians(20.0),
        "helix_angle": 0.0,
        "overlap_ratio": 0.0,
        "virtual_contact_ratio": 1.5,
        "face_width": 48e-3,
        "tooth_height": 9e-3,
        "rim": 40e-3,
        "internal": False,
        "quality": 6.0,
        "roughness": 20e-6,
    }
    return bending.BendingGear(**given | changes)


def test_the_form_factor_is_the_bending_of_a_cantilever_under_the_tangential_load():
    """6 F cos α_F h/(b s²) for F = F_t/cos α_n, over F_t/(b m)."""
    given = gear()
    force, section = 1000.0 / math.cos(given.normal_pressure_angle), given.section
    plain = 6 * force * math.cos(section.load_angle) * section.arm / (given.face_width * section.thickness**2)
    found = bending.nominal_stress(given, 1000.0)
    assert found.nominal == pytest.approx(plain * found.correction, rel=1e-12)


def test_thin_rims_and_idlers_stand_less():
    thick, thin = bending.nominal_stress(gear(), 1e3), bending.nominal_stress(gear(rim=5e-3), 1e3)
    assert thick.rim == 1.0
    assert thin.rim == pytest.approx(1.6 * math.log(2.242 * 9.0 / 5.0))
    at_limit = [bending.rim_factor(gear(rim=share * 9e-3)) for share in (1.2, 1.21)]
    assert at_limit == pytest.approx([1.0, 1.0], abs=2e-3)
    relative = bending.relative_factors(gear(reversed=True), thick, CASE)
    assert relative.alternating == pytest.approx(0.7, abs=0.03)
    assert bending.relative_factors(gear(), thick, CASE).alternating == 1.0


def test_the_static_notch_factor_is_another_programs():
    """0.44 Y_S + 0.12 of case-hardened steel: Y_S 2.3254914 and 2.4397245 give 1.1432162 and 1.1934788."""
    section = gear().section
    for correction, expected in (
        (2.3254914040266397, 1.1432162177717213),
        (2.439724457289684, 1.1934787612074609),
    ):
        found = bending.Stress(1.0, correction, 1.0, 1.0, 1.0, 2.5, 1.0)
        assert bending.relative_factors(gear(section=section), found, CASE).static_notch == pytest.approx(
            expected
        )


def test_a_notch_like_the_test_gears_has_factor_1():
    alike = bending.Stress(1.0, 2.0, 1.0, 1.0, 1.0, 2.5, 1.0)
    for metal in (CASE, SOFT):
        assert bending.relative_factors(gear(), alike, metal).notch == 1.0
        assert slip_layer(metal) > 0.0


def test_lubricant_velocity_and_roughness_count_by_the_softer_material():
    """A planet of 1500 MPa against a ring of 700 MPa: both C_ZL = 0.83, C_Zv = 0.85, C_ZR = 0.15."""
    mixed = pitting.influences(mesh(edition=2006), (CASE, SOFT))
    speed, tangent = 38e-3 * 980 * math.pi / 30, math.tan(mesh().path.pressure_angle)
    curvature = sum(1 / (base * tangent) for base in mesh().path.base_radius)
    rough = 4.0 * (10e-3 * curvature) ** (1 / 3)
    assert mixed.lubricant == pytest.approx((0.83 + 4 * 0.17 / (1.2 + 134 / 220) ** 2,) * 2, rel=1e-12)
    assert mixed.speed == pytest.approx((0.85 + 2 * 0.15 / math.sqrt(0.8 + 32 / speed),) * 2, rel=1e-12)
    assert mixed.roughness == pytest.approx(((3 / rough) ** 0.15,) * 2, rel=1e-12)
    assert pitting.influences(mesh(), (SOFT, CASE)).lubricant == mixed.lubricant
    # the edition of 2019 takes the speed at the working pitch circle
    working = speed / 38e-3 * mesh().path.pitch_radius[0]
    newer = pitting.influences(mesh(), (CASE, SOFT))
    assert newer.speed[0] == pytest.approx(0.85 + 2 * 0.15 / math.sqrt(0.8 + 32 / working), rel=1e-12)
    hard = pitting.influences(mesh(), (CASE, CASE))
    assert hard.lubricant[0] < mixed.lubricant[0]
    assert hard.speed[0] > mixed.speed[0]


def test_wide_helical_gears_without_suitable_modification_press_more_in_2019():
    """√f_ZCa: 1.2 unmodified, 1.07 usual, 1 suitable; ε_β between 0 and 1 goes over to it from M_1."""
    wide = mesh().path._replace(overlap_ratio=1.2)
    for modification, factor in (("none", 1.2), ("usual", 1.07), ("suitable", 1.0)):
        found = pitting.geometry(mesh(path=wide, modification=modification))
        assert found.single_pair == pytest.approx((math.sqrt(factor),) * 2)
    assert pitting.geometry(mesh(path=wide, edition=2006)).single_pair == (1.0, 1.0)
    spur, half = (
        pitting.geometry(mesh(path=mesh().path._replace(overlap_ratio=overlap))).single_pair[0]
        for overlap in (0.0, 0.5)
    )
    assert half == pytest.approx((spur + math.sqrt(1.2)) / 2.0)


def test_pairs_share_the_bending_load_of_helical_teeth_in_2019():
    """f_ε 1/√ε_αn from ε_β = 1 on; Y_β is over cos³ β; neither in 2006, nor of spur teeth."""
    helix = math.radians(20.0)
    wide = gear(overlap_ratio=1.3, helix_angle=helix)
    old, new = (bending.nominal_stress(wide._replace(edition=year), 1e3) for year in (2006, 2019))
    assert new.distribution == pytest.approx(1.0 / math.sqrt(1.5))
    assert new.form / old.form == pytest.approx(new.distribution)
    assert new.helix / old.helix == pytest.approx(1.0 / math.cos(helix) ** 3)
    assert old.distribution == 1.0
    assert (
        bending.nominal_stress(gear(), 1e3).nominal == bending.nominal_stress(gear(edition=2006), 1e3).nominal
    )
    deep = gear(overlap_ratio=0.5, virtual_contact_ratio=2.1)
    assert bending.distribution_factor(deep) == pytest.approx(math.sqrt(0.25 + 0.5 / 2.1))
    assert bending.distribution_factor(gear(virtual_contact_ratio=2.1)) == 0.7
