"""The geometry of a drive in the engineer's figures and units."""

import math
from typing import Any

from tribodyn.geometry.assembly import assemble, lowest_contact_radius, tip_clearance
from tribodyn.geometry.drive import SIDES, Drive, body_of, reference_radius
from tribodyn.geometry.family import Family
from tribodyn.geometry.path import kinematics, seen_from
from tribodyn.geometry.tooth import flank_point, thickness_half_angle

Quantity = tuple[float, str]


def geometry_sheet(family: Family, drive: Drive) -> dict[str, Any]:
    """Summarise a drive that has passed `checks.check`.

    Returns
    -------
    dict
        Name -> (value, unit) for the pair, in reading order, and under "pinion" and "gear" the same for
        each body. Lengths in mm, angles in degrees.
    """
    assembly = assemble(family, drive)
    path = assembly.path
    at_pitch, at_start, at_end = (kinematics(path, r) for r in (0.0, assembly.r_start, assembly.r_end))
    pitch_angle = 2 * math.pi / drive.pinion.teeth
    pair: dict[str, Any] = {
        "module": _millimetres(drive.module),
        "gear ratio": (float(drive.gear.teeth / drive.pinion.teeth), ""),
        "centre distance": _millimetres(path.pinion_pitch_radius + path.gear_pitch_radius),
        "contact ratio": (assembly.contact_ratio, ""),
        "approach contact ratio": (-float(path.rotation(assembly.r_start)) / pitch_angle, ""),
        "recess contact ratio": (float(path.rotation(assembly.r_end)) / pitch_angle, ""),
        "start of contact from pitch point": _millimetres(assembly.r_start),
        "end of contact from pitch point": _millimetres(assembly.r_end),
        "pressure angle at start of contact": _degrees(at_start.pressure_angle),
        "pressure angle at pitch point": _degrees(at_pitch.pressure_angle),
        "pressure angle at end of contact": _degrees(at_end.pressure_angle),
        "equivalent radius at start of contact": _millimetres(1 / at_start.relative_curvature),
        "equivalent radius at pitch point": _millimetres(1 / at_pitch.relative_curvature),
        "equivalent radius at end of contact": _millimetres(1 / at_end.relative_curvature),
    }
    for side in SIDES:
        tooth, body = assembly.tooth(side), body_of(drive, side)
        working = seen_from(path, side).pinion_pitch_radius
        pair[side] = {
            "teeth": (float(body.teeth), ""),
            "profile shift": (float(body.profile_shift), ""),
            "reference diameter": _millimetres(2 * reference_radius(drive, side)),
            "working pitch diameter": _millimetres(2 * working),
            "tip diameter": _millimetres(2 * tooth.tip_radius),
            "lowest contact diameter": _millimetres(2 * lowest_contact_radius(assembly, side)),
            "form diameter": _millimetres(2 * tooth.form_radius),
            "undercut by the rack": (float(tooth.overrun > 0), ""),
            "root diameter": _millimetres(2 * tooth.root_radius),
            "bore diameter": _millimetres(2 * body.bore_radius),
            "face width": _millimetres(body.face_width),
            "tooth thickness on working pitch circle": _millimetres(
                2 * working * thickness_half_angle(tooth, working)
            ),
            "tip thickness": _millimetres(2 * flank_point(tooth, tooth.tip_distance)[1]),
            "tip clearance": _millimetres(tip_clearance(assembly, side)),
        }
    return pair


def _millimetres(length: Any) -> Quantity:
    return 1e3 * float(length), "mm"


def _degrees(angle: Any) -> Quantity:
    return math.degrees(float(angle)), "°"
