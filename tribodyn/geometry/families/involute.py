"""The involute family: straight path of contact, standard or profile-shifted."""

import math
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, Side, body_of, reference_radii, reference_radius
from tribodyn.geometry.families import Family
from tribodyn.geometry.helix import normal_section
from tribodyn.geometry.path import Path, PerContact
from tribodyn.numerics.elementary import arctan2, cos, maximum, namespace, sin, sqrt, tan
from tribodyn.numerics.iteration import newton

#: Overlap in modules that is rounding of a tight mesh's centre distance.
_ROUNDING = 1e-9


class InvolutePath(NamedTuple):
    """Straight path of contact at the working pressure angle; closed forms throughout."""

    #: pinion_pitch_radius, gear_pitch_radius: working pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    angle: Any  # working pressure angle, rad

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle, the same everywhere, rad."""
        return self.angle + 0.0 * r

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Zero, rad/m."""
        return 0.0 * r

    def rotation(self, r: PerContact) -> PerContact:
        """Pinion angle r/(base radius), rad."""
        return r / (self.pinion_pitch_radius * cos(self.angle))

    def signed_distance(self, rotation: PerContact) -> PerContact:
        """Signed distance, m: φ × base radius."""
        return rotation * (self.pinion_pitch_radius * cos(self.angle))


def involute_function(angle: PerContact) -> PerContact:
    """Evaluate the involute function inv α = tan α − α, rad."""
    return tan(angle) - angle


def inverse_involute(value: PerContact) -> PerContact:
    """Solve for the angle α (rad, 0 < α < 1.2) with inv α = `value` > 0, to rounding."""
    xp = namespace(value)
    value = xp.asarray(value)
    root = value ** (1 / 3)
    # Inverse of the power series tan α − α = α³/3 + 2α⁵/15 + …
    start = 3 ** (1 / 3) * root - 0.4 * value
    return newton(lambda a, inv: a - (tan(a) - a - inv) / tan(a) ** 2, start, 6, value)


def working_pressure_angle(drive: Drive) -> Any:
    """Pressure angle at which the pair works, rad: of its centre distance, or without backlash.

    cos α_w = a_0 cos α/a with the reference centre distance a_0 = m (Z1 + Z2)/2 (ISO 21771); without one, of
    teeth of nominal thickness, inv α_w = inv α + 2 tan α (x1 + x2)/(Z1 + Z2) (DIN 3960).
    """
    if drive.centre_distance is None:
        alpha, teeth = drive.pressure_angle, drive.pinion.teeth + drive.gear.teeth
        shift = drive.pinion.profile_shift + drive.gear.profile_shift
        return inverse_involute(involute_function(alpha) + 2 * tan(alpha) * shift / teeth)
    cosine = sum(reference_radii(drive)) * cos(drive.pressure_angle) / drive.centre_distance
    return arctan2(sqrt(maximum(1.0 - cosine**2, 0.0)), cosine)  # closer than the base circles: refused


def working_path(drive: Drive) -> Path:
    """Path of contact of the pair at its working centre distance a cos α/cos α_w."""
    working = working_pressure_angle(drive)
    stretch = cos(drive.pressure_angle) / cos(working)
    r_p, r_g = reference_radii(drive)
    return InvolutePath(r_p * stretch, r_g * stretch, working)


def generating_path(drive: Drive, side: Side) -> tuple[Path, Any]:
    """Path of contact of one body with the standard rack, and the rack's shift (m).

    The rack has no pitch radius, the other body's stands in for it and nothing depends on it. The shift
    leaves the tooth its thickness: x_E m = x m + A_sn/(2 tan α) (ISO 21771).
    """
    other: Side = "gear" if side == "pinion" else "pinion"
    path = InvolutePath(reference_radius(drive, side), reference_radius(drive, other), drive.pressure_angle)
    body = body_of(drive, side)
    shift = drive.module * body.profile_shift + body.thickness_allowance / (2 * tan(drive.pressure_angle))
    return path, shift


def cutter_path(drive: Drive, side: Side) -> Path:
    """Path of contact of one body with its pinion-type cutter, which mesh without backlash.

    inv α_w0 = inv α + 2 tan α (x_0 + x_E)/(z_0 + z) with the shift x_E that leaves the tooth its thickness;
    z < 0 of an internal gear (ISO 21771).
    """
    path, shift = generating_path(drive, side)
    body, alpha = body_of(drive, side), drive.pressure_angle
    shifts = drive.module * body.cutter_shift + shift
    teeth = drive.module * (body.cutter_teeth + body.teeth)
    working = inverse_involute(involute_function(alpha) + 2 * tan(alpha) * shifts / teeth)
    stretch = cos(alpha) / cos(working)
    cutter = drive.module * body.cutter_teeth / 2
    return InvolutePath(path.pinion_pitch_radius * stretch, cutter * stretch, working)


def normal_backlash(drive: Drive) -> Any:
    """Distance j_bn between the back flanks along their line of action, m; negative where teeth overlap.

    Base pitch less both base thicknesses, at the working pressure angle (ISO 21771):
    j_bn = m cos α [(z1 + z2)(inv α_w − inv α) − 2 (x1 + x2) tan α] − (A_sn1 + A_sn2) cos α.
    """
    alpha = drive.pressure_angle
    shift = drive.pinion.profile_shift + drive.gear.profile_shift
    teeth = drive.pinion.teeth + drive.gear.teeth
    opened = involute_function(working_pressure_angle(drive)) - involute_function(alpha)
    allowances = drive.pinion.thickness_allowance + drive.gear.thickness_allowance
    return cos(alpha) * (drive.module * (teeth * opened - 2 * shift * tan(alpha)) - allowances)


def tight_centre_distance(drive: Drive) -> Any:
    """Centre distance at which the teeth, of the thickness that they have, mesh without backlash, m."""
    alpha = drive.pressure_angle
    shift = 2 * drive.module * (drive.pinion.profile_shift + drive.gear.profile_shift) * tan(alpha)
    thicker = shift + drive.pinion.thickness_allowance + drive.gear.thickness_allowance
    reference = sum(reference_radii(drive))
    tight = inverse_involute(involute_function(alpha) + thicker / (2 * reference))
    return reference * cos(alpha) / cos(tight)


def shift_sensitivity(drive: Drive) -> Any:
    """Change of `tight_centre_distance` with the sum of profile shifts, m: m sin α/sin α_t.

    a_t = a_0 cos α/cos α_t gives da_t = a_t tan α_t dα_t, and inv α_t gives tan² α_t dα_t = m tan α dΣx/a_0.
    """
    alpha = drive.pressure_angle
    cosine = sum(reference_radii(drive)) * cos(alpha) / tight_centre_distance(drive)
    return drive.module * sin(alpha) / sqrt(1.0 - cosine**2)


def overlap(drive: Drive) -> bool:
    """Whether the teeth overlap at the centre distance that is given, by more than the rounding of floats."""
    return drive.centre_distance is not None and not normal_backlash(drive) >= -_ROUNDING * drive.module


def check(drive: Drive) -> None:
    """Refuse shifts without a working pressure angle, and a centre distance at which teeth overlap."""
    alpha = drive.pressure_angle
    teeth = drive.pinion.teeth + drive.gear.teeth
    shift = drive.pinion.profile_shift + drive.gear.profile_shift
    minimum = -(math.tan(alpha) - alpha) * teeth / (2 * math.tan(alpha))
    if (shift - minimum) / teeth <= 0:
        written = normal_section(drive)
        needed = minimum / math.cos(drive.helix_angle) - written.gear.profile_shift
        more, fewer = math.ceil(1000.0 * needed) / 1000.0, math.floor(1000.0 * needed) / 1000.0
        raise InputError(
            "drive.pinion.profile_shift",
            written.pinion.profile_shift,
            "with this sum of profile shifts the gears would be closer than their base circles allow",
            f"use more than {more:g}" if teeth > 0 else f"use less than {fewer:g}",
        )
    if not overlap(drive):
        return
    tight = float(tight_centre_distance(drive))
    if tight < 0:  # the key is the distance without its sign
        raise InputError(
            "drive.centre_distance",
            f"{-1e3 * drive.centre_distance:.7g} mm",
            f"the teeth overlap: they mesh without backlash at {-1e3 * tight:.4f} mm",
            f"use at most {math.floor(-1e7 * tight) / 1e4:.4f} mm, less profile shift or thinner teeth",
        )
    raise InputError(
        "drive.centre_distance",
        f"{1e3 * drive.centre_distance:.7g} mm",
        f"the teeth overlap: they mesh without backlash at {1e3 * tight:.4f} mm",
        f"use at least {math.ceil(1e7 * tight) / 1e4:.4f} mm, less profile shift or thinner teeth",
    )


FAMILY = Family(
    "involute",
    working_path,
    generating_path,
    True,
    check,
    cutter_path=cutter_path,
    involute=True,
    about="standard or profile-shifted involute; pressure_angle is the rack's",
)
