"""From a REXS model to a scenario: what it is made of, in the order of the file that is written."""

import re
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.exchange.rexs.file.attributes import NUMBER_OF_TEETH, QUALITY, ROUGHNESS, TORSIONAL_STIFFNESS
from tribodyn.exchange.rexs.file.files import read_model
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import NotUsed, Sheet
from tribodyn.exchange.rexs.reading.bearings import RIGID_TILT, STIFF_TILT
from tribodyn.exchange.rexs.reading.draft import Draft, text
from tribodyn.exchange.rexs.reading.gears import GEARS, put_gear, put_stage, stages_of
from tribodyn.exchange.rexs.reading.loads import ends_of, put_operating, transmitting
from tribodyn.exchange.rexs.reading.materials import TYPICAL_MATERIAL, put_lubricant
from tribodyn.exchange.rexs.reading.planetary import (
    COUPLINGS,
    ENGAGED,
    PlanetarySet,
    held_member,
    put_bearings_of_set,
    put_carrier,
    put_set,
    set_of,
    shaft_of,
)
from tribodyn.exchange.rexs.reading.shafts import gears_on, masses_on, put_masses, put_shaft, sections_of

#: What no scenario can hold: gears on axes that are not parallel.
_FOREIGN = re.compile(r"(worm|bevel|hypoid|crown|face_gear|crossed|beveloid)\w*")
#: Speeds of a set's members over that of the sun, by the teeth of sun and ring; by which member is held.
_WILLIS = {
    "ring": lambda sun, ring: {"sun": 1.0, "carrier": sun / (sun + ring)},
    "carrier": lambda sun, ring: {"sun": 1.0, "ring": -sun / ring},
    "sun": lambda sun, ring: {"ring": 1.0, "carrier": ring / (sun + ring)},
}


class RexsScenario(NamedTuple):
    """A scenario that was made of a REXS file."""

    toml: str
    version: str
    application: str
    not_used: tuple[NotUsed, ...]
    assumed: tuple[str, ...]
    changed: tuple[str, ...]


def scenario_of(path: Path) -> RexsScenario:
    """Make a scenario of a file; InputError where it is broken, contradicts itself, or none can hold it."""
    sheet = Sheet(read_model(path), str(path))
    try:
        return _scenario(sheet, path)
    except InputError as error:
        raise error if error.file else error.moved(lambda _: str(path)) from None


def _scenario(sheet: Sheet, path: Path) -> RexsScenario:
    model = sheet.model
    foreign = [part for part in model.parts.values() if _FOREIGN.fullmatch(part.type)]
    for part in sorted(foreign, key=lambda each: not each.type.endswith("_stage"))[:1]:
        raise sheet.refused(
            part, "cylindrical gears on parallel axes alone are taken", "export the cylindrical stages alone"
        )
    draft = Draft(sheet)
    stages = stages_of(sheet)
    if not stages:
        raise sheet.refused("components", "no cylindrical_stage is in the file", "name a file with gears")
    sets = [set_of(sheet, stage, stages) for stage in model.of_type("planetary_stage")]
    in_sets = {stage.number for each in sets for stage, _, _ in each.meshes}
    pairs = [each for each in stages if each[0].number not in in_sets]
    names = _name_ends(draft, sets)
    ends = ends_of(sheet, _speeds(sheet, pairs, sets))
    unit = next(iter(model.of_type("gear_unit")), None)
    draft.lines = [f"# from {path.name}: REXS {model.version}, {model.application}".rstrip(", "), ""]
    draft.put("title", text((unit.name if unit is not None else "") or path.stem))
    draft.lines.append('kind = "gear-train"')
    _put_common(draft)
    put_lubricant(draft)
    _put_parts(draft, pairs, sets, names)
    put_operating(draft, ends, names)
    draft.table("[mesh]")
    draft.put("compliance", text("fem") if draft.modified_spur else None, "spur gears with modified flanks")
    draft.assume("damping_ratio", "0.05", "REXS has none: a usual value")
    draft.table("[friction]")
    draft.put("law", text("auto"))
    draft.assumed = list(dict.fromkeys(draft.assumed))
    changed = tuple(dict.fromkeys(draft.changed))
    return RexsScenario(
        draft.toml(), model.version, model.application, tuple(sheet.not_used()), tuple(draft.assumed), changed
    )


def _put_common(draft: Draft) -> None:
    """Write what holds for gears of which the file says nothing, where there are some."""
    sheet = draft.sheet
    gears = list(sheet.model.of_type(*GEARS))
    if not all(
        sheet.model.related("reference", "origin", gear.number, "referenced", "material") for gear in gears
    ):
        draft.assume("material", text(TYPICAL_MATERIAL), "of gears for which the file has none")
    if None in [sheet.number(gear, ROUGHNESS) for gear in gears]:
        draft.assume(
            "mean_roughness", '"0.5 um"', "Ra; of gears for which the file has none: a typical value"
        )
    if None in [sheet.number(gear, QUALITY) for gear in gears]:
        draft.suggest("quality", "6", "ISO 1328-1; of gears for which the file has none: a typical value")


def _name_ends(draft: Draft, sets: list[PlanetarySet]) -> dict[int, str]:
    """Name gears first; and what each shaft is called where power enters or a link ends."""
    sheet = draft.sheet
    for each in sets:
        draft.name(each.planets[0])
    for gear in sheet.model.of_type(*GEARS):
        draft.name(gear)
    names = {shaft.number: draft.name(each.carrier) for each in sets for shaft in each.carrier_shafts}
    for shaft in sheet.model.of_type("shaft"):
        gears, masses = gears_on(sheet, shaft), masses_on(sheet, shaft)
        if shaft.number in names:
            continue
        if gears:
            names[shaft.number] = draft.name(gears[0] if len(gears) == 1 else shaft)
        elif masses:
            names[shaft.number] = draft.name(masses[0])
        elif any(each is shaft for _, each in transmitting(sheet)) and sections_of(draft, shaft):
            names[shaft.number] = draft.name(shaft)
    return names


def _put_parts(
    draft: Draft,
    pairs: list[tuple[Component, Component, Component]],
    sets: list[PlanetarySet],
    names: Mapping[int, str],
) -> None:
    sheet = draft.sheet
    alike = {planet.number for each in sets for planet in each.planets[1:]}
    for gear in dict.fromkeys(gear.number for gear in sheet.model.of_type(*GEARS)):
        if gear not in alike:
            put_gear(draft, sheet.model.parts[gear])
    writers = {stage.number: partial(put_stage, draft, stage, *gears) for stage, *gears in pairs}
    writers |= {each.stage.number: partial(put_set, draft, each) for each in sets}
    for number in (each for each in sheet.model.parts if each in writers):
        writers[number]()
    members = {number: each for each in sets for number in each.shafts}
    shafts = list(sheet.model.of_type("shaft"))
    carriers = {shaft.number for each in sets for shaft in each.carrier_shafts}
    for shaft in shafts:
        if shaft.number not in carriers:
            put_masses(draft, shaft, bare=shaft.number in names and names[shaft.number] == draft.named(shaft))
    for each in sets:
        put_carrier(draft, each)
    for shaft in shafts:
        if shaft.number not in members and (gears_on(sheet, shaft) or shaft.number not in names):
            put_shaft(draft, shaft)
        elif len(gears_on(sheet, shaft)) > 1:
            draft.table("[[shaft]]", shaft.name)
            draft.put("name", text(draft.name(shaft)))
            draft.put(
                "gears", "[" + ", ".join(text(draft.name(gear)) for gear in gears_on(sheet, shaft)) + "]"
            )
    _put_links(draft, sets)
    for each in sets:
        put_bearings_of_set(draft, each)
    if not any(line.startswith("[bearings") for line in draft.lines):
        draft.table("[bearings]")


def _coupled(sheet: Sheet) -> list[tuple[Component, Component, Component]]:
    """Engaged couplings between two shafts."""
    found = []
    for coupling in sheet.model.of_type(*COUPLINGS):
        ends = [
            sheet.model.related("side", "assembly", coupling.number, role, "shaft")
            for role in ("inner_part", "outer_part")
        ]
        engaged = coupling.type == "coupling" or sheet.truth(coupling, ENGAGED) is not False
        if ends[0] and ends[1] and engaged:
            found.append((coupling, ends[0][0], ends[1][0]))
    return found


def _put_links(draft: Draft, sets: list[PlanetarySet]) -> None:
    """Write [[link]] of couplings between shafts that carry something; others are left out."""
    sheet = draft.sheet
    names = _name_ends(draft, sets)
    for coupling, first, second in _coupled(sheet):
        if first.number not in names or second.number not in names:
            if any(each.number in names for each in (first, second)):
                bare = second if first.number in names else first
                draft.change(coupling, f"joins {bare}, which carries no gear: left out")
            continue
        if names[first.number] == names[second.number]:
            continue
        value = sheet.si(coupling, TORSIONAL_STIFFNESS)
        draft.table("[[link]]", coupling.name)
        draft.put("name", text(draft.name(coupling)))
        draft.put("ends", f"[{text(names[first.number])}, {text(names[second.number])}]")
        if not value:
            draft.assume("stiffness", '"1e6 N*m/rad"')
        else:
            rigid = value >= RIGID_TILT
            if rigid:
                draft.change(coupling, f"is rigid against twist: {STIFF_TILT:g} N*m/rad")
            limited = STIFF_TILT if rigid else value
            draft.put("stiffness", f'"{limited:.9g} N*m/rad"', "rigid in the file" if rigid else "")
        draft.assume("damping_ratio", "0.02")


def _speeds(
    sheet: Sheet, pairs: list[tuple[Component, Component, Component]], sets: list[PlanetarySet]
) -> Mapping[int, float]:
    """Shaft -> its speed over that of the first shaft of a load, signed, of those that gears link with it."""
    ratios: list[tuple[int, int, float]] = []
    for _, first, second in pairs:
        teeth = [sheet.si(gear, NUMBER_OF_TEETH) or 1.0 for gear in (first, second)]
        shafts = shaft_of(sheet, first), shaft_of(sheet, second)
        sign = 1.0 if "ring_gear" in (first.type, second.type) else -1.0
        for gear, shaft in zip((first, second), shafts, strict=True):
            if shaft is None:
                raise sheet.refused(gear, "is on no shaft", "add a relation assembly of its shaft and it")
        assert shafts[0] is not None
        assert shafts[1] is not None
        ratios.append((shafts[0].number, shafts[1].number, sign * abs(teeth[0] / teeth[1])))
    for each in sets:
        sun, ring = (abs(sheet.si(gear, NUMBER_OF_TEETH) or 1.0) for gear in (each.sun, each.ring))
        members = _WILLIS[held_member(sheet, each)](sun, ring)
        turning = [(shaft.number, speed) for name, speed in members.items() for shaft in each.members[name]]
        ratios += [(turning[0][0], number, speed / turning[0][1]) for number, speed in turning[1:]]
    ratios += [(first.number, second.number, 1.0) for _, first, second in _coupled(sheet)]
    loads = transmitting(sheet)
    speeds = {loads[0][1].number: 1.0} if loads else {}
    for _ in range(len(ratios)):
        for first, second, ratio in ratios:
            if first in speeds and second not in speeds:
                speeds[second] = speeds[first] * ratio
            elif second in speeds and first not in speeds:
                speeds[first] = speeds[second] / ratio
    return speeds
