"""Checks of a family with one path for rack and mate: does the path reach as far as the teeth do."""

from collections.abc import Callable
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, Side, body_of, tip_radius
from tribodyn.geometry.path import Path, kinematics, radius, seen_from

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
    between the tips each flank must move the way it is convex to (u_p, u_g > 0), which is where it exists.

    Parameters
    ----------
    drive : plain numbers
    path : working path
    lower, upper : signed distances from and to which the path is known, m; lower < 0 < upper
    advice : what to change for either half
    """
    active = {}
    for side in SIDES:
        view, body = seen_from(path, side), body_of(drive, side)
        recess, approach = (upper, -lower) if side == "pinion" else (-lower, upper)
        distance = recess * np.linspace(0.0, 1.0, _SAMPLES)
        beyond = radius(view, distance) >= tip_radius(drive, side)
        half = 1 if side == "pinion" else -1
        if not beyond.any():
            height = _millimetres(np.nanmax(distance * np.sin(view.pressure_angle(distance))))
            _refuse(
                drive, half, advice, f"the path ends {height} from the pitch line, before the {side}'s tip"
            )
        active[side] = float(distance[np.argmax(beyond)])
        distance = approach * np.linspace(0.0, 1.0, _SAMPLES)
        sine = np.sin(view.pressure_angle(-distance))
        rounding = drive.module * body.fillet_radius
        left = (distance - rounding) * sine - (drive.module * body.dedendum - rounding)
        if not (left >= 0).any():
            height = _millimetres(np.nanmax(distance * sine))
            rule = f"the path ends {height} from the pitch line, before the flank of the {side}'s rack"
            _refuse(drive, -half, advice, rule)
    inner = np.linspace(1e-6, 1.0, _SAMPLES)
    for half, end in ((-1, -active["gear"]), (1, active["pinion"])):
        motion = kinematics(path, end * inner)
        speeds: dict[Side, Any] = {"pinion": motion.pinion_speed, "gear": motion.gear_speed}
        for side, speed in speeds.items():
            if not np.all(speed > 0):
                _refuse(drive, half, advice, f"the working flank of the {side} would be undercut")


def _refuse(drive: Drive, half: int, advice: Advice, rule: str) -> None:
    key, value, remedy = advice(drive, half)
    raise InputError(f"drive.{key}", value, rule, remedy)


def _millimetres(length: Any) -> str:
    return f"{1e3 * float(length):.4g} mm"
