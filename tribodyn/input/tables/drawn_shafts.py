"""Shafts as drawn: sections, gears and bearings at their places; and what is wrong with them."""

import math
from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.input import units
from tribodyn.input.fields import PartName
from tribodyn.input.quantity import InUnit, NotNegative, Table, written
from tribodyn.input.tables.drawn_bearing_rules import LOCATING, broken_bearing_of_shaft, shown_length
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, Place, Size

Frequency = Annotated[float, InUnit(units.positive(units.ANGULAR_FREQUENCY), "5 kHz")]


#: Largest diameter of a shaft over the smallest, and over its length: stiffness in bending goes with the
#: fourth power, of which rounding leaves 2e-6.
MOST_STEPPED, THICKEST = 300.0, 30.0


class SectionOfShaft(Table):
    """A stretch of a shaft with one section; they follow each other from the end at smaller z."""

    length: Size
    diameter: Size
    bore: Place = written("0 mm")


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
                times = f"{section.diameter / other:.3g} times the {name}, {shown_length(other)}"
                rule = f"is {times}, above {most:g}: too stiff beside it for its bending to be computed"
                place = f"{key}.section.{number}.diameter"
                yield InputError(place, shown_length(section.diameter), rule, "check both, and their units")
                break
        if section.bore >= section.diameter:
            rule = f"must be smaller than the diameter, {shown_length(section.diameter)}"
            yield InputError(
                f"{key}.section.{number}.bore",
                shown_length(section.bore),
                rule,
                "check both, and their units",
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
            yield InputError(place, shown_length(position), rule, "give each a place of its own")
    places = [(place, position, "the gear would not be on it") for place, position in on_it.items()]
    places += [
        (f"{key}.bearing.{number}.position", bearing.position, "the bearing would not be on it")
        for number, bearing in enumerate(shaft.bearing)
    ]
    for place, position, why in places:
        if position > length:
            rule = f"is beyond the end of the shaft, whose sections are {shown_length(length)} long: {why}"
            remedy = f"write 0 mm to {shown_length(length)}, or lengthen the sections"
            yield InputError(place, shown_length(position), rule, remedy)
    broken = [
        error
        for number, bearing in enumerate(shaft.bearing)
        for error in broken_bearing_of_shaft(f"{key}.bearing.{number}", bearing)
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
    axial |= any(bearing.type in LOCATING and bearing.locating for bearing in shaft.bearing)
    if not axial:
        rule = "none of them holds the shaft along its axis"
        remedy = (
            "make one a deep groove ball bearing or another that is locating, or two tapered ones, or add "
            f'an axial stop: a further [[{key}.bearing]] with stiffness_axial = "1e8 N/m" alone'
        )
        yield InputError(f"{key}.bearing", None, rule, remedy)
