"""Shafts of fixed axes: from REXS to [[shaft]] with sections, bearings and what they carry."""

import math
from typing import NamedTuple

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import Sheet
from tribodyn.exchange.rexs.reading.bearings import Support, put_bearing, put_springs_of, supports_of
from tribodyn.exchange.rexs.reading.draft import Draft, text, texts
from tribodyn.exchange.rexs.reading.frames import middle_of_gear, sense_of
from tribodyn.exchange.rexs.reading.gears import GEARS

#: Cylinders that stand for a cone; m within which sections join.
_STEPS, _NEAR = 4, 1e-6


class Cylinder(NamedTuple):
    """A cylinder of a shaft, m."""

    start: float
    length: float
    diameter: float
    bore: float


def gears_on(sheet: Sheet, shaft: Component) -> list[Component]:
    """The gears of a shaft."""
    return sheet.model.related("assembly", "assembly", shaft.number, "part", *GEARS)


def sections_of(draft: Draft, shaft: Component) -> list[Cylinder]:
    """The cylinders of a shaft from its start on, which must join; cones in steps."""
    sheet = draft.sheet
    found: list[Cylinder] = []
    parts = sheet.model.related("assembly", "assembly", shaft.number, "part", "shaft_section")
    for part in sorted(parts, key=lambda each: sheet.si(each, rexs.U_ON_SHAFT) or 0.0):
        values = [
            sheet.si(part, key)
            for key in (rexs.LENGTH, rexs.OUTER_BEGIN, rexs.OUTER_END, rexs.INNER_BEGIN, rexs.INNER_END)
        ]
        length, begin, end, bore, last = (value or 0.0 for value in values)
        end, last = end if values[2] is not None else begin, last if values[4] is not None else bore
        start = sheet.si(part, rexs.U_ON_SHAFT)
        expected = found[-1].start + found[-1].length if found else start or 0.0
        if start is not None and abs(start - expected) > _NEAR:
            rule = f"but the section before it ends at {1e3 * expected:.9g} mm on {shaft}"
            raise sheet.refused(part, rule, "let the sections join", rexs.U_ON_SHAFT.name)
        if length <= 0 or min(begin, end) <= 0:
            raise sheet.refused(
                part, "has no length or no outer diameter", "add length and outer_diameter_begin"
            )
        steps = 1 if begin == end and bore == last else _STEPS
        for step in range(steps):
            share = (step + 0.5) / steps
            place, outer = expected + step * length / steps, begin + share * (end - begin)
            found.append(Cylinder(place, length / steps, outer, bore + share * (last - bore)))
        if steps > 1:
            draft.change(part, f"is a cone; here {steps} cylinders")
    return found


def mass_of(sheet: Sheet, stretches: list[Cylinder], shaft: Component) -> tuple[float, float, bool]:
    """Mass (kg) and polar inertia (kg m²) of cylinders, and whether the file says their density."""
    material = sheet.model.related("reference", "origin", shaft.number, "referenced", "material")
    density = sheet.si(material[0], rexs.DENSITY) if material else None
    mass = inertia = 0.0
    for each in stretches:
        section = 0.25 * math.pi * (each.diameter**2 - each.bore**2) * each.length * (density or 7850.0)
        mass += section
        inertia += section * (each.diameter**2 + each.bore**2) / 8
    return mass, inertia, density is not None


def masses_on(sheet: Sheet, shaft: Component) -> list[Component]:
    """Couplings, rotors and the like of a shaft."""
    return sheet.model.related("assembly", "assembly", shaft.number, "part", "additional_mass")


def put_masses(draft: Draft, shaft: Component, *, bare: bool = False) -> None:
    """Write [[body]] of every additional mass of a shaft, of a bare one of the shaft itself."""
    sheet = draft.sheet
    if bare and not gears_on(sheet, shaft):
        stretches = sections_of(draft, shaft)
        mass, inertia, known = mass_of(sheet, stretches, shaft)
        draft.table("[[body]]", shaft.name)
        draft.put("name", text(draft.name(shaft)))
        draft.put("mass", f'"{mass:.9g} kg"', "of its sections" + ("" if known else ", as of steel"))
        draft.put("inertia", f'"{inertia:.9g} kg*m**2"')
    for part in masses_on(draft.sheet, shaft):
        draft.table("[[body]]", part.name if part.name != draft.name(part) else "")
        draft.put("name", text(draft.name(part)))
        draft.bodies.add(part.number)
        for key in (rexs.MASS, rexs.INERTIA):
            value = draft.sheet.toml(part, key)
            if value is None:
                raise draft.sheet.refused(part, f"{key.name} missing", "add it")
            draft.put(key.key, value)


def held_by_housing(draft: Draft, shaft: Component) -> list[Support]:
    """The bearings that hold a shaft; what stands between two shafts holds the one inside in the housing."""
    sheet = draft.sheet
    held = []
    for support in supports_of(sheet, shaft):
        between = support.other is not None and support.other.type == "shaft"
        if between and shaft not in sheet.model.related(
            "side", "assembly", support.bearing.number, "inner_part"
        ):
            continue
        if between:
            draft.change(
                support.bearing,
                f"stands between {shaft} and {support.other}; here it holds {shaft} in the housing",
            )
        held.append(support)
    return held


def put_shaft(draft: Draft, shaft: Component) -> None:
    """Write a shaft of fixed axes: as drawn where its bearings hold it, else the springs that do."""
    sheet = draft.sheet
    gears, masses = gears_on(sheet, shaft), masses_on(sheet, shaft)
    stretches, supports = sections_of(draft, shaft), held_by_housing(draft, shaft)
    sense = sense_of(sheet, shaft)
    places = {each.number: middle_of_gear(sheet, each, shaft) for each in gears}
    places |= {each.number: sheet.si(each, rexs.U_ON_SHAFT) for each in masses}
    why = _not_drawn(sheet, shaft, stretches, supports, places)
    if not gears:
        if stretches or supports:
            draft.change(shaft, "carries no gear and is left out")
        return
    if why:
        draft.change(shaft, f"is not drawn: {why}")
    if len(gears) > 1 or not why:
        draft.table("[[shaft]]", shaft.name)
        draft.put("name", text(draft.name(shaft)))
        draft.put("gears", texts(draft.name(gear) for gear in gears))
    if why and supports:
        put_springs_of(draft, draft.name(gears[0] if len(gears) == 1 else shaft), supports)
    if not why:
        _put_drawn(draft, shaft, stretches, supports, places, sense)


def _not_drawn(
    sheet: Sheet,
    shaft: Component,
    stretches: list[Cylinder],
    supports: list[Support],
    places: dict[int, float | None],
) -> str:
    """Why a shaft cannot be drawn; "" where it can."""
    if not stretches:
        return "it has no sections"
    if len({each.place for each in supports}) < 2:
        return "its bearings hold it at fewer than two places"
    if None in places.values() or any(each.place is None for each in supports):
        return "places along it are missing"
    return ""


def _put_drawn(
    draft: Draft,
    shaft: Component,
    stretches: list[Cylinder],
    supports: list[Support],
    places: dict[int, float | None],
    sense: int,
) -> None:
    sheet = draft.sheet
    first, last = stretches[0].start, stretches[-1].start + stretches[-1].length

    def along(place: float | None) -> float:
        return (place or 0.0) - first if sense > 0 else last - (place or 0.0)

    draft.table("[shaft.drawn]")
    named = {draft.name(sheet.model.parts[number]): along(place) for number, place in places.items()}
    listed = ", ".join(
        f'{name} = "{1e3 * place:.12g} mm"' for name, place in sorted(named.items(), key=lambda each: each[1])
    )
    draft.put("positions", f"{{ {listed} }}")
    _put_material(draft, shaft)
    draft.lines.append("section = [")
    for each in stretches if sense > 0 else stretches[::-1]:
        bore = f', bore = "{1e3 * each.bore:.12g} mm"' if each.bore else ""
        sizes = f'length = "{1e3 * each.length:.12g} mm", diameter = "{1e3 * each.diameter:.12g} mm"'
        draft.lines.append(f"    {{ {sizes}{bore} }},")
    draft.lines.append("]")
    for support in supports:
        put_bearing(draft, support, along(support.place), sense)


def _put_material(draft: Draft, shaft: Component) -> None:
    sheet = draft.sheet
    found = sheet.model.related("reference", "origin", shaft.number, "referenced", "material")
    for key in rexs.MATERIAL[:3] if found else ():
        draft.put(key.key, sheet.toml(found[0], key))
