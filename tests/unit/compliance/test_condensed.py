"""Faces in slices condensed to one spring and gap per pair: exact at the operating load, tangent near it."""

import numpy as np
import pytest

from tests.support.faces_in_slices import CASES, model, table
from tribodyn.compliance.sharing.condensed import _condensed, _stiff_together, press_pairs
from tribodyn.compliance.sharing.load_sharing import contact_deflection
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import family
from tribodyn.geometry.modification import FlankModification, Misalignment, Modifications
from tribodyn.mesh.quasi_static import quasi_static


@pytest.mark.parametrize("name", CASES)
def test_quasi_static_mesh_is_the_load_contact_model(case, name):
    modified, slices = CASES[name]
    cycle = table(case, modified, slices)
    torque = case.operating.gear_torque
    shared = model(case, cycle, modified, slices, torque)
    still = quasi_static(cycle, torque)
    loads = still.normal_load.reshape(shared.normal_load.shape)
    np.testing.assert_allclose(loads, shared.normal_load, atol=2e-3 * shared.normal_load.max())
    error = np.abs(still.deflection.ravel() - shared.deflection)
    assert np.max(error) < 3e-3 * np.ptp(shared.deflection)
    # At a little more load the mesh deflects more as the model does, but for 3 % of the local part's secant,
    # and the slice that the edge of the contact is in, where the face touches in part.
    more = model(case, cycle, modified, slices, 1.05 * torque).deflection - shared.deflection
    found = quasi_static(cycle, 1.05 * torque).deflection.ravel() - still.deflection.ravel()
    assert np.mean(found) == pytest.approx(np.mean(more), rel=0.1 if name == "lift" else 0.04)


def test_a_lifted_face_is_refused_by_its_own_key(case):
    with pytest.raises(InputError, match="lifts the flanks") as refused:
        table(case, Modifications(misalignment=Misalignment(8e-3)), 11)
    assert refused.value.key == "mesh.misalignment.in_plane"


def test_coupling_is_symmetric_and_everything_finite(case):
    cycle = table(case, *CASES["all"])
    np.testing.assert_allclose(cycle.coupling, np.swapaxes(cycle.coupling, -1, -2), atol=1e-22)
    assert np.all(cycle.compliance > 0)
    assert all(np.all(np.isfinite(np.asarray(field))) for field in cycle)


def test_slices_of_straight_flanks_change_nothing_but_that_their_ends_are_free(case):
    plain, sliced, apart = (
        table(case, Modifications(), slices, slice_coupling=coupled)
        for slices, coupled in ((1, True), (7, True), (7, False))
    )
    for name in ("compliance", "gap", "coupling"):
        first, second = getattr(plain, name), getattr(apart, name)
        np.testing.assert_allclose(second, first, rtol=1e-7, atol=1e-7 * np.abs(first).max())
    softer = sliced.compliance / plain.compliance
    print(softer.min(), softer.max())
    assert np.all(softer > 1.0)
    assert np.all(softer < 1.04)


def test_relief_begins_on_the_boundary_of_a_segment(case):
    cycle = table(case, *CASES["tips"])
    assembly = assemble(family(case.family), case.drive)
    start, end = assembly.roll_limits
    reach = float(assembly.path.rotation(assembly.r_start + 3e-3)) - start
    for roll in (start + reach, float(assembly.path.rotation(assembly.r_end - 3e-3))):
        phase = (roll - cycle.roll_start) / cycle.pitch_angle % 1.0
        assert np.min(np.abs(cycle.boundary - phase)) < 1e-9
    assert end > start


def test_back_flanks_are_modified_where_the_scenario_says_so(case):
    modified, slices = CASES["tips"]
    both = Modifications(*(flank._replace(both_flanks=True) for flank in modified[:2]))
    gaps = []
    for given in (modified, both):
        cycle = table(case, given, slices, backlash=5e-5)
        on_path = (cycle.in_contact[:, None, :] > 0) & (cycle.side < 0)
        gaps.append(np.where(on_path, cycle.gap, 5e-5) - 5e-5)
    # 12 µm of relief at either end of the path, where the corners are the only gap without it
    left, relieved = gaps
    assert left.min() == pytest.approx(0.0, abs=1e-9)
    assert np.sum(left > 1e-7) < 0.6 * np.sum(relieved > 1e-7)


def test_errors_of_single_teeth_are_refused_in_the_dynamics(case):
    flank = FlankModification(pitch_error=(1e-6,) * 18)
    with pytest.raises(InputError, match="pitch_errors"):
        table(case, Modifications(pinion=flank), 1)


def test_slices_that_touch_are_springs_side_by_side(rng):
    """A slice that carries less than a fifth of the mean counts in part, an idle one not at all."""
    own = rng.uniform(1e-9, 2e-9, (1, 2, 4, 4))
    own = own + np.swapaxes(own, -1, -2) + 6e-9 * np.eye(4)
    secant = rng.uniform(2e-9, 4e-9, (1, 2, 4))
    load = np.array([[[30.0, 50.0, 90.0, 0.0], [1.0, 70.0, 60.0, 40.0]]])
    compliance, share = _stiff_together(own, secant, load)
    np.testing.assert_allclose(share.sum(axis=-1), 1.0, rtol=1e-12)
    # the last slice idle: three springs, all at the same deflection
    three = own[0, 0, :3, :3] + np.diag(secant[0, 0, :3])
    one_each = np.linalg.solve(three, np.ones(3))
    assert compliance[0, 0] == pytest.approx(1.0 / one_each.sum(), rel=1e-12)
    np.testing.assert_allclose(share[0, 0], [*(one_each / one_each.sum()), 0.0], rtol=1e-12)
    # the first at 1/42.75 of the mean: between none and all of it
    without = np.linalg.solve(own[0, 1, 1:, 1:] + np.diag(secant[0, 1, 1:]), np.ones(3)).sum()
    whole = np.linalg.solve(own[0, 1] + np.diag(secant[0, 1]), np.ones(4)).sum()
    assert without < 1.0 / compliance[0, 1] < whole
    joined = 1.0 / 42.75 / 0.2
    weight = joined**2 * (3.0 - 2.0 * joined)
    springs = own[0, 1] + np.diag(secant[0, 1] / np.array([weight, 1.0, 1.0, 1.0]))
    assert 1.0 / compliance[0, 1] == pytest.approx(np.linalg.solve(springs, np.ones(4)).sum(), rel=1e-9)


def test_a_pair_is_its_slices_under_their_loads(rng, pair):
    """Springs of secants side by side, the neighbour's push on them, a gap that makes the state exact."""
    positions, pairs, slices, width = 2, 2, 3, pair.width / 3
    curvature = np.array([[90.0, 140.0], [120.0, 70.0]])
    root = rng.uniform(-1e-5, 1e-5, (positions, pairs * slices, pairs * slices))
    matrix = root @ np.swapaxes(root, 1, 2) + 3e-10 * np.eye(pairs * slices)
    matrix = matrix.reshape(positions, pairs, slices, pairs, slices)
    gap = rng.uniform(0.0, 2e-6, (positions, pairs, slices))
    gap[1, 1] += 1e-4  # one pair does not touch
    unit = np.ones((positions, pairs))
    shared = press_pairs(pair, curvature, matrix, unit, unit, gap, np.array([4000.0, 900.0]))
    total, minimum = shared.normal_load, 0.1
    found = _condensed(pair, curvature, matrix, gap, shared.slice_load, minimum)
    assert np.all(shared.slice_load[0] > 0.0)
    assert total[1, 1] == 0.0
    for t in range(positions):
        stiff, shares = np.zeros(pairs), np.zeros((pairs, slices))
        for j in range(pairs):
            load = shared.slice_load[t, j]
            if total[t, j] == 0.0:
                continue
            own = np.array(matrix[t, j, :, j])
            for m in range(slices):
                u = contact_deflection(pair, np.array(curvature[t, j]), np.array(load[m] / width))[0]
                own[m, m] += float(u) / load[m] if load[m] else 1e6
            each = np.linalg.solve(own, np.ones(slices))
            stiff[j], shares[j] = each.sum(), each / each.sum()
            assert found.compliance[t, j] == pytest.approx(1.0 / stiff[j], rel=1e-6)
            assert found.line_load_peak[t, j] == pytest.approx(slices * max(load) / sum(load), rel=1e-4)
        for j in range(pairs):
            assert found.coupling[t, j, j] == 0.0
            reached = found.gap[t, j] + found.compliance[t, j] * total[t, j] + found.coupling[t, j] @ total[t]
            if total[t, j] > 0.0:
                assert reached == pytest.approx(shared.deflection[t], rel=1e-6)
            else:
                left = [
                    gap[t, j, m] + matrix[t, j, m].ravel() @ shared.slice_load[t].ravel()
                    for m in range(slices)
                ]
                assert reached == pytest.approx(min(left), rel=1e-9)
            k = 1 - j
            if total[t, j] > 0.0 and total[t, k] > 0.0:
                pushed = shares[j] @ matrix[t, j, :, k] @ shares[k]
                assert found.coupling[t, j, k] == pytest.approx(pushed, rel=1e-5, abs=1e-16)


def test_an_idle_pair_is_taken_at_the_minimum_load(rng, pair):
    """Pressed alone, as the other's load leaves its flank: as a pair that is by itself under that load."""
    matrix = np.zeros((1, 2, 3, 2, 3))
    own = rng.uniform(-1e-5, 1e-5, (3, 3))
    own = own @ own.T + 3e-10 * np.eye(3)
    matrix[0, 0, :, 0], matrix[0, 1, :, 1] = own, own
    matrix[0, 0, :, 1] = matrix[0, 1, :, 0] = 2e-10
    gap = np.array([[[0.0, 1e-7, 3e-7], [2e-4, 2e-4 + 2e-7, 2e-4]]])
    load, minimum = np.array([[[500.0, 400.0, 300.0], [0.0, 0.0, 0.0]]]), 35.0
    found = _condensed(pair, np.full((1, 2), 100.0), matrix, gap, load, minimum)
    unit = np.ones((1, 1))
    alone = press_pairs(pair, 100.0 * unit, matrix[:, 1:, :, 1:], unit, unit, gap[:, 1:], np.array([minimum]))
    by_itself = _condensed(pair, 100.0 * unit, matrix[:, 1:, :, 1:], gap[:, 1:], alone.slice_load, 1e-9)
    assert found.compliance[0, 1] == pytest.approx(by_itself.compliance[0, 0], rel=1e-6)
    assert found.line_load_peak[0, 1] == pytest.approx(by_itself.line_load_peak[0, 0], rel=1e-6)
