"""How far a pair of gears is from the limits of its existence: signed distances, for a search.

`checks` refuses the first rule that a pair breaks; here every rule is a number, positive where it holds,
continuous, and differentiable through JAX. A pair beyond the limits has distances too.
"""

from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, mate_of, tip_clearance, tip_corner_gap
from tribodyn.geometry.drive import SIDES, Drive, Side, body_of, tip_circle_radius
from tribodyn.geometry.helix import overlap_ratio
from tribodyn.geometry.limits.sizes import millimetres
from tribodyn.geometry.path import distance_at_radius, kinematics, position, radius
from tribodyn.geometry.tooth import flank_point, polar, thickness_half_angle
from tribodyn.numerics.elementary import (
    absolute,
    arctan2,
    as_float,
    cos,
    maximum,
    minimum,
    namespace,
    sense,
    sin,
    smallest,
    sqrt,
    where,
)
from tribodyn.numerics.shapes import Array, Float

# How far an internal pair is from the limits that external gears do not have: signed distances, m.
#
# Positive: the limit is kept. Radii and half thickness angles of the ring are negative (ISO 21771). What a
# pair of involutes shares with external gears, tip in the fillet, contact below the base circle of the
# pinion, contact ratio and clearances, is in `limits` and `checks`.


def base_circle_margin(assembly: Assembly, side: Side) -> Any:
    """Distance from an internal involute tooth's tip out to its base circle, above which it has no flank."""
    path = assembly.tooth(side).path
    base = path.pinion_pitch_radius * cos(path.pressure_angle(0.0))
    return as_float(base - tip_circle_radius(assembly.drive, side))


def tool_margin(assembly: Assembly, side: Side) -> Any:
    """Minimum speed along the tool's flank while it cuts this body's, m per rad of the cutter.

    r_0 sin α − r + r κ_0, κ_0 = r_0 cos α dα/dr; of a rack per rad of the body, r_p (sin α + r cos α dα/dr).
    Where it changes its sign the tool's flank ends, and the body is left without a part of its own. Of an
    involute's cutter it is the distance along the line of action from its base tangent point to where it cuts
    the tip. Between two external gears a rack has a flank wherever both of them have.
    """
    tooth, module = assembly.tooth(side), assembly.drive.module
    r = tooth.form_distance + (tooth.tip_distance - tooth.form_distance) * np.linspace(0.0, 1.0, _SAMPLES)
    alpha = tooth.path.pressure_angle(r)
    rise = sin(alpha) + r * cos(alpha) * tooth.path.pressure_angle_slope(r)
    rack = tooth.tool_curvature is None
    speed = tooth.path.pinion_pitch_radius * rise if rack else rise / tooth.tool_curvature - r
    return as_float(smallest(away_from_pitch_point(speed, r, module)))


def away_from_pitch_point(speed: Any, r: Any, module: Any) -> Any:
    """Speeds along a flank, raised by up to a module within 0.01 modules of P, where a cycloid's are zero."""
    return speed + module * maximum(1.0 - absolute(r) / (1e-2 * module), 0.0)


def internal_distances(assembly: Assembly) -> dict[str, Any]:
    """The ring's own distances from its limits, each at most a module; a module of a pair without a ring."""
    drive = assembly.drive
    ring: Side | None = next((side for side in SIDES if body_of(drive, side).cutter_teeth is not None), None)
    module = drive.module
    if ring is None:
        return {"trochoidal_clearance": module, "tool_flank": module, "base_circle": module}
    base = base_circle_margin(assembly, ring) if assembly.family.involute else module
    return {
        "trochoidal_clearance": minimum(trochoidal_gap(assembly, ring), module),
        "tool_flank": minimum(minimum(*(tool_margin(assembly, side) for side in SIDES)), module),
        "base_circle": minimum(base, module),
    }


def tip_in_base_circle(assembly: Assembly, ring: Side) -> str:
    """Say that the ring's tip lies within its base circle, or nothing."""
    if not assembly.family.involute or base_circle_margin(assembly, ring) > 0:
        return ""
    return "the tip lies within the base circle, where there is no involute"


def check_outside(assembly: Assembly, side: Side) -> None:
    """Refuse a ring without material outside its root circle."""
    outside, root = body_of(assembly.drive, side).bore_radius, assembly.tooth(side).root_radius
    if not outside < root:
        rule = f"the root circle, of radius {millimetres(abs(root))}, reaches the outside of the ring"
        raise InputError(
            f"drive.{side}.outer_diameter", millimetres(abs(2 * outside)), rule, "use a larger one"
        )


def check_cutter(assembly: Assembly, side: Side) -> None:
    """Refuse a cutter whose flank does not reach the tip that it cuts, and one that cannot be shifted."""
    margin, body = tool_margin(assembly, side), body_of(assembly.drive, side)
    if body.cutter_shift and not assembly.family.involute:
        rule = "a cutter of this family cannot be profile-shifted: its path belongs to one centre distance"
        raise InputError(f"drive.{side}.cutter_profile_shift", body.cutter_shift, rule, "use 0")
    if not margin > 0:
        rule = "the cutter's flank ends before the tip of the internal tooth"
        if assembly.family.involute:
            rule = f"the cutter's involute ends {millimetres(-margin)} before the tip of the internal tooth"
        raise InputError(
            f"drive.{side}.cutter_teeth", f"{body.cutter_teeth:g}", rule, "use more, or a lower tip"
        )


def rack_without_flank(assembly: Assembly, ring: Side) -> str:
    """Say that the rack of the ring's mate has no flank up to the mate's tip, or nothing."""
    if tool_margin(assembly, mate_of(ring)) > 0:
        return ""
    return "the path of contact turns back to the pitch line, where no rack cuts the tooth"


def tips_collide(assembly: Assembly, ring: Side) -> str:
    """Say that the tips run into each other beyond the path of contact, or nothing."""
    gap = trochoidal_gap(assembly, ring)
    if gap > 0:
        return ""
    return f"the tips run into each other where they pass, {millimetres(-gap)} deep"


def trochoidal_gap(assembly: Assembly, ring: Side) -> Any:
    """Room of the mate's tip corner beside the ring's flank, from the end of contact to the ring's tip.

    The corner is at the angle θ from the line of centres while the mate has turned by φ = θ + ψ − ψ_a. Its
    arc from the ring's flank at the same radius is zero where contact ends, and is taken over the square of
    its way from there: where the tip circles cross, at cos θ = (a² + r_a² − r_a,ring²)/(2 a r_a), it is the
    arc between both corners (trochoidal interference), the minimum of involutes. A tip that never leaves the
    ring's teeth goes on to θ = π, where it is in another gap.
    """
    mate = mate_of(ring)
    path, drive = assembly.path_of(mate), assembly.drive
    r_p, r_g = path.pinion_pitch_radius, path.gear_pitch_radius
    tip, distance = tip_circle_radius(drive, mate), r_p + r_g
    cosine = (distance**2 + tip**2 - tip_circle_radius(drive, ring) ** 2) / (2 * distance * tip)
    cosine = where(cosine > -1.0, cosine, -1.0)
    end = distance_at_radius(path, tip)
    first = polar(*position(path, end), r_p)[1]
    way = np.linspace(0.0, 1.0, _SAMPLES)[1:]
    theta = first + (arctan2(sqrt(1.0 - cosine**2), cosine) - first) * way
    turned = (theta - first + path.rotation(end)) * r_p / r_g
    radius, angle = polar(-tip * sin(theta), r_p - tip * cos(theta), r_g)
    tooth = assembly.tooth(ring)
    apart = thickness_half_angle(tooth, r_g) + angle + turned - thickness_half_angle(tooth, radius)
    return as_float(smallest(apart * radius / way**2))


def radial_assembly(assembly: Assembly, ring: Side) -> Any:
    """Smallest room of the ring's mate pushed in radially between its tips, across its way.

    The mate stands with a tooth, or with a gap, on the line of centres, whichever leaves more room. A pair
    without room can be put together along the axis only. Plain numbers only.
    """
    return max(_room(assembly, ring, first) for first in (0.0, 0.5))


def _room(assembly: Assembly, ring: Side, first: float) -> float:
    drive, path, mate = assembly.drive, assembly.path, mate_of(ring)
    teeth = round(float(body_of(drive, mate).teeth))
    tip, ring_tip = tip_circle_radius(drive, mate), tip_circle_radius(drive, ring)
    distance = path.pinion_pitch_radius + path.gear_pitch_radius
    number = first + np.arange(teeth // 4 + 1)
    corner = number * 2 * np.pi / teeth + float(thickness_half_angle(assembly.tooth(mate), tip))
    gap = (number + 0.5) * 2 * np.pi / body_of(drive, ring).teeth
    gap = -gap + float(thickness_half_angle(assembly.tooth(ring), ring_tip))
    x, y = tip * np.sin(corner), tip * np.cos(corner) - distance
    beyond = np.hypot(x, y) > -ring_tip  # in a gap of the ring when it is in place
    room = -ring_tip * np.sin(gap) - x
    return float(room[beyond].min()) if beyond.any() else np.inf


_SAMPLES = 129
# Share of the module over which the smooth minimum blends values.
_BLENDED = 1e-3


_OF_BODY = ("undercut", "interference", "tip_corner", "tip_thickness", "clearance", "rack_tip")
#: Name of every distance -> its SI unit; what each is stands in the catalogue of quantities.
LIMITS = {f"{name}_{side}": "m" for name in _OF_BODY for side in SIDES}
LIMITS |= {"contact_ratio_above_1": "1", "trochoidal_clearance": "m", "tool_flank": "m", "base_circle": "m"}


def distances(assembly: Assembly) -> dict[str, Any]:
    """Distances of a pair from the limits of its existence, by the names of `LIMITS`; m, positive: it holds.

    Of any numbers, traced or plain, that need not pass the checks; nothing is raised. What does not exist at
    all, because the path ends before the teeth do, is NaN. `undercut_…` is a smooth minimum over the contact:
    at most 0.005 modules below the sharp one.
    """
    with np.errstate(all="ignore"):
        margins = {}
        for side in SIDES:
            of_body = _of_body(assembly, side)
            margins |= {f"{name}_{side}": of_body[name] for name in _OF_BODY}
        margins["contact_ratio_above_1"] = assembly.contact_ratio + overlap_ratio(assembly) - 1.0
        margins |= internal_distances(assembly)
    return {name: margins[name] for name in LIMITS}


def plain_distances(assembly: Assembly) -> dict[str, float]:
    """Distances of a pair of plain numbers; `beyond` where one does not exist."""
    margins = {name: float(value) for name, value in distances(assembly).items()}
    return {
        name: value if np.isfinite(value) else beyond(LIMITS[name], assembly.drive)
        for name, value in margins.items()
    }


def beyond(unit: str, drive: Drive) -> float:
    """What stands for a distance that does not exist: a module beyond the limit, or 1."""
    return -float(drive.module) if unit == "m" else -1.0


def _of_body(assembly: Assembly, side: Side) -> dict[str, Any]:
    drive, tooth = assembly.drive, assembly.tooth(side)
    start, end = assembly.tip_limits
    r = start + (end - start) * np.linspace(0.0, 1.0, _SAMPLES)
    motion = kinematics(assembly.path, r)
    speed = motion.pinion_speed if side == "pinion" else motion.gear_speed
    speed = speed * sense(assembly.path.pinion_pitch_radius)  # in the pinion's own sense of turning
    return {
        "undercut": smooth_minimum(away_from_pitch_point(speed, r, drive.module), _BLENDED * drive.module),
        "interference": radius(assembly.path_of(side), assembly.lowest_at_tip(side)) - tooth.form_radius,
        "tip_corner": minimum(tip_corner_gap(assembly, side), drive.module),
        "tip_thickness": 2 * flank_point(tooth, tooth.tip_distance)[1],
        "clearance": tip_clearance(assembly, side),
        "rack_tip": tooth.corner_limit - tooth.corner_x,
    }


def smooth_minimum(values: Float[Array, " sample"], width: Any) -> Any:
    """−width ln Σ exp(−values/width): at most width ln n below the minimum, and differentiable."""
    xp = namespace(values, width)
    lowest = smallest(values)
    return lowest - width * xp.log(xp.sum(xp.exp((lowest - values) / width)))
