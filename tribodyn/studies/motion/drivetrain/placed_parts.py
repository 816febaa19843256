"""The gears and shafts of a gearbox in their places, unloaded, while its first mesh begins a cycle."""

from collections.abc import Sequence

import numpy as np

from tribodyn.drawing.shapes import (
    GearShape,
    ModifiedFlank,
    PlacedPart,
    ShaftShape,
    gear_shape,
    modified_flank,
    pushes_above,
)
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.limits.checks import check
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, friction_data, sized
from tribodyn.studies.motion.assembly import assemblies, phases
from tribodyn.studies.motion.case import BodyData, Gearbox
from tribodyn.train.planetary import CARRIER, RAVIGNEAUX, SUN

#: Room between planes of gears of which no drawing says how far apart they are, over the wider one's width.
_ROOM = 0.15


def placed_parts(case: Gearbox, tolerance: float) -> list[PlacedPart]:
    """Gears and drawn shafts with the names of the scenario.

    Chords leave the exact surfaces by `tolerance` (m) at most. InputError where teeth cannot be made.
    """
    pairs = assemblies(case)
    if not case.named:  # those of a train have been checked
        check(pairs[0].family, pairs[0].drive)
    teeth, heights = phases(case, pairs).teeth, _heights(case)
    path = pairs[0].path
    shapes: dict[tuple[object, ...], GearShape] = {}
    carriers = {body: case.bodies[each.members[CARRIER]] for each in case.sets for body in each.planets}
    found = []
    for number, gear in enumerate(case.gears):
        (mesh, side), (key, flanks) = gear.meshes[0], _flanks(case, number, pairs)
        key = gear.face_width, gear.stated, *key
        if key not in shapes:
            shapes[key] = gear_shape(pairs[mesh], side, tolerance, flanks, gear.stated)
        x, y = case.bodies[gear.body].centre
        if y != y:  # of a pair they are as far apart as its path of contact says
            y = float(path.pinion_pitch_radius + path.gear_pitch_radius)
        body, about = case.bodies[gear.body], carriers.get(gear.body)
        first = body.sense == case.bodies[0].sense
        fill = "ring" if gear.teeth < 0 else "pinion" if first else "gear"
        part = PlacedPart(gear.name, shapes[key], (x, y, heights[number]), teeth[number], fill, _turns(body))
        if about is not None:
            part = part._replace(orbits=_turns(about), axis=about.centre)
        found.append(part)
    for shaft in case.system.shafts if case.system is not None else ():
        sections = shaft.drawing.section
        shape = ShaftShape(
            tuple(section.length for section in sections),
            tuple(section.diameter / 2.0 for section in sections),
            tuple(section.bore for section in sections),
            tolerance,
        )
        name, turns = _other(shaft.name, found), _turns(case.bodies[shaft.points[0][0]])
        found.append(PlacedPart(name, shape, (*shaft.centre, shaft.start), 0.0, "shaft", turns))
        for number, bearing in enumerate(shaft.drawing.bearing, start=1):
            if (ring := _bearing(bearing, shape)) is not None:
                place = (*shaft.centre, shaft.start + bearing.position - sum(ring.length) / 2.0)
                found.append(PlacedPart(f"bearing {shaft.name}-{number}", ring, place, 0.0, "bearing"))
    return found


def _bearing(bearing: BearingOfShaft, shaft: ShaftShape) -> ShaftShape | None:
    """A rolling bearing as a ring on its shaft, as wide as its rolling elements; of springs none."""
    inside, outside = sized(bearing), friction_data(bearing)
    if outside is None or outside.outside_diameter is None:
        return None
    width = inside.roller_length or inside.element_diameter or 0.0
    width += (bearing.row_distance or width) * (outside.rows - 1)
    ends = np.append(0.0, np.cumsum(shaft.length))
    near = (ends[:-1] < bearing.position + width / 2.0) & (ends[1:] > bearing.position - width / 2.0)
    under = np.array(shaft.radius)[near]
    radius = float(under.max(initial=0.0))
    if not radius < outside.outside_diameter / 2.0:
        return None
    return ShaftShape((width,), (outside.outside_diameter / 2.0,), (radius,), shaft.tolerance)


def _flanks(
    case: Gearbox, number: int, pairs: Sequence[Assembly]
) -> tuple[list[object], tuple[ModifiedFlank | None, ModifiedFlank | None]]:
    """A key that gears of one shape share, and both flanks of a gear, each by the mesh in which it drives.

    The back flanks are those of the first mesh that says something of them.
    """
    gear, key, front, back = case.gears[number], [], dict[bool, ModifiedFlank](), dict[bool, ModifiedFlank]()
    for mesh, side in gear.meshes:
        own = case.meshes[mesh]
        carried = _turns(case.bodies[own.carrier]) if own.carrier >= 0 else 0.0
        above = pushes_above(side, _turns(case.bodies[gear.body]) - carried)
        way = -float(case.bodies[own.driver].sense)  # from its pair's +z the driver turns clockwise
        taken = getattr(own.pair.mesh.modifications, side)
        key.append((pairs.index(pairs[mesh]), side, above, way))
        if (flank := modified_flank(pairs[mesh], side, taken, way)) is not None:
            front.setdefault(above, flank)
            if taken.both_flanks:
                back.setdefault(not above, flank)
    both = back | front
    return key, (both.get(False), both.get(True))


def _turns(body: BodyData) -> float:
    """Turns of a body for each of the first one, counter-clockwise."""
    return body.sense * float(body.ratio)


def _other(name: str, parts: Sequence[PlacedPart]) -> str:
    """A name of a shaft that no gear has."""
    return f"shaft {name}" if name in {part.name for part in parts} else name


def _heights(case: Gearbox) -> list[float]:
    """Middle of every gear along z, m: where drawn shafts say it, else the planes one after the other."""
    drawn = {
        body: shaft.start + place
        for shaft in (case.system.shafts if case.system is not None else ())
        for body, place in shaft.points
    }
    along = [gear.axial_position + beside for gear, beside in zip(case.gears, _beside(case), strict=True)]
    middle: dict[int, float] = {}
    top = None
    for plane in sorted({gear.plane for gear in case.gears}):
        own = [n for n, gear in enumerate(case.gears) if gear.plane == plane]
        known = [drawn[case.gears[n].body] for n in own if case.gears[n].body in drawn]
        low = min(along[n] - case.gears[n].face_width / 2.0 for n in own)
        high = max(along[n] + case.gears[n].face_width / 2.0 for n in own)
        if known:
            middle[plane] = known[0]
        else:
            room = _ROOM * (high - low)
            middle[plane] = 0.0 if top is None else top + room - low
        top = middle[plane] + high if top is None else max(top, middle[plane] + high)
    return [drawn.get(gear.body, middle[gear.plane]) + along[n] for n, gear in enumerate(case.gears)]


def _beside(case: Gearbox) -> list[float]:
    """How far gears of a Ravigneaux set stand beside the middle of the long planets, m."""
    beside = [0.0] * len(case.gears)
    for gearset in case.sets:
        if gearset.teeth.kind != RAVIGNEAUX:
            continue
        short = {gearset.members[SUN], *gearset.planets[: gearset.arms]}
        long = gearset.planets[gearset.arms :]
        width = max(gear.face_width for gear in case.gears if gear.body in long)
        for number, gear in enumerate(case.gears):
            if gear.body in gearset.bodies and gear.body not in long and not gear.axial_position:
                aside = max(0.0, (width - gear.face_width) / 2.0)
                beside[number] = -aside if gear.body in short else aside
    return beside
