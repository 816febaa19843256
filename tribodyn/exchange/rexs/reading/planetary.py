"""Planetary stages: from REXS to [[stage]] with type = "planetary", and the carrier's [[body]]."""

import math
from typing import NamedTuple

from tribodyn.exchange.rexs.file import attributes as rexs
from tribodyn.exchange.rexs.file.model import Component
from tribodyn.exchange.rexs.file.sheet import Sheet
from tribodyn.exchange.rexs.reading.bearings import (
    RIGID_SUPPORT,
    TYPICAL,
    hold_across,
    put_springs_of,
    put_stiffness,
    supports_of,
)
from tribodyn.exchange.rexs.reading.draft import Draft, text, texts
from tribodyn.exchange.rexs.reading.frames import frame_of, line_of_centres, middle_of_gear, sense_of
from tribodyn.exchange.rexs.reading.gears import check_hands, flanks_of, put_teeth
from tribodyn.exchange.rexs.reading.shafts import Cylinder, mass_of, masses_on, sections_of

COUPLINGS = "coupling", "switchable_coupling"
ENGAGED = rexs.RexsKey("is_engaged", "")


class PlanetarySet(NamedTuple):
    """A planetary stage and its parts."""

    stage: Component
    meshes: tuple[tuple[Component, Component, Component], ...]  # its cylindrical stages with both gears
    sun: Component
    ring: Component
    planets: tuple[Component, ...]
    sun_shaft: Component | None
    ring_shaft: Component | None
    carrier_shafts: tuple[Component, ...]
    pins: tuple[Component, ...]
    carrier: Component  # the carrier, or a shaft of it

    @property
    def members(self) -> dict[str, tuple[Component, ...]]:
        """Member -> its shafts."""
        sun, ring = ((each,) if each is not None else () for each in (self.sun_shaft, self.ring_shaft))
        return {"sun": sun, "ring": ring, "carrier": self.carrier_shafts}

    @property
    def shafts(self) -> set[int]:
        """The ids of all its shafts."""
        return {part.number for parts in (*self.members.values(), self.pins) for part in parts}


def shaft_of(sheet: Sheet, part: Component) -> Component | None:
    """The shaft that carries a part."""
    found = sheet.model.related("assembly", "part", part.number, "assembly", "shaft")
    return found[0] if found else None


def set_of(
    sheet: Sheet, stage: Component, stages: list[tuple[Component, Component, Component]]
) -> PlanetarySet:
    """The parts of a planetary stage: one sun, one ring, equal planets, a carrier."""
    model = sheet.model
    inside = {
        part.number
        for part in model.related("assembly", "assembly", stage.number, "part", "cylindrical_stage")
    }
    meshes = tuple(each for each in stages if each[0].number in inside)
    rings = {gear.number: gear for _, *gears in meshes for gear in gears if gear.type == "ring_gear"}
    with_ring = {
        gear.number: gear
        for _, *gears in meshes
        for gear in gears
        if {g.type for g in gears} == {"ring_gear", "cylindrical_gear"} and gear.type != "ring_gear"
    }
    suns = {
        gear.number: gear
        for _, *gears in meshes
        for gear in gears
        if gear.number not in with_ring and gear.number not in rings
    }
    if len(rings) != 1 or len(suns) != 1 or not with_ring:
        rule = f"has {len(suns)} suns, {len(with_ring)} planets and {len(rings)} rings"
        raise sheet.refused(stage, rule, "a set has one sun, one ring and planets that mesh with both")
    sun, ring, planets = next(iter(suns.values())), next(iter(rings.values())), tuple(with_ring.values())
    if len(meshes) != 2 * len(planets):
        rule = f"{len(planets)} planets but {len(meshes)} meshes: stepped and meshed planets are not taken"
        raise sheet.refused(stage, rule, "let every planet mesh with the sun and the ring")
    carriers = model.related("planet_carrier_shaft", "planetary_stage", stage.number, "shaft")
    pins = model.related("planet_pin", "planetary_stage", stage.number, "shaft")
    own = model.related("planet_shaft", "planetary_stage", stage.number, "shaft")
    bodies = model.related("assembly", "assembly", stage.number, "part", "planet_carrier")
    if not (bodies or carriers):
        raise sheet.refused(stage, "has no carrier", "add a planet_carrier or a planet_carrier_shaft")
    return PlanetarySet(
        stage,
        meshes,
        sun,
        ring,
        planets,
        shaft_of(sheet, sun),
        shaft_of(sheet, ring),
        tuple(carriers),
        tuple({part.number: part for part in (*pins, *own)}.values()),
        (bodies or carriers)[0],
    )


def fixed_shafts(sheet: Sheet, *, open_too: bool = False) -> set[int]:
    """Ids of shafts that engaged couplings hold in the casing; `open_too`: or could."""
    held = set()
    for coupling in sheet.model.of_type(*COUPLINGS):
        inner, outer = (
            sheet.model.related("side", "assembly", coupling.number, role)
            for role in ("inner_part", "outer_part")
        )
        engaged = open_too or coupling.type == "coupling" or sheet.truth(coupling, ENGAGED) is not False
        for parts, others in ((inner, outer), (outer, inner)):
            if engaged and any(other.type == "gear_casing" for other in others):
                held |= {part.number for part in parts if part.type == "shaft"}
    return held


def couplings_of(sheet: Sheet, shafts: tuple[Component, ...]) -> list[Component]:
    """The couplings that join shafts with the casing."""
    found = []
    for coupling in sheet.model.of_type(*COUPLINGS):
        roles = (
            sheet.model.related("side", "assembly", coupling.number, f"{side}_part")
            for side in ("inner", "outer")
        )
        parts = [part for role in roles for part in role]
        if any(each in parts for each in shafts) and any(part.type == "gear_casing" for part in parts):
            found.append(coupling)
    return found


def held_member(sheet: Sheet, found: PlanetarySet) -> str:
    """Which member does not turn."""
    for held in (fixed_shafts(sheet), fixed_shafts(sheet, open_too=True)):
        members = [
            name for name, shafts in found.members.items() if any(each.number in held for each in shafts)
        ]
        if members:  # else what an open coupling could hold: without it no power flows
            break
    if len(members) != 1:
        rule = f"{' and '.join(members) or 'no member'} held by engaged couplings in the casing"
        raise sheet.refused(
            found.stage, rule, "hold one member: a coupling between its shaft and the gear_casing"
        )
    return members[0]


def put_set(draft: Draft, found: PlanetarySet) -> None:
    """Write a planetary stage."""
    sheet = draft.sheet
    for stage, first, second in found.meshes:
        check_hands(sheet, stage, first, second)
    lines = {}
    for stage, first, second in found.meshes:
        line = line_of_centres(sheet, stage, first, second)
        if found.sun in (first, second):
            planet = second if first is found.sun else first
            azimuth = line.azimuth if first is found.sun or line.azimuth is None else line.azimuth + math.pi
            lines[planet.number] = line.distance, azimuth
    distances = {distance for distance, _ in lines.values() if distance is not None}
    if distances and max(distances) - min(distances) > 1e-6:
        raise sheet.refused(
            found.stage, "its planets stand on circles of different size", "one centre distance for all"
        )
    for gear in (found.sun, found.ring, *found.planets):
        if (shaft := shaft_of(sheet, gear)) is not None:
            sense_of(sheet, shaft)
            middle_of_gear(sheet, gear, shaft)
    for shaft in found.carrier_shafts:
        sense_of(sheet, shaft)
    draft.table("[[stage]]", found.stage.name)
    draft.put("type", text("planetary"))
    draft.put("name", text(draft.name(found.stage)))
    for member, gear in (
        ("sun", found.sun),
        ("planet", found.planets[0]),
        ("ring", found.ring),
        ("carrier", found.carrier),
    ):
        draft.put(member, text(draft.name(gear)))
    draft.put("planets", str(len(found.planets)))
    held = held_member(sheet, found)
    if {each.number for each in found.members[held]} & fixed_shafts(sheet):
        draft.put("held", text(held))
    else:
        draft.assume("held", text(held), "its coupling is open in the file: no power would flow")
    for coupling in couplings_of(sheet, found.members[held]):
        value = sheet.si(coupling, rexs.TORSIONAL_STIFFNESS)
        if value and value < RIGID_SUPPORT:
            draft.put("support_stiffness", f'"{value:.9g} N*m/rad"')
            break
        if value:
            draft.change(coupling, "is rigid against rotation: the scenario's choice of support_stiffness")
    floating = [
        name
        for name, shafts in found.members.items()
        if name != "carrier"
        and shafts
        and not any(hold_across(sheet, supports_of(sheet, each)) for each in shafts)
        and name != held
    ]
    draft.put("floating", texts(floating) if floating else None)
    put_teeth(
        draft, found.stage, (found.sun, *found.planets, found.ring), min(distances) if distances else None
    )
    _put_angles(draft, found, [azimuth for _, azimuth in lines.values()])
    for other in found.planets[1:]:
        _same_planet(draft, found.planets[0], other)


def _put_angles(draft: Draft, found: PlanetarySet, azimuths: list[float | None]) -> None:
    if None in azimuths:
        return
    angles = sorted(math.degrees(each or 0.0) % 360.0 for each in azimuths)
    draft.put("angles", "[" + ", ".join(f'"{angle:.9g} deg"' for angle in angles) + "]")


def _same_planet(draft: Draft, first: Component, other: Component) -> None:
    """The planets of a set are one gear: what the others say must be the same, and counts as read."""
    for name, attribute in other.attributes.items():
        same = first.attributes.get(name)
        place = name in ("support_vector", "w_axis_vector", "u_axis_vector", "u_coordinate_on_shaft")
        if not place and same is not None and same != attribute:
            rule = f"differs from that of {first}: the planets of a set are alike"
            raise draft.sheet.refused(other, rule, "let all planets say the same", name)
    for pair in (
        (first, other),
        *zip(flanks_of(draft.sheet, first), flanks_of(draft.sheet, other), strict=False),
    ):
        draft.sheet.alike(*pair)


def put_carrier(draft: Draft, found: PlanetarySet) -> None:
    """Write the carrier's body: the mass of its plates, shafts and pins, as far as their sizes are there."""
    sheet, carrier = draft.sheet, found.carrier
    name = draft.name(carrier)
    mass = inertia = 0.0
    guessed = False
    for plate in sheet.model.related("assembly", "assembly", carrier.number, "part", "side_plate"):
        length, outer, inner = (sheet.si(plate, key) or 0.0 for key in (rexs.LENGTH, rexs.OUTER, rexs.INNER))
        part = mass_of(sheet, [Cylinder(0.0, length, outer, inner)], plate)
        mass, inertia, guessed = mass + part[0], inertia + part[1], guessed or not part[2]
    for shaft in found.carrier_shafts:
        part = mass_of(sheet, sections_of(draft, shaft), shaft)
        mass, inertia, guessed = mass + part[0], inertia + part[1], guessed or not part[2]
        for each in masses_on(sheet, shaft):
            sheet.si(each, rexs.U_ON_SHAFT)
            mass, inertia = (
                mass + (sheet.si(each, rexs.MASS) or 0.0),
                inertia + (sheet.si(each, rexs.INERTIA) or 0.0),
            )
    for pin in sheet.model.related("planet_pin", "planetary_stage", found.stage.number, "shaft"):
        part, away = (
            mass_of(sheet, sections_of(draft, pin), pin),
            sheet.si(found.meshes[0][0], rexs.CENTRE_DISTANCE) or 0.0,
        )
        frame_of(sheet, pin)
        mass, inertia, guessed = mass + part[0], inertia + part[1] + part[0] * away**2, guessed or not part[2]
    told = sheet.si(carrier, rexs.MASS)
    if told:
        mass, inertia = told, inertia * told / mass if mass else 0.0
    draft.table("[[body]]", carrier.name)
    draft.put("name", text(name))
    if inertia > 0.0:
        comment = "of its plates, shafts and pins" + (", steel where no density is given" if guessed else "")
        draft.put("mass", f'"{mass:.9g} kg"', comment)
        draft.put("inertia", f'"{inertia:.9g} kg*m**2"')
    else:
        draft.put("mass", f'"{told:.9g} kg"') if told else draft.assume("mass", '"10 kg"')
        draft.assume("inertia", '"0.1 kg*m**2"')


def put_bearings_of_set(draft: Draft, found: PlanetarySet) -> None:
    """Write the bearings of its members, and of planets on their pins."""
    sheet = draft.sheet
    gears = {"sun": found.sun, "ring": found.ring, "carrier": found.carrier}
    for member, shafts in found.members.items():
        supports = [
            each
            for shaft in shafts
            for each in supports_of(sheet, shaft)
            if each.other is None or each.other.type == "gear_casing"
        ]
        if supports:
            put_springs_of(draft, draft.name(gears[member]), supports)
        elif {each.number for each in shafts} & fixed_shafts(sheet, open_too=True):
            coupling = couplings_of(sheet, shafts)[0]
            _put_coupled(draft, draft.name(gears[member]), coupling)
    shaft = shaft_of(sheet, found.planets[0])
    supports = supports_of(sheet, shaft) if shaft is not None else []
    if supports:
        put_springs_of(draft, draft.name(found.planets[0]), supports)
        for each in supports:
            sheet.si(each.bearing, rexs.U_INNER)
    for other in found.planets[1:]:
        its = shaft_of(sheet, other)
        for one, same in zip(supports, supports_of(sheet, its) if its is not None else [], strict=False):
            sheet.alike(one.bearing, same.bearing)


def _put_coupled(draft: Draft, name: str, coupling: Component) -> None:
    sheet = draft.sheet
    across, along, tilt = (
        sheet.si(coupling, key) or 0.0
        for key in (rexs.RADIAL_STIFFNESS, rexs.AXIAL_STIFFNESS, rexs.TILT_STIFFNESS)
    )
    draft.table(f"[bearings.{name}]", coupling.name)
    if not across:
        for key in ("stiffness_x", "stiffness_y"):
            draft.assume(key, f'"{TYPICAL:g} N/m"')
    put_stiffness(draft, coupling, across, along, tilt)
    draft.assume("damping_ratio", "0.05")
