"""Load contact of helical pairs: limits, balance, hands, convergence, a uniform foundation in closed form."""

import numpy as np
import pytest

from tests.support.faces_in_slices import STEEL
from tests.support.helical import PAIR, WIDTH, assembly, elastic
from tests.support.soak_parameters import all_in_soak
from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.compliance.iso6336 import MEASURED_CORRECTION, pair_of, reference_stiffness
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import roll_through
from tribodyn.compliance.sharing.oblique import oblique_compliance
from tribodyn.compliance.sharing.section import oblique_faces
from tribodyn.compliance.sharing.slices import PairFlexibility, slice_compliance
from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.helix import base_helix_angle, overlap_ratio
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
    turned_round,
)

TORQUE = 300.0
MODIFIED = Modifications(
    FlankModification(tip=Relief(8e-6, 3e-3), lead=LeadRelief(4e-6, 9e-6, 8e-3)),
    FlankModification(lead=LeadRelief(crowning=3e-6)),
    Misalignment(2e-4, 1e-4),
)


def test_as_the_helix_vanishes_the_spur_pair_is_left():
    """Loads, error, stiffness and root stress, in proportion to the angle."""
    flexible = elastic(PAIR, 0.0, WIDTH)
    spur = roll_through(LoadedFlanks(flexible, MODIFIED, 7), TORQUE, 12)
    for angle, allowed in ((1e-5, 1e-6), (1e-3, 1e-4)):
        nearly = flexible._replace(assembly=assembly(PAIR, angle, WIDTH))
        found = roll_through(LoadedFlanks(nearly, MODIFIED, 7), TORQUE, 12)
        np.testing.assert_allclose(found.deflection, spur.deflection, rtol=allowed)
        np.testing.assert_allclose(found.mesh_stiffness, spur.mesh_stiffness, rtol=10 * allowed)
        for name in ("normal_load", "line_load", "pressure", "root_tension", "root_compression"):
            whole = getattr(spur, name)
            scale = np.max(np.abs(whole))
            np.testing.assert_allclose(getattr(found, name), whole, atol=30 * allowed * scale)


def test_slices_touched_at_one_radius_are_those_of_a_spur_tooth():
    spur = elastic(PAIR, 0.0, WIDTH)
    roll = np.array([[0.25, -0.1], [0.31, -0.04]])
    expected = slice_compliance(spur, pair_geometry(spur.assembly, roll), 9)
    straight = oblique_faces(spur.assembly, np.repeat(roll[..., None], 9, axis=-1))
    found = oblique_compliance(spur, straight.at(slice(None)))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12 * np.max(expected))


def test_loads_at_two_radii_do_the_same_work_and_no_load_gains_any():
    pair = elastic(PAIR, 20.0, WIDTH)
    flanks = LoadedFlanks(pair, slices=9)
    roll = np.array([[0.3, -0.05, -0.4]])
    faces = oblique_faces(pair.assembly, flanks.rolls(roll))
    matrix = oblique_compliance(pair, faces.at(slice(None))).reshape(27, 27)
    np.testing.assert_allclose(matrix, matrix.T, rtol=1e-9)
    assert np.min(np.linalg.eigvalsh(matrix)) > 0.0


@pytest.mark.parametrize("friction", [0.0, 0.06])
def test_the_loads_carry_the_torque(friction):
    """Σ F (r_g cos α cos β_b ± μ L): arms from the base circle, the helix's slope there, and the distance."""
    flanks = LoadedFlanks(elastic(PAIR, 20.0, WIDTH), MODIFIED, 9)
    loaded = roll_through(flanks, TORQUE, 10, friction_coefficient=friction)
    drive = flanks.flexible.assembly.drive
    base = drive.module * 36 / 2 * np.cos(drive.pressure_angle)
    seen = flanks.contacts(loaded.roll)
    load = loaded.line_load * WIDTH / 9 / np.cos(base_helix_angle(drive))
    r = seen.geometry.motion.signed_distance
    along = base * np.tan(drive.pressure_angle) - r  # no shift: α_w = α_t
    torque = np.sum(
        load * (base * np.cos(base_helix_angle(drive)) + np.sign(r) * friction * along), axis=(1, 2)
    )
    np.testing.assert_allclose(torque, TORQUE, rtol=1e-9)
    np.testing.assert_allclose(np.sum(load, axis=-1), loaded.normal_load, rtol=1e-12)


def test_the_other_hand_is_the_mirror_image():
    right = roll_through(LoadedFlanks(elastic(PAIR, 20.0, WIDTH), MODIFIED, 9), TORQUE, 8)
    left = roll_through(LoadedFlanks(elastic(PAIR, -20.0, WIDTH), turned_round(MODIFIED), 9), TORQUE, 8)
    np.testing.assert_allclose(left.deflection, right.deflection, rtol=1e-10)
    np.testing.assert_allclose(
        left.line_load[..., ::-1], right.line_load, atol=1e-7 * np.max(right.line_load)
    )


def test_a_whole_overlap_leaves_the_stiffness_nearly_constant():
    """ε_β = 1: the contact lines' length is constant; corners and the tooth's varying stiffness remain."""
    flexible = elastic(PAIR, 20.0, WIDTH)
    assert overlap_ratio(flexible.assembly) == pytest.approx(1.0)
    helical = roll_through(LoadedFlanks(flexible, slices=31), TORQUE, 24)
    spur = roll_through(LoadedFlanks(elastic(PAIR, 0.0, WIDTH)), TORQUE, 24)
    assert np.ptp(spur.mesh_stiffness) > 0.2 * np.mean(spur.mesh_stiffness)
    assert helical.peak_to_peak < 0.1 * spur.peak_to_peak
    assert np.ptp(helical.mesh_stiffness) < 0.05 * np.mean(helical.mesh_stiffness)


def test_results_converge_in_the_slices():
    """The error faster than to first order; loads of pairs by the slices that just touch.

    Over the whole deflection, against the bores.
    """
    flexible = elastic(PAIR, 20.0, WIDTH, held=True)
    found = [roll_through(LoadedFlanks(flexible, MODIFIED, slices), TORQUE, 16) for slices in (7, 15, 31)]
    for name, order, left in (
        ("deflection", 1.5, 5e-3),
        ("normal_load", 1.0, 0.02),
        ("mesh_stiffness", 1.0, 0.02),
    ):
        coarse, middle, fine = (getattr(loaded, name) for loaded in found)
        far, near = (np.max(np.abs(values - fine)) / np.max(fine) for values in (coarse, middle))
        assert near < left
        assert far / near > (15 / 7) ** order


def test_misalignment_of_a_uniform_foundation():
    """K_Hβ = 1 + κ up to κ = 1, then √(4κ), κ = c γ b²/(2 F_bt), c = k' ε_α cos β_b (mean over the cycle)."""
    pair = assembly((24, 36), 20.0, 36e-3)
    softness, radius = 2000.0, np.linspace(30e-3, 80e-3, 5)
    inside = np.full((2, 5), softness)
    gear = GearCompliance(radius, inside, np.zeros((5, 5, 5)), 0.75e-3)
    flexible = PairFlexibility(pair, (STEEL, STEEL), 36e-3, (gear, gear))
    base = float(base_helix_angle(pair.drive))
    # E/λ of both gears per length of the tooth, b/cos β, as of the line of contact, b/cos β_b
    per_length = STEEL.youngs_modulus / (2.0 * softness) * np.cos(base) / np.cos(pair.drive.helix_angle)
    stiffness = per_length * float(pair.contact_ratio) * np.cos(base)
    arm = float(pair.path.gear_pitch_radius) * np.cos(float(pair.path.pressure_angle(0.0)))
    torque = 0.02
    for kappa in (0.5, 1.0, 4.0):
        angle = kappa * 2.0 * torque / arm / (stiffness * (36e-3) ** 2)
        modified = Modifications(misalignment=Misalignment(angle))
        phase = np.arange(40)[:, None] / 40 + np.arange(3, -4, -1)
        shared = LoadedFlanks(flexible, modified, 41, coupled=False).share(pair.pitch_angle * phase, torque)
        over_face = np.mean(np.sum(shared.slice_load, axis=1), axis=0)
        # the slices' middles do not reach the edge, where the load is greatest: extended to it
        edge = over_face[0] + 0.5 * (over_face[0] - over_face[1])
        expected = 1.0 + kappa if kappa <= 1.0 else np.sqrt(4.0 * kappa)
        assert edge / np.mean(over_face) == pytest.approx(expected, rel=0.03)


#: Teeth, helix angle, width, module, shifts, dedendum, bore; the first is that of the other tests.
DRIVES = {
    "whole overlap": (PAIR, 20.0, WIDTH, 3e-3, (0.0, 0.0), 1.25, 0.3),
    "ISO/TR 6336-30, 1": ((17, 103), 15.8, 100e-3, 8e-3, (0.145, 0.0), 1.4, 0.3),
    "half turned": ((24, 36), 20.0, 36e-3, 3e-3, (0.0, 0.0), 1.25, 0.3),
    "steep": ((24, 36), 30.0, 36e-3, 3e-3, (0.0, 0.0), 1.25, 0.3),
}


def against_the_standard(teeth, helix, width, *rest):
    """c' and c_γα of the finite elements over those of ISO 6336-1 at 300 N/mm."""
    flexible = elastic(teeth, helix, width, *rest)
    pair, path = flexible.assembly, flexible.assembly.path
    torque = 300e3 * width * float(pair.drive.module) * teeth[1] / 2.0
    across, base = np.cos(float(path.pressure_angle(0.0))), np.cos(float(base_helix_angle(pair.drive)))
    load = torque / (float(path.gear_pitch_radius) * across * base)
    standard = reference_stiffness(pair_of(pair, flexible.materials, load))
    alone = LoadedFlanks(flexible).share(np.zeros((1, 1)), torque)
    single = load * base / (alone.deflection[0] * across) / width
    loaded = roll_through(LoadedFlanks(flexible, slices=15 if helix else 1), torque, 24)
    mesh = np.mean(loaded.mesh_stiffness) / across**2 / width
    return single / standard.single_pair, mesh / standard.mesh


@pytest.mark.parametrize("name", all_in_soak(DRIVES, ("whole overlap",)))
def test_the_helix_changes_the_stiffness_as_the_standard_has_it(name):
    """c' and c_γα of helical over straight teeth, within 3 and 8 %.

    Against the values themselves: one pair on bodies that are free is as stiff as the theory for solid discs,
    c'_th, within a tenth, and c' is 0.8 of that; free bodies hardly couple pairs, which c_γα adds up.
    """
    teeth, helix, *rest = DRIVES[name]
    single, mesh = against_the_standard(teeth, helix, *rest)
    single_straight, mesh_straight = against_the_standard(teeth, 0.0, *rest)
    assert single == pytest.approx(single_straight, rel=0.03)
    assert mesh == pytest.approx(mesh_straight, rel=0.08)
    assert single * MEASURED_CORRECTION == pytest.approx(1.0, abs=0.1)
    assert mesh / single == pytest.approx(1.0, abs=0.1)


def test_a_helical_face_in_one_piece_is_refused():
    with pytest.raises(InputError, match=r"mesh\.slices"):
        roll_through(LoadedFlanks(elastic(PAIR, 20.0, WIDTH)), TORQUE, 8)
