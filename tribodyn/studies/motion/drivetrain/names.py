"""Names in a train's scenario: each stands for one part, and every part that is named is there."""

from collections.abc import Iterator, Sequence
from typing import Any

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input.tables.bearings import DEFAULT, broken_bearings
from tribodyn.input.tables.shafts import broken_list, broken_shafts, in_order, listed
from tribodyn.studies.motion.drivetrain.structure import OF_DRIVE
from tribodyn.studies.motion.drivetrain.tables import GROUND, Link, PlanetaryStage
from tribodyn.studies.motion.planetary.stages import broken_sets, planetary_stages

_PLACE = "gear, shaft or body"


def broken_names(scenario: Any) -> Iterator[InputError]:
    """Go through what is wrong with the names of a scenario that is of one sort, see `broken_sort`."""
    gears: list[str] = list(scenario.gear) if scenario.drive is None else list(OF_DRIVE)
    declared = list(_declared(scenario, gears))
    names = [name for name, _ in declared]
    for place, (name, key) in enumerate(declared):
        if name in (GROUND, DEFAULT):
            yield InputError(key, quoted(name), "has a meaning of its own", "use another name")
        elif name in names[:place]:
            yield InputError(key, quoted(name), "names two parts of the train", "use another name")
    of_planets = [name for _, stage in planetary_stages(scenario) for name in stage.planet_gears]
    for number, stage in enumerate(scenario.stage):
        if not isinstance(stage, PlanetaryStage):
            single = [name for name in gears if name not in of_planets]
            yield from broken_list(f"stage.{number}.gears", stage.gears, single, "gear")
    yield from broken_sets(scenario, gears)
    if isinstance(scenario.mesh, tuple):
        for number, mesh in enumerate(scenario.mesh):
            yield from broken_list(f"mesh.{number}.bodies", mesh.bodies, names, "body")
    bodies = [body.name for body in scenario.body]
    yield from broken_shafts(scenario.shaft, gears, scenario.bearings, bodies)
    yield from _shafts(scenario)
    for number, link in enumerate(scenario.link):
        yield from _link(scenario, f"link.{number}", link, names)
    for number, clutch in enumerate(scenario.clutch):
        yield from _two_bodies(scenario, f"clutch.{number}", clutch.ends, names)
    yield from _ends(scenario, names)
    yield from _bearings(scenario, names)


def broken_sort(scenario: Any) -> Iterator[InputError]:
    """Refuse a drive, stages and a bare model in one scenario, and none of them."""
    bare = isinstance(scenario.mesh, tuple)
    gear_tables = [name for name in ("drive", "gear", "stage", "shaft") if getattr(scenario, name)]
    if bare and gear_tables:
        rule = "contradicts [[mesh]], a bare model: only [[body]], [[link]] and [[clutch]] stand beside it"
        yield InputError(gear_tables[0], None, rule, "leave it out, or write one table [mesh]")
    elif scenario.drive is not None and {"gear", "stage"} & set(gear_tables):
        rule, remedy = "contradicts drive, which is a train of one stage", "leave the one or the other out"
        yield InputError(gear_tables[1], None, rule, remedy)
    elif not bare and scenario.drive is None and not scenario.stage:
        remedy = 'add a [[stage]] with gears = ["pinion", "wheel"]'
        yield InputError("stage", None, "missing: a train has a mesh at least", remedy)


def _declared(scenario: Any, gears: list[str]) -> Iterator[tuple[str, str]]:
    """Names of all parts and their keys."""
    for name in gears:
        yield name, f"gear.{name}" if scenario.drive is None else f"drive.{name}"
    for table, parts in (("shaft", listed(scenario.shaft)), ("body", scenario.body)):
        for number, part in enumerate(parts):
            yield part.name, f"{table}.{number}.name"


def _shafts(scenario: Any) -> Iterator[InputError]:
    for number, shaft in enumerate(listed(scenario.shaft)):
        bodies = [_rigid_body(scenario, name) for name in shaft.gears]
        if shaft.stiffness is not None and len(bodies) == 2 and bodies[0] == bodies[1]:
            rule = f"its gears turn together with the rigid shaft {bodies[0]} already"
            yield InputError(f"shaft.{number}.stiffness", None, rule, "leave the one or the other out")


def _link(scenario: Any, key: str, link: Link, names: list[str]) -> Iterator[InputError]:
    yield from _two_bodies(scenario, key, link.ends, names)
    springs = link.stiffness_x, link.stiffness_y, link.stiffness
    dampers = link.damping_x, link.damping_y, link.damping
    if not any((*springs, *dampers)):
        yield InputError(key, None, "has neither stiffness nor damping", 'add stiffness = "1e5 N*m/rad"')
    if GROUND in link.ends and (link.stiffness or link.damping):
        rule = "a body that turns is not held in rotation by the housing"
        yield InputError(f"{key}.stiffness", None, rule, "leave stiffness and damping out, or name a body")


def _two_bodies(scenario: Any, key: str, ends: Sequence[str], names: list[str]) -> Iterator[InputError]:
    """What is wrong with the ends of a link or clutch."""
    yield from broken_list(f"{key}.ends", ends, [*names, GROUND], f"{_PLACE}, or {quoted(GROUND)}")
    for place, name in enumerate(ends):
        yield from _compliant(scenario, f"{key}.ends.{place}", name)
    bodies = [_rigid_body(scenario, name) for name in ends]
    if bodies[0] == bodies[1] and ends[0] != ends[1]:
        rule = f"{' and '.join(ends)} are one body, the shaft {bodies[0]}"
        yield InputError(f"{key}.ends", None, rule, "name two bodies")


def _rigid_body(scenario: Any, name: str) -> str:
    rigid = (shaft for shaft in listed(scenario.shaft) if shaft.rigid)
    return next((shaft.name for shaft in rigid if name in shaft.gears), name)


def _ends(scenario: Any, names: list[str]) -> Iterator[InputError]:
    """Input, output and loads."""
    operating = scenario.operating
    named = [("operating.input", operating.input), ("operating.output", operating.output)]
    named += [(f"load.{number}.at", load.at) for number, load in enumerate(scenario.load)]
    for key, name in named:
        if name is not None and name not in names:
            yield unknown_name(key, name, names, _PLACE)
        elif name is not None:
            yield from _compliant(scenario, key, name)
    source, output = operating.input, operating.output
    if source and output and _rigid_body(scenario, source) == _rigid_body(scenario, output):
        rule = "is the input too: no power goes through the meshes"
        yield InputError("operating.output", quoted(output), rule, "name another body")


def _compliant(scenario: Any, key: str, name: str) -> Iterator[InputError]:
    for _, stage in planetary_stages(scenario):
        if name in stage.planet_gears:
            rule = f"is a planet, of which there are {stage.planets}"
            yield InputError(key, quoted(name), rule, "name the sun, the ring, the carrier or another body")
    for shaft in listed(scenario.shaft):
        if shaft.name == name and not shaft.rigid:
            rule = "is a compliant shaft, which has a body at either end"
            carried = in_order(shaft) or shaft.gears
            yield InputError(key, quoted(name), rule, f"name one that it carries: {', '.join(carried)}")


def _bearings(scenario: Any, names: list[str]) -> Iterator[InputError]:
    yield from broken_bearings(scenario.bearings, [*names, DEFAULT], f"{_PLACE}, or {quoted(DEFAULT)}")
    held: dict[str, str] = {}
    for name in scenario.bearings.by_name:
        body = _rigid_body(scenario, name)
        if held.setdefault(body, name) != name:
            rule = f"{name} and {held[body]} are one body, which has one bearing"
            yield InputError(f"bearings.{name}", None, rule, f"name the shaft alone: [bearings.{body}]")
