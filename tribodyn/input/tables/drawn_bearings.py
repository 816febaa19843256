"""Bearings of drawn shafts: rolling bearings by type and size, springs, matrices; what is wrong with them."""

import math
from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Positive, Switch, Table, Text, written
from tribodyn.input.tables.bearings import MatrixUnits, Rows, Stiffness, broken_matrix, matrix_of
from tribodyn.train.elastic.bearing_types import (
    Arrangement,
    four_point,
    paired,
    self_aligning_balls,
    spherical_rollers,
    toroidal_rollers,
)
from tribodyn.train.elastic.rolling_bearing import BallRow, BearingRows, RollerRow, answer, contact_pressure
from tribodyn.train.elastic.system import Matrix

Size = Annotated[float, InUnit(units.positive(units.LENGTH), "30 mm")]
Place = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]
Fit = Annotated[float, InUnit(units.DEVIATION, "10 um")]
Rating = Annotated[float, InUnit(units.positive(units.FORCE), "30 kN")]

#: Clearance and preload over the diameter of the rolling elements, at most: beyond the greatest clearance
#: class of ISO 5753, and what a ball takes up between its grooves.
LARGEST_CLEARANCE, LARGEST_FIT = 0.03, 0.1
#: Contact pressure, Pa, at which ISO 76 rates the static load: balls, self-aligning ones, rollers.
STATIC_PRESSURE, _SELF_ALIGNING_PRESSURE, _ROLLER_PRESSURE = 4200e6, 4600e6, 4000e6
#: Contact angles of angular contact ball bearings by ISO 281.
_LEAST_ANGLE, _MOST_ANGLE = math.radians(10.0), math.radians(45.0)

DrawnType = Literal[
    "deep-groove-ball",
    "angular-contact-ball",
    "four-point-contact-ball",
    "self-aligning-ball",
    "cylindrical-roller",
    "needle-roller",
    "tapered-roller",
    "spherical-roller",
    "toroidal-roller",
]
_SIZES = ("elements", "element_diameter", "pitch_diameter")
_ROLLERS = (*_SIZES, "roller_length")
#: Keys that rolling bearings of a type need, and those that they may have besides; others have no effect.
_NEEDED: dict[str, tuple[str, ...]] = {
    "deep-groove-ball": _SIZES,
    "angular-contact-ball": (*_SIZES, "contact_angle"),
    "four-point-contact-ball": (*_SIZES, "contact_angle"),
    "self-aligning-ball": (*_SIZES, "contact_angle"),
    "cylindrical-roller": _ROLLERS,
    "needle-roller": _ROLLERS,
    "tapered-roller": (*_ROLLERS, "contact_angle"),
    "spherical-roller": (*_ROLLERS, "contact_angle"),
    "toroidal-roller": (*_ROLLERS, "raceway_radius"),
}
_OPTIONAL: dict[str, tuple[str, ...]] = {
    "deep-groove-ball": ("clearance", "static_factor"),
    "angular-contact-ball": ("thrust", "arrangement", "row_distance", "preload", "static_factor"),
    "four-point-contact-ball": ("clearance",),
    "self-aligning-ball": ("clearance",),
    "cylindrical-roller": ("clearance", "rows", "row_distance"),
    "needle-roller": ("clearance", "rows", "row_distance"),
    "tapered-roller": ("thrust", "arrangement", "row_distance", "preload"),
    "spherical-roller": ("clearance",),
    "toroidal-roller": ("clearance",),
}
#: Those that take axial load, and those of them that also run in a ring that slides.
LOCATING = (
    *("deep-groove-ball", "angular-contact-ball", "four-point-contact-ball", "self-aligning-ball"),
    *("tapered-roller", "spherical-roller"),
)
_SLIDING = ("deep-groove-ball", "self-aligning-ball", "spherical-roller")
_EXAMPLES = {
    "elements": "9",
    "element_diameter": '"12.7 mm"',
    "pitch_diameter": '"65 mm"',
    "roller_length": '"14 mm"',
    "contact_angle": '"14 deg"',
    "thrust": '"+z"',
    "raceway_radius": '"150 mm"',
    "row_distance": '"20 mm"',
    "arrangement": '"O"',
    "rows": "2",
}
#: What else is a rolling bearing's alone.
_OF_CATALOGUE = "dynamic_rating", "static_rating", "fatigue_load_limit", "contamination_factor"
#: Springs along x, y and z, and about x and y.
SPRINGS = ("stiffness_x", "stiffness_y", "stiffness_axial", "stiffness_tilt")


class BearingOfShaft(Table):
    """A bearing of a shaft: a rolling bearing by type and size, springs, or a matrix."""

    position: Place
    type: DrawnType | None = None
    elements: Annotated[int, Field(strict=True, ge=3, le=1000)] | None = None
    element_diameter: Size | None = None
    pitch_diameter: Size | None = None
    roller_length: Size | None = None
    contact_angle: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "14 deg")] | None = None
    thrust: Literal["+z", "-z"] | None = None
    arrangement: Arrangement | None = None
    rows: Literal[1, 2] | None = None
    row_distance: Size | None = None
    raceway_radius: Size | None = None
    clearance: Fit = written("0 um")
    preload: Fit = written("0 um")
    locating: Switch = True
    seat: Text | None = None
    dynamic_rating: Rating | None = None
    static_rating: Rating | None = None
    fatigue_load_limit: Rating | None = None
    contamination_factor: Annotated[float, Field(strict=True, gt=0, le=1)] | None = None
    static_factor: Positive | None = None
    stiffness_x: Stiffness | None = None
    stiffness_y: Stiffness | None = None
    stiffness_axial: Stiffness | None = None
    stiffness_tilt: Annotated[float, InUnit(units.positive(units.TORSIONAL_STIFFNESS))] | None = None
    matrix: Rows = None
    matrix_units: MatrixUnits = None

    @property
    def thrust_rows(self) -> int:
        """Rows that share a radial load and take thrust both ways, as ISO 281 counts them: 2 of O and X."""
        return 2 if self.arrangement in ("O", "X") else 1


def held_by(table: BearingOfShaft) -> BallRow | RollerRow | BearingRows | Matrix:
    """A bearing that breaks no rule as the physics takes it."""
    if table.matrix is not None:
        return matrix_of(table.matrix, table.matrix_units)
    if table.type is None:
        x, y, z, tilt = (getattr(table, name) or 0.0 for name in SPRINGS)
        return tuple(map(tuple, np.diag([x, y, z, tilt, tilt]).tolist()))
    sizes: Any = {
        "elements": table.elements,
        "diameter": table.element_diameter,
        "pitch_diameter": table.pitch_diameter,
        "clearance": table.clearance,
        "contact_angle": table.contact_angle or 0.0,
        "thrust": {"+z": 1, "-z": -1, None: 0}[table.thrust],
        "preload": table.preload,
        "located": table.locating,
    }
    if table.type.endswith("ball"):
        balls = BallRow(**sizes)
        if table.type == "four-point-contact-ball":
            return four_point(balls)
        return self_aligning_balls(balls) if table.type == "self-aligning-ball" else _pair(balls, table)
    rollers = RollerRow(**sizes, length=table.roller_length or 0.0)
    if table.type == "spherical-roller":
        return spherical_rollers(rollers)
    if table.type == "toroidal-roller":
        return toroidal_rollers(rollers, table.raceway_radius or 0.0)
    return _pair(rollers, table)


def _pair(row: BallRow | RollerRow, table: BearingOfShaft) -> BallRow | RollerRow | BearingRows:
    """One row, or two of them."""
    if table.arrangement is None and table.rows != 2:
        return row
    return paired(row, table.row_distance or 0.0, table.arrangement or "tandem")


def broken_bearing_of_shaft(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
    """Go through what is wrong with the bearing at a key."""
    ways = [
        name
        for name, there in (
            ("type", bearing.type is not None),
            ("matrix", bearing.matrix is not None),
            ("stiffness", any(getattr(bearing, name) is not None for name in SPRINGS)),
        )
        if there
    ]
    if len(ways) != 1:
        rule = f"given as {' and '.join(ways)}" if ways else "says nothing of how stiff the bearing is"
        remedy = "give one: type with its sizes, springs such as stiffness_x, or matrix"
        yield InputError(key, None, rule, remedy)
    elif bearing.type is None:
        yield from _broken_spring(key, bearing)
    else:
        broken = [*_broken_keys(key, bearing, bearing.type), *_broken_sizes(key, bearing)]
        yield from broken or _overloaded(key, bearing, bearing.type)


def _broken_keys(key: str, bearing: BearingOfShaft, kind: str) -> Iterator[InputError]:
    """What a type lacks, and what it has no use for."""
    needed, optional = _NEEDED[kind], _OPTIONAL[kind]
    if "arrangement" in optional:
        pair = bearing.arrangement is not None
        needed += ("row_distance",) if pair else ()
        needed += ("thrust",) if bearing.arrangement in (None, "tandem") else ()
        optional = tuple(one for one in optional if pair or one != "row_distance")
        optional = tuple(one for one in optional if one != "thrust")
    elif bearing.rows == 2:
        needed += ("row_distance",)
    elif "rows" in optional:
        optional = tuple(one for one in optional if one != "row_distance")
    what = f"type = {quoted(kind)}"
    if bearing.arrangement is not None and "arrangement" in optional:
        what += f" and arrangement = {quoted(bearing.arrangement)}"
    for name in needed:
        if getattr(bearing, name) is None:
            yield InputError(
                f"{key}.{name}", rule=f"missing: {what} needs it", remedy=f"add {name} = {_EXAMPLES[name]}"
            )
    for name in ("matrix_units", *_EXAMPLES, "clearance", "preload", "static_factor"):
        if getattr(bearing, name) and name not in (*needed, *optional):
            rule = f"has no effect with {what}"
            yield InputError(f"{key}.{name}", None, rule, f"leave {name} out")
    if not bearing.locating and kind in LOCATING and kind not in _SLIDING:
        single = bearing.arrangement is None and kind != "four-point-contact-ball"
        rule = (
            "its rings come apart where one of them slides"
            if single
            else "is not taken of two rows like these"
        )
        yield InputError(f"{key}.locating", "false", rule, "leave it out")


def _broken_sizes(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
    """Sizes that no bearing has."""
    size, pitch = bearing.element_diameter, bearing.pitch_diameter
    if bearing.elements and size and pitch:
        most = math.pi / math.asin(min(size / pitch, 1.0))
        if bearing.elements > most:
            rule = f"no more than {math.floor(most)} of them fit side by side on the pitch circle"
            remedy = "check elements (of one row), element_diameter and pitch_diameter"
            yield InputError(f"{key}.elements", bearing.elements, rule, remedy)
    for name, most in (("clearance", LARGEST_CLEARANCE), ("preload", LARGEST_FIT)) if size else ():
        fit = getattr(bearing, name)
        if abs(fit) > most * (size or 0.0):
            rule = f"is more than {most:.0%} of the rolling elements' diameter, {1e3 * (size or 0.0):g} mm"
            yield InputError(f"{key}.{name}", shown_length(fit), rule, "check its unit: fits are micrometres")
    angle = bearing.contact_angle
    if angle is not None:
        shown = f"{math.degrees(angle):.6g} deg"
        if angle >= math.radians(60.0):
            rule = "60 deg or more: a thrust bearing"
            yield InputError(f"{key}.contact_angle", shown, rule, "write 10 to 30 deg")
        elif bearing.type in ("angular-contact-ball", "four-point-contact-ball") and not (
            _LEAST_ANGLE - 1e-9 <= angle <= _MOST_ANGLE + 1e-9
        ):
            rule = "ISO 281 has no factors X and Y below 10 and above 45 deg"
            yield InputError(
                f"{key}.contact_angle", shown, rule, "write 10 to 45 deg, as the catalogue has it"
            )
    length, distance = bearing.roller_length, bearing.row_distance
    needed = (length or size or 0.0) * math.cos(angle or 0.0)
    if distance is not None and distance < needed:
        rule = f"is less than the rolling elements need, {shown_length(needed)}"
        remedy = "it is from the middle of one row to that of the other; of a pair, the width of one bearing"
        yield InputError(f"{key}.row_distance", shown_length(distance), rule, remedy)
    if (
        bearing.type == "spherical-roller"
        and angle
        and length
        and pitch
        and pitch * math.sin(angle) < 0.5 * length
    ):
        rule = f"its two rows of rollers would run into each other at {shown_length(pitch * math.tan(angle))}"
        remedy = "check contact_angle and roller_length: catalogues give e = 1.5 tan α"
        yield InputError(f"{key}.roller_length", shown_length(length), rule, remedy)
    if (
        bearing.raceway_radius is not None
        and size
        and pitch
        and bearing.raceway_radius <= (pitch + size) / 2.0
    ):
        rule = f"is not larger than the outer raceway's own, {shown_length((pitch + size) / 2.0)}"
        remedy = "it is that of the raceway's profile: about (B/k_2 + D)/2 with k_2 of the catalogue"
        yield InputError(f"{key}.raceway_radius", shown_length(bearing.raceway_radius), rule, remedy)


def _overloaded(key: str, bearing: BearingOfShaft, kind: str) -> Iterator[InputError]:
    """Refuse what preload alone presses beyond the static rating of ISO 76."""
    held: Any = held_by(bearing)
    load = float(np.max(answer(held, np.zeros(5)).element_load))
    row = held.rows[0] if isinstance(held, BearingRows) else held
    pressure = contact_pressure(row, load)
    most = STATIC_PRESSURE if kind.endswith("ball") else _ROLLER_PRESSURE
    most = _SELF_ALIGNING_PRESSURE if kind == "self-aligning-ball" else most
    if pressure > most:
        name = "preload" if bearing.preload else "clearance"
        rule = (
            f"presses the rolling elements with {pressure / 1e6:,.0f} MPa before any load, above "
            f"{most / 1e6:,.0f} MPa at which ISO 76 rates the static load"
        )
        remedy = "check its unit: fits are micrometres"
        yield InputError(f"{key}.{name}", shown_length(getattr(bearing, name)), rule, remedy)


def shown_length(length: float) -> str:
    """A length as messages have it."""
    return f"{1e3 * length:.6g} mm"


def _broken_spring(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
    """What a spring or a matrix lacks, and what belongs to rolling bearings."""
    yield from broken_matrix(f"{key}.matrix", bearing.matrix, bearing.matrix_units)
    for name in (*_EXAMPLES, *_OF_CATALOGUE):
        if getattr(bearing, name) is not None:
            rule = "is that of a rolling bearing, and type is missing"
            remedy = f'add type = "deep-groove-ball", or leave {name} out'
            yield InputError(f"{key}.{name}", None, rule, remedy)
