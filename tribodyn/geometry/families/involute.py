"""The involute family: straight path of contact, standard or profile-shifted."""

import math
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, Side, body_of, reference_radius, tip_radius
from tribodyn.geometry.family import Family
from tribodyn.geometry.path import Path, PerContact
from tribodyn.numerics.elementary import cos, namespace, sin, sqrt, tan
from tribodyn.numerics.iteration import newton


class InvolutePath(NamedTuple):
    """Straight path of contact at the working pressure angle; closed forms throughout.

    Parameters
    ----------
    pinion_pitch_radius, gear_pitch_radius : float
        Working pitch radii, m.
    angle : float
        Working pressure angle, rad.
    """

    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    angle: Any

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
    """Pressure angle at which the shifted pair works without backlash, rad.

    inv α_w = inv α + 2 tan α (x1 + x2)/(Z1 + Z2) (ISO 21771, DIN 3960); α itself where x1 + x2 = 0.
    """
    alpha = drive.pressure_angle
    shift = drive.pinion.profile_shift + drive.gear.profile_shift
    teeth = drive.pinion.teeth + drive.gear.teeth
    return inverse_involute(involute_function(alpha) + 2 * tan(alpha) * shift / teeth)


def working_path(drive: Drive) -> Path:
    """Path of contact of the pair at its working centre distance a cos α/cos α_w."""
    working = working_pressure_angle(drive)
    stretch = cos(drive.pressure_angle) / cos(working)
    return InvolutePath(
        reference_radius(drive, "pinion") * stretch, reference_radius(drive, "gear") * stretch, working
    )


def generating_path(drive: Drive, side: Side) -> tuple[Path, Any]:
    """Path of contact of one body with the standard rack, and the rack's shift (m).

    The rack has no pitch radius, the other body's stands in for it and nothing depends on it.
    """
    other: Side = "gear" if side == "pinion" else "pinion"
    path = InvolutePath(reference_radius(drive, side), reference_radius(drive, other), drive.pressure_angle)
    return path, drive.module * body_of(drive, side).profile_shift


def closed_form_contact_ratio(drive: Drive) -> Any:
    """Transverse contact ratio (ISO 21771): length of the line of action between the tip circles / p_b."""
    working = working_pressure_angle(drive)
    stretch = cos(drive.pressure_angle) / cos(working)
    length = 0.0
    for side in ("pinion", "gear"):
        pitch = reference_radius(drive, side) * stretch
        base = pitch * cos(working)
        length = length + sqrt(tip_radius(drive, side) ** 2 - base**2) - pitch * sin(working)
    return length / (math.pi * drive.module * cos(drive.pressure_angle))


def check(drive: Drive) -> None:
    """Refuse a sum of profile shifts for which no working pressure angle exists."""
    alpha = drive.pressure_angle
    teeth = drive.pinion.teeth + drive.gear.teeth
    shift = drive.pinion.profile_shift + drive.gear.profile_shift
    minimum = -(math.tan(alpha) - alpha) * teeth / (2 * math.tan(alpha))
    if shift <= minimum:
        needed = minimum - drive.gear.profile_shift
        raise InputError(
            "drive.pinion.profile_shift",
            drive.pinion.profile_shift,
            "with this sum of profile shifts the gears would be closer than their base circles allow",
            f"use more than {math.ceil(1000.0 * needed) / 1000.0:g}",
        )


FAMILY = Family(
    "involute",
    working_path,
    generating_path,
    True,
    check,
    involute=True,
    about="standard or profile-shifted involute; pressure_angle is the rack's",
)
