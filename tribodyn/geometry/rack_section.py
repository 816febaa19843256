"""Numbers of a helical drive by the rack's normal section, as drawings have them, and by the transverse one.

m_t = m_n/cos β, tan α_t = tan α_n/cos β; lengths across the rolling line stay, those along it grow by 1/cos β
(ISO 21771). The circle that rounds the rack's tip is an ellipse in the transverse section; a circle of
ρ_t (1 − sin α_t) = ρ_n (1 − sin α_n) stands for it, by which the straight flank ends at the same height: form
circle and undercut are exact, the fillet below is not.
"""

from typing import Any

from tribodyn.geometry.drive import SIDES, Drive, body_of
from tribodyn.geometry.families import Family
from tribodyn.numerics.elementary import arctan2, cos, sin, tan


def as_written(family: Family, drive: Drive) -> Drive:
    """The drive with the numbers of its keys: of the normal section for involutes, else as it stands."""
    return normal_section(drive) if family.involute else drive


def from_written(family: Family, drive: Drive) -> Drive:
    """The transverse section of a drive with the numbers of its keys: the inverse of `as_written`."""
    return transverse_section(drive) if family.involute else drive


def transverse_section(drive: Drive) -> Drive:
    """Drive of its transverse section, from module, pressure angle and rack of the normal section."""
    return _stretched(drive, 1.0 / cos(drive.helix_angle))


def normal_section(drive: Drive) -> Drive:
    """The drive by the normal section's module, pressure angle and rack: undoes `transverse_section`."""
    return _stretched(drive, cos(drive.helix_angle))


def _stretched(drive: Drive, stretch: Any) -> Drive:
    """The section in which lengths along the rolling line are `stretch` times as long."""
    if type(drive.helix_angle) in (float, int) and drive.helix_angle == 0:
        return drive  # to the last digit
    tangent = stretch * tan(drive.pressure_angle)
    angle = arctan2(tangent, 1.0 + 0.0 * tangent)
    rounding = (1.0 - sin(drive.pressure_angle)) / (1.0 - sin(angle)) / stretch
    bodies = {}
    for side in SIDES:
        body = body_of(drive, side)
        bodies[side] = body._replace(
            profile_shift=body.profile_shift / stretch,
            addendum=body.addendum / stretch,
            dedendum=body.dedendum / stretch,
            fillet_radius=body.fillet_radius * rounding,
            thickness_allowance=body.thickness_allowance * stretch,
            cutter_shift=body.cutter_shift / stretch,
            cutter_addendum=None if body.cutter_addendum is None else body.cutter_addendum / stretch,
        )
    return drive._replace(module=drive.module * stretch, pressure_angle=angle, **bodies)
