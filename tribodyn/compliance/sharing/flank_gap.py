"""What modifications, errors and misalignment leave open between two unloaded flanks.

Every part is a distance along the common normal, positive where material is missing, at the point of each
flank that touches: on the path of contact both flanks' points are the path's; beyond its ends the corner of
the tip stays where it is and the mate's point moves up the flank. First order in the modifications: where the
nominal flanks touch, the modified ones are taken to be nearest. A relief's slope e' along the flank moves the
nearest point and makes the gap smaller by e'² ρ/2 (ρ the equivalent radius): with module 3 mm by 6 % of a
linear relief of 20 µm over 2 mm, by 2 % over 4 mm (test_flank_gap).
"""

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry, pair_geometry
from tribodyn.geometry.drive import SIDES, Side, body_of, tip_radius
from tribodyn.geometry.flank_form import along_face, at_the_end, over_profile
from tribodyn.geometry.helix import normal_slope
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    broken_flank_rules,
)
from tribodyn.geometry.path import PerContact
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.numerics.shapes import Array, Float, Int

#: Maximum tip relief, as a share of the tip's thickness: both flanks together then leave half of it.
MAXIMUM_TIP_SHARE = 0.25
#: Maximum of all other modifications, in modules. What is more changes the tooth, not its flank.
MAXIMUM_SHARE = 0.1


def flank_gap(
    assembly: Assembly,
    modifications: Modifications,
    geometry: PairGeometry,
    face_position: Float[Array, " slice"],
) -> Float[Array, "*pair slice"]:
    """Gap (…, slice) beside that of the corners, m; pitch errors apart (`pitch_gap`).

    The places along the axis (slice,), m, are from the middle of the faces, which stand symmetrically.
    """
    profile = profile_gap(assembly, modifications, geometry)
    along = misalignment_gap(assembly, modifications.misalignment, geometry, face_position)
    places = geometry.pinion_place[..., None], geometry.gear_place[..., None]
    twist = bias_gap(assembly, modifications, places, face_position)
    return profile[..., None] + lead_gap(assembly, modifications, face_position) + twist + along


def oblique_gap(
    assembly: Assembly,
    modifications: Modifications,
    geometry: PairGeometry,
    face_position: Float[Array, " slice"],
    slope: float,
    side: int = 1,
) -> Float[Array, "*pair slice"]:
    """`flank_gap` of slices each with its own geometry (…, slice), along the normal of helical flanks, m.

    A gear turned by γ in the plane of action moves by z γ along the line of action and by −r γ along the
    axis: by γ (z cos β_n ∓ r sin β_n) along the normal of driving (`side` 1) and back flanks (−1). `slope` is
    tan β_w.
    """
    motion, (within, across) = geometry.motion, modifications.misalignment
    leaning = normal_slope(slope, motion.pressure_angle)
    turned = motion.pressure_angle - float(assembly.path.pressure_angle(0.0))
    angle = within * np.cos(turned) + across * np.sin(turned)
    opened = angle * (face_position - side * motion.signed_distance * leaning) / np.hypot(1.0, leaning)
    profile = profile_gap(assembly, modifications, geometry)
    twist = bias_gap(assembly, modifications, (geometry.pinion_place, geometry.gear_place), face_position)
    return profile + lead_gap(assembly, modifications, face_position) + twist + opened


def profile_gap(
    assembly: Assembly, modifications: Modifications, geometry: PairGeometry
) -> Float[Array, "*pair"]:
    """Relief of tips and roots and error of the profile of both flanks, m; shaped like the geometry."""
    total = np.zeros_like(geometry.gap)
    for side, place in zip(SIDES, (geometry.pinion_place, geometry.gear_place), strict=True):
        total = total + over_profile(assembly, side, getattr(modifications, side), place)
    return total


def lead_gap(
    assembly: Assembly, modifications: Modifications, face_position: Float[Array, " slice"]
) -> Float[Array, " slice"]:
    """Relief of both flanks along the face (slice,), m; each over its own gear's face width."""
    total = np.zeros_like(face_position)
    for side in SIDES:
        width = float(body_of(assembly.drive, side).face_width)
        total = total + along_face(getattr(modifications, side).lead, width, face_position)
    return total


def bias_gap(
    assembly: Assembly,
    modifications: Modifications,
    places: tuple[PerContact, PerContact],
    face_position: Float[Array, " slice"],
) -> Float[Array, "*pair slice"]:
    """What the twist of both flanks leaves open, m, at places (…, slice) along the line of action, m.

    Over the whole active path and each gear's own face width; the gear's tip is where the path begins.
    """
    total = 0.0 * face_position
    for side, place in zip(SIDES, places, strict=True):
        across = face_position / (float(body_of(assembly.drive, side).face_width) / 2.0)
        total = total + at_the_end(assembly, side, getattr(modifications, side), place) * across
    return total


def misalignment_gap(
    assembly: Assembly,
    misalignment: Misalignment,
    geometry: PairGeometry,
    face_position: Float[Array, " slice"],
) -> Float[Array, "*pair slice"]:
    """Gap (…, slice) that inclined axes leave, m; 0 in the middle of the face, negative on its nearer half.

    At z the gear stands off the pinion by d = z γ_in along the line of action of the pitch point and by
    s = z γ_out across it. At a contact whose normal is turned from there by β the distance along the normal
    is d cos β + s sin β, for an involute d. Across the normal the shift s' = s cos β − d sin β moves flanks
    of the radii ρ₁, ρ₂, as two circles, apart by √((ρ₁ + ρ₂)² + s'²) − (ρ₁ + ρ₂): of second order,
    nanometres, because spur flanks are straight along the axis.
    """
    motion = geometry.motion
    turned = (motion.pressure_angle - float(assembly.path.pressure_angle(0.0)))[..., None]
    within, across = misalignment.in_plane * face_position, misalignment.out_of_plane * face_position
    shift = across * np.cos(turned) - within * np.sin(turned)
    curvature = motion.pinion_curvature * motion.gear_curvature / motion.relative_curvature
    bend = shift * curvature[..., None]
    return within * np.cos(turned) + across * np.sin(turned) + shift * bend / (1.0 + np.hypot(1.0, bend))


def pitch_gap(modifications: Modifications, tooth: Int[Array, "*pair"]) -> Float[Array, "*pair"]:
    """Pitch errors of both flanks, m, of pairs that are counted: pair n joins tooth n of both gears.

    Numbers increase in the order in which pairs enter; they are taken modulo the number of errors.
    """
    total = np.zeros(np.shape(tooth))
    for side in SIDES:
        errors = getattr(modifications, side).pitch_error
        if len(errors):
            total = total + np.asarray(errors, dtype=float)[np.asarray(tooth) % len(errors)]
    return total


def lead_amounts(lead: LeadRelief) -> dict[str, float]:
    """What is missing along the face, m, by the keys of a scenario; of a slope its magnitude."""
    return {
        "lead_relief_start": lead.start,
        "lead_relief_end": lead.end,
        "crowning": lead.crowning,
        "helix_slope": abs(lead.slope),
    }


def maximum_along_lead(assembly: Assembly, modifications: Modifications) -> tuple[str, str]:
    """Key and value of what opens the flanks most along the face: an angle of the axes, or a relief."""
    width = min(float(body_of(assembly.drive, side).face_width) for side in SIDES)
    ends, geometry = np.array([-width, width]) / 2.0, pair_geometry(assembly, np.array(assembly.roll_limits))
    openings = []
    for name, angle in modifications.misalignment._asdict().items():
        opened = np.max(np.abs(misalignment_gap(assembly, Misalignment(**{name: angle}), geometry, ends)))
        openings.append((opened, f"mesh.misalignment.{name}", f"{np.degrees(angle) * 60:.6g} arcmin"))
    for side in SIDES:
        for name, amount in lead_amounts(getattr(modifications, side).lead).items():
            openings.append((amount, f"drive.{side}.modification.{name}", f"{amount * 1e6:.6g} um"))
        bias = getattr(modifications, side).bias
        openings.append((abs(bias), f"drive.{side}.modification.bias", f"{bias * 1e6:.6g} um"))
    return max(openings)[1:]


def relief_rolls(assembly: Assembly, modifications: Modifications) -> list[float]:
    """Pinion angles (rad from the pitch point) on the path where a linear relief begins: kinks of the gap."""
    start, end = assembly.r_start, assembly.r_end
    first = modifications.pinion.root, modifications.gear.tip
    last = modifications.pinion.tip, modifications.gear.root
    places = [start + relief.length for relief in first if relief.amount and relief.exponent < 2.0]
    places += [end - relief.length for relief in last if relief.amount and relief.exponent < 2.0]
    return [float(assembly.path.rotation(place)) for place in places if start < place < end]


def check_modifications(assembly: Assembly, modifications: Modifications) -> None:
    """Refuse reliefs that are no longer reliefs, and errors that are not one per tooth.

    Raises InputError if a relief is longer than the active path or deeper than a share of the tooth, or
    negative; and for the rules that hold for every shape of teeth (`broken_flank_rules`).
    """
    for side in SIDES:
        _check_flank(assembly, getattr(modifications, side), side)


def _check_flank(assembly: Assembly, flank: FlankModification, side: Side) -> None:
    key = f"drive.{side}.modification."
    module = float(assembly.drive.module)
    body = body_of(assembly.drive, side)
    for broken in broken_flank_rules(side, flank, round(float(body.teeth)), float(body.face_width)):
        raise broken
    tip = float(tip_radius(assembly.drive, side))
    thickness = 2.0 * tip * float(thickness_half_angle(assembly.tooth(side), tip))
    maximum = MAXIMUM_SHARE * module
    deepest = min(maximum, MAXIMUM_TIP_SHARE * thickness)
    for name, relief, most in (("tip_relief", flank.tip, deepest), ("root_relief", flank.root, maximum)):
        _require(key + name, relief.amount, most, "deepest relief of this tooth")
        if relief.amount:
            path = assembly.r_end - assembly.r_start
            _require(key + name + "_length", relief.length, path, "path of contact", above=True)
    amounts = lead_amounts(flank.lead) | {"bias": abs(flank.bias)}
    if flank.profile_error is not None:
        amounts["profile_error"] = float(np.max(np.abs(flank.profile_error[1])))
    if len(flank.pitch_error):
        amounts["pitch_errors"] = float(np.max(np.abs(flank.pitch_error)))
    for name, amount in amounts.items():
        _require(key + name, amount, maximum, "tenth of the module")


def _require(key: str, value: float, highest: float, name: str, above: bool = False) -> None:
    if not 0.0 <= value <= highest or (above and value <= 0.0):
        raise InputError(
            key,
            f"{value * 1e6:.6g} um",
            f"must be {'more than' if above else 'at least'} 0 and at most {highest * 1e6:.4g} um, "
            f"the {name}",
            "give a length in between",
        )
