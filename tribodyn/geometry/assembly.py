"""A drive put together, and the margins by which it can be made and run."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from tribodyn.geometry.drive import SIDES, Drive, Side, tip_circle_radius, tip_radius
from tribodyn.geometry.families import Family
from tribodyn.geometry.path import (
    Path,
    contact_limits,
    contact_ratio,
    distance_at_radius,
    kinematics,
    radius,
    seen_from,
)
from tribodyn.geometry.tooth import Tooth, cut_tooth, fillet_point, polar, thickness_half_angle
from tribodyn.numerics.elementary import absolute, as_float, cos, maximum, minimum, namespace, smallest, sqrt

_SAMPLES = 400


@dataclass(frozen=True)
class Assembly:
    """Path, teeth and contact limits of a drive, each worked out once, when it is first needed."""

    family: Family
    drive: Drive  # its numbers may be traced; lengths and angles are then tracers too

    @cached_property
    def path(self) -> Path:
        """Working path of contact."""
        return self.family.working_path(self.drive)

    @cached_property
    def pinion(self) -> Tooth:
        """Tooth of the pinion, as cut."""
        return cut_tooth(self.family, self.drive, "pinion")

    @cached_property
    def gear(self) -> Tooth:
        """Tooth of the gear, as cut."""
        return cut_tooth(self.family, self.drive, "gear")

    @cached_property
    def tip_limits(self) -> tuple[Any, Any]:
        """Signed distances, m, at which the tip circles cut the path; NaN where they do not reach it."""
        return _plain(contact_limits(self.path, *(tip_radius(self.drive, side) for side in SIDES)))

    @cached_property
    def limits(self) -> tuple[Any, Any]:
        """Signed distances r_start and r_end of first and last contact, m; NaN where there is no path.

        Where the mate's tip touches a flank, or where an undercut flank begins above that.
        """
        start, end = self.tip_limits
        return _plain((_above_undercut(self, "pinion", start), -_above_undercut(self, "gear", -end)))

    @property
    def r_start(self) -> Any:
        """Signed distance of the first contact, m; < 0 unless the pitch point lies before the path."""
        return self.limits[0]

    @property
    def r_end(self) -> Any:
        """Signed distance of the last contact, m; > 0 unless the pitch point lies behind the path."""
        return self.limits[1]

    @cached_property
    def roll_limits(self) -> tuple[Any, Any]:
        """Pinion angles at which the path of contact begins and ends, rad from the pitch point."""
        return _plain(self.path.rotation(limit) for limit in self.limits)

    @cached_property
    def contact_ratio(self) -> Any:
        """Transverse contact ratio."""
        return self.contact_ratio_between(*self.limits)

    def contact_ratio_between(self, start: Any, end: Any) -> Any:
        """Transverse contact ratio of a path from a signed distance to another, m."""
        return as_float(contact_ratio(self.path, start, end, self.drive.pinion.teeth))

    @property
    def common_width(self) -> Any:
        """Width over which both gears' teeth meet, m."""
        return minimum(self.drive.pinion.face_width, self.drive.gear.face_width)

    @property
    def pitch_angle(self) -> Any:
        """Pinion angle from one pair to the next, rad."""
        return 2 * np.pi / self.drive.pinion.teeth

    def tooth(self, side: Side) -> Tooth:
        """Return the tooth of one body."""
        return self.pinion if side == "pinion" else self.gear

    def lowest_contact(self, side: Side) -> Any:
        """Signed distance (m), in the body's own view, of the lowest contact on this body's flank."""
        return self.r_start if side == "pinion" else -self.r_end

    def lowest_at_tip(self, side: Side) -> Any:
        """The same where the mate's tip cuts the path, whether there is a flank or not."""
        return self.tip_limits[0] if side == "pinion" else -self.tip_limits[1]

    def shortened(self, side: Side) -> bool:
        """Whether contact on a body's flank begins where undercut ends it; of plain numbers."""
        return bool(self.lowest_contact(side) > self.lowest_at_tip(side))

    def path_of(self, side: Side) -> Path:
        """Return the working path as one body sees it, which is that path's pinion."""
        return seen_from(self.path, side)


def _plain(values: Iterable[Any]) -> tuple[Any, ...]:
    """Floats, where they are not JAX's."""
    return tuple(map(as_float, values))


def _above_undercut(assembly: Assembly, side: Side, lowest: Any) -> Any:
    """The lowest contact, in a body's own view, not below the start of a flank that is undercut."""
    tooth, path = assembly.tooth(side), assembly.path_of(side)
    xp = namespace(assembly.drive)
    begins = distance_at_radius(path, tooth.form_radius)
    return xp.where(tooth.overrun > 0, maximum(lowest, begins), lowest)


def mate_of(side: Side) -> Side:
    """Return the other body's name."""
    return "gear" if side == "pinion" else "pinion"


def assemble(family: Family, drive: Drive) -> Assembly:
    """Put a drive together."""
    return Assembly(family, drive)


def half_angles(assembly: Assembly) -> tuple[float, float]:
    """Half thickness angles (rad) of pinion and gear on their working pitch circles."""
    one, two = (
        float(thickness_half_angle(assembly.tooth(side), assembly.path_of(side).pinion_pitch_radius))
        for side in SIDES
    )
    return one, two


def tip_clearance(assembly: Assembly, side: Side) -> Any:
    """Distance between this body's tip circle and its mate's root circle on the line of centres, m."""
    centre_distance = assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius
    root = assembly.tooth(mate_of(side)).root_radius
    return as_float(centre_distance - tip_circle_radius(assembly.drive, side) - root)


def lowest_contact_speed(assembly: Assembly, side: Side) -> Any:
    """Speed along this body's flank where the mate's tip cuts the path, m per rad; no flank there unless > 0.

    Per rad of its own turning, in the sense in which an external body turns.
    """
    path = assembly.path_of(side)
    r_p = path.pinion_pitch_radius
    return as_float(kinematics(path, assembly.lowest_at_tip(side)).pinion_speed * absolute(r_p) / r_p)


def lowest_contact_radius(assembly: Assembly, side: Side) -> Any:
    """Radius on this body of its lowest contact, m."""
    return as_float(radius(assembly.path_of(side), assembly.lowest_contact(side)))


def tip_corner_gap(assembly: Assembly, side: Side) -> Any:
    """Minimum gap (m) from this body's fillet to the corner of the mate's tip; infinite if they never meet.

    The corner is followed in the tooth's frame from the lowest contact to the line of centres, where it is
    deepest, and compared with the fillet at the same radius.
    """
    tooth, path = assembly.tooth(side), assembly.path_of(side)
    xp = namespace(assembly.drive)
    r_p, r_g = path.pinion_pitch_radius, path.gear_pitch_radius
    lowest = assembly.lowest_at_tip(side)
    alpha = path.pressure_angle(lowest)
    tip, mate_angle = polar(lowest * xp.cos(alpha), -lowest * xp.sin(alpha), r_g)
    mate_turn = -mate_angle * np.linspace(0.0, 1.0, _SAMPLES)
    corner_x, corner_y = tip * xp.sin(mate_angle + mate_turn), r_g - tip * xp.cos(mate_angle + mate_turn)
    distance, angle = polar(corner_x, corner_y, r_p)
    rotation = path.rotation(lowest) + mate_turn * r_g / r_p
    corner_angle = thickness_half_angle(tooth, r_p) + angle - rotation
    normal_angle = xp.linspace(np.pi / 2, tooth.form_angle, _SAMPLES)
    fillet_x, fillet_y = fillet_point(tooth, normal_angle)
    fillet_radius, fillet_angle = polar(fillet_y, fillet_x - r_p, r_p)
    gap = (corner_angle - xp.interp(distance, fillet_radius, fillet_angle)) * distance
    # where the corner leaves the flank the gap changes most: not only as near as the samples happen to lie
    leaving = xp.interp(tooth.form_radius, distance[::-1], corner_angle[::-1])
    first = (leaving - xp.interp(tooth.form_radius, fillet_radius, fillet_angle)) * tooth.form_radius
    inside = distance < tooth.form_radius
    return as_float(smallest(xp.where(xp.append(inside, inside[-1]), xp.append(gap, first), np.inf)))


def flank_angle_at_tip(family: Family, drive: Drive, side: Side) -> Any:
    """Sine and cosine of the angle between the flank at the tip circle and the radius there.

    The flank's normal passes the axis at the arm r_p cos α: the cosine is this arm over the tip's radius.
    """
    path, _ = family.generating_path(drive, side)
    outer = tip_circle_radius(drive, side)
    arm = path.pinion_pitch_radius * cos(path.pressure_angle(distance_at_radius(path, outer)))
    cosine = arm / outer
    return sqrt(1.0 - cosine**2), cosine


def tip_break(family: Family, drive: Drive, side: Side, rounding: float) -> Any:
    """Height below the tip circle, m, at which a rounding of radius ρ ends on the flank: ρ (1 − sin α_a)."""
    sine, _ = flank_angle_at_tip(family, drive, side)
    return rounding * (1.0 - sine)
