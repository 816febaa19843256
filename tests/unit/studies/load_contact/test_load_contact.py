"""The load contact model: reference values, equilibrium, symmetry, independence of mesh and depth."""

import numpy as np
import pytest

from tests.support.faces_in_slices import DRIVE, STEEL, WIDTH
from tribodyn.compliance.sharing.load_sharing import (
    LoadedFlanks,
    contact_deflection,
    effective_contact_ratio,
    extended_rolls,
    flexibility,
)
from tribodyn.compliance.sharing.slices import pair_harmonics
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry, roll_at_gap
from tribodyn.geometry.families.involute import FAMILY

PITCH_RADIUS, ANGLE = 27e-3, np.radians(20.0)
PITCH = 2 * np.pi / 18


@pytest.fixture(scope="module")
def pair():
    return flexibility(assemble(FAMILY, DRIVE), (STEEL, STEEL), held=True)


def stiffness_at_pitch_point(flexible):
    """One pair at 235 N/mm, per face width, N/(mm µm)."""
    geometry = pair_geometry(flexible.assembly, np.zeros((1, 1)))
    line_load = np.full((1, 1), 235e3)
    local, _ = contact_deflection(flexible, geometry.motion.relative_curvature, line_load)
    deflection = pair_harmonics(flexible, geometry)[0, :, :, 0] * line_load * WIDTH + local
    return 235e3 / deflection[0, 0] * 1e-9


def history(flexible, gear_torque, friction=0.0, positions=240):
    limits = roll_at_gap(flexible.assembly, 3e-5 + 2e-7 * gear_torque)
    roll = extended_rolls(flexible.assembly, limits, positions)
    return roll, LoadedFlanks(flexible).share(roll, gear_torque, friction)


def test_stiffness_at_the_pitch_point(pair):
    # Plain subtraction at a third of a module, as Diez-Ibarbia et al. do it: reference 13.8 ± 0.3.
    plain = flexibility(pair.assembly, pair.materials, held=True, depth=1 / 3)
    flat = [gear._replace(inside=_as_if_free_of_depth(gear.inside)) for gear in plain.gears]
    assert stiffness_at_pitch_point(plain._replace(gears=tuple(flat))) == pytest.approx(13.8, abs=0.3)
    # Freed of the depth it is 1 % softer, and no longer depends on it (below).
    assert stiffness_at_pitch_point(pair) == pytest.approx(13.45, abs=0.02)


def _as_if_free_of_depth(inside):
    """Displacements that `freed_of_depth` takes to those read at the depth itself."""
    return np.stack([inside[0], inside[0] - 2 * 0.91 / np.pi * np.log(2)])


@pytest.mark.parametrize(("torque", "expected"), [(40.0, 1.671), (159.0, 1.733), (637.0, 1.854)])
def test_effective_contact_ratio(pair, torque, expected):
    roll, shared = history(pair, 2 * torque)
    assert effective_contact_ratio(roll, shared, PITCH) == pytest.approx(expected, abs=0.02)


def test_stiffness_does_not_depend_on_the_depth_of_the_local_region(pair):
    found = [
        stiffness_at_pitch_point(flexibility(pair.assembly, pair.materials, held=True, depth=depth))
        for depth in (0.15, 0.2, 0.25, 1 / 3)
    ]
    assert np.ptp(found) < 2e-3 * np.mean(found), found


def test_stiffness_does_not_depend_on_the_mesh(pair):
    level = {
        n: 1 / stiffness_at_pitch_point(flexibility(pair.assembly, pair.materials, held=True, level=n))
        for n in (1, 2, 3)
    }
    assert abs(level[2] / level[3] - 1) < 1e-3
    # second order: the corner of the clamped bore, not the elements, sets the rate
    assert (level[1] - level[2]) / (level[2] - level[3]) > (1 - 2**-1.5) / (2**-1.5 - 3**-1.5)


def test_loads_and_deflections_agree(pair):
    roll, shared = history(pair, 318.3)
    geometry = pair_geometry(pair.assembly, roll)
    compliance = np.einsum("...ii->...i", pair_harmonics(pair, geometry)[0])
    own = compliance * shared.normal_load + shared.contact_deflection[..., 0]
    loaded = shared.normal_load > 0
    np.testing.assert_allclose(own[loaded], shared.overlap[loaded, 0], rtol=1e-8)
    assert np.all(shared.normal_load >= 0)
    assert np.all(shared.overlap[~loaded] <= 0)


def test_friction_steps_at_the_pitch_point(pair):
    # Diez-Ibarbia et al., OC4: F/F_N = 1/(1 ∓ μ tan φ), 1.0213 to 0.9797
    friction = 0.05708
    rolls = np.array([[-1e-6], [1e-6]])
    shared = LoadedFlanks(pair).share(rolls, 2 * 637.0, friction)
    full = 2 * 637.0 / (2 * PITCH_RADIUS * np.cos(ANGLE))
    slope = friction * np.tan(ANGLE)
    np.testing.assert_allclose(shared.normal_load[:, 0] / full, [1 / (1 - slope), 1 / (1 + slope)], rtol=1e-4)
    np.testing.assert_allclose(shared.normal_load[:, 0] / full, [1.0213, 0.9797], atol=2e-4)


def test_vanishing_load_leaves_the_theoretical_contact_ratio(pair):
    assert effective_contact_ratio(*history(pair, 0.01, positions=2000), PITCH) == pytest.approx(
        1.6111, abs=4e-3
    )


def test_neighbours_are_coupled_symmetrically_and_less_than_a_pair_with_itself(pair):
    roll, _ = history(pair, 318.3, positions=16)
    geometry = pair_geometry(pair.assembly, roll)
    matrix = pair_harmonics(pair, geometry)[0]
    np.testing.assert_array_equal(matrix, matrix.swapaxes(-1, -2))
    own = np.einsum("...ii->...i", matrix)
    between = matrix[:, 0, 1] / np.sqrt(own[:, 0] * own[:, 1])
    assert np.all((between > 0.1) & (between < 0.45))


def test_corner_gap_opens_with_the_square_of_the_distance():
    assembly = assemble(FAMILY, DRIVE)
    start, end = assembly.roll_limits
    for limit, outwards in ((start, -1), (end, 1)):
        near, far = (pair_geometry(assembly, np.array([limit + outwards * x])).gap[0] for x in (1e-3, 2e-3))
        assert 3.8 < far / near < 4.3
        just = pair_geometry(assembly, np.array([limit + outwards * 1e-9]))
        on = pair_geometry(assembly, np.array([limit]))
        assert just.gap[0] == pytest.approx(0.0, abs=1e-12)
        assert just.motion.signed_distance == pytest.approx(on.motion.signed_distance, rel=1e-6)
        assert just.pinion_radius == pytest.approx(on.pinion_radius, rel=1e-6)
    early = pair_geometry(assembly, np.array([start - 0.02]))
    assert early.gear_radius[0] == pytest.approx(57e-3)  # the gear's tip
    assert early.motion.sliding[0] == pytest.approx(1.5 * early.motion.signed_distance[0], rel=1e-9)
