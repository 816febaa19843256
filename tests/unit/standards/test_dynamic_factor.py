"""K_v by method B of ISO 6336-1: example 1 of ISO/TR 6336-30, and the ranges of the resonance ratio."""

import math

import pytest

from tribodyn.standards.load_factors import (
    DynamicMesh,
    coefficients,
    dynamic_factor,
    reduced_mass,
    resonance_speed,
    run_in_relief,
)

MESH = DynamicMesh(25.0, 0.0, 8.0, 14e9, 20e9, 200e3, 10e-6, 8e-6, 1.6, 0.0, 7.0)


def at(ratio, mesh=MESH):
    """K_v where the pinion turns at so many times its resonance speed."""
    speed = ratio * resonance_speed(mesh.pinion_teeth, mesh.mesh_stiffness, mesh.reduced_mass)
    return dynamic_factor(mesh._replace(pinion_speed=speed))


def test_example_1_of_iso_tr_6336_30():
    # printed: K_v 1.003; z 17/103, m_n 8 mm, β 15.8°, b 100 mm, 9000 N m at 360 rpm, grade 5, C_a 70 µm
    helix, angle = math.radians(15.8), math.radians(20.0)
    transverse = math.atan(math.tan(angle) / math.cos(helix))
    pitch = [z * 8e-3 / math.cos(helix) for z in (17.0, 103.0)]
    base = [d * math.cos(transverse) / 2.0 for d in pitch]
    inertias = [7830.0 * math.pi / 32.0 * d**4 * (1 - 0.5**4) * 0.1 for d in pitch]
    mass = reduced_mass((inertias[0], inertias[1]), (base[0], base[1]), 0.1)
    # ISO 1328-1:2013, grade 5, in µm and mm: f_p = 0.001 d + 0.4 m + 5, f_fα = 0.55 m + 5
    single_pitch = (0.001 * 1e3 * pitch[1] + 0.4 * 8.0 + 5.0) * 1e-6
    form = (0.55 * 8.0 + 5.0) * 1e-6
    mesh = DynamicMesh(
        17.0,
        360.0 * math.pi / 30.0,
        mass,
        12.370e9,
        17.465e9,
        9000.0 / (pitch[0] / 2.0) / 0.1,
        single_pitch * math.cos(transverse),
        form,
        1.55 + 0.1 * math.sin(helix) / (math.pi * 8e-3),
        70e-6,
        5.0,
    )
    found = dynamic_factor(mesh)
    assert found.range == "subcritical"
    assert found.factor == pytest.approx(1.003, abs=1e-3)


def test_ranges_meet_and_are_named():
    names = [at(ratio).range for ratio in (0.5, 1.0, 1.3, 2.0)]
    assert names == ["subcritical", "main resonance", "intermediate", "supercritical"]
    assert at(1.15).factor == pytest.approx(at(1.15 + 1e-9).factor, rel=1e-6)
    assert at(1.5).factor == pytest.approx(at(1.5 - 1e-9).factor, rel=1e-6)
    assert at(1e-9).factor == pytest.approx(1.0)
    half = at(0.4).factor - 1.0
    assert at(0.8).factor - 1.0 == pytest.approx(2.0 * half)


def test_resonance_begins_earlier_at_low_load():
    low = MESH._replace(line_load=25e3)
    assert at(0.7, low).range == "main resonance"
    assert at(0.67, low).range == "subcritical"
    assert at(0.7).range == "subcritical"


def test_relief_counts_below_grade_6_and_pays_where_it_meets_the_deflection():
    fine = MESH._replace(quality=5.0, tip_relief=MESH.line_load / MESH.single_stiffness)
    coarse = fine._replace(quality=6.0)
    assert at(1.0, fine).factor == pytest.approx(at(1.0, coarse).factor - 0.90)
    assert run_in_relief(1500e6) == pytest.approx(2.0e-6, abs=0.1e-6)


@pytest.mark.parametrize("total", [2.0, 2.5])
def test_coefficients_are_continuous_to_what_the_table_rounds(total):
    below, above = coefficients(total - 1e-9), coefficients(total + 1e-9)
    for before, after in zip(below, above, strict=True):
        assert before == pytest.approx(after, rel=0.08)


def test_reduced_mass_of_equal_gears_is_half_of_one():
    assert reduced_mass((2e-3, 2e-3), (0.04, 0.04), 0.02) == pytest.approx(2e-3 / 0.04**2 / 2.0 / 0.02)
