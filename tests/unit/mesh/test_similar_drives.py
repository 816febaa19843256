"""Drives that differ in size, in stiffness or in which gear drives: what has to change, and by how much."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.sample_drives import SOUND
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import mass_and_inertia
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.mesh.quasi_static import mean_efficiency, quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import tabulate

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
IRON = MaterialData("iron", 120e9, 0.26, 7200.0, 46.0, 470.0, 6e9)
SIZE, STIFFER = 1.7, 1.3
PAIRS = pytest.mark.parametrize(("family", "drive"), SOUND)


def larger(drive):
    """The same drive, all lengths times `SIZE`."""
    bodies = [
        body._replace(face_width=SIZE * body.face_width, bore_radius=SIZE * body.bore_radius)
        for body in (drive.pinion, drive.gear)
    ]
    return drive._replace(module=SIZE * drive.module, pinion=bodies[0], gear=bodies[1])


def stiffer(material):
    return replace(material, youngs_modulus=STIFFER * material.youngs_modulus)


def table(family, drive, materials=(STEEL, IRON), **options):
    data = MeshData(**({"compliance": "energy", "damping_ratio": 0.05, "points": 17} | options))
    return tabulate(assemble(family, drive), materials, data, 2)


def numbers(sheet):
    for name, value in sheet.items():
        if isinstance(value, dict):
            yield from ((f"{name} {inner}", number) for inner, number in numbers(value))
        else:
            yield name, value


@PAIRS
def test_a_larger_drive_has_larger_lengths_and_equal_angles(family, drive):
    small, large = (dict(numbers(geometry_sheet(assemble(family, size)))) for size in (drive, larger(drive)))
    assert small.keys() == large.keys()
    lengths = 0
    for name, (value, unit) in small.items():
        factor = SIZE if unit.startswith("mm") else 1.0
        if not isinstance(value, float) or ("pin" in name and "pinion" != name.split()[0]):
            continue
        assert large[name] == (pytest.approx(factor * value, rel=1e-9, abs=1e-9), unit), name
        lengths += unit == "mm"
    assert lengths > 20
    for side in SIDES:
        mass, inertia = mass_and_inertia(assemble(family, drive), side, 7850.0)
        heavier = mass_and_inertia(assemble(family, larger(drive)), side, 7850.0)
        assert heavier == pytest.approx((SIZE**3 * mass, SIZE**5 * inertia), rel=1e-9)


@PAIRS
@pytest.mark.parametrize("hertz", ["linear", "load-dependent"])
def test_a_larger_and_stiffer_drive(family, drive, hertz):
    """Compliance goes with 1/(E L), Palmgren's with 1/(E^0.9 L^0.8); loads with E L² at equal shares."""
    small = table(family, drive, hertz=hertz)
    other = table(family, larger(drive), (stiffer(STEEL), stiffer(IRON)), hertz=hertz)
    for name in ("boundary", "in_contact", "phase", "pressure_angle", "contact_ratio", "pitch_point_phase"):
        np.testing.assert_allclose(getattr(other, name), getattr(small, name), rtol=1e-9, atol=1e-12)
    for name in ("signed_distance", "equivalent_radius", "pinion_speed", "gear_speed", "face_width"):
        np.testing.assert_allclose(getattr(other, name), SIZE * getattr(small, name), rtol=1e-9, atol=1e-12)
    for name in ("compliance", "coupling"):
        np.testing.assert_allclose(
            getattr(other, name), getattr(small, name) / (STIFFER * SIZE), rtol=1e-8, atol=1e-22
        )
    assert other.hertz_coefficient == pytest.approx(small.hertz_coefficient / (STIFFER**0.9 * SIZE**0.8))
    if hertz == "linear":
        shared, heavier = quasi_static(small, 300.0), quasi_static(other, 300.0 * STIFFER * SIZE**3)
        np.testing.assert_allclose(heavier.normal_load, STIFFER * SIZE**2 * shared.normal_load, rtol=1e-7)
        np.testing.assert_allclose(heavier.deflection, SIZE * shared.deflection, rtol=1e-7)
        np.testing.assert_allclose(heavier.mesh_stiffness, STIFFER * SIZE * shared.mesh_stiffness, rtol=1e-7)
        assert mean_efficiency(other, 800.0, 0.05) == pytest.approx(mean_efficiency(small, 300.0, 0.05))


@PAIRS
def test_with_the_gears_exchanged_a_pair_goes_its_way_back(family, drive):
    turned = drive._replace(pinion=drive.gear, gear=drive.pinion)
    forth, reverse = assemble(family, drive), assemble(family, turned)
    assert (reverse.r_start, reverse.r_end) == pytest.approx((-forth.r_end, -forth.r_start), rel=1e-9)
    assert reverse.contact_ratio == pytest.approx(forth.contact_ratio, rel=1e-9)
    r = np.linspace(forth.r_start, forth.r_end, 9)
    there, back = kinematics(forth.path, r), kinematics(reverse.path, -r)
    ratio = drive.gear.teeth / drive.pinion.teeth
    np.testing.assert_allclose(back.pressure_angle, there.pressure_angle, rtol=1e-8)
    np.testing.assert_allclose(back.relative_curvature, there.relative_curvature, rtol=1e-7)
    np.testing.assert_allclose(back.pinion_speed, ratio * there.gear_speed, rtol=1e-7)
    np.testing.assert_allclose(back.gear_speed, ratio * there.pinion_speed, rtol=1e-7)
    np.testing.assert_allclose(back.pinion_friction_arm, there.gear_friction_arm, rtol=1e-7)
    np.testing.assert_allclose(back.gear_normal_arm, there.pinion_normal_arm, rtol=1e-7)
    first, last = table(family, drive), table(family, turned, (IRON, STEEL))
    # the pair that entered last goes back as the one that leaves first
    inside = (
        first.in_contact[
            0,
            :,
        ]
        > 0
    )
    assert inside.all()
    np.testing.assert_allclose(last.compliance[0, ::-1, ::-1], first.compliance[0], rtol=1e-6)
    np.testing.assert_allclose(last.coupling[0, ::-1, ::-1, ::-1], first.coupling[0], rtol=1e-6, atol=1e-16)
    np.testing.assert_allclose(last.compliance[1, ::-1, 1], first.compliance[1, :, 1], rtol=1e-6)
    np.testing.assert_allclose(last.boundary, first.boundary, rtol=1e-8)
    # and the shares of a load without friction are the same
    turns = quasi_static(first, 300.0 * ratio), quasi_static(last, 300.0)
    np.testing.assert_allclose(turns[1].normal_load[0, ::-1, ::-1], turns[0].normal_load[0], rtol=1e-6)
