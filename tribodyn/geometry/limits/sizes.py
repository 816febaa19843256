"""Sizes of a drive, and the limits that messages name."""

import math
from collections.abc import Callable
from typing import Any

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, GearBody, Side, body_of

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
        whole = body.teeth >= 3 and body.teeth == round(body.teeth)
        require(f"{side}.teeth", body.teeth, whole, "must be a whole number of at least 3")
        for name in ("addendum", "dedendum", "face_width"):
            value = getattr(body, name)
            require(f"{side}.{name}", value, value > 0, "must be greater than zero")
        for name in ("fillet_radius", "bore_radius"):
            value = getattr(body, name)
            require(f"{side}.{name}", value, value >= 0, "must not be negative")


def require(key: str, value: Any, holds: bool, rule: str) -> None:
    """Refuse a number of the drive that is not finite or breaks a rule."""
    if not math.isfinite(value):
        raise InputError(f"drive.{key}", value, "must be a finite number")
    if not holds:
        name = key.rpartition(".")[2]
        shown = f"{math.degrees(value):.4g}°" if name == "pressure_angle" else value
        raise InputError(f"drive.{key}", millimetres(value) if name in _LENGTHS else shown, rule)


def replaced(drive: Drive, side: Side, **changes: Any) -> Drive:
    """Return the drive with some numbers of one body changed."""
    return drive._replace(**{side: body_of(drive, side)._replace(**changes)})


def boundary(holds: Callable[[float], bool], bad: float, good: float) -> float | None:
    """Find the value nearest to `bad` that obeys a rule, rounded to 0.001 on the safe side.

    None if `good` breaks the rule too.
    """
    if not holds(good):
        return None
    sign = 1 if good > bad else -1
    for _ in range(30):
        middle = (bad + good) / 2
        bad, good = (bad, middle) if holds(middle) else (middle, good)
    return sign * math.ceil(sign * good * 1000) / 1000


def advice(limit: float | None, bound: str, otherwise: str) -> str:
    """Say which limit to keep to, or what else to do where there is none."""
    return otherwise if limit is None else f"use {bound} {limit:.7g}"


def millimetres(length: float) -> str:
    """Write a length given in m."""
    return f"{1e3 * length:.4g} mm"
