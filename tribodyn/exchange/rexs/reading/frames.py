"""Where the parts of a REXS model stand, and whether what it says of that agrees."""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import Sheet

#: How far what is said twice may differ: lengths in m, angles in rad.
_NEAR, _NEAR_ANGLE = 1e-5, 2e-3
#: Frames inside each other.
_DEEPEST = 20


class Frame(NamedTuple):
    """Origin and axes (u, v, w) of a part, in the coordinates of the gear unit; m."""

    origin: np.ndarray
    axes: np.ndarray  # rows

    @property
    def along(self) -> np.ndarray:
        """Its axis u."""
        return self.axes[0]


_TOP = Frame(np.zeros(3), np.eye(3))


def frame_of(sheet: Sheet, part: Component, depth: int = 0) -> Frame | None:
    """The frame of a part; None where the file says none."""
    origin, u, w = (sheet.vector(part, key) for key in (rexs.ORIGIN, rexs.U_AXIS, rexs.W_AXIS))
    if origin is None or u is None or w is None:
        return None
    if depth > _DEEPEST:
        raise sheet.refused(part, "its place refers to itself", "", rexs.FRAME.name)
    reference = sheet.whole(part, rexs.FRAME)
    above = sheet.model.parts.get(reference) if reference not in (None, part.number) else None
    base = (frame_of(sheet, above, depth + 1) if above is not None else None) or _TOP
    along, up = np.array(u), np.array(w)
    if min(np.linalg.norm(along), np.linalg.norm(up)) == 0.0:
        raise sheet.refused(part, "an axis of no length", "", rexs.U_AXIS.name)
    along, up = along / np.linalg.norm(along), up / np.linalg.norm(up)
    if abs(along @ up) > _NEAR_ANGLE:
        raise sheet.refused(part, "is not at a right angle to u_axis_vector", "", rexs.W_AXIS.name)
    axes = np.array([along, np.cross(up, along), up])
    if part.type == "gear_unit":  # the train is written in its coordinates
        return _TOP
    return Frame(base.origin + np.array(origin) @ base.axes, axes @ base.axes)


def sense_of(sheet: Sheet, part: Component) -> int:
    """1 where a part's axis is that of the gear unit, -1 where it points the other way."""
    frame = frame_of(sheet, part)
    if frame is None:
        return 1
    if abs(abs(frame.along[0]) - 1.0) > _NEAR_ANGLE:
        rule = "its axis is not parallel to that of the gear unit"
        raise sheet.refused(part, rule, "bevel, worm and crossed gears are not taken", rexs.U_AXIS.name)
    return 1 if frame.along[0] > 0 else -1


def middle_of_gear(sheet: Sheet, gear: Component, shaft: Component) -> float | None:
    """Where the middle of a gear's face is on its shaft, m from its start; the file's two ways must agree."""
    place, width = sheet.si(gear, rexs.U_ON_SHAFT), sheet.si(gear, rexs.FACE_WIDTH) or 0.0
    here, there = frame_of(sheet, gear), frame_of(sheet, shaft)
    from_start = (1, 0) == tuple(map(int, sheet.model.version.split(".")[:2]))
    if here is None or there is None:
        return place + 0.5 * width if place is not None and from_start else place
    along = float((here.origin - there.origin) @ there.along)
    aside = np.linalg.norm(here.origin - there.origin - along * there.along)
    if aside > _NEAR:
        rule = f"is {1e3 * aside:.6g} mm beside the axis of {shaft}"
        raise sheet.refused(gear, rule, "put the gear on its shaft", rexs.ORIGIN.name)
    if place is not None and min(abs(along - place), abs(along - place - 0.5 * width)) > _NEAR:
        rule = f"but support_vector puts it at {1e3 * along:.6g} mm on {shaft}"
        raise sheet.refused(gear, rule, "let both say the same", rexs.U_ON_SHAFT.name)
    if place is not None and abs(along - place) <= _NEAR:
        return place
    return along if place is None else place + 0.5 * width


class LineOfCentres(NamedTuple):
    """From the axis of a stage's first gear to that of its second: distance (m), direction (rad, from x)."""

    distance: float | None
    azimuth: float | None


def line_of_centres(sheet: Sheet, stage: Component, first: Component, second: Component) -> LineOfCentres:
    """What a stage and the places of its gears say, if they agree; x is v of the gear unit, y its w."""
    distance, angle = sheet.si(stage, rexs.CENTRE_DISTANCE), sheet.si(stage, rexs.ROTATING_ANGLE)
    said = None if angle is None else math.remainder(0.5 * math.pi - angle, 2 * math.pi)
    here, there = frame_of(sheet, first), frame_of(sheet, second)
    if here is None or there is None:
        return LineOfCentres(distance, said)
    apart = (there.origin - here.origin)[1:]
    found = float(np.hypot(*apart))
    if distance is not None and abs(found - distance) > _NEAR + 1e-6 * distance:
        rule = f"but the axes of {first} and {second} are {1e3 * found:.9g} mm apart"
        raise sheet.refused(stage, rule, "let both say the same", rexs.CENTRE_DISTANCE.name)
    direction = math.atan2(apart[1], apart[0])
    if said is not None and abs(math.remainder(said - direction, 2 * math.pi)) > _NEAR_ANGLE:
        turned = math.degrees(math.remainder(0.5 * math.pi - direction, 2 * math.pi))
        rule = f"but the axes of {first} and {second} stand at {turned:.6g} deg"
        raise sheet.refused(stage, rule, "let both say the same", rexs.ROTATING_ANGLE.name)
    widths = [sheet.si(gear, rexs.FACE_WIDTH) or 0.0 for gear in (first, second)]
    beside = abs(there.origin[0] - here.origin[0])
    if beside > 0.5 * sum(widths):
        rule = f"the faces of {first} and {second} are {1e3 * beside:.6g} mm apart along their axes"
        raise sheet.refused(stage, rule, "check support_vector and face_width of both")
    return LineOfCentres(distance if distance is not None else found, said if said is not None else direction)
