"""What is wrong with a bearing of a drawn shaft."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.input.tables.bearings import broken_matrix
from tribodyn.input.tables.drawn_bearings import (
    OF_CATALOGUE,
    ROLLER_SIZES,
    SIZES,
    SPRINGS,
    BearingOfShaft,
    held_by,
    sized,
)
from tribodyn.train.elastic.bearing_sizes import static_pressure
from tribodyn.train.elastic.rolling_bearing import BearingRows, answer, contact_pressure

#: Clearance and preload over the diameter of the rolling elements, at most: beyond the greatest clearance
#: class of ISO 5753, and what a ball takes up between its grooves.
LARGEST_CLEARANCE, LARGEST_FIT = 0.03, 0.1
#: Length of a roller over its diameter: beyond it is no needle; distance of rows over the pitch diameter.
_LONGEST, _FARTHEST = 10.0, 2.0
#: Contact angles of angular contact ball bearings by ISO 281.
_LEAST_ANGLE, _MOST_ANGLE = math.radians(10.0), math.radians(45.0)

#: Keys that rolling bearings of a type need, and those that they may have besides; others have no effect.
_NEEDED: dict[str, tuple[str, ...]] = {
    "deep-groove-ball": SIZES,
    "angular-contact-ball": (*SIZES, "contact_angle"),
    "four-point-contact-ball": (*SIZES, "contact_angle"),
    "self-aligning-ball": (*SIZES, "contact_angle"),
    "cylindrical-roller": ROLLER_SIZES,
    "needle-roller": ROLLER_SIZES,
    "tapered-roller": (*ROLLER_SIZES, "contact_angle"),
    "spherical-roller": (*ROLLER_SIZES, "contact_angle"),
    "toroidal-roller": (*ROLLER_SIZES, "raceway_radius"),
}
_OPTIONAL: dict[str, tuple[str, ...]] = {
    "deep-groove-ball": ("clearance", "static_factor"),
    "angular-contact-ball": (
        "thrust",
        "arrangement",
        "row_distance",
        "preload",
        "preload_force",
        "static_factor",
    ),
    "four-point-contact-ball": ("clearance",),
    "self-aligning-ball": ("clearance",),
    "cylindrical-roller": ("clearance", "rows", "row_distance"),
    "needle-roller": ("clearance", "rows", "row_distance"),
    "tapered-roller": ("thrust", "arrangement", "row_distance", "preload", "preload_force"),
    "spherical-roller": ("clearance",),
    "toroidal-roller": ("clearance",),
}
#: Those that take axial load.
LOCATING = (
    *("deep-groove-ball", "angular-contact-ball", "four-point-contact-ball", "self-aligning-ball"),
    *("tapered-roller", "spherical-roller"),
)
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
_RATINGS = "preload_force", "dynamic_rating", "static_rating", "fatigue_load_limit", "contamination_factor"


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
        kind = bearing.type
        estimated = list(_broken_catalogue(key, bearing, kind))
        bearing = bearing if estimated else sized(bearing)
        broken = [*_broken_keys(key, bearing, kind), *_broken_sizes(key, bearing)]
        yield from estimated or broken or _overloaded(key, bearing)


def _broken_catalogue(key: str, bearing: BearingOfShaft, kind: str) -> Iterator[InputError]:
    """What is wrong with the sizes from which the inside is estimated; only the first of it."""
    there = [name for name in OF_CATALOGUE if getattr(bearing, name) is not None]
    if not there:
        return
    inside = [name for name in ROLLER_SIZES if getattr(bearing, name) is not None]
    lacking = [name for name in (*OF_CATALOGUE, "static_rating") if getattr(bearing, name) is None]
    bore, outside = bearing.bore or 0.0, bearing.outside_diameter or 0.0
    if kind == "needle-roller":
        rule = "no estimate of needle roller bearings: their needles do not follow from their size"
        yield InputError(f"{key}.{there[0]}", None, rule, f"give {', '.join(ROLLER_SIZES)}")
    elif inside:
        rule = "contradicts bore and outside_diameter, from which it is estimated"
        yield InputError(f"{key}.{inside[0]}", None, rule, "give the one or the other")
    elif lacking:
        rule = f"missing: the rolling elements are estimated from it and {there[0]}"
        yield InputError(f"{key}.{lacking[0]}", None, rule, f"add it, or give {', '.join(ROLLER_SIZES)}")
    elif bore >= outside:
        rule = f"is not larger than the bore, {shown_length(bore)}"
        yield InputError(
            f"{key}.outside_diameter", shown_length(outside), rule, "check both, and their units"
        )
    elif bearing.contact_angle is not None or "contact_angle" not in _NEEDED[kind]:
        found = sized(bearing)
        most = math.pi / math.asin((found.element_diameter or 0.0) / (found.pitch_diameter or 1.0))
        count, length = found.elements or 0, found.roller_length or 0.0
        if not 3 <= count <= most or length > outside - bore:
            rows = f"{count} rolling elements of {1e3 * (found.element_diameter or 0.0):.3g} mm"
            rows += f" and {1e3 * length:.3g} mm length" if length else ""
            rule = f"asks for {rows} in a row, which no bearing of {1e3 * bore:g} x {1e3 * outside:g} mm has"
            shown = f"{(bearing.static_rating or 0.0) / 1e3:.6g} kN"
            yield InputError(f"{key}.static_rating", shown, rule, "check C_0, bore and outside_diameter")


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
    for name in ("matrix_units", *_EXAMPLES, "clearance", "preload", "preload_force", "static_factor"):
        if getattr(bearing, name) and name not in (*needed, *optional):
            rule = f"has no effect with {what}"
            yield InputError(f"{key}.{name}", None, rule, f"leave {name} out")
    if not bearing.locating and "thrust" in needed:
        rule = "its rings come apart where one of them slides"
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
    if bearing.preload and bearing.preload_force is not None:
        rule = "contradicts preload_force, from which it follows"
        yield InputError(f"{key}.preload", shown_length(bearing.preload), rule, "give the one or the other")
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
    rows = bearing.arrangement is not None or bearing.type == "four-point-contact-ball"
    sliding = rows and not bearing.locating
    if bearing.force != "linear" and (sliding or bearing.type == "toroidal-roller"):
        what = "a pair whose rings slide" if sliding else f"type = {quoted(bearing.type)}"
        rule, remedy = f"has no law for {what}", "leave force out"
        yield InputError(f"{key}.force", quoted(bearing.force), rule, remedy)
    length, distance = bearing.roller_length, bearing.row_distance
    if length is not None and size and length > _LONGEST * size:
        rule = f"is more than {_LONGEST:g} times the rollers' diameter, {shown_length(size)}"
        yield InputError(f"{key}.roller_length", shown_length(length), rule, "check both, and their units")
    if distance is not None and pitch and distance > _FARTHEST * pitch:
        rule = f"is more than twice the pitch diameter, {shown_length(pitch)}"
        remedy = "check its unit, or draw two bearings"
        yield InputError(f"{key}.row_distance", shown_length(distance), rule, remedy)
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


def _overloaded(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
    """Refuse what preload alone presses beyond the static rating of ISO 76."""
    force = bearing.preload_force
    held: Any = held_by(bearing.model_copy(update={"preload_force": None}))
    row = held.rows[0] if isinstance(held, BearingRows) else held
    if force is None:
        load = float(np.max(answer(held, np.zeros(5)).element_load))
    else:
        load = force / (row.elements * math.sin(row.contact_angle))
    pressure = contact_pressure(row, load)
    most = static_pressure(row)
    if pressure > most:
        name = "preload" if bearing.preload else "clearance"
        rule = (
            f"presses the rolling elements with {pressure / 1e6:,.0f} MPa before any load, above "
            f"{most / 1e6:,.0f} MPa at which ISO 76 rates the static load"
        )
        if force is not None:
            yield InputError(f"{key}.preload_force", f"{force:g} N", rule, "check its unit")
            return
        remedy = "check its unit: fits are micrometres"
        yield InputError(f"{key}.{name}", shown_length(getattr(bearing, name)), rule, remedy)


def shown_length(length: float) -> str:
    """A length as messages have it."""
    return f"{1e3 * length:.6g} mm"


def _broken_spring(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
    """What a spring or a matrix lacks, and what belongs to rolling bearings."""
    yield from broken_matrix(f"{key}.matrix", bearing.matrix, bearing.matrix_units)
    if bearing.force != "linear":
        rule = "is that of rolling elements, and type is missing"
        remedy = 'add type = "deep-groove-ball" with its sizes, or leave force out'
        yield InputError(f"{key}.force", quoted(bearing.force), rule, remedy)
    for name in (*_EXAMPLES, *OF_CATALOGUE, *_RATINGS):
        if getattr(bearing, name) is not None:
            rule = "is that of a rolling bearing, and type is missing"
            remedy = f'add type = "deep-groove-ball", or leave {name} out'
            yield InputError(f"{key}.{name}", None, rule, remedy)
