"""Slow rotation under load: equilibrium, symmetry, convergence, and what relief of the tips is for."""

import numpy as np
import pytest

from tests.support.faces_in_slices import DRIVE, STEEL, WIDTH
from tribodyn.compliance.sharing.flank_gap import flank_gap
from tribodyn.compliance.sharing.load_sharing import (
    LoadedFlanks,
    effective_contact_ratio,
    extended_rolls,
    flexibility,
)
from tribodyn.compliance.sharing.loaded_contact import loaded_error, mean_pairs, reach, roll_through
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.helix import face_positions
from tribodyn.geometry.modification import (
    UNMODIFIED,
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
)

ANGLE = np.radians(20.0)
TORQUE, PITCH = 318.3, 2 * np.pi / 18
#: Both tips, linear, over all of the path that two pairs share; as deep as one pair deflects.
LONG = FlankModification(tip=Relief(12e-6, 5.4e-3))
TIPS = Modifications(LONG, LONG)
EVERYTHING = Modifications(
    LONG._replace(lead=LeadRelief(4e-6, 6e-6, 5e-3)), LONG, Misalignment(in_plane=3e-4, out_of_plane=2e-4)
)


def rolled(pair, modifications, torque, positions, cycles=1, friction_coefficient=0.0, **face):
    return roll_through(
        LoadedFlanks(pair, modifications, **face), torque, positions, cycles, friction_coefficient
    )


def error_of(pair, modifications, torque, positions, cycles=1, friction_coefficient=0.0, **face):
    return loaded_error(
        LoadedFlanks(pair, modifications, **face), torque, positions, cycles, friction_coefficient
    )


@pytest.fixture(scope="module")
def pair():
    return flexibility(assemble(FAMILY, DRIVE), (STEEL, STEEL), lead=True)


def test_nothing_modified_is_the_plane_model(pair):
    found = rolled(pair, UNMODIFIED, TORQUE, 60)
    sliced = rolled(pair, UNMODIFIED, TORQUE, 60, slices=9, coupled=False)
    plane = LoadedFlanks(pair).share(found.roll, TORQUE)
    np.testing.assert_allclose(found.normal_load, plane.normal_load, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(sliced.normal_load, plane.normal_load, rtol=1e-8, atol=1e-5)
    np.testing.assert_allclose(sliced.deflection, found.deflection, rtol=1e-9)
    assert np.all(np.abs(found.unloaded) < 1e-12)
    np.testing.assert_allclose(np.ptp(sliced.line_load, axis=-1), 0.0, atol=1e-6 * sliced.line_load.max())
    np.testing.assert_allclose(sliced.root_tension, found.root_tension * np.ones(9), rtol=1e-6, atol=1e3)
    limits = reach(LoadedFlanks(pair), TORQUE)
    roll = extended_rolls(pair.assembly, limits, 60)
    expected = effective_contact_ratio(roll, LoadedFlanks(pair).share(roll, TORQUE), PITCH)
    assert found.contact_ratio == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_torque_balances_with_everything_modified(pair, friction):
    found = rolled(pair, EVERYTHING, TORQUE, 30, friction_coefficient=friction, slices=15)
    motion = pair_geometry(pair.assembly, found.roll).motion
    lever = motion.gear_normal_arm + np.sign(motion.signed_distance) * friction * motion.gear_friction_arm
    np.testing.assert_allclose(np.sum(found.normal_load * lever, axis=1), TORQUE, rtol=1e-9)
    assert np.all(found.line_load >= 0)


@pytest.mark.parametrize("tilt", [4e-4, 5e-3])
def test_the_other_tilt_is_the_mirror_image(pair, tilt):
    first, second = (
        rolled(pair, Modifications(misalignment=Misalignment(sign * tilt)), TORQUE, 12, slices=21)
        for sign in (1, -1)
    )
    np.testing.assert_allclose(
        first.line_load, second.line_load[..., ::-1], atol=1e-6 * first.line_load.max()
    )
    np.testing.assert_allclose(first.deflection, second.deflection, rtol=1e-9)
    np.testing.assert_allclose(first.root_tension, second.root_tension[..., ::-1], rtol=1e-6, atol=1e3)
    # the nearer half, z < 0, carries more; at 17' less than half of the face touches
    assert np.all(
        np.sum(first.line_load[..., :10], axis=(1, 2)) > np.sum(first.line_load[..., 11:], axis=(1, 2))
    )
    if tilt > 1e-3:
        heaviest = np.argmax(first.normal_load, axis=1)
        touching = first.line_load[np.arange(12), heaviest] > 0
        assert np.all(touching.sum(axis=1) < 10)


def test_equal_gears_with_equal_tips_and_crowning_share_symmetrically():
    body = GearBody(24, 0.0, 1.0, 1.25, 0.25, WIDTH, 15e-3)
    twins = flexibility(assemble(FAMILY, Drive(3e-3, ANGLE, body, body)), (STEEL, STEEL), level=1)
    flank = FlankModification(tip=Relief(10e-6, 2e-3), lead=LeadRelief(3e-6, 3e-6))
    pitch = 2 * np.pi / 24
    roll = extended_rolls(twins.assembly, (-pitch, pitch), 60)
    gap = flank_gap(
        twins.assembly,
        Modifications(flank, flank),
        pair_geometry(twins.assembly, roll),
        face_positions(WIDTH, 7),
    )
    shared = LoadedFlanks(twins, slices=7, coupled=False).share(roll, 300.0, gap=gap)
    load = shared.slice_load[:, :, 0] / shared.slice_load.max()
    np.testing.assert_allclose(load, shared.slice_load[:, :, 6] / shared.slice_load.max(), atol=1e-9)
    order = np.argsort(roll, axis=None)
    angle, load = roll.ravel()[order], load.ravel()[order]
    np.testing.assert_allclose(angle, -angle[::-1], atol=1e-9)
    np.testing.assert_allclose(load, load[::-1], atol=1e-6)


def test_loads_converge_with_the_slices(pair):
    tilted = Modifications(misalignment=Misalignment(5e-4))
    loads, deflection, stress = [], [], []
    for slices in (21, 42, 84):
        found = rolled(pair, tilted, TORQUE, 3, slices=slices)
        load = found.line_load[1, np.argmax(found.normal_load[1])]
        loads.append(load.reshape(21, -1).mean(axis=1) / load.mean())
        deflection.append(found.deflection[1])
        stress.append(found.root_tension[0].max())
    np.testing.assert_allclose(loads[:2], loads[1:], atol=3e-3)
    np.testing.assert_allclose(deflection[:2], deflection[1:], rtol=2e-4)
    # the maximum is that of the last slice, at the end of the face
    assert abs(stress[1] - stress[2]) < 0.5 * abs(stress[0] - stress[1]) < 5e-3 * stress[2]


def test_free_ends_give_way_more_and_leave_their_load_to_the_places_next_to_them(pair):
    """Plane strain in the middle of the face; the very ends are softer, what is next to them carries more."""
    plane = rolled(pair, UNMODIFIED, TORQUE, 12)
    free = rolled(pair, UNMODIFIED, TORQUE, 12, slices=42)
    softer = free.deflection / plane.deflection
    assert np.all(softer > 1.01)
    assert np.all(softer < 1.04)
    np.testing.assert_allclose(free.normal_load, plane.normal_load, atol=0.01 * plane.normal_load.max())
    single = np.argmax(np.max(free.normal_load, axis=1))
    load = free.line_load[single, np.argmax(free.normal_load[single])]
    load = load / load.mean()
    np.testing.assert_allclose(load, load[::-1], rtol=1e-6)
    assert load[0] < 1.0
    assert 1.02 < np.max(load) < 1.07
    assert np.argmax(load[:21]) in (1, 2, 3)
    np.testing.assert_allclose(load[6:36], 1.0, atol=0.012)


def test_slices_that_hold_each_other_even_out_less():
    pair = flexibility(assemble(FAMILY, DRIVE), (STEEL, STEEL), lead=True, held=True)
    tilted = Modifications(misalignment=Misalignment(5e-4))
    held, alone = (rolled(pair, tilted, TORQUE, 6, slices=21, coupled=coupled) for coupled in (True, False))
    assert np.nanmin(held.face_load_factor / alone.face_load_factor) > 1.05


def test_misalignment_costs_stiffness_and_strains_the_roots_of_one_end(pair):
    straight = rolled(pair, UNMODIFIED, TORQUE, 12)
    tilted = rolled(pair, Modifications(misalignment=Misalignment(5e-4)), TORQUE, 12, slices=21)
    assert np.all(tilted.mesh_stiffness < straight.mesh_stiffness * 1.001)
    assert tilted.root_tension.max() > 1.2 * straight.root_tension.max()
    # at the end of the face that is loaded more, and more even than the load, which the tooth spreads
    worst = np.unravel_index(np.argmax(tilted.root_tension[0]), tilted.root_tension[0].shape)
    assert worst[2] < 5
    at = tilted.root_tension[0][worst[:2]]
    load = tilted.line_load[worst[:2]]
    assert 1.0 < at.max() / at.mean() < load.max() / load.mean()


def test_pitch_errors_are_the_unloaded_error_of_their_teeth(pair):
    errors = np.zeros(18)
    errors[1] = 6e-6
    found = rolled(
        pair, Modifications(pinion=FlankModification(pitch_error=tuple(errors))), 1.0, 40, cycles=3
    )
    # tooth 1 enters at phase 1: it leaves the error where no other tooth is on the path, from ε − 1 on
    ratio = pair.assembly.contact_ratio
    alone = (found.phase > 1 + ratio - 1 + 0.08) & (found.phase < 2 - 0.08)
    np.testing.assert_allclose(found.unloaded[alone] * np.cos(ANGLE), 6e-6, rtol=1e-9)
    before = found.phase < 1 - 0.08
    np.testing.assert_allclose(found.unloaded[before], 0.0, atol=1e-12)
    assert np.ptp(found.deflection) * np.cos(ANGLE) == pytest.approx(6e-6, rel=0.05)


def test_relief_of_the_tips_is_best_near_its_design_torque(pair):
    """Harris' map: long linear relief as deep as a pair deflects leaves the smallest error at that torque."""
    torques = [80.0, 160.0, TORQUE, 500.0, 640.0]
    plain, relieved = (
        np.array([np.ptp(error_of(pair, modified, torque, 40)) for torque in torques])
        for modified in (UNMODIFIED, TIPS)
    )
    assert np.all(np.diff(plain) > 0)
    assert np.argmin(relieved) == 2
    assert relieved[2] < 0.25 * plain[2]
    assert relieved[0] > 3 * relieved[2]
    assert relieved[4] > 3 * relieved[2]


def gaps(assembly, modified, roll, face):
    """Minimum gap of one pair along the face, m, and that on the pitch circles."""
    geometry = pair_geometry(assembly, np.array([roll]))
    whole = geometry.gap[0] + flank_gap(assembly, modified, geometry, face)[0]
    return float(np.min(whole)), float(np.min(whole) / np.cos(geometry.motion.pressure_angle[0]))


@pytest.mark.parametrize("factor", [1.3, 2.0])
def test_pairs_reach_as_far_as_deflections_gaps_and_errors_let_their_corners_touch(pair, factor):
    modified = EVERYTHING._replace(
        pinion=EVERYTHING.pinion._replace(pitch_error=tuple(3e-6 * np.sin(np.arange(18.0)))),
        gear=EVERYTHING.gear._replace(tip=Relief(20e-6, 5.4e-3), pitch_error=(5e-6, *[0.0] * 34, -2e-6)),
    )
    assembly, face = pair.assembly, face_positions(pair.width, 3)
    limits = reach(LoadedFlanks(pair, modified, 3), TORQUE, factor)
    start, end = assembly.roll_limits
    # of one pair at the pitch point, from first touch
    middle = np.zeros((1, 1))
    gap = flank_gap(assembly, modified, pair_geometry(assembly, middle), face)
    deflection = LoadedFlanks(pair, slices=3).share(middle, TORQUE, 0.0, gap).deflection[0]
    most = deflection * np.cos(ANGLE) - np.min(gap)
    most *= factor
    # what is open at the worst phase while nothing is loaded
    left = []
    for phase in range(60):
        rolls = [start + PITCH * (n + phase / 60) for n in range(3)]
        left.append(min(gaps(assembly, modified, roll, face)[0] for roll in rolls if roll < end))
    most += max(left) + sum(np.ptp(flank.pitch_error) for flank in (modified.pinion, modified.gear))
    assert max(left) > 1e-6
    for limit, path_end in zip(limits, (start, end), strict=True):
        nominal = pair_geometry(assembly, np.array([limit])).gap[0]
        assert 0.0 < abs(limit - path_end) < PITCH
        assert nominal + gaps(assembly, modified, path_end, face)[0] == pytest.approx(most, rel=1e-6)


def test_pairs_follow_their_teeth_through_several_cycles(pair):
    """Pair n enters in cycle n, with its teeth's errors; the first to touch makes the unloaded error."""
    errors = 4e-6 * np.cos(1.7 * np.arange(18.0))
    modified = Modifications(LONG._replace(pitch_error=tuple(errors)), LONG)
    positions, cycles = 3, 2
    found = rolled(pair, modified, TORQUE, positions, cycles)
    start, _ = pair.assembly.roll_limits
    arm = 54e-3 * np.cos(ANGLE)
    for t in range(positions * cycles):
        cycle, time = t // positions, t / positions
        assert found.phase[t] == pytest.approx(time, abs=1e-15)
        open_between = []
        for n in range(cycle - 3, cycle + 4):
            roll = start + PITCH * (time - n)
            _, along = gaps(pair.assembly, modified, roll, np.zeros(1))
            open_between.append(along + errors[n % 18] / np.cos(ANGLE))
            if found.roll[t].min() - 1e-9 < roll < found.roll[t].max() + 1e-9:
                assert np.min(np.abs(found.roll[t] - roll)) < 1e-12
        assert found.unloaded[t] == pytest.approx(min(open_between), abs=1e-12)
        assert found.normal_load[t].sum() * arm == pytest.approx(TORQUE, rel=1e-9)
    assert np.ptp(found.unloaded) > 1e-6
    assert found.peak_to_peak == pytest.approx(max(found.deflection) - min(found.deflection), rel=1e-12)


def test_stiffness_is_the_slope_of_the_force_on_the_pitch_circles(pair):
    found = rolled(pair, TIPS, TORQUE, 2, friction_coefficient=0.04)
    error, more = found.deflection, error_of(pair, TIPS, 1.001 * TORQUE, 2, friction_coefficient=0.04)
    # one pitch circle's force is the torque over its radius; the local part stiffens with the load
    np.testing.assert_allclose(found.mesh_stiffness, 1e-3 * TORQUE / 54e-3 / (more - error), rtol=2e-4)


def test_slices_are_pressed_as_hertz_says(pair):
    found = rolled(pair, EVERYTHING, TORQUE, 2, slices=4)
    np.testing.assert_allclose(found.slice_position, WIDTH * np.array([-3.0, -1.0, 1.0, 3.0]) / 8, rtol=1e-12)
    modulus = 207e9 / 2 / (1 - 0.3**2)
    carried = 0
    for t, j in np.ndindex(found.roll.shape):
        curvature = pair_geometry(pair.assembly, found.roll[t, j : j + 1]).motion.relative_curvature[0]
        load = found.line_load[t, j]
        assert found.normal_load[t, j] == pytest.approx(np.sum(load) * WIDTH / 4, rel=1e-12)
        half = np.sqrt(4 * load / (np.pi * modulus * curvature))
        np.testing.assert_allclose(found.half_width[t, j], half, rtol=1e-9)
        pressure = np.sqrt(load * modulus * curvature / np.pi)
        np.testing.assert_allclose(found.pressure[t, j], pressure, rtol=1e-9)
        if np.any(load):
            carried += 1
            assert found.face_load_factor[t, j] == pytest.approx(np.max(load) / np.mean(load), rel=1e-12)
        else:
            assert np.isnan(found.face_load_factor[t, j])
    assert 1 < carried < found.roll.size


@pytest.mark.parametrize("positions", [8, 13, 50])
@pytest.mark.parametrize("begin", [0.0, 0.31, 0.77, 0.93, 0.985])
def test_contact_ratio_under_load_counts_across_the_seam_of_cycles(positions, begin):
    """Overlaps linear in the roll angle between their ends: the count is exact however coarse the steps."""
    ratios = np.array([1.63, 1.21, 1.88])  # of the pairs that enter in each of three cycles
    phase = np.arange(positions * 3) / positions
    # slots from the pair that entered first, in the cycle each position is in
    age, cycle = np.arange(3, -2, -1), np.arange(positions * 3) // positions
    ratio = ratios[(cycle[:, None] - age) % 3]
    overlap = ratio / 2.0 - np.abs((phase % 1.0)[:, None] + age - begin - ratio / 2.0)
    assert mean_pairs(overlap, positions) == pytest.approx(np.mean(ratios), abs=1e-12)


def test_relief_keeps_corners_from_touching(pair):
    deep = LONG._replace(tip=Relief(20e-6, 5.4e-3))
    plain, relieved = (
        rolled(pair, modified, TORQUE, 120) for modified in (UNMODIFIED, Modifications(deep, deep))
    )
    start, end = pair.assembly.roll_limits
    outside = (plain.roll < start - 1e-6) | (plain.roll > end + 1e-6)
    assert np.any(plain.normal_load[outside] > 0)
    # deeper than what a pair deflects, 12.6 µm on the pitch circles
    outside = (relieved.roll < start - 1e-6) | (relieved.roll > end + 1e-6)
    assert not np.any(relieved.normal_load[outside])
    assert relieved.contact_ratio < pair.assembly.contact_ratio < plain.contact_ratio


@pytest.mark.parametrize(
    ("modified", "torque", "slices", "message"),
    [
        (Modifications(misalignment=Misalignment(1e-3)), TORQUE, 2, r"mesh\.slices = 2"),
        (Modifications(misalignment=Misalignment(1e-3)), TORQUE, 500, "give at most"),
        (Modifications(), 1e12, 1, "operating.gear_torque.*wider than the face"),
        (Modifications(misalignment=Misalignment(2e-2)), TORQUE, 9, "carry the heaviest pair"),
        (UNMODIFIED, 0.0, 1, "gear_torque"),
        (Modifications(FlankModification(tip=Relief(1e-3, 1e-3))), TORQUE, 1, "tip_relief"),
    ],
)
def test_what_cannot_be_is_refused(pair, modified, torque, slices, message):
    with pytest.raises(InputError, match=message):
        rolled(pair, modified, torque, 6, slices=slices)
