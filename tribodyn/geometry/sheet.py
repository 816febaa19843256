"""The geometry of a drive in the engineer's quantities and units, measured tooth thickness included.

Of helical teeth in the transverse section where nothing else is said, with what the helix adds to it.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly, lowest_contact_radius, tip_clearance
from tribodyn.geometry.backlash import at_limits, circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import SIDES, Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.geometry.gauges import Gauge, Quantity, involute_of, thickness_lines
from tribodyn.geometry.helix import (
    as_written,
    base_helix_angle,
    contact_lines,
    hand_name,
    lead,
    overlap_ratio,
    pitch_slope,
)
from tribodyn.geometry.limits.limits import base_circle_margin, radial_assembly, tool_margin, trochoidal_gap
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import flank_point, thickness_half_angle

_SAMPLES = 400


def geometry_sheet(
    assembly: Assembly,
    masses: Sequence[tuple[float, float]] | None = None,
    gauges: tuple[Gauge, Gauge] = (Gauge(), Gauge()),
    gear_torque: float = 0.0,
    distance_allowance: float = 0.0,
) -> dict[str, Any]:
    """Summarise a drive that has passed `checks.check`; lengths in mm, angles in degrees.

    Name -> (value, unit) for the pair, in reading order, and under "pinion" and "gear" the same for each
    body; radii and number of teeth of an internal gear are negative (ISO 21771). Masses (kg) and inertias
    (kg m²) of pinion and gear stand there where they are given, and with a torque on the gear (N m) the
    forces of helical involutes. Where tooth thickness or centre distance (m, ±) has a tolerance, backlashes
    have limits.
    """
    path, drive = assembly.path, assembly.drive
    ends = {"start of contact": assembly.r_start, "pitch point": 0.0, "end of contact": assembly.r_end}
    places = {name: kinematics(path, r) for name, r in ends.items()}
    operating = {"operating pressure angle": _degrees(places["pitch point"].pressure_angle)}
    operating = operating if assembly.family.involute else {}
    pitch_angle = 2 * math.pi / drive.pinion.teeth
    pair: dict[str, Any] = {
        **_module_lines(assembly),
        "gear ratio": (float(drive.gear.teeth / drive.pinion.teeth), ""),
        "centre distance": _millimetres(path.pinion_pitch_radius + path.gear_pitch_radius),
        **operating,
        **backlash_lines(assembly),
        **_backlash_limits(assembly, gauges, distance_allowance),
        **_rack_angle_lines(assembly),
        "contact ratio": (assembly.contact_ratio, ""),
        "approach contact ratio": (-assembly.roll_limits[0] / pitch_angle, ""),
        "recess contact ratio": (assembly.roll_limits[1] / pitch_angle, ""),
        **(_helix_lines(assembly, gear_torque) if drive.helix_angle else {}),
        "start of contact from pitch point": _millimetres(assembly.r_start),
        "end of contact from pitch point": _millimetres(assembly.r_end),
        **{f"pressure angle at {name}": _degrees(at.pressure_angle) for name, at in places.items()},
        **{
            f"equivalent radius at {name}": _millimetres(1 / at.relative_curvature)
            for name, at in places.items()
        },
    }
    sliding = _sliding(assembly)
    pair |= sliding.pop("pair")
    for number, side in enumerate(SIDES):
        tooth, body = assembly.tooth(side), body_of(drive, side)
        working = assembly.path_of(side).pinion_pitch_radius
        rounded = {"tip form diameter": _millimetres(2 * tooth.tip_radius)}
        pair[side] = {
            "teeth": (float(body.teeth), ""),
            "profile shift": (float(body_of(as_written(assembly.family, drive), side).profile_shift), ""),
            **(_hand_lines(assembly, side) if drive.helix_angle else {}),
            "reference diameter": _millimetres(2 * reference_radius(drive, side)),
            "working pitch diameter": _millimetres(2 * working),
            **_base_diameter(assembly, side),
            "tip diameter": _millimetres(2 * tip_circle_radius(drive, side)),
            **(rounded if body.tip_break > 0 else {}),
            "lowest contact diameter": _millimetres(2 * lowest_contact_radius(assembly, side)),
            "form diameter": _millimetres(2 * tooth.form_radius),
            "active flank above form circle": _millimetres(
                lowest_contact_radius(assembly, side) - tooth.form_radius
            ),
            "undercut margin": _millimetres(-tooth.overrun),
            "undercut by the rack": (float(tooth.overrun > 0), ""),
            "root diameter": _millimetres(2 * tooth.root_radius),
            "bore diameter" if body.teeth > 0 else "outer diameter": _millimetres(2 * body.bore_radius),
            "face width": _millimetres(body.face_width),
            "tooth thickness on working pitch circle": _millimetres(
                2 * working * thickness_half_angle(tooth, working)
            ),
            "tip thickness": _millimetres(2 * flank_point(tooth, tooth.tip_distance)[1]),
            "tip clearance": _millimetres(tip_clearance(assembly, side)),
            **(_thickness_on_reference(assembly, side) if drive.helix_angle else {}),
            **thickness_lines(assembly, side, gauges[number]),
            **(_internal_lines(assembly, side) if body.teeth < 0 else {}),
            **sliding[side],
        }
        if masses is not None:
            mass, inertia = masses[number]
            pair[side] |= {"mass": (float(mass), "kg"), "moment of inertia": (1e6 * float(inertia), "kg mm²")}
    return pair


def _internal_lines(assembly: Assembly, side: Side) -> dict[str, Quantity]:
    """The cutter of an internal gear, and the distances from the limits that external gears do not have."""
    body, tooth = body_of(assembly.drive, side), assembly.tooth(side)
    # the cutter's tip reaches the root circle: −(a_0 − r_f)
    cutter = tooth.path.pinion_pitch_radius + 1 / tooth.tool_curvature - tooth.root_radius
    base = {"base circle margin of the tip": _millimetres(base_circle_margin(assembly, side))}
    return {
        "teeth of the cutter": (float(body.cutter_teeth), ""),
        "profile shift of the cutter": (float(body.cutter_shift), ""),
        "tip diameter of the cutter": _millimetres(2 * cutter),
        **(base if assembly.family.involute else {}),
        "margin of the cutter's flank": _millimetres(tool_margin(assembly, side)),
        "trochoidal clearance of the tips": _millimetres(trochoidal_gap(assembly, side)),
        "room for radial assembly": _millimetres(radial_assembly(assembly, side)),
    }


def _module_lines(assembly: Assembly) -> dict[str, Quantity]:
    """The module, of helical teeth in both sections."""
    drive = assembly.drive
    transverse = _millimetres(drive.module)
    if not drive.helix_angle:
        return {"module": transverse}
    return {
        "normal module": _millimetres(drive.module * math.cos(drive.helix_angle)),
        "transverse module": transverse,
    }


def _rack_angle_lines(assembly: Assembly) -> dict[str, Quantity]:
    """The rack's pressure angle, of helical involutes in both sections."""
    of_rack, angle = (
        "pressure angle of the rack on its rolling line",
        assembly.family.generating_path(assembly.drive, "pinion")[0].pressure_angle(0.0),
    )
    if not (assembly.drive.helix_angle and assembly.family.involute):
        return {of_rack: _degrees(angle)}
    normal = as_written(assembly.family, assembly.drive).pressure_angle
    return {f"normal {of_rack}": _degrees(normal), f"transverse {of_rack}": _degrees(angle)}


def _helix_lines(assembly: Assembly, gear_torque: float) -> dict[str, Quantity]:
    """What the helix adds to the sheet of the pair."""
    drive, overlap = assembly.drive, float(overlap_ratio(assembly))
    involute = assembly.family.involute
    backlash = float(circumferential_backlash(assembly))
    backlash *= float(reference_radius(drive, "pinion") / assembly.path.pinion_pitch_radius)
    open_by = backlash if backlash > 1e-9 * drive.module else 0.0
    lines = contact_lines(assembly)
    return {
        "overlap ratio": (overlap, ""),
        "total contact ratio": (float(assembly.contact_ratio) + overlap, ""),
        "helix angle": _degrees(abs(drive.helix_angle)),
        "helix angle on working pitch circle": _degrees(math.atan(abs(float(pitch_slope(assembly))))),
        **({"base helix angle": _degrees(abs(base_helix_angle(drive)))} if involute else {}),
        "circumferential backlash on reference circle": _millimetres(open_by),
        **{f"{name} length of contact lines": _millimetres(value) for name, value in lines._asdict().items()},
        **(_force_lines(assembly, abs(gear_torque)) if involute and gear_torque else {}),
    }


def _force_lines(assembly: Assembly, gear_torque: float) -> dict[str, Quantity]:
    """Forces between involutes without friction: tangential, radial and axial; N."""
    drive = assembly.drive
    nominal = gear_torque / abs(float(reference_radius(drive, "gear")))
    working = gear_torque / abs(float(assembly.path.gear_pitch_radius))
    angle = float(assembly.path.pressure_angle(0.0))
    return {
        "tangential force on reference circle": (nominal, "N"),
        "radial force on reference circle": (nominal * math.tan(drive.pressure_angle), "N"),
        "tangential force on working pitch circle": (working, "N"),
        "radial force on working pitch circle": (working * math.tan(angle), "N"),
        "axial force": (nominal * math.tan(abs(drive.helix_angle)), "N"),
    }


def _hand_lines(assembly: Assembly, side: Side) -> dict[str, Quantity]:
    """What the helix adds to the sheet of one gear."""
    drive = assembly.drive
    lines: dict[str, Quantity] = {
        "hand of helix": (hand_name(drive, side), ""),
        "lead": _millimetres(lead(drive, side)),
    }
    if assembly.family.involute:
        lines["virtual number of teeth"] = involute_of(drive, side)[0].virtual_teeth, ""
    return lines


def _thickness_on_reference(assembly: Assembly, side: Side) -> dict[str, Quantity]:
    """Tooth thickness on the reference circle in both sections, arcs; s_n = s_t cos β."""
    radius = reference_radius(assembly.drive, side)
    arc = 2 * radius * thickness_half_angle(assembly.tooth(side), radius)
    return {
        "normal tooth thickness on reference circle": _millimetres(
            arc * math.cos(assembly.drive.helix_angle)
        ),
        "transverse tooth thickness on reference circle": _millimetres(arc),
    }


def backlash_lines(assembly: Assembly) -> dict[str, Quantity]:
    """Backlash of the pair and, of involutes, the centre distance at which it has none."""
    lines: dict[str, Quantity] = {}
    if assembly.family.involute:
        lines["centre distance without backlash"] = 1e3 * float(tight_centre_distance(assembly.drive)), "mm"
    rounding = 1e-9 * float(assembly.drive.module)
    for name, backlash in (
        ("normal backlash", normal_backlash(assembly)),
        ("circumferential backlash", circumferential_backlash(assembly)),
    ):
        lines[name] = 1e3 * (float(backlash) if abs(backlash) > rounding else 0.0), "mm"
    return lines


def _backlash_limits(
    assembly: Assembly, gauges: tuple[Gauge, Gauge], distance_allowance: float
) -> dict[str, Quantity]:
    """Least and greatest backlash within the tolerances of tooth thickness and centre distance."""
    if not distance_allowance and not any(gauge.tolerance for gauge in gauges):
        return {}
    limits = [
        (normal_backlash(each), circumferential_backlash(each))
        for each in at_limits(assembly, [gauge.tolerance for gauge in gauges], distance_allowance)
    ]
    lines = {}
    if distance_allowance:
        lines["allowance of the centre distance, ±"] = _millimetres(distance_allowance)
    for number, name in enumerate(("normal backlash", "circumferential backlash")):
        for end, choose in (("least", min), ("most", max)):
            lines[f"{name}, {end}"] = _millimetres(choose(float(each[number]) for each in limits))
    return lines


def specific_sliding_max(assembly: Assembly) -> float:
    """Largest magnitude of both flanks' specific sliding along the path of contact."""
    sliding = _sliding(assembly)
    ends = (f"{end} specific sliding" for end in ("minimum", "maximum"))
    return max(abs(float(sliding[side][end][0])) for end in ends for side in SIDES)


def _sliding(assembly: Assembly) -> dict[str, dict[str, Quantity]]:
    """Maximum sliding in approach and recess, and each flank's extremes of specific sliding.

    Sliding per rad of the pinion, so mm/rad times rad/s is mm/s. Specific sliding is the flank's speed less
    its mate's, over the flank's own: −∞ where a flank is touched at its point of zero velocity.
    """
    path = assembly.path
    # Without P, where both speeds of a cycloid vanish; it may lie beyond an end of an internal pair's path.
    away, limits = np.linspace(1.0, 0.0, _SAMPLES, endpoint=False), (assembly.r_start, assembly.r_end)
    nearest = min(max(0.0, limits[0]), limits[1])
    approach, recess = (kinematics(path, nearest + (limit - nearest) * away) for limit in limits)
    result: dict[str, dict[str, Quantity]] = {
        "pair": {
            f"maximum sliding in {name}": (
                1e3 * float(np.abs(part.sliding[half * part.signed_distance > 0]).max(initial=0.0)),
                "mm/rad",
            )
            for name, half, part in (("approach", -1.0, approach), ("recess", 1.0, recess))
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
    return {"base diameter": _millimetres(2 * arm[0])} if np.ptp(arm) <= 1e-12 * abs(arm[0]) else {}


def _millimetres(length: Any) -> Quantity:
    return 1e3 * float(length), "mm"


def _degrees(angle: Any) -> Quantity:
    return math.degrees(float(angle)), "°"
