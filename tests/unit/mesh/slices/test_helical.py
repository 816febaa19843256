"""Slices of helical pairs: lines of contact in closed form, their surfaces, mirrored hands, back flanks."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.support.helical_pairs import (
    ENERGY,
    EVEN,
    STEEL,
    WHOLE,
    base_angle,
    helical_pair,
    line_length,
    line_lengths,
    sliced,
)
from tribodyn.errors import InputError
from tribodyn.geometry.families import crc, cycloidal
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
)
from tribodyn.mesh.by_compliance import mesh_cycle_of
from tribodyn.mesh.quasi_static import cycle_mean
from tribodyn.mesh.record_arrays import as_arrays, from_arrays

OVERLAPS = [0.3, 0.7, 1.0, 1.4, 2.0, 2.6]


@pytest.mark.parametrize("overlap", OVERLAPS)
@pytest.mark.parametrize("addendum", [0.6, 0.8, 1.0, 1.3])
def test_lines_of_contact_are_as_long_as_the_field_says(overlap, addendum):
    pair = helical_pair(overlap, addendum=addendum)
    cycle = sliced(pair, nodes=1025)
    shortest, longest, mean = line_lengths(pair, overlap)
    length = line_length(cycle)
    assert np.min(length) == pytest.approx(shortest, rel=2e-3)
    assert np.max(length) == pytest.approx(longest, rel=2e-3)
    assert np.mean(length[:-1]) == pytest.approx(mean, rel=1e-5)
    assert cycle_mean(cycle, length[None]) == pytest.approx(mean, rel=1e-5)


@pytest.mark.parametrize("overlap", OVERLAPS)
def test_a_pair_moves_on_by_one_slot_in_a_cycle(overlap):
    cycle = sliced(helical_pair(overlap), replace(EVEN, backlash=2e-5), back=True)
    fronts, slices = cycle.front_slots, cycle.slices
    for name in ("share", "signed_distance", "gap", "compliance"):
        value = getattr(cycle, name)[0]
        first, last = value[0], value[-1]
        np.testing.assert_allclose(last[slices:fronts], first[: fronts - slices], rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(last[fronts:-slices], first[fronts + slices :], rtol=1e-9, atol=1e-12)
    share = cycle.share[0]
    assert np.all(share[0, fronts - slices : fronts] < 1e-9)  # the newest pair begins at phase 0
    assert share[1, fronts - slices] > 0.0
    assert np.all(share[-1, :slices] < 1e-9)  # the oldest has left before the cycle ends
    back = np.sum(share[:-1, fronts:], axis=-1).mean()
    assert back == pytest.approx(np.sum(share[:-1, :fronts], axis=-1).mean(), rel=1e-3)


def test_table_is_that_of_the_middle_of_the_face():
    pair = helical_pair(1.3)
    cycle = sliced(pair)
    assert (cycle.roll_end - cycle.roll_start) / cycle.pitch_angle == pytest.approx(pair.contact_ratio + 1.3)
    middle = cycle.signed_distance[0, :, cycle.slices // 2 :: cycle.slices][:, : cycle.front_pairs]
    inside = (cycle.share[0, :, cycle.slices // 2 :: cycle.slices] > WHOLE)[:, : cycle.front_pairs]
    passed = cycle.phase[0][:, None] - cycle.pitch_point_phase + np.arange(cycle.front_pairs)[::-1]
    base_pitch = cycle.pitch_angle * cycle.pinion_pitch_radius * np.cos(pair.path.pressure_angle(0.0))
    np.testing.assert_allclose(middle[inside], base_pitch * passed[inside], rtol=1e-9, atol=1e-12)


def surface(pair, body, rolled, place, z):
    """Point of a flank, m: what touches at `place` in its section, when the pinion stands at `rolled`."""
    path = pair.path
    slope = math.tan(pair.drive.helix_angle) / (pair.drive.module * pair.drive.pinion.teeth / 2)
    turn = rolled - z * slope - path.rotation(place)  # by which the section has moved on since
    alpha = path.pressure_angle(place)
    x, y = place * np.cos(alpha), place * np.sin(alpha)
    if body == "gear":
        turn, axis = -turn * path.pinion_pitch_radius / path.gear_pitch_radius, path.gear_pitch_radius
    else:
        axis = -path.pinion_pitch_radius
    cosine, sine = np.cos(turn), np.sin(turn)  # clockwise
    return np.array([x * cosine + (y - axis) * sine, axis - x * sine + (y - axis) * cosine, z])


def curvature(pair, body, rolled, place, z, frame):
    """Curvature (2, 2) of a flank in the tangent plane of the frame, and its tangents (2, 3)."""
    h = 2e-5

    def at(i, j):
        return surface(pair, body, rolled, place + i * h, z + j * h)

    along = np.array([at(1, 0) - at(-1, 0), at(0, 1) - at(0, -1)]) / (2 * h)
    normal, tangents = frame[0], frame[1:]
    second = (
        np.array(
            [
                [at(1, 0) - 2 * at(0, 0) + at(-1, 0), (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / 4],
                [np.zeros(3), at(0, 1) - 2 * at(0, 0) + at(0, -1)],
            ]
        )
        / h**2
        @ normal
    )
    second[1, 0] = second[0, 1]
    to_plane = np.linalg.inv(along @ tangents.T)
    return to_plane @ second @ to_plane.T, along


@pytest.mark.parametrize(
    "pair", [helical_pair(0.8), helical_pair(0.8, family=crc.FAMILY)], ids=["inv", "crc"]
)
def test_normals_radii_and_speeds_are_those_of_the_screw_surfaces(pair):
    """Both flanks as surfaces in space, differentiated numerically where a slice touches."""
    cycle = sliced(pair)
    node = 40
    touching = np.flatnonzero(cycle.share[0, node, : cycle.front_slots] > WHOLE)
    assert touching.size > 10
    for slot in touching[::3]:
        z = cycle.face_position[slot % cycle.slices]
        place = cycle.signed_distance[0, node, slot]
        late = z * math.tan(pair.drive.helix_angle) / (pair.drive.module * pair.drive.pinion.teeth / 2)
        rolled = pair.path.rotation(place) + late
        alpha, slope = cycle.pressure_angle[0, node, slot], cycle.pitch_slope
        normal = np.array([np.cos(alpha), np.sin(alpha), slope * np.cos(alpha)])
        normal /= np.linalg.norm(normal)
        tangent = np.cross(normal, [0.0, 0.0, 1.0])
        tangent /= np.linalg.norm(tangent)
        frame = np.array([normal, tangent, np.cross(normal, tangent)])
        bent = []
        for body in ("pinion", "gear"):
            matrix, along = curvature(pair, body, rolled, place, z, frame)
            bent.append(matrix)
            np.testing.assert_allclose(along @ normal, 0.0, atol=1e-6)
        relative = np.linalg.eigvalsh(bent[1] - bent[0])
        radius = cycle.equivalent_radius[0, node, slot]
        np.testing.assert_allclose(np.abs(relative).max() * radius, 1.0, rtol=2e-4)
        assert np.abs(relative).min() * radius < 2e-3


def test_other_hands_have_the_same_table():
    right, left = (sliced(helical_pair(1.2, hand * 0.3), ENERGY) for hand in (1, -1))
    for one, other in zip(right, left, strict=True):
        np.testing.assert_array_equal(one, other)


def test_table_goes_through_a_record():
    cycle = sliced(helical_pair(1.2), replace(EVEN, backlash=1e-5), back=True)
    for one, other in zip(cycle, from_arrays(as_arrays(cycle)), strict=True):
        np.testing.assert_array_equal(np.broadcast_to(one, np.shape(other)), other)


def test_slices_of_a_spur_pair_are_the_pair():
    pair = helical_pair(1.0)
    spur = replace_helix(pair)
    apart = replace(ENERGY, foundation_coupling=False)
    whole = mesh_cycle_of(spur, (STEEL, STEEL), apart, 100.0)
    parts = mesh_cycle_of(spur, (STEEL, STEEL), replace(apart, slices=7), 100.0)
    np.testing.assert_array_equal(parts.boundary, whole.boundary)
    stiffness = (1.0 / parts.compliance).reshape(*whole.compliance.shape, 7).sum(axis=-1)
    np.testing.assert_allclose(stiffness, 1.0 / whole.compliance, rtol=1e-14)
    np.testing.assert_array_equal(parts.in_contact[:, ::7], whole.in_contact)


def replace_helix(pair):
    return type(pair)(pair.family, pair.drive._replace(helix_angle=0.0))


def test_gaps_of_modified_flanks():
    """Crowning, misalignment and tip relief against their closed forms on an involute."""
    pair = helical_pair(1.1)
    crowned = FlankModification(tip=Relief(20e-6, 2e-3), lead=LeadRelief(crowning=8e-6))
    angle = 2e-4
    made = Modifications(pinion=crowned, misalignment=Misalignment(in_plane=angle))
    cycle = sliced(pair, replace(EVEN, modifications=made))
    width, beta, points = float(pair.common_width), base_angle(pair), 2000
    along = np.linspace(-0.5, 0.5, 2 * points + 1)[1::2, None, None] * cycle.share[0] * width / cycle.slices
    z = cycle.face_place[0] + along
    r = cycle.signed_distance[0] - along * cycle.pitch_slope * np.cos(cycle.pressure_angle[0])
    inside = 1.0 - (pair.r_end - r) / 2e-3
    stands = angle * (z * math.cos(beta) - r * math.sin(beta))
    expected = 20e-6 * np.clip(inside, 0.0, 1.0) + 8e-6 * (2.0 * z / width) ** 2 + stands
    expected, smooth = np.mean(expected, axis=0), (inside[0] < 0.0) == (inside[-1] < 0.0)
    np.testing.assert_allclose(cycle.gap[0][smooth], expected[smooth], rtol=1e-6, atol=1e-11)
    np.testing.assert_allclose(cycle.gap[0], expected, atol=4e-7)  # the relief's kink is in a slice


def test_too_few_slices_for_the_overlap():
    with pytest.raises(
        InputError, match=r"mesh.slices = 3: too few for contact ratios of 1\.\d+ \(transverse\)"
    ):
        sliced(helical_pair(4.0), slices=3)


def test_a_path_with_a_corner_in_slices():
    """Cycloidal flanks: the radius vanishes where a slice stands at the pitch point, and only there."""
    pair = helical_pair(0.9, family=cycloidal.FAMILY, shape=cycloidal.CycloidShape(0.0235, 0.0235))
    cycle = sliced(pair)
    assert np.all(np.isfinite(cycle.equivalent_radius))
    far = np.abs(cycle.signed_distance) > 1e-4
    assert np.all(cycle.equivalent_radius[far] > 0.0)
