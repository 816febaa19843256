"""Slices that hold each other: finite elements' harmonics, lumping, convergence, the number of slices."""

from dataclasses import replace

import numpy as np
import pytest

from tests.support.helical import PAIR, WIDTH, assembly
from tests.support.helical_pairs import ENERGY, STEEL, helical_pair, sliced
from tribodyn.compliance.energy import loaded_tooth, tooth_compliance, under_uneven_load
from tribodyn.compliance.sharing.load_sharing import flexibility
from tribodyn.compliance.sharing.slices import pair_harmonics
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import SIDES, Drive, GearBody
from tribodyn.geometry.families import involute
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    turned_round,
)
from tribodyn.mesh.by_compliance import mesh_cycle_of
from tribodyn.mesh.quasi_static import cycle_mean, quasi_static
from tribodyn.mesh.slices.coupled import couple_slices
from tribodyn.mesh.slices.held import BODIES_LENGTH, TEETH_LENGTH, spread

MATERIALS = (STEEL, STEEL)
TORQUE = 300.0


def coarse_pair():
    """19/60 of module 5 mm on a wide face, with large bores."""
    bodies = (GearBody(z, 0.0, 1.0, 1.25, 0.25, 0.08, bore) for z, bore in ((19.0, 0.012), (60.0, 0.05)))
    return assemble(involute.FAMILY, Drive(0.005, np.radians(20.0), *bodies, helix_angle=0.2))


@pytest.mark.parametrize(
    "pair",
    [
        assembly(PAIR, 0.0, WIDTH),
        pytest.param(helical_pair(2.0), marks=pytest.mark.soak),
        pytest.param(coarse_pair(), marks=pytest.mark.soak),
    ],
    ids=["18/36", "23/47", "19/60"],
)
def test_harmonics_are_those_of_finite_elements(pair):
    """Of spur teeth, for wave lengths from the face's down to one and a half modules."""
    spur = assemble(pair.family, pair.drive._replace(helix_angle=0.0))
    start, end = spur.roll_limits
    geometry = pair_geometry(spur, np.array([[0.6 * start], [0.0], [0.6 * end]]))
    flexible = flexibility(spur, MATERIALS, lead=True, held=True)
    harmonics = pair_harmonics(flexible, geometry, 25)[:, :, 0, 0]
    r = geometry.motion.signed_distance[:, 0]
    teeth = [under_uneven_load(loaded_tooth(spur, side)) for side in SIDES]
    parts = [tooth_compliance(tooth, STEEL, spur.common_width, r) for tooth in teeth]
    bodies = sum(part.foundation for part in parts)
    teeth = sum(part.total for part in parts) - bodies
    wave = np.pi * np.arange(25)[:, None] / flexible.width * spur.drive.module
    model = teeth / (1.0 + (TEETH_LENGTH * wave) ** 2) + bodies / (1.0 + BODIES_LENGTH * wave)
    np.testing.assert_allclose(model / model[0], harmonics / harmonics[0], atol=0.055)
    # a free body is stiffer under an even load alone; a bore counts little under all others
    free = pair_harmonics(flexibility(spur, MATERIALS, lead=True), geometry, 25)[:, :, 0, 0]
    assert np.all(free[0] < 0.9 * harmonics[0])
    np.testing.assert_allclose(free[1:], harmonics[1:], rtol=1e-9)


def test_an_even_load_is_met_by_the_whole_compliance():
    slices = 7
    middle, share = ((np.arange(slices) + 0.5) / slices)[None], np.ones((1, slices))
    falling = 1.0 / (1.0 + 0.3 * np.arange(6 * slices))
    np.testing.assert_allclose(spread(middle, share, (falling,), slices)[0].sum(axis=-1), 1.0, rtol=1e-12)


def test_slices_that_do_not_hold_each_other_meet_their_own_compliance():
    """Also while they touch in part: then over less than the slice's width, at its early end."""
    slices, share = 5, np.array([[0.5, 1.0, 1.0, 0.25, 1.0]])
    middle = (np.arange(slices) + 0.5 - (1.0 - share) / 2.0) / slices
    found = spread(middle, share, (np.ones(6000),), slices)[0][0]
    np.testing.assert_allclose(found, np.diag(1.0 / share[0]), atol=5e-3)


@pytest.mark.parametrize("hertz", ["linear", "load-dependent"])
@pytest.mark.parametrize("crowning", [0.0, 15e-6])
def test_lumped_slices_balance_like_those_that_hold_each_other(hertz, crowning):
    """Lumped at a torque, the table deflects under a little more as that which is lumped there."""
    made = Modifications(pinion=FlankModification(lead=LeadRelief(crowning=crowning)))
    pair, mesh = helical_pair(1.1), replace(ENERGY, hertz=hertz, modifications=made)
    cycle = sliced(pair, mesh, 7, nodes=33)

    def deflection(lumped_at, torque):
        return quasi_static(couple_slices(pair, MATERIALS, mesh, cycle, lumped_at), torque).deflection

    step = 1.0
    tangent = deflection(TORQUE, TORQUE + step) - deflection(TORQUE, TORQUE)
    exact = deflection(TORQUE + step, TORQUE + step) - deflection(TORQUE, TORQUE)
    np.testing.assert_allclose(tangent, exact, rtol=3e-2)
    assert np.mean(tangent) == pytest.approx(np.mean(exact), rel=3e-3)


def test_deflection_of_slices_that_hold_each_other_converges():
    pair = helical_pair(1.1)

    def state(slices):
        cycle = couple_slices(pair, MATERIALS, ENERGY, sliced(pair, ENERGY, slices, nodes=65), TORQUE)
        return quasi_static(cycle, TORQUE).deflection[0]

    exact = state(31)
    errors = [float(np.sqrt(np.mean((state(k) - exact) ** 2))) for k in (5, 9, 15)]
    assert errors[0] < 2e-3 * np.mean(exact)
    assert errors[2] < errors[0] / 3.0


def test_slices_open_by_the_bias_of_their_places():
    """Corners of the field of contact: early or late in roll, at either end of the face."""
    pair, slices = helical_pair(1.1), 9
    made = Modifications(pinion=FlankModification(bias=10e-6))
    cycle = sliced(pair, replace(ENERGY, modifications=made), slices, nodes=65)
    gap = (cycle.gap - sliced(pair, ENERGY, slices, nodes=65).gap)[0]
    place = np.broadcast_to(cycle.signed_distance, cycle.gap.shape)[0]
    length, width = float(pair.r_end - pair.r_start), float(pair.common_width)
    late, z = (2.0 * place - pair.r_start - pair.r_end) / length, 2.0 * cycle.face_place[0] / width
    # the mean of a product that is linear in both along the part that touches
    along = cycle.share[0] * width / slices
    fall = cycle.pitch_slope * np.cos(cycle.pressure_angle[0])
    late_by_z = late * z - (2.0 * fall * along / length) * (2.0 * along / width) / 12.0
    touching = np.broadcast_to(cycle.share, cycle.gap.shape)[0] > 0.0
    np.testing.assert_allclose(gap[touching], (10e-6 * late_by_z)[touching], atol=1e-12)


def test_a_left_hand_pinion_is_a_right_hand_one_from_its_other_end():
    pair, slices = helical_pair(1.1), 9
    left = assemble(pair.family, pair.drive._replace(helix_angle=-pair.drive.helix_angle))
    lead = LeadRelief(start=4e-6, end=9e-6)
    made = Modifications(FlankModification(lead=lead, bias=10e-6), misalignment=Misalignment(1e-4, 2e-4))
    found = sliced(left, replace(ENERGY, modifications=made), slices, nodes=65)
    seen = sliced(pair, replace(ENERGY, modifications=turned_round(made)), slices, nodes=65)
    np.testing.assert_allclose(found.gap, seen.gap, atol=1e-15)


def test_back_flanks_keep_their_compliance():
    pair, mesh = helical_pair(0.8), replace(ENERGY, backlash=5e-5)
    cycle = mesh_cycle_of(pair, MATERIALS, replace(mesh, slices=5), TORQUE, back=True)
    apart = mesh_cycle_of(pair, MATERIALS, replace(mesh, slices=5, slice_coupling=False), TORQUE, back=True)
    fronts = cycle.front_slots
    nodes = np.interp(cycle.phase[0], apart.phase[0], np.arange(apart.phase.shape[1]))
    same = np.isclose(nodes, np.round(nodes))
    at = np.round(nodes[same]).astype(int)
    inside = apart.share[0, at, fronts:] > 0.0
    found, expected = cycle.compliance[0, same, fronts:], apart.compliance[0, at, fronts:]
    np.testing.assert_allclose(found[inside], expected[inside], rtol=3e-3)
    assert np.max(np.abs(cycle.compliance[0, same, :fronts] / apart.compliance[0, at, :fronts] - 1.0)) > 0.1
    means = [cycle_mean(c, quasi_static(c, TORQUE).mesh_stiffness) for c in (cycle, apart)]
    assert means[0] == pytest.approx(means[1], rel=0.1)
