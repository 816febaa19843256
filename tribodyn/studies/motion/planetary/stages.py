"""The planetary stages of a scenario: their parts by number, and whether what they name is there."""

from collections.abc import Iterator
from math import cos, sin
from typing import Any, NamedTuple

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input.tables.bearings import bearing_of, broken_bearing
from tribodyn.input.tables.gears.model_files import Hand
from tribodyn.input.tables.shafts import listed
from tribodyn.studies.motion.drivetrain.tables import PlanetaryStage
from tribodyn.train.joints import SetMembers
from tribodyn.train.planetary import (
    CARRIER,
    IN_PAIRS,
    RAVIGNEAUX,
    SECOND_SUN,
    SIMPLE,
    STEPPED,
    SUN,
    SetTeeth,
    check_assembly,
)


class SetPart(NamedTuple):
    """A planetary set by its bodies."""

    key: str
    table: PlanetaryStage
    members: dict[str, int]  # bodies of suns, ring and carrier
    planets: tuple[int, ...]  # bodies, those that mesh with the sun first
    teeth: SetTeeth
    face_width: float  # of the planets, m

    @property
    def held(self) -> int:
        """The body that does not turn; −1: every member turns."""
        return -1 if self.table.held is None else self.members[self.table.held]

    def turning(self) -> SetMembers:
        """The set as its kinematics see it."""
        central = tuple(body for name, body in self.members.items() if name != CARRIER)
        held = self.held, self.table.held or ""
        return SetMembers(self.key, self.members[CARRIER], central, self.planets, *held)

    @property
    def floating(self) -> tuple[int, ...]:
        """Bodies that no bearing holds."""
        return tuple(self.members[name] for name in self.table.floating)


def planetary_stages(scenario: Any) -> list[tuple[str, PlanetaryStage]]:
    """The planetary stages with their keys."""
    stages = ((f"stage.{number}", stage) for number, stage in enumerate(scenario.stage))
    return [(key, stage) for key, stage in stages if isinstance(stage, PlanetaryStage)]


def planet_names(stage: PlanetaryStage, gear: str) -> list[str]:
    """Names of the planets' gears, by the first of which their bodies are called: planet-1, planet-2."""
    return [f"{gear}-{number}" for number in range(1, stage.planets + 1)]


def teeth_of_set(scenario: Any, stage: PlanetaryStage) -> SetTeeth:
    """Numbers of teeth of a stage whose names are sound."""
    teeth = {name: scenario.gear[name].teeth for name in stage.parts if name != stage.carrier}
    second = [teeth[name] for name in stage.planet_gears[1:]] or [0]
    second_sun = 0 if stage.second_sun is None else teeth[stage.second_sun]
    three = teeth[stage.sun], teeth[stage.planet], -teeth[stage.ring]
    return SetTeeth(*three, second[0], stage.type, second_sun)


def set_of(scenario: Any, key: str, stage: PlanetaryStage, places: dict[str, tuple[int, ...]]) -> SetPart:
    """The set of a stage; `places` are the bodies of names."""
    members = {name: places[gear_name][0] for name, gear_name in stage.members.items()}
    width = float(scenario.gear[stage.planet].face_width)
    planets = tuple(body for name in stage.planet_bodies for body in places[name])
    return SetPart(key, stage, members, planets, teeth_of_set(scenario, stage), width)


def meshes_of_set(stage: PlanetaryStage) -> Iterator[tuple[str, str, str, str, float | None]]:
    """The meshes of a stage: what is at one end, name, both gears, direction between their axes, rad.

    First those of the sun with every planet, last those of the planets with the ring. None: a direction that
    follows from the distances of the axes, see `room`.
    """
    for member, one, two in stage.meshing:
        at_first = stage.type not in IN_PAIRS or member == SUN
        for number, angle in enumerate(stage.placed, start=1):
            ends = [f"{name}-{number}" if name in stage.planet_gears else name for name in (one, two)]
            yield member, f"{stage.name}-{member}-{number}", ends[0], ends[1], angle if at_first else None


def broken_sets(scenario: Any, gears: list[str]) -> Iterator[InputError]:
    """Go through what contradicts itself in the planetary stages, by names and numbers."""
    of_sets: dict[str, str] = {}
    bodies = [body.name for body in scenario.body]
    for key, stage in planetary_stages(scenario):
        yield from _sort(key, stage)
        for name in ("sun", "second_sun", "planet", "second_planet", "ring"):
            gear = getattr(stage, name)
            if gear is None:
                continue
            if gear not in gears:
                yield unknown_name(f"{key}.{name}", gear, gears, "gear")
                continue
            internal = scenario.gear[gear].internal
            if internal is not (name == "ring"):
                kind = "an internal" if name == "ring" else "an external"
                remedy = f"add internal = true to [gear.{gear}]" if name == "ring" else "name another gear"
                yield InputError(f"{key}.{name}", quoted(gear), f"must be {kind} gear", remedy)
        if stage.carrier not in bodies:
            yield unknown_name(f"{key}.carrier", stage.carrier, bodies, "[[body]]")
        for name in ("sun", "second_sun", "planet", "second_planet", "ring", "carrier"):
            gear = getattr(stage, name)
            if gear and (of_sets.setdefault(gear, key) != key or stage.parts.count(gear) > 1):
                rule = f"{gear} is named twice in planetary stages"
                yield InputError(f"{key}.{name}", quoted(gear), rule, "use a gear of its own for each")
        yield from _counts(key, stage)
        yield from _elastic(scenario, key, stage)
        if all(name in gears for name in stage.parts if name != stage.carrier):
            yield from _assembly(scenario, key, stage)
            yield from _hands(scenario, stage)
        yield from _held(scenario, key, stage)
    yield from _joined_rigidly(scenario, of_sets)
    yield from _bearings(scenario, of_sets)


def _sort(key: str, stage: PlanetaryStage) -> Iterator[InputError]:
    """Refuse keys that a sort of stages does not have, and ask for those that it needs."""
    of = f"and type is {quoted(stage.type)}"
    needs = {"second_planet": stage.type != SIMPLE, "second_sun": stage.type == RAVIGNEAUX}
    for name, needed in needs.items():
        if needed is (getattr(stage, name) is None):
            rule = f"missing, {of}" if needed else f"is there, {of}"
            remedy = f'add {name} = "…", a gear' if needed else "leave it out, or change the type"
            yield InputError(f"{key}.{name}", None, rule, remedy)
    if stage.second_module is not None and stage.type != STEPPED:
        remedy = "leave it out, for gears in one train of meshes have one module"
        yield InputError(f"{key}.second_module", None, f"is of stepped planets, {of}", remedy)
    for name in ("held", "floating"):
        if SECOND_SUN in (getattr(stage, name) or ()) and stage.second_sun is None:
            rule = "names a second sun, and the stage has none"
            yield InputError(f"{key}.{name}", None, rule, "name another member")
    if stage.type == SIMPLE:
        return
    if stage.family != "involute":
        rule = f"is not modelled, {of}"
        yield InputError(f"{key}.family", quoted(stage.family), rule, "leave it out: involutes")
    if stage.helix_angle:
        rule = f"is not modelled, {of}: its gears are spur"
        yield InputError(f"{key}.helix_angle", None, rule, "leave it out")
    if stage.type in IN_PAIRS:
        if stage.centre_distance is not None:
            rule = f"is one of three, {of}: they follow from the teeth, without backlash"
            remedy = 'leave it out; give gears profile_shift, and backlash by thickness_allowance = "-30 um"'
            yield InputError(f"{key}.centre_distance", None, rule, remedy)
        for name in ("radial_pin_errors", "tangential_pin_errors"):
            if getattr(stage, name):
                yield InputError(f"{key}.{name}", None, f"is not modelled, {of}", "leave it out")


def _counts(key: str, stage: PlanetaryStage) -> Iterator[InputError]:
    for name in ("angles", "radial_pin_errors", "tangential_pin_errors"):
        values = getattr(stage, name)
        if values and len(values) != stage.planets:
            rule = f"has {len(values)} values for {stage.planets} planets"
            yield InputError(f"{key}.{name}", None, rule, "give one for every planet, or leave it out")
    for number, name in enumerate(stage.floating):
        if name in stage.floating[:number]:
            yield InputError(f"{key}.floating", None, f"names {name} twice", "name each member once")
    if stage.floating and stage.planets < 3:
        rule = f"{stage.planets} planets do not hold a floating {stage.floating[0]} in place"
        yield InputError(f"{key}.floating", None, rule, "give it a bearing, or the stage three planets")
    if len(stage.floating) == len(stage.members):
        rule = "no member of the set has a bearing: it has no place"
        yield InputError(f"{key}.floating", None, rule, "let one of them have a bearing")


def _elastic(scenario: Any, key: str, stage: PlanetaryStage) -> Iterator[InputError]:
    """Refuse rims and pins that contradict themselves, and rims whose bending the mesh has too."""
    rim, pin = stage.ring_rim, stage.pin
    if rim is not None:
        held_by = scenario.gear[stage.ring].rim if stage.ring in scenario.gear else "fixed"
        if held_by != "fixed":
            rule = f"counts the bending of the rim twice, for {key}.ring_rim has it"
            yield InputError(f"gear.{stage.ring}.rim", quoted(held_by), rule, "leave it out")
        if rim.pins is not None and rim.orders > rim.pins - 2:
            rule = f"{rim.pins} pins couple waves of higher orders than {rim.pins - 2} with the ring's shift"
            yield InputError(
                f"{key}.ring_rim.orders", rim.orders, rule, f"give at most {rim.pins - 2}, or more pins"
            )
        for name in ("pins", "tangential_stiffness"):
            if rim.stiffness is None and getattr(rim, name) is not None:
                remedy = 'add stiffness = "2e8 N/m", radial, of each pin, or of the whole fit'
                yield InputError(f"{key}.ring_rim.stiffness", None, f"missing beside {name}", remedy)
                break
    if pin is None:
        return
    drawn = [name for name in ("diameter", "length") if getattr(pin, name) is not None]
    if pin.stiffness is not None and drawn:
        remedy = "give the one or the other"
        yield InputError(f"{key}.pin.stiffness", None, f"contradicts {drawn[0]}, of which it follows", remedy)
    elif pin.stiffness is None and len(drawn) < 2:
        name = "length" if drawn == ["diameter"] else "diameter"
        yield InputError(f"{key}.pin.{name}", None, "missing", "add it, or the pin's stiffness")
    elif pin.diameter is not None and pin.bore >= pin.diameter:
        rule = f"is not below the diameter of {1e3 * pin.diameter:g} mm"
        yield InputError(f"{key}.pin.bore", f"{1e3 * pin.bore:g} mm", rule, "give a smaller one")


def hands_of_set(scenario: Any, stage: PlanetaryStage) -> dict[str, Hand | None]:
    """Hands of sun, planets and ring by their names: planets have that of the ring, the sun has the other.

    The first that the scenario gives says all of them; None: it gives none.
    """
    other: dict[Hand | None, Hand | None] = {None: None, "right": "left", "left": "right"}
    given = {name: scenario.gear[name].hand for name in (stage.sun, stage.planet, stage.ring)}
    of_sun = given[stage.sun] or other[given[stage.planet] or given[stage.ring]]
    return {stage.sun: of_sun, stage.planet: other[of_sun], stage.ring: other[of_sun]}


def gears_with_hands(scenario: Any) -> dict[str, Any]:
    """Tables of all gears by their names, those of helical sets with their hands."""
    tables = dict(scenario.gear)
    for _, stage in planetary_stages(scenario):
        for name, hand in hands_of_set(scenario, stage).items() if stage.helix_angle else ():
            tables[name] = tables[name].model_copy(update={"hand": hand})
    return tables


def _hands(scenario: Any, stage: PlanetaryStage) -> Iterator[InputError]:
    """Ask for one hand of a helical set, and refuse those that cross."""
    if not stage.helix_angle:
        return
    for name, hand in hands_of_set(scenario, stage).items():
        given = scenario.gear[name].hand
        if hand is None:
            rule = "missing: of a helical set one gear has to say the hand of its helix"
            yield InputError(f"gear.{name}.hand", None, rule, 'add hand = "right"; the others follow')
            return
        if given is not None and given != hand:
            have = "planets have the hand of the ring, and the sun has the other"
            rule = f"crosses the hands of the stage {stage.name}: {have}"
            yield InputError(
                f"gear.{name}.hand", quoted(given), rule, f"write {quoted(hand)}, or leave it out"
            )
            return


def _assembly(scenario: Any, key: str, stage: PlanetaryStage) -> Iterator[InputError]:
    if stage.angles and len(stage.angles) != stage.planets:
        return
    teeth = teeth_of_set(scenario, stage)
    if teeth.sun >= -teeth.ring:
        rule = f"the ring's {-teeth.ring} teeth do not reach around the sun's {teeth.sun}"
        yield InputError(f"{key}.ring", quoted(stage.ring), rule, "give the ring more teeth")
        return
    try:
        check_assembly(teeth, stage.placed, f"{key}.angles")
    except InputError as error:
        if stage.angles:
            yield error
        else:
            yield InputError(f"{key}.planets", stage.planets, error.rule, error.remedy)


def _held(scenario: Any, key: str, stage: PlanetaryStage) -> Iterator[InputError]:
    """Refuse power at a member that is held."""
    if stage.held not in stage.members:
        return
    held, operating = stage.members[stage.held], scenario.operating
    named = [("operating.input", operating.input), ("operating.output", operating.output)]
    named += [(f"load.{number}.at", load.at) for number, load in enumerate(scenario.load)]
    for place, name in named:
        if name == held:
            turning = " or ".join(gear for member, gear in stage.members.items() if member != stage.held)
            rule = f"is held in the planetary stage {stage.name}, and does not turn"
            yield InputError(place, quoted(name), rule, f"name {turning}, or hold another member: {key}.held")


def _bearings(scenario: Any, of_sets: dict[str, str]) -> Iterator[InputError]:
    """Bearings of members are the same in all directions, for their frame turns; and none is missing."""
    by_name = scenario.bearings.by_name
    for _, stage in planetary_stages(scenario):
        floating = {stage.members[name] for name in stage.floating}
        if stage.type == STEPPED and stage.second_planet in by_name:
            rule = f"turns on the pins of {stage.planet}, and has their bearings"
            yield InputError(f"bearings.{stage.second_planet}", None, rule, f"name {stage.planet}")
        moves = f"missing: {{}} of the planetary stage {stage.name} moves in x and y"
        if stage.helix_angle:  # a member that floats is held along the axis and against tilts
            floating, moves = set(), f"missing: teeth push {{}} of the planetary stage {stage.name} along z"
        for name in sorted({*stage.members.values(), *stage.planet_bodies} - floating):
            if not {name, "default", "gear"} & set(by_name):
                rule = moves.format(name)
                remedy = f"add [bearings.{name}], or [bearings.default]"
                yield InputError(f"bearings.{name}", None, rule, remedy)
    for name, bearing in scenario.bearings.by_name.items():
        if name not in of_sets and not (name == "default" and of_sets):
            continue
        if any(broken_bearing("", bearing)):
            continue
        data = bearing_of(bearing)
        both = (data.stiffness_x, data.damping_ratio_x), (data.stiffness_y, data.damping_ratio_y)
        if both[0] != both[1]:
            rule = "differs in x and y, and holds members of a planetary stage, whose frame turns"
            remedy = "give stiffness_x and stiffness_y, and their damping ratios, the same values"
            yield InputError(f"bearings.{name}", None, rule, remedy)


def _joined_rigidly(scenario: Any, of_sets: dict[str, str]) -> Iterator[InputError]:
    """Members of sets move in the frames of their carriers, others in the housing."""
    for number, shaft in enumerate(listed(scenario.shaft)):
        for name in shaft.gears:
            if name in of_sets:
                rule = f"{name} is of a planetary stage, which moves in the frame of its carrier"
                remedy = f'join it by a [[link]] with ends = ["{name}", …] and a torsional stiffness'
                yield InputError(f"shaft.{number}.gears", quoted(name), rule, remedy)
                break


def coaxial(sets: tuple[SetPart, ...]) -> list[tuple[int, int]]:
    """Bodies on one axis, in pairs."""
    return [
        (gearset.members[CARRIER], body)
        for gearset in sets
        for name, body in gearset.members.items()
        if name != CARRIER
    ]


def pin_offset(stage: PlanetaryStage, planet: int) -> tuple[float, float]:
    """Place of a planet's pin from where it should be, x and y, m."""
    if not stage.radial_pin_errors and not stage.tangential_pin_errors:
        return 0.0, 0.0
    angle = stage.placed[planet]
    outwards = stage.radial_pin_errors[planet] if stage.radial_pin_errors else 0.0
    onwards = stage.tangential_pin_errors[planet] if stage.tangential_pin_errors else 0.0
    return outwards * cos(angle) - onwards * sin(angle), outwards * sin(angle) + onwards * cos(angle)
