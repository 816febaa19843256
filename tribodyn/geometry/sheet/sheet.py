"""The geometry of a drive in the engineer's figures and units."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly, lowest_contact_radius, tip_clearance
from tribodyn.geometry.drive import SIDES, Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.sheet.measures import Gauge, backlash_lines, thickness_lines
from tribodyn.geometry.tooth.tooth import flank_point, thickness_half_angle

Quantity = tuple[float, str]

_SAMPLES = 400


def geometry_sheet(
    assembly: Assembly,
    masses: Sequence[tuple[float, float]] | None = None,
    gauges: tuple[Gauge, Gauge] = (Gauge(), Gauge()),
) -> dict[str, Any]:
    """Summarise a drive that has passed `checks.check`.

    Parameters
    ----------
    assembly : of plain numbers
    masses : sequence of (mass kg, inertia kg m²), optional
        Of pinion and gear, where they are to stand in the sheet.
    gauges : what the tooth thickness of pinion and gear is measured with

    Returns
    -------
    dict
        Name -> (value, unit) for the pair, in reading order, and under "pinion" and "gear" the same for
        each body. Lengths in mm, angles in degrees.
    """
    path, drive = assembly.path, assembly.drive
    at_pitch, at_start, at_end = (kinematics(path, r) for r in (0.0, assembly.r_start, assembly.r_end))
    pitch_angle = 2 * math.pi / drive.pinion.teeth
    pair: dict[str, Any] = {
        "module": _millimetres(drive.module),
        "gear ratio": (float(drive.gear.teeth / drive.pinion.teeth), ""),
        "centre distance": _millimetres(path.pinion_pitch_radius + path.gear_pitch_radius),
        **_operating_angle(assembly),
        **backlash_lines(assembly),
        "pressure angle of the rack on its rolling line": _degrees(assembly.pinion.path.pressure_angle(0.0)),
        "contact ratio": (assembly.contact_ratio, ""),
        "approach contact ratio": (-assembly.roll_limits[0] / pitch_angle, ""),
        "recess contact ratio": (assembly.roll_limits[1] / pitch_angle, ""),
        "start of contact from pitch point": _millimetres(assembly.r_start),
        "end of contact from pitch point": _millimetres(assembly.r_end),
        "pressure angle at start of contact": _degrees(at_start.pressure_angle),
        "pressure angle at pitch point": _degrees(at_pitch.pressure_angle),
        "pressure angle at end of contact": _degrees(at_end.pressure_angle),
        "equivalent radius at start of contact": _millimetres(1 / at_start.relative_curvature),
        "equivalent radius at pitch point": _millimetres(1 / at_pitch.relative_curvature),
        "equivalent radius at end of contact": _millimetres(1 / at_end.relative_curvature),
    }
    sliding = _sliding(assembly)
    pair |= sliding.pop("pair")
    for number, side in enumerate(SIDES):
        tooth, body = assembly.tooth(side), body_of(drive, side)
        working = assembly.path_of(side).pinion_pitch_radius
        pair[side] = {
            "teeth": (float(body.teeth), ""),
            "profile shift": (float(body.profile_shift), ""),
            "reference diameter": _millimetres(2 * reference_radius(drive, side)),
            "working pitch diameter": _millimetres(2 * working),
            **_base_diameter(assembly, side),
            "tip diameter": _millimetres(2 * tip_circle_radius(drive, side)),
            **_tip_form_diameter(assembly, side),
            "lowest contact diameter": _millimetres(2 * lowest_contact_radius(assembly, side)),
            "form diameter": _millimetres(2 * tooth.form_radius),
            "active flank above form circle": _millimetres(
                lowest_contact_radius(assembly, side) - tooth.form_radius
            ),
            "undercut margin": _millimetres(-tooth.overrun),
            "undercut by the rack": (float(tooth.overrun > 0), ""),
            "root diameter": _millimetres(2 * tooth.root_radius),
            "bore diameter": _millimetres(2 * body.bore_radius),
            "face width": _millimetres(body.face_width),
            "tooth thickness on working pitch circle": _millimetres(
                2 * working * thickness_half_angle(tooth, working)
            ),
            "tip thickness": _millimetres(2 * flank_point(tooth, tooth.tip_distance)[1]),
            "tip clearance": _millimetres(tip_clearance(assembly, side)),
            **thickness_lines(assembly, side, gauges[number]),
            **sliding[side],
        }
        if masses is not None:
            mass, inertia = masses[number]
            pair[side] |= {"mass": (float(mass), "kg"), "moment of inertia": (1e6 * float(inertia), "kg mm²")}
    return pair


def specific_sliding_max(assembly: Assembly) -> float:
    """Largest magnitude of both flanks' specific sliding along the path of contact."""
    found = _sliding(assembly)
    ends = (f"{end} specific sliding" for end in ("minimum", "maximum"))
    return max(abs(found[side][end][0]) for end in ends for side in SIDES)


def _sliding(assembly: Assembly) -> dict[str, dict[str, Quantity]]:
    """Maximum sliding in approach and recess, and each flank's extremes of specific sliding.

    Sliding per rad of the pinion, so mm/rad times rad/s is mm/s. Specific sliding is the flank's speed less
    its mate's, over the flank's own: −∞ where a flank is touched at its point of zero velocity.
    """
    path = assembly.path
    # Without P, where both speeds of a cycloid vanish.
    approach = kinematics(path, assembly.r_start * np.linspace(1.0, 0.0, _SAMPLES, endpoint=False))
    recess = kinematics(path, assembly.r_end * np.linspace(1.0, 0.0, _SAMPLES, endpoint=False))
    result: dict[str, dict[str, Quantity]] = {
        "pair": {
            f"maximum sliding in {name}": (1e3 * float(np.abs(part.sliding).max()), "mm/rad")
            for name, part in (("approach", approach), ("recess", recess))
        }
    }
    for side, sign in zip(SIDES, (1.0, -1.0), strict=True):
        specific = np.concatenate(
            [sign * part.sliding / getattr(part, f"{side}_speed") for part in (approach, recess)]
        )
        result[side] = {
            "minimum specific sliding": (float(specific.min()), ""),
            "maximum specific sliding": (float(specific.max()), ""),
        }
    return result


def _base_diameter(assembly: Assembly, side: Side) -> dict[str, Quantity]:
    """Return the diameter of the base circle where there is one: where the normal load's arm is constant."""
    along = kinematics(assembly.path, np.linspace(assembly.r_start, assembly.r_end, 5))
    arm = getattr(along, f"{side}_normal_arm")
    return {"base diameter": _millimetres(2 * arm[0])} if np.ptp(arm) <= 1e-12 * arm[0] else {}


def _operating_angle(assembly: Assembly) -> dict[str, Quantity]:
    """Return the pressure angle at which involutes work, the same along their path."""
    if not assembly.family.involute:
        return {}
    return {"operating pressure angle": _degrees(assembly.path.pressure_angle(0.0))}


def _tip_form_diameter(assembly: Assembly, side: Side) -> dict[str, Quantity]:
    """Return the diameter at which the flank ends where a rounding of the tip ends it."""
    rounded = body_of(assembly.drive, side).tip_break > 0
    return {"tip form diameter": _millimetres(2 * assembly.tooth(side).tip_radius)} if rounded else {}


def _millimetres(length: Any) -> Quantity:
    return 1e3 * float(length), "mm"


def _degrees(angle: Any) -> Quantity:
    return math.degrees(float(angle)), "°"
