"""The critical section of a root: by the closed form of ISO 6336-3 for a rack, and by the outline itself."""

import math

import numpy as np
import pytest

import tribodyn as td
from tribodyn.geometry.drive import SIDES, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.helix import base_helix_angle, normal_section
from tribodyn.geometry.root_section import critical_section
from tribodyn.geometry.tooth import fillet_point


def closed_form(assembly, side) -> tuple[float, float, float, float]:
    """h_Fe, s_Fn, ρ_F, α_Fen of a gear cut by a rack: ISO 6336-3, method B, SI units."""
    drive, written = assembly.drive, normal_section(assembly.drive)
    body, m, angle = body_of(written, side), written.module, written.pressure_angle
    base = float(base_helix_angle(drive))
    z, x = body.teeth / (math.cos(base) ** 2 * math.cos(drive.helix_angle)), body.profile_shift
    deep, round_ = body.dedendum, body.fillet_radius
    g = round_ - deep + x
    e = math.pi / 4 - deep * math.tan(angle) - (1 - math.sin(angle)) * round_ / math.cos(angle)
    h = 2 / z * (math.pi / 2 - e) - math.pi / 3
    theta = math.pi / 6
    for _ in range(200):
        theta = 2 * g / z * math.tan(theta) - h
    chord = z * math.sin(math.pi / 3 - theta) + math.sqrt(3) * (g / math.cos(theta) - round_)
    notch = round_ + 2 * g**2 / (math.cos(theta) * (z * math.cos(theta) ** 2 - 2 * g))
    tip = z + 2 * (tip_circle_radius(drive, side) - reference_radius(drive, side)) / m
    inner, ratio = z * math.cos(angle), assembly.contact_ratio / math.cos(base) ** 2
    along = math.sqrt(tip**2 - inner**2) / 2 - math.pi * math.cos(angle) * (ratio - 1)
    loaded = 2 * math.hypot(along, inner / 2)
    pressure = math.acos(inner / loaded)
    involute = [math.tan(value) - value for value in (angle, pressure)]
    half = (math.pi / 2 + 2 * x * math.tan(angle)) / z + involute[0] - involute[1]
    load = pressure - half
    arm = (
        (math.cos(half) - math.sin(half) * math.tan(load)) * loaded
        - z * math.cos(math.pi / 3 - theta)
        - g / math.cos(theta)
        + round_
    ) / 2
    return arm * m, chord * m, notch * m, load


@pytest.mark.parametrize(
    "drive",
    ["helical-24-95", "spur-25-51", "helical-fzg-20-30", "diez-ibarbia-18-36", "liu-ni-involute-23-47"],
)
@pytest.mark.parametrize("side", SIDES)
def test_a_gear_cut_by_a_rack_has_the_section_of_the_standards_closed_form(drive, side):
    assembly = td.drive(drive)._assembly
    found = critical_section(assembly, side)
    expected = closed_form(assembly, side)
    assert (found.arm, found.thickness, found.notch_radius, found.load_angle) == pytest.approx(
        expected, rel=1e-9
    )


def test_another_program_finds_the_same_chords_and_notches():
    """The first example of an open program of DIN 3990-11: z 19/104, m 4 mm, x 0.5/0.15, ρ_fP 0.25.

    Its iteration of ϑ ends 2e-4 degrees before the solution.
    """
    pair = td.drive(
        {
            "family": "involute",
            "module": "4 mm",
            "pressure_angle": "20 deg",
            "material": "16MnCr5",
            "mean_roughness": "0.8 um",
            "pinion": {"teeth": 19, "profile_shift": 0.5, "face_width": "48.64 mm", "fillet_radius": 0.25},
            "gear": {"teeth": 104, "profile_shift": 0.15, "face_width": "48.64 mm", "fillet_radius": 0.25},
        }
    )
    found = [critical_section(pair._assembly, side) for side in SIDES]
    assert [1e3 * each.thickness for each in found] == pytest.approx([8.748743356, 9.239504611], rel=1e-4)
    assert [1e3 * each.notch_radius for each in found] == pytest.approx([1.316147758, 1.325999193], rel=1e-4)


def test_the_section_of_a_ring_is_where_its_outline_leans_by_60_degrees():
    """By differences of the outline that the pinion-type cutter leaves, and the load's line as drawn."""
    assembly = td.drive("ring-36-93")._assembly
    found, tooth = critical_section(assembly, "gear"), assembly.tooth("gear")
    normals = np.linspace(float(tooth.form_angle), math.pi / 2, 20001)
    x, y = (np.asarray(value, float) for value in fillet_point(tooth, normals))
    slope = np.gradient(y, normals) / np.gradient(x, normals)
    place = int(np.argmin(np.abs(np.abs(slope) - math.tan(math.radians(60.0)))))
    assert found.thickness == pytest.approx(2.0 * y[place], rel=1e-5)
    bend = np.gradient(np.arctan(slope), normals) / np.hypot(np.gradient(x, normals), np.gradient(y, normals))
    assert found.notch_radius == pytest.approx(1.0 / abs(bend[place]), rel=1e-3)
    assert found.arm > 0.0
    assert math.radians(10.0) < found.load_angle < math.radians(40.0)


def test_a_ring_by_the_standard_s_formula_has_the_root_that_another_program_prints():
    """Planet and ring of the second stage of NREL's 5 MW gearbox; the report's z_0 30, x_0 0, ρ_fP 0.3."""
    sides = {"face_width": "550 mm"}
    pair = td.drive(
        {
            "family": "involute",
            "module": "21 mm",
            "pressure_angle": "20 deg",
            "material": "16MnCr5",
            "mean_roughness": "0.6 um",
            "centre_distance": "584 mm",
            "pinion": {"teeth": 36, "profile_shift": 0.5039, "tip_diameter": "815.663 mm", **sides},
            "gear": {
                "teeth": 93,
                "internal": True,
                "profile_shift": 0.1171,
                "tip_diameter": "1906.081 mm",
                "fillet_radius": 0.30,
                "cutter_teeth": 30,
                **sides,
            },
        }
    )
    found = critical_section(pair._assembly, "gear", by_formula=True)
    printed = (30.32, 56.76, 8.78, math.radians(18.63))
    for value, one in zip(found, printed, strict=False):
        assert value * (1e3 if one > 1.0 else 1.0) == pytest.approx(one, abs=5.1e-3 if one > 1.0 else 1e-4)
