"""Sizes of a drive, how far its path reaches, and the limits that messages name."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, GearBody, Side, body_of, internal_side, tip_radius
from tribodyn.geometry.path import Path, kinematics, radius, seen_from
from tribodyn.numerics.elementary import sense

_SAMPLES = 2000

#: (drive, which half: −1 approach, +1 recess) -> key below ``drive``, value as text, remedy.
Advice = Callable[[Drive, int], tuple[str, Any, str]]


def refuse_shift(drive: Drive) -> None:
    """Refuse profile shift, where the path of contact belongs to one centre distance."""
    for side in SIDES:
        shift = body_of(drive, side).profile_shift
        if shift != 0:
            rule = "teeth of this family cannot be profile-shifted: their path belongs to one centre distance"
            raise InputError(f"drive.{side}.profile_shift", shift, rule, "use 0")


def require_reach(drive: Drive, path: Path, lower: float, upper: float, advice: Advice) -> None:
    """Refuse a path that ends before the teeth do, or whose flanks are undercut where they work.

    Both bodies: their tip circle must cut the path, their rack's rounding must touch its flank on it, and
    between the tips each flank must move the way it is convex to (u_p, u_g > 0, per turn in the sense of an
    external pinion), which is where it exists.
    The working path is known from the signed distance `lower` < 0 to `upper` > 0, m.
    """
    active = {}
    for side in SIDES:
        view, body = seen_from(path, side), body_of(drive, side)
        recess, approach = (upper, -lower) if side == "pinion" else (-lower, upper)
        distance = recess * np.linspace(0.0, 1.0, _SAMPLES)
        beyond = radius(view, distance) >= tip_radius(drive, side)
        half = 1 if side == "pinion" else -1
        if not beyond.any():
            height = millimetres(np.nanmax(distance * np.sin(view.pressure_angle(distance))))
            _refuse(
                drive, half, advice, f"the path ends {height} from the pitch line, before the {side}'s tip"
            )
        active[side] = float(distance[np.argmax(beyond)])
        distance = approach * np.linspace(0.0, 1.0, _SAMPLES)
        sine = np.sin(view.pressure_angle(-distance))
        rounding = drive.module * body.fillet_radius
        depth = body.dedendum if body.cutter_addendum is None else body.cutter_addendum
        below = drive.module * depth - rounding
        margin = (distance - rounding) * sine - below
        if body.cutter_teeth is not None:  # the same of a cutter, see `tooth.tangent_distance`
            margin += ((distance - rounding) ** 2 - below**2) / (drive.module * body.cutter_teeth)
        if not (margin >= 0).any():
            height = millimetres(np.nanmax(distance * sine))
            tool = "rack" if body.cutter_teeth is None else "cutter"
            rule = f"the path ends {height} from the pitch line, before the flank of the {side}'s {tool}"
            _refuse(drive, -half, advice, rule)
    inner = np.linspace(1e-6, 1.0, _SAMPLES)
    for half, end in ((-1, -active["gear"]), (1, active["pinion"])):
        motion = kinematics(path, end * inner)
        speeds: dict[Side, Any] = {"pinion": motion.pinion_speed, "gear": motion.gear_speed}
        for side, speed in speeds.items():
            if not np.all(speed * sense(path.pinion_pitch_radius) > 0):
                _refuse(drive, half, advice, f"the working flank of the {side} would be undercut")


def _refuse(drive: Drive, half: int, advice: Advice, rule: str) -> None:
    key, value, remedy = advice(drive, half)
    raise InputError(f"drive.{key}", value, rule, remedy)


_MAXIMUM_PRESSURE_ANGLE = math.radians(45)
_LENGTHS = ("module", "centre_distance", "face_width", "bore_radius", "tip_radius")


def check_sizes(drive: Drive, pressure_angle: bool = True) -> None:
    """Refuse numbers that are not finite or have the wrong sign; the pressure angle if the family has one."""
    require("module", drive.module, drive.module > 0, "must be greater than zero")
    if pressure_angle:
        angle_holds = 0 < drive.pressure_angle <= _MAXIMUM_PRESSURE_ANGLE
        require("pressure_angle", drive.pressure_angle, angle_holds, "must be between 0 and 45°")
    for side in SIDES:
        body = body_of(drive, side)
        for name in GearBody._fields:
            if getattr(body, name) is not None:
                require(f"{side}.{name}", getattr(body, name), True, "")
        cutter = body.cutter_teeth
        internal = side == internal_side(drive) and cutter is not None
        whole = (body.teeth >= 3 or internal) and body.teeth == round(body.teeth)
        require(f"{side}.teeth", body.teeth, whole, "must be a whole number of at least 3")
        if internal and cutter is not None:
            mate = drive.pinion if side == "gear" else drive.gear
            for broken in broken_internal_sizes(side, -body.teeth, mate.teeth, cutter):
                raise broken
        for name in ("addendum", "dedendum", "face_width"):
            value = getattr(body, name)
            require(f"{side}.{name}", value, value > 0, "must be greater than zero")
        require(f"{side}.fillet_radius", body.fillet_radius, body.fillet_radius >= 0, "must not be negative")
        if not internal:
            require(f"{side}.bore_radius", body.bore_radius, body.bore_radius >= 0, "must not be negative")


def broken_internal_sizes(side: Side, teeth: float, mate: float, cutter: float) -> Iterator[InputError]:
    """Refuse an internal gear as small as its mate or the cutter that turns in it; numbers of teeth > 0."""
    other = "pinion" if side == "gear" else "gear"
    if not teeth > mate:
        rule = f"the internal gear must have more teeth than the {other} that turns in it, {mate:g}"
        yield InputError(f"drive.{side}.teeth", f"{teeth:g}", rule, "use more")
    if cutter != round(cutter):
        yield InputError(f"drive.{side}.cutter_teeth", cutter, "must be a whole number")
    elif not 3 <= cutter < teeth:
        yield InputError(
            f"drive.{side}.cutter_teeth", f"{cutter:g}", "must be at least 3, and less than teeth"
        )


def require(key: str, value: Any, valid: bool, rule: str) -> None:
    """Refuse a number of the drive that is not finite or breaks a rule."""
    if not math.isfinite(value):
        raise InputError(f"drive.{key}", value, "must be a finite number")
    if not valid:
        name = key.rpartition(".")[2]
        shown = f"{math.degrees(value):.4g}°" if name == "pressure_angle" else value
        raise InputError(f"drive.{key}", millimetres(value) if name in _LENGTHS else shown, rule)


def replaced(drive: Drive, side: Side, **changes: Any) -> Drive:
    """Return the drive with some numbers of one body changed."""
    return drive._replace(**{side: body_of(drive, side)._replace(**changes)})


def boundary(is_valid: Callable[[float], bool], bad: float, good: float) -> float | None:
    """Find the value nearest to `bad` that obeys a rule, rounded to 0.001 on the safe side.

    None if `good` breaks the rule too.
    """
    if not is_valid(good):
        return None
    sign = 1 if good > bad else -1
    for _ in range(30):
        middle = (bad + good) / 2
        bad, good = (bad, middle) if is_valid(middle) else (middle, good)
    return sign * math.ceil(sign * good * 1000) / 1000


def advice(limit: float | None, bound: str, otherwise: str) -> str:
    """Say which limit to keep to, or what else to do where there is none."""
    return otherwise if limit is None else f"use {bound} {limit:.7g}"


def millimetres(length: float) -> str:
    """Write a length given in m."""
    return f"{1e3 * length:.4g} mm"
