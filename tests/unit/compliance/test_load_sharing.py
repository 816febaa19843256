"""How positions are parted and pairs counted; the batches of a face do not change its loads."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.faces_in_slices import DRIVE, STEEL
from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.compliance.sharing import load_sharing
from tribodyn.compliance.sharing.load_sharing import (
    LoadedFlanks,
    SharedLoad,
    contact_deflection,
    effective_contact_ratio,
    extended_rolls,
    half_width,
)
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.families import cycloidal
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.path import pitch_point


def of_overlap(overlap):
    none = np.zeros(1)
    return SharedLoad(none, none, overlap, none, none)


@pytest.mark.parametrize("limits", [(-0.31, 0.42), (-0.2, 0.5), (-0.45, 0.1)])
def test_all_pairs_between_the_limits_are_there_once(limits):
    assembly = assemble(FAMILY, DRIVE)
    pitch = assembly.pitch_angle
    roll = extended_rolls(assembly, limits, 7)
    assert np.all(np.diff(roll, axis=1) < 0)  # the pair that entered first in front
    count = next(n for n in range(20) if limits[0] + n * pitch >= limits[1])
    expected = [limits[0] + (n + 0.5) * pitch / 7 for n in range(7 * count)]
    np.testing.assert_allclose(np.sort(roll, axis=None), expected, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize(("begin", "end"), [(-0.21, 0.29), (-0.1234, 0.4567)])
def test_contact_ratio_is_from_where_the_overlap_begins_to_where_it_ends(begin, end):
    """An overlap of two straight lines, one slice ahead of the other: ends are met between positions."""
    assembly = assemble(FAMILY, DRIVE)
    pitch = assembly.pitch_angle
    roll = extended_rolls(assembly, (begin - 0.1, end + 0.15), 9)
    first = np.minimum(roll - begin, 2.0 * (end - 0.02 - roll))
    second = np.minimum(roll - begin - 0.03, 2.0 * (end - roll))
    overlap = np.stack([first, second], axis=-1)
    assert effective_contact_ratio(roll, of_overlap(overlap), pitch) == pytest.approx((end - begin) / pitch)


def test_the_contact_flattens_both_bodies(pair):
    """Hertz's width of unlike materials, and each gear's own deflection down to its own depth."""
    soft = replace(STEEL, youngs_modulus=110e9, poisson_ratio=0.25)
    gears = pair.gears[0], pair.gears[1]._replace(depth=2.3e-3)
    unlike = pair._replace(materials=(STEEL, soft), gears=gears)
    load, curvature = np.array([40e3, 300e3]), np.array([90.0, 260.0])
    softness = (1 - 0.3**2) / 207e9 + (1 - 0.25**2) / 110e9
    half = np.sqrt(4 * load * softness / (np.pi * curvature))
    np.testing.assert_allclose(half_width(unlike, curvature, load), half, rtol=1e-12)
    expected = 0.0
    for material, depth in ((STEEL, gears[0].depth), (soft, 2.3e-3)):
        nu = material.poisson_ratio
        # C. Weber, K. Banaschek, far below the surface: 2 (1 - ν²)/(π E) q [ln(2 h/b) - ν/(2 (1 - ν))]
        logarithm = np.log(2 * depth / half) - nu / (2 * (1 - nu))
        expected = expected + 2 * (1 - nu**2) / (np.pi * material.youngs_modulus) * load * logarithm
    value, slope = contact_deflection(unlike, curvature, load)
    np.testing.assert_allclose(value, expected, rtol=0.02)
    more, less = (contact_deflection(unlike, curvature, load * (1 + step))[0] for step in (1e-5, -1e-5))
    np.testing.assert_allclose(slope, (more - less) / (2e-5 * load), rtol=1e-6)


def test_where_the_radii_vanish_the_contact_s_own_width_sees_more_of_them():
    """At the pitch point of a cycloid ρ̄² = M a, the mean over the half width a; and a² = 8 q ρ̄/(π E')."""
    soft = replace(STEEL, youngs_modulus=110e9, poisson_ratio=0.25)
    drive = DRIVE._replace(shape=cycloidal.CycloidShape(28e-3, 33e-3))
    assembly = assemble(cycloidal.FAMILY, drive)
    none = GearCompliance(np.empty(0), np.empty(0), np.empty(0), 1e-3)
    flexible = PairFlexibility(assembly, (STEEL, soft), float(drive.pinion.face_width), (none, none))
    modulus = 2 / ((1 - 0.3**2) / 207e9 + (1 - 0.25**2) / 110e9)
    for load in (20e3, 400e3):
        half = half_width(flexible, np.array([1e15]), np.array([load]))[0]
        mean = np.sqrt(pitch_point(assembly.path).length * half)
        assert half**2 == pytest.approx(8 * load * mean / (np.pi * modulus), rel=1e-6)


@pytest.mark.parametrize("friction", [0.0, 0.07])
def test_torques_balance_with_the_friction_s_arm(pair, friction):
    """About the gear's axis: normal loads, and friction that turns at the pitch point."""
    roll = np.array([[0.21, -0.139], [0.3, -0.049], [0.02, -0.329]])
    shared = LoadedFlanks(pair).share(roll, 150.0, friction)
    base = 54e-3 * np.cos(np.radians(20.0))
    for t in range(3):
        torque = 0.0
        for angle, load in zip(roll[t], shared.normal_load[t], strict=True):
            geometry = pair_geometry(pair.assembly, np.array([angle]))
            # the contact's distance from the foot of the gear's base circle, along the line of action
            along = 54e-3 * np.sin(np.radians(20.0)) - geometry.motion.signed_distance[0]
            torque += load * (base + np.sign(geometry.motion.signed_distance[0]) * friction * along)
        assert torque == pytest.approx(150.0, rel=1e-9)


def test_loads_do_not_know_of_batches(monkeypatch, pair):
    roll = extended_rolls(pair.assembly, (-0.3, 0.4), 5)
    whole = LoadedFlanks(pair, slices=3).share(roll, 200.0, 0.05, 2e-6 * np.cos(9.0 * roll))
    monkeypatch.setattr(load_sharing, "ENTRIES", 300)
    for first, second in zip(
        whole, LoadedFlanks(pair, slices=3).share(roll, 200.0, 0.05, 2e-6 * np.cos(9.0 * roll)), strict=True
    ):
        np.testing.assert_allclose(first, second, rtol=1e-12)
