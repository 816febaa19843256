"""Loads of slices in slow rotation against closed forms for a uniform stiffness of the lines of contact."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.support.closures import coulomb
from tests.support.helical_pairs import (
    ENERGY,
    EVEN,
    STEEL,
    STIFFNESS,
    WHOLE,
    base_angle,
    helical_pair,
    line_length,
    sliced,
)
from tribodyn.compliance.iso6336 import theoretical_stiffness
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.modification import Misalignment, Modifications
from tribodyn.mesh.equilibrium import contacts, elastic, settled, sliding_side
from tribodyn.mesh.quasi_static import (
    by_pairs,
    cycle_mean,
    friction_loss,
    mean_efficiency,
    normal_arms,
    quasi_static,
    single_pair,
)
from tribodyn.mesh.tabulate import pair_slots, tabulate

TORQUE = 300.0


def base_force(pair) -> float:
    """F_bt, N."""
    return TORQUE / float(pair.path.gear_pitch_radius) / math.cos(float(pair.path.pressure_angle(0.0)))


@pytest.mark.parametrize("overlap", [0.6, 1.0, 1.7])
def test_uniform_stiffness_deflects_by_the_lines_length(overlap):
    pair = helical_pair(overlap)
    cycle = sliced(pair)
    found = quasi_static(cycle, TORQUE)
    beta, width = base_angle(pair), float(pair.common_width)
    per_length = STIFFNESS * math.cos(beta) / width
    deflection = found.deflection[0] * math.cos(float(pair.path.pressure_angle(0.0)))
    np.testing.assert_allclose(
        deflection, base_force(pair) / (per_length * line_length(cycle) * math.cos(beta) ** 2), rtol=1e-10
    )


@pytest.mark.parametrize("overlap", [1.0, 2.0])
@pytest.mark.parametrize("hertz", [0.0, 3e-9])
def test_whole_overlap_leaves_no_transmission_error(overlap, hertz):
    """Of a stiffness that is the same everywhere, with a load-dependent contact too."""
    cycle = sliced(helical_pair(overlap))._replace(hertz_coefficient=hertz)
    deflection = quasi_static(cycle, TORQUE).deflection
    assert np.ptp(deflection) < 1e-6 * np.mean(deflection)


@pytest.mark.parametrize("family", [involute.FAMILY, crc.FAMILY], ids=lambda f: f.name)
def test_loads_balance_the_torque_by_virtual_work(family):
    """Load times the approach per rotation that the transverse sections have, leaning by the normal."""
    pair = helical_pair(1.3, family=family)
    cycle = sliced(pair, replace(ENERGY, hertz="load-dependent"))
    found = quasi_static(cycle, TORQUE)
    alpha = cycle.pressure_angle
    transverse = found.normal_load / np.hypot(1.0, cycle.pitch_slope * np.cos(alpha))
    torque = np.sum(transverse * cycle.gear_pitch_radius * np.cos(alpha), axis=-1)
    np.testing.assert_allclose(torque, TORQUE, rtol=1e-9)
    full = found.normal_load[cycle.share > 0.0] / cycle.share[cycle.share > 0.0]
    arms = (found.deflection[..., None] * normal_arms(cycle))[cycle.share > 0.0]
    expected = cycle.compliance[cycle.share > 0.0] * full + cycle.hertz_coefficient * full**0.9
    np.testing.assert_allclose(arms, expected, rtol=1e-9)
    assert by_pairs(found.normal_load, cycle.slices).shape[-1] == cycle.front_pairs


def test_stiffness_is_that_of_the_slices_together():
    cycle = sliced(helical_pair(1.3), ENERGY)
    found = quasi_static(cycle, TORQUE)
    stiffness = np.broadcast_to(cycle.share / cycle.compliance, cycle.compliance.shape)[0]
    # along the pitch tangent: Σ k cos² α cos² β_n
    square = np.cos(np.nan_to_num(cycle.pressure_angle[0])) ** 2
    total = np.sum(stiffness * square / (1.0 + float(cycle.pitch_slope) ** 2 * square), axis=-1)
    np.testing.assert_allclose(total, found.mesh_stiffness[0], rtol=1e-12)


def test_single_pair_is_the_whole_face_at_the_pitch_point():
    pair = helical_pair(0.8)
    assert single_pair(sliced(pair), TORQUE).stiffness == pytest.approx(STIFFNESS, rel=1e-12)
    load = base_force(pair) / math.cos(base_angle(pair))
    assert single_pair(sliced(pair), TORQUE).normal_load == pytest.approx(load, rel=1e-9)
    coarse, fine = (
        single_pair(sliced(pair, replace(ENERGY, hertz="load-dependent"), k), TORQUE) for k in (5, 41)
    )
    assert coarse.stiffness == pytest.approx(fine.stiffness, rel=1e-4)


@pytest.mark.parametrize("foundation", ["sainsot-velex", "ring"])
@pytest.mark.parametrize("helix", [0.2, 0.35, 0.5])
def test_single_pair_softens_with_the_cosine_of_the_helix_angle(helix, foundation):
    """ISO 6336-1, of solid discs: in the transverse plane, per face width, c' = c'_th cos β for one rack.

    Within 3 % above cos β, and below that with c'_th of the virtual numbers of teeth, by which it rises.
    (Held at bores that do not grow with the gears, more wind-up hides this rise.)
    """

    def stiffness(angle):
        drive = helical_pair(1.0, angle).drive
        solid = [body._replace(bore_radius=0.0) for body in (drive.pinion, drive.gear)]
        pair = assemble(involute.FAMILY, drive._replace(pinion=solid[0], gear=solid[1]))
        cycle = sliced(pair, replace(ENERGY, foundation=foundation), 5)
        single = single_pair(cycle, TORQUE).stiffness
        return single * math.cos(base_angle(pair)) ** 2 / float(pair.common_width)

    over_cosine = stiffness(helix) / stiffness(0.02) / math.cos(helix)
    rising = theoretical_stiffness((23.0, 47.0), helix_angle=helix) / theoretical_stiffness((23.0, 47.0))
    assert 1.0 < over_cosine < min(rising, 1.03)


def test_small_helix_is_the_spur_pair():
    """The mean stiffness tends to the spur pair's as the helix angle goes to zero, at one face width."""
    overlaps = np.array([0.08, 0.04, 0.02])
    helix = 0.02
    mesh = replace(ENERGY, foundation_coupling=False)
    change = []
    for overlap in overlaps:
        pair = helical_pair(overlap * 5.0, helix * overlap / overlaps[0])
        spur = assemble(involute.FAMILY, pair.drive._replace(helix_angle=0.0))
        of_spur = tabulate(spur, (STEEL, STEEL), mesh, pair_slots(spur))
        means = []
        for cycle in (sliced(pair, mesh, nodes=4001), of_spur):
            means.append(cycle_mean(cycle, quasi_static(cycle, TORQUE).mesh_stiffness))
        change.append(abs(means[0] / means[1] - 1.0))
    assert change[0] < 2e-3
    assert change[2] < change[0] / 2.0


def load_along_face(cycle) -> np.ndarray:
    """Mean over the phase of the load of each slice, all pairs together."""
    load = quasi_static(cycle, TORQUE).normal_load
    per_slot = cycle_mean(cycle, load)[: cycle.front_slots]
    return per_slot.reshape(-1, cycle.slices).sum(axis=0)


@pytest.mark.parametrize("ratio", [0.4, 0.8, 3.0, 6.0])
def test_misaligned_faces_carry_as_a_uniform_stiffness_does(ratio):
    """K_Hβ = 1 + κ while the whole face touches, then √(4κ); κ from the stiffness of the whole mesh.

    Extrapolated linearly from the last two slices' middles to the edge. What differs is where along the path
    a line meets the end of the face, r sin β_b of b/2.
    """
    pair = helical_pair(4.0, helix=0.2)
    beta, width = base_angle(pair), float(pair.common_width)
    per_width = STIFFNESS * math.cos(beta) / width * float(pair.contact_ratio) * math.cos(beta)
    angle = ratio * 2.0 * base_force(pair) / (per_width * width**2)
    made = Modifications(misalignment=Misalignment(in_plane=angle))
    load = load_along_face(sliced(pair, replace(EVEN, modifications=made), 41, nodes=257))
    share = load / load.mean()
    peak = max(1.5 * share[0] - 0.5 * share[1], 1.5 * share[-1] - 0.5 * share[-2])
    assert peak == pytest.approx(1.0 + ratio if ratio < 1.0 else math.sqrt(4.0 * ratio), rel=0.01)


@pytest.mark.parametrize("overlap", [1.0, 2.0])
def test_loss_of_constant_friction(overlap):
    """P = μ F_n (ω_1 + ω_2) ξ̄, of loads that are even along the lines; of second order."""
    pair = helical_pair(overlap)
    mu, path = 0.05, pair.path
    start, end = pair.r_start, pair.r_end
    mean = (start**2 + end**2) / (2.0 * (end - start))
    normal = base_force(pair) / math.cos(base_angle(pair))
    expected = mu * normal * (1.0 + path.pinion_pitch_radius / path.gear_pitch_radius) * mean
    errors = []
    for slices in (6, 12, 24):
        cycle = sliced(pair, EVEN, slices, nodes=961)
        loss = friction_loss(cycle, quasi_static(cycle, TORQUE).normal_load, mu)
        errors.append(abs(loss / expected - 1.0))
    assert errors[2] < 1e-3
    assert math.log2(errors[0] / errors[2]) / 2.0 > 1.8
    efficiency = mean_efficiency(cycle, TORQUE, mu)
    put_in = TORQUE * path.pinion_pitch_radius / path.gear_pitch_radius
    assert efficiency == pytest.approx(1.0 - expected / (put_in + expected), rel=1e-4)


def test_sliding_turns_over_the_width_of_a_slice():
    cycle = sliced(helical_pair(1.2))
    side = sliding_side(cycle)
    assert np.all(np.abs(side) <= 1.0)
    extent = cycle.slice_width * np.tan(base_angle(helical_pair(1.2)))
    whole = cycle.share > WHOLE
    np.testing.assert_allclose(side[whole], np.clip(2.0 * cycle.signed_distance[whole] / extent, -1.0, 1.0))
    assert np.any((np.abs(side) < 1.0) & whole)


@pytest.mark.parametrize("overlap", [0.7, 1.4])
def test_deflection_converges_with_the_square_of_the_slices_width(overlap):
    pair = helical_pair(overlap)

    def deflection(slices):
        return quasi_static(sliced(pair, ENERGY, slices, nodes=257), TORQUE).deflection[0]

    exact = deflection(320)
    errors = [np.sqrt(np.mean((deflection(k) - exact) ** 2)) for k in (5, 10, 20, 40)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.mean(orders) > 1.8


def test_contacts_of_slices_are_as_long_as_the_lines():
    """With friction: loads by the equilibrium balance the torque of load and friction."""
    cycle = sliced(helical_pair(1.2))
    seen = contacts(cycle, TORQUE, 100.0, coulomb(0.08))
    length = np.sum(cycle.share * seen.face_width, axis=-1)
    np.testing.assert_allclose(length[0], line_length(cycle), rtol=1e-12)
    found = settled(seen, elastic(cycle, TORQUE))
    torque = np.sum(found.normal_load * seen.arms(found.friction_coefficient)[1], axis=-1)
    np.testing.assert_allclose(torque, TORQUE, rtol=1e-9)
    without = quasi_static(cycle, TORQUE).normal_load.sum()
    assert found.normal_load.sum() != pytest.approx(without, rel=1e-5)
