"""Shafts as drawn: sections, gears and bearings at their places; and what is wrong with them."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import InUnit, NotNegative, Positive, Switch, Table, Text, written
from tribodyn.input.tables.bearings import MatrixUnits, Rows, Stiffness, broken_matrix

Size = Annotated[float, InUnit(units.positive(units.LENGTH), "30 mm")]
Place = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 mm")]
Fit = Annotated[float, InUnit(units.DEVIATION, "10 um")]
Rating = Annotated[float, InUnit(units.positive(units.FORCE), "30 kN")]
Frequency = Annotated[float, InUnit(units.positive(units.ANGULAR_FREQUENCY), "5 kHz")]


#: Largest diameter of a shaft over the smallest, and over its length: stiffness in bending goes with the
#: fourth power, of which rounding leaves 2e-6.
MOST_STEPPED, THICKEST = 300.0, 30.0
#: Clearance and preload over the diameter of the rolling elements, at most.
LARGEST_FIT = 0.1

DrawnType = Literal["deep-groove-ball", "cylindrical-roller", "tapered-roller"]
#: Keys that rolling bearings of a type need, and those that others have no use for.
_NEEDED = {
    "deep-groove-ball": ("elements", "element_diameter", "pitch_diameter"),
    "cylindrical-roller": ("elements", "element_diameter", "pitch_diameter", "roller_length"),
    "tapered-roller": (
        *("elements", "element_diameter", "pitch_diameter", "roller_length"),
        *("contact_angle", "thrust"),
    ),
}
_UNREAD = {
    "deep-groove-ball": ("roller_length", "contact_angle", "thrust", "preload"),
    "cylindrical-roller": ("contact_angle", "thrust", "preload", "static_factor"),
    "tapered-roller": ("clearance", "static_factor"),
}
_EXAMPLES = {
    "elements": "9",
    "element_diameter": '"12.7 mm"',
    "pitch_diameter": '"65 mm"',
    "roller_length": '"14 mm"',
    "contact_angle": '"14 deg"',
    "thrust": '"+z"',
}
#: What else is a rolling bearing's alone.
_OF_CATALOGUE = "dynamic_rating", "static_rating", "fatigue_load_limit", "contamination_factor"
#: Springs along x, y and z, and about x and y.
SPRINGS = ("stiffness_x", "stiffness_y", "stiffness_axial", "stiffness_tilt")


class SectionOfShaft(Table):
    """A stretch of a shaft with one section; they follow each other from the end at smaller z."""

    length: Size
    diameter: Size
    bore: Place = written("0 mm")


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


class DrawnShaft(Table):
    """A shaft as drawn, straight along z, its gears and its bearings in the housing."""

    section: tuple[SectionOfShaft, ...] = Field(min_length=1, max_length=200)
    gear_position: Place | None = None
    positions: dict[PartName, Place] = written({})
    bearing: tuple[BearingOfShaft, ...] = Field(min_length=1, max_length=20)
    damping_ratio: NotNegative = 0.05
    youngs_modulus: Annotated[float, InUnit(units.positive(units.PRESSURE))] = written("206 GPa")
    poisson_ratio: Annotated[float, Field(strict=True, ge=0, lt=0.5)] = 0.3
    density: Annotated[float, InUnit(units.positive(units.DENSITY))] = written("7850 kg/m**3")
    modes_up_to: Frequency | None = None

    def placed(self, gear: str) -> dict[str, float]:
        """Places of all that it carries, by name; `gear` is the one whose place is `gear_position`, m."""
        return self.positions if self.gear_position is None else {gear: self.gear_position}


def torsional_stiffness(shaft: DrawnShaft, span: tuple[float, float]) -> float:
    """Stiffness in torsion of a shaft between two places along it (m), N m/rad: sections in series."""
    start, yielding, (low, high) = 0.0, 0.0, sorted(span)
    for section in shaft.section:
        end = start + section.length
        inside = max(0.0, min(end, high) - max(start, low))
        yielding += inside * 32.0 / (math.pi * (section.diameter**4 - section.bore**4))
        start = end
    return shaft.youngs_modulus / (2.0 * (1.0 + shaft.poisson_ratio)) / yielding


def _shown(length: float) -> str:
    return f"{1e3 * length:.6g} mm"


def broken_shaft(key: str, shaft: DrawnShaft) -> Iterator[InputError]:
    """Go through what is wrong with the shaft that a key draws."""
    length = sum(section.length for section in shaft.section)
    thinnest = min(range(len(shaft.section)), key=lambda number: shaft.section[number].diameter)
    for number, section in enumerate(shaft.section):
        others = (
            (shaft.section[thinnest].diameter, MOST_STEPPED, f"diameter of section {thinnest + 1}"),
            (length, THICKEST, "length of the shaft"),
        )
        for other, most, name in others:
            if section.diameter > most * other:
                times = f"{section.diameter / other:.3g} times the {name}, {_shown(other)}"
                rule = f"is {times}, above {most:g}: too stiff beside it for its bending to be computed"
                place = f"{key}.section.{number}.diameter"
                yield InputError(place, _shown(section.diameter), rule, "check both, and their units")
                break
        if section.bore >= section.diameter:
            rule = f"must be smaller than the diameter, {_shown(section.diameter)}"
            yield InputError(
                f"{key}.section.{number}.bore", _shown(section.bore), rule, "check both, and their units"
            )
    if (shaft.gear_position is None) is not bool(shaft.positions):
        what, remedy = ("contradicts positions", "leave the one or the other out")
        if shaft.gear_position is None:
            what, remedy = "missing", 'add gear_position = "50 mm", or positions of several gears'
        yield InputError(f"{key}.gear_position", None, what, remedy)
    on_it = {f"{key}.positions.{name}": place for name, place in shaft.positions.items()}
    if shaft.gear_position is not None:
        on_it[f"{key}.gear_position"] = shaft.gear_position
    for place, position in on_it.items():
        if list(on_it.values()).index(position) < list(on_it).index(place):
            rule = "is where another gear or body of the shaft is"
            yield InputError(place, _shown(position), rule, "give each a place of its own")
    places = [(place, position, "the gear would not be on it") for place, position in on_it.items()]
    places += [
        (f"{key}.bearing.{number}.position", bearing.position, "the bearing would not be on it")
        for number, bearing in enumerate(shaft.bearing)
    ]
    for place, position, why in places:
        if position > length:
            rule = f"is beyond the end of the shaft, whose sections are {_shown(length)} long: {why}"
            remedy = f"write 0 mm to {_shown(length)}, or lengthen the sections"
            yield InputError(place, _shown(position), rule, remedy)
    broken = [
        error
        for number, bearing in enumerate(shaft.bearing)
        for error in _broken_bearing(f"{key}.bearing.{number}", bearing)
    ]
    yield from broken
    if not broken:
        yield from _unstable(key, shaft)


def _unstable(key: str, shaft: DrawnShaft) -> Iterator[InputError]:
    """Refuse a shaft that its bearings do not hold whatever the load is."""
    springs = [bearing for bearing in shaft.bearing if bearing.type is None]
    tilts = any(bearing.matrix is not None or bearing.stiffness_tilt is not None for bearing in springs)
    across = {
        bearing.position
        for bearing in shaft.bearing
        if bearing.type is not None
        or bearing.matrix is not None
        or None not in (bearing.stiffness_x, bearing.stiffness_y)
    }
    if len(across) < (1 if tilts else 2):
        rule = "holds the shaft across its axis at fewer than two places: it would tip over"
        remedy = f"add a second [[{key}.bearing]], or give stiffness_tilt of one that is clamped"
        yield InputError(f"{key}.bearing", None, rule, remedy)
    axial = any(bearing.matrix is not None or bearing.stiffness_axial is not None for bearing in springs)
    axial |= any(bearing.type == "tapered-roller" for bearing in shaft.bearing)
    axial |= any(bearing.type == "deep-groove-ball" and bearing.locating for bearing in shaft.bearing)
    if not axial:
        rule = "none of them holds the shaft along its axis"
        remedy = (
            "make one a deep groove ball bearing that is locating, or two tapered ones, or add an axial "
            f'stop: a further [[{key}.bearing]] with stiffness_axial = "1e8 N/m" alone'
        )
        yield InputError(f"{key}.bearing", None, rule, remedy)


def _broken_bearing(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
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
        return
    if bearing.type is None:
        yield from _broken_spring(key, bearing)
        return
    for name in _NEEDED[bearing.type]:
        if getattr(bearing, name) is None:
            rule = f"missing: type = {quoted(bearing.type)} needs it"
            yield InputError(f"{key}.{name}", rule=rule, remedy=f"add {name} = {_EXAMPLES[name]}")
    for name in ("matrix_units", *_UNREAD[bearing.type]):
        if getattr(bearing, name):
            rule = f"has no effect with type = {quoted(bearing.type)}"
            yield InputError(f"{key}.{name}", None, rule, f"leave {name} out")
    if bearing.type == "tapered-roller" and not bearing.locating:
        rule = "its rings come apart where one of them slides"
        yield InputError(f"{key}.locating", "false", rule, "leave it out")
    if bearing.elements and bearing.element_diameter and bearing.pitch_diameter:
        most = math.pi / math.asin(min(bearing.element_diameter / bearing.pitch_diameter, 1.0))
        if bearing.elements > most:
            rule = f"no more than {math.floor(most)} of them fit side by side on the pitch circle"
            remedy = "check elements, element_diameter and pitch_diameter"
            yield InputError(f"{key}.elements", bearing.elements, rule, remedy)
    for name in ("clearance", "preload") if bearing.element_diameter else ():
        fit, size = getattr(bearing, name), bearing.element_diameter or 0.0
        if abs(fit) > LARGEST_FIT * size:
            rule = f"is more than a tenth of the rolling elements' diameter, {_shown(size)}"
            yield InputError(f"{key}.{name}", _shown(fit), rule, "check its unit: fits are micrometres")
    if bearing.contact_angle is not None and bearing.contact_angle >= math.radians(60.0):
        shown = f"{math.degrees(bearing.contact_angle):.6g} deg"
        rule = "60 deg or more: a thrust bearing"
        yield InputError(f"{key}.contact_angle", shown, rule, "write 10 to 30 deg")


def _broken_spring(key: str, bearing: BearingOfShaft) -> Iterator[InputError]:
    """What a spring or a matrix lacks, and what belongs to rolling bearings."""
    yield from broken_matrix(f"{key}.matrix", bearing.matrix, bearing.matrix_units)
    for name in (*_EXAMPLES, *_OF_CATALOGUE):
        if getattr(bearing, name) is not None:
            rule = "is that of a rolling bearing, and type is missing"
            remedy = f'add type = "deep-groove-ball", or leave {name} out'
            yield InputError(f"{key}.{name}", None, rule, remedy)
