"""Compliance that a crack adds: by the energy that opens it, and by finite elements with the crack meshed."""

import math

import numpy as np
import pytest

from tests.support.cracked_pair import STEEL, WIDTH, body, pair
from tribodyn.compliance.crack import (
    Crack,
    _bent,
    _pulled,
    _sheared,
    crack_compliance,
    mouth,
    root_thickness,
    tangent_limits,
)
from tribodyn.compliance.energy import hertz_linear, loaded_tooth, tooth_compliance
from tribodyn.compliance.fem.cracked_tooth import added_compliance, cracked_mesh, solved_crack_compliance
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, Drive
from tribodyn.geometry.families import involute
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate_loaded import tabulate_loaded

TANGENT = math.radians(30.0)


def cracked(tooth, share, angle=60.0):
    return Crack(share * root_thickness(tooth, TANGENT), math.radians(angle), TANGENT)


def test_strips_are_tada_s():
    """Table values of the handbook: 1.122 of a small crack; at half the width 1.49 bent, 2.83 pulled."""
    small, half = np.array([1e-9]), np.array([0.5])
    for factor in (_bent, _pulled, _sheared):
        assert factor(small)[0] == pytest.approx(1.122, rel=1e-3)
    assert _bent(half)[0] == pytest.approx(1.49, rel=0.01)
    assert _pulled(half)[0] == pytest.approx(2.83, rel=0.01)


def test_mouth_is_where_the_fillet_leans_so():
    tooth = loaded_tooth(pair(), "pinion")
    low, high = tangent_limits(tooth)
    assert low < TANGENT < high < math.pi / 2
    near = [mouth(tooth, TANGENT + d).place for d in (-1e-3, 1e-3)]
    step = near[1] - near[0]
    assert math.atan2(abs(step[1]), abs(step[0])) == pytest.approx(TANGENT, abs=1e-3)
    turned = np.linalg.norm(step) / 2e-3
    assert mouth(tooth, TANGENT).radius == pytest.approx(turned, rel=1e-3)


def test_similar_teeth_gain_alike():
    """E b C is a number of the shape."""
    found = []
    for module in (0.003, 0.006):
        tooth = loaded_tooth(pair(module), "pinion")
        r = np.linspace(-1.0, 1.0, 5) * 2.0 * module
        crack = cracked(tooth, 0.3)
        found.append(crack_compliance(tooth, STEEL, WIDTH, r, crack, np.array([crack.depth]))[0])
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9)


def test_grows_with_depth_from_nothing_and_towards_the_tip():
    tooth = loaded_tooth(pair(), "pinion")
    crack = cracked(tooth, 0.6)
    r = np.linspace(-5e-3, 6.5e-3, 7)
    found = crack_compliance(tooth, STEEL, WIDTH, r, crack, crack.depth * np.linspace(0.0, 1.0, 9))
    assert np.all(found[0] == 0.0)
    assert np.all(np.diff(found, axis=0) > 0.0)
    assert np.all(np.diff(found[-1]) > 0.0)
    shallow = crack_compliance(
        tooth, STEEL, WIDTH, r, crack._replace(depth=1e-6), np.array([0.5e-6, 1e-6])
    )  # in a stress that is even over the crack: with the square of the depth
    np.testing.assert_allclose(shallow[1] / shallow[0], 4.0, rtol=5e-3)


def by_finite_elements(assembly, r):
    """Compliance of a sound pair, m/N, by the load contact model."""
    cycle = tabulate_loaded(assembly, (STEEL, STEEL), MeshData("fem", damping_ratio=0.05), 200.0)
    held = np.broadcast_to(np.asarray(cycle.in_contact)[:, None, :] > 0, cycle.compliance.shape)
    at, compliance = cycle.signed_distance[held], cycle.compliance[held]
    order = np.argsort(at)
    return np.interp(r, at[order], compliance[order])


def drops_of(side, crack_of):
    """Drops of a pair's stiffness over the roll, each method by itself, and where the upper half is."""
    assembly = pair()
    tooth = loaded_tooth(assembly, side)
    crack = crack_of(tooth)
    start, end = (float(limit) for limit in assembly.limits)
    r = start + (end - start) * np.linspace(0.02, 0.98, 25)
    sound = hertz_linear(STEEL, STEEL, WIDTH) + sum(
        tooth_compliance(loaded_tooth(assembly, each), STEEL, WIDTH, r).total for each in SIDES
    )
    energy = crack_compliance(tooth, STEEL, WIDTH, r, crack, np.array([crack.depth]))[0]
    solved = solved_crack_compliance(tooth, STEEL, WIDTH, r, crack)
    reach = np.asarray(tooth.contact(r if side == "pinion" else -r).x)
    upper = reach > (reach.min() + reach.max()) / 2.0
    return energy / (sound + energy), solved / (by_finite_elements(assembly, r) + solved), upper


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5])
@pytest.mark.parametrize("side", SIDES)
def test_drop_of_stiffness_is_that_of_finite_elements(side, share):
    """Over the upper half of the flank within a tenth, or 1.5 % of the stiffness; below within 6 % of it."""
    energy, solved, upper = drops_of(side, lambda tooth: cracked(tooth, share))
    off = np.abs(energy - solved)
    assert np.all(off[upper] < np.maximum(0.1 * solved, 0.015)[upper])
    assert np.all(off < 0.06)


@pytest.mark.parametrize("side", SIDES)
def test_a_crack_square_to_the_axis_is_within_a_quarter(side):
    energy, solved, upper = drops_of(side, lambda tooth: cracked(tooth, 0.4, 90.0))
    assert np.all(np.abs(energy / solved - 1.0)[upper] < 0.25)


def test_finite_elements_are_converged():
    tooth = loaded_tooth(pair(), "pinion")
    crack = cracked(tooth, 0.3)
    found = []
    for refined in (1.0, 2.0):
        distance, added = added_compliance(tooth, cracked_mesh(tooth, crack, refined), 0.3)
        order = np.argsort(distance)
        found.append(np.interp(0.004, distance[order], added[order]))
    # linear between fourteen places: what is between them differs by more than the mesh
    assert found[0] == pytest.approx(found[1], rel=0.02)


def test_finite_elements_do_not_feel_how_far_the_bore_is():
    """A crack's effect is local: half the ring under the tooth changes it by a hundredth."""
    found = []
    for bore in (0.012, 0.017):
        drive = Drive(0.003, math.radians(20.0), body(18, bore), body(36, 0.025))
        tooth = loaded_tooth(assemble(involute.FAMILY, drive), "pinion")
        crack = cracked(tooth, 0.3)
        found.append(solved_crack_compliance(tooth, STEEL, WIDTH, np.array([0.0, 4e-3]), crack))
    np.testing.assert_allclose(found[0], found[1], rtol=0.02)


def test_a_small_helix_angle_changes_little():
    r = np.array([0.0, 3e-3])
    found = []
    for helix in (0.0, 1e-4):
        tooth = loaded_tooth(pair(helix=helix), "pinion")
        crack = cracked(tooth, 0.3)
        found.append(crack_compliance(tooth, STEEL, WIDTH, r, crack, np.array([crack.depth]))[0])
    np.testing.assert_allclose(found[0], found[1], rtol=1e-6)


def test_a_crack_into_the_bore_is_refused():
    drive = Drive(0.003, math.radians(20.0), body(18, 0.0222), body(36, 0.025))
    tooth = loaded_tooth(assemble(involute.FAMILY, drive), "pinion")
    with pytest.raises(InputError, match="leaves the body"):
        cracked_mesh(tooth, cracked(tooth, 0.9))
