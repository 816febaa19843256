"""The thermal network of a gearbox, of what is drawn of it: gears, shafts, bearings, oil, housing."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from tribodyn.cases.heat_part import AMBIENT, HOUSING, OIL, GearboxHeat
from tribodyn.gears.drawn_system import ShaftData
from tribodyn.geometry.body import mass_and_inertia
from tribodyn.geometry.drive import SIDES, body_of, tip_radius
from tribodyn.input.tables.drawn_bearings import sized
from tribodyn.studies.motion.assembly import assemblies
from tribodyn.studies.motion.case import Gearbox
from tribodyn.tribology.heat.data import GearboxHeatData
from tribodyn.tribology.heat.network import ConductanceLaw, HeatNetwork, HeatPath
from tribodyn.tribology.heat.parts import (
    SEAT,
    SHAFT_DIAMETER,
    STEEL,
    BearingRing,
    GearDisc,
    OilHeat,
    gear_to_oil,
    housing_to_air,
    wall_from_oil,
)
from tribodyn.tribology.heat.surfaces import in_series

#: Held nodes: the coolant, and the oil that enters.
COOLANT, SUPPLY = "coolant", "oil supply"
_SEAT = "seat, reference heat flow density of ISO 15312"
#: Temperature at which the oil's heat capacity is taken, K.
_USUAL = 333.15


class _HeatPart(NamedTuple):
    """A node with its paths, and where heat of a source of this name enters."""

    name: str
    capacity: float
    paths: tuple[HeatPath, ...]
    source: str = ""


def heat_of(case: Gearbox) -> GearboxHeat | None:
    """The thermal network of a gearbox; None where its scenario asks for none."""
    data = case.heat
    if data is None:
        return None
    sheet = case.pair.lubricant.sheet
    assert sheet is not None, "a rule asks for the data sheet"
    oil = OilHeat(sheet)
    discs = [_disc(case, number) for number in range(len(case.gears))]
    parts = [
        *_gears(case, data, discs, oil),
        *_undrawn_shafts(case, discs, oil),
        *(part for shaft in _drawn(case) for part in _shaft(case, shaft, discs, oil)),
    ]
    parts += _typed_bearings(case, parts, oil)
    capacities = {part.name: part.capacity for part in parts}
    capacities |= {HOUSING: data.housing.capacity}
    held, paths = {AMBIENT: data.ambient_temperature}, [*_housing(data)]
    if data.oil_temperature is not None and data.oil_flow == 0.0:
        held[OIL] = data.oil_temperature
    else:
        capacities[OIL] = data.oil_volume * float(oil.volumetric_heat(_USUAL))
    if data.cooler is not None:
        held[COOLANT] = data.cooler.coolant_temperature
        paths.append(HeatPath(OIL, COOLANT, data.cooler.conductance, "cooler"))
    if data.oil_flow > 0.0 and data.oil_temperature is not None:
        held[SUPPLY] = data.oil_temperature
        flow = data.oil_flow * float(oil.volumetric_heat(data.oil_temperature))
        paths.append(HeatPath(OIL, SUPPLY, flow, "oil that flows through, ρ c V̇"))
    paths += [path for part in parts for path in part.paths]
    names = [gear_node(gear.name) for gear in case.gears]
    return GearboxHeat(
        HeatNetwork(capacities, held, tuple(paths)),
        tuple((names[one], names[two]) for one, two in (mesh.gears for mesh in case.meshes)),
        {part.source: part.name for part in parts if part.source},
    )


def gear_node(name: str) -> str:
    """The node of a gear."""
    return f"gear {name}"


def _speed_ratio(case: Gearbox, body: int) -> float:
    """Speed of a body over that of the input."""
    return abs(float(case.bodies[body].ratio / case.bodies[case.source.body].ratio))


def _disc(case: Gearbox, number: int) -> GearDisc:
    gear = case.gears[number]
    mesh, side = gear.meshes[0]
    pair, assembly = case.meshes[mesh].pair, assemblies(case)[mesh]
    body, material = body_of(pair.drive, side), pair.materials[SIDES.index(side)]
    mass = gear.stated.mass
    if mass is None:
        mass = float(mass_and_inertia(assembly, side, gear.density)[0])
    return GearDisc(
        abs(float(tip_radius(pair.drive, side))),
        abs(float(assembly.tooth(side).root_radius)),
        abs(float(body.bore_radius)),
        float(body.face_width),
        abs(float(pair.drive.module)),
        abs(int(body.teeth)),
        material.thermal_conductivity,
        mass * material.specific_heat,
    )


def _gears(case: Gearbox, data: GearboxHeatData, discs: list[GearDisc], oil: OilHeat) -> Iterator[_HeatPart]:
    for gear, disc in zip(case.gears, discs, strict=True):
        name, given = gear_node(gear.name), data.tooth_oil.get(gear.name)
        law = gear_to_oil(disc.surface, _speed_ratio(case, gear.body), oil)
        what = "disc that turns in oil, Levich (1962)" if given is None else "given"
        paths = [HeatPath(name, OIL, law if given is None else given, what)]
        if gear.teeth < 0 and case.bodies[gear.body].ratio == 0:
            seat = SEAT * 2.0 * math.pi * disc.bore_radius * disc.width
            paths.append(HeatPath(name, HOUSING, seat, "outside of a ring that stands, as of a seat"))
        yield _HeatPart(name, disc.capacity, tuple(paths))


def _undrawn_shafts(case: Gearbox, discs: list[GearDisc], oil: OilHeat) -> Iterator[_HeatPart]:
    """Shafts that have a mass and are not drawn, and carriers."""
    on_drawn = case.system.bodies if case.system is not None else ()
    members = {body for gearset in case.sets for body in gearset.members.values()}
    for number, body in enumerate(case.bodies):
        if body.mass <= 0.0 or number in on_drawn or not (body.gears or number in members):
            continue
        name = f"shaft {body.name}"
        paths = [
            HeatPath(
                gear_node(case.gears[gear].name),
                name,
                discs[gear].to_shaft(SHAFT_DIAMETER * discs[gear].root_radius),
                "ring from the roots of the teeth to the bore, or to half the root diameter",
            )
            for gear in body.gears
            if case.gears[gear].teeth > 0
        ]
        if not body.gears:
            surface = 6.0 * (body.mass / STEEL[0]) ** (2.0 / 3.0)
            law = gear_to_oil(surface, _speed_ratio(case, number), oil)
            paths.append(HeatPath(name, OIL, law, "surface of a cube of its mass that turns in oil"))
        yield _HeatPart(name, body.mass * STEEL[1], tuple(paths))


def _drawn(case: Gearbox) -> tuple[ShaftData, ...]:
    return case.system.shafts if case.system is not None else ()


def _shaft(case: Gearbox, shaft: ShaftData, discs: list[GearDisc], oil: OilHeat) -> Iterator[_HeatPart]:
    """A drawn shaft and its bearings."""
    name, drawing = f"shaft {shaft.name}", shaft.drawing
    volume = sum(
        math.pi / 4.0 * (section.diameter**2 - section.bore**2) * section.length
        for section in drawing.section
    )
    on_it = [(gear, place) for body, place in shaft.points for gear in case.bodies[body].gears]
    paths = [
        HeatPath(
            gear_node(case.gears[gear].name),
            name,
            discs[gear].to_shaft(0.5 * _section_at(shaft, place).diameter),
            "ring from the roots of the teeth to the shaft",
        )
        for gear, place in on_it
    ]
    yield _HeatPart(name, volume * drawing.density * STEEL[1], tuple(paths))
    ratio = _speed_ratio(case, shaft.points[0][0])
    for number, table in enumerate(drawing.bearing, start=1):
        if table.type is None:
            continue
        source = f"{shaft.name}-{number}"
        mean = sized(table).pitch_diameter or 0.0
        typical = BearingRing.typical(mean)
        ring = BearingRing(
            table.bore or typical.bore, table.outside_diameter or typical.outside, typical.width
        )
        node, bearing_seat = f"bearing {source}", ring.to_seat(ring.bore)
        gears = [place for _, place in on_it] or [table.position]
        along = _along(shaft, table.position, min(gears, key=lambda place: abs(place - table.position)))
        to_shaft = bearing_seat if along == math.inf else in_series(bearing_seat, along)
        yield _HeatPart(
            node,
            ring.capacity,
            (
                HeatPath(node, HOUSING, ring.to_seat(ring.outside), _SEAT),
                HeatPath(node, name, to_shaft, f"{_SEAT}, and the shaft to the next gear"),
                HeatPath(node, OIL, ring.to_oil(ratio, oil), "plate in oil, Harris"),
            ),
            source,
        )


def _typed_bearings(case: Gearbox, parts: Sequence[_HeatPart], oil: OilHeat) -> Iterator[_HeatPart]:
    """Bearings that [losses] has and no drawing, on the shaft or the gear that they carry."""
    names, drawn = {part.name for part in parts}, {part.source for part in parts}
    gears = {gear.name: gear.body for gear in case.gears}
    for pair in case.pairs:
        for shaft in pair.losses.shafts if pair.losses is not None else ():
            body = gears.get(shaft.name) if shaft.body is None else shaft.body
            for name, bearing, *_ in shaft.bearings:
                if body is None or name in drawn:
                    continue
                typical = BearingRing.typical(bearing.mean_diameter)
                ring = BearingRing(
                    bearing.bore or typical.bore,
                    bearing.outside_diameter or typical.outside,
                    bearing.width or typical.width,
                )
                node, count, law = name, bearing.count, ring.to_oil(_speed_ratio(case, body), oil)
                carried = [f"shaft {case.bodies[body].name}"]
                carried += [gear_node(case.gears[gear].name) for gear in case.bodies[body].gears]
                paths = [
                    HeatPath(node, HOUSING, count * ring.to_seat(ring.outside), _SEAT),
                    HeatPath(node, OIL, _times(count, law), "plate in oil, Harris"),
                    *(
                        HeatPath(node, other, count * ring.to_seat(ring.bore), _SEAT)
                        for other in [other for other in carried if other in names][:1]
                    ),
                ]
                yield _HeatPart(node, count * ring.capacity, tuple(paths), name)


def _times(count: int, law: ConductanceLaw) -> ConductanceLaw:
    """A conductance, so many times."""
    return lambda one, two, speed: count * law(one, two, speed)


def _section_at(shaft: ShaftData, place: float) -> Any:
    start = 0.0
    for section in shaft.drawing.section:
        start += section.length
        if place <= start:
            return section
    return shaft.drawing.section[-1]


def _along(shaft: ShaftData, one: float, two: float) -> float:
    """Conductance of a shaft between two places along it, m, W/K; infinite where they are one."""
    low, high = sorted((one, two))
    start, resistance = 0.0, 0.0
    for section in shaft.drawing.section:
        end = start + section.length
        inside = max(0.0, min(end, high) - max(start, low))
        resistance += inside / (STEEL[2] * math.pi / 4.0 * (section.diameter**2 - section.bore**2))
        start = end
    return 1.0 / resistance if resistance else math.inf


def _housing(data: GearboxHeatData) -> Iterator[HeatPath]:
    splashed = "walls that oil splashes, ISO/TR 14179-2, and half of the wall"
    yield HeatPath(OIL, HOUSING, wall_from_oil(data.housing), splashed)
    outside = "natural and forced convection, radiation" if data.housing.coefficient is None else "given"
    yield HeatPath(HOUSING, AMBIENT, housing_to_air(data.housing), f"{outside}, and half of the wall")
