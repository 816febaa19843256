"""A train as its scenario draws it: parts, speeds, the pair of every mesh, axes, and room for the gears."""

from collections.abc import Callable
from fractions import Fraction
from itertools import count
from math import pi, remainder
from typing import Any, NamedTuple, TypeVar

from tribodyn.errors import InputError, InputErrors
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Drive, Side, tip_circle_radius
from tribodyn.geometry.families import Family, family
from tribodyn.geometry.limits.checks import check, check_path
from tribodyn.input.tables.gears.drive_data import drive_of
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.studies.motion.drivetrain.clutch_rules import refuse_meshing_beyond
from tribodyn.studies.motion.drivetrain.pair_tables import drive_table
from tribodyn.studies.motion.drivetrain.structure import (
    OF_DRIVE,
    Structure,
    motion_of,
    structure,
)
from tribodyn.studies.motion.drivetrain.teeth import check_planet, check_same_teeth, engagement
from tribodyn.studies.motion.planetary.room import directions, in_planes, refuse_overlap
from tribodyn.studies.motion.planetary.stages import coaxial
from tribodyn.train.joints import GivenSpeed, joined
from tribodyn.train.kinematics import TrainSpeeds
from tribodyn.train.phases import ToothedShaft, nominal_phases
from tribodyn.train.planetary import IN_PAIRS
from tribodyn.train.positions import Centres, Disc, Distance, check_room, places

#: Modules by which a loop of meshes may not close, a choice: the rounding of azimuths in degrees with two
#: decimals moves axes less, and backlash changes by 0.7 of it.
LOOP_TOLERANCE = 0.01
SENSES = {"clockwise": -1, "counter-clockwise": 1}


_Checked = TypeVar("_Checked")


class TrainKinematics(NamedTuple):
    """A train that is known to turn; meshes and bodies in the order of `motion`."""

    parts: Structure
    motion: TrainSpeeds
    drives: tuple[DriveTable, ...]  # of every mesh; its pinion drives

    @property
    def numbers(self) -> dict[int, int]:
        """Body as the scenario writes it -> its number in the train's order."""
        return {body: number for number, body in enumerate(self.motion.bodies)}

    @property
    def couplings(self) -> list[tuple[int, int]]:
        """Bodies, by their numbers, that turn alike."""
        new = self.numbers
        return [(new[one], new[two]) for _, (one, two) in self.parts.couplings()]

    def meshes_of(self, gear: int) -> tuple[tuple[int, Side], ...]:
        """The meshes that a gear belongs to, and what it is in the pair of each."""
        return tuple(
            (mesh, side)
            for mesh, gears in enumerate(self.motion.gears)
            for side, one in zip(SIDES, gears, strict=True)
            if one == gear
        )


class PlacedTrain(NamedTuple):
    """A train that can be made and has room."""

    assemblies: tuple[Assembly, ...]  # of every mesh
    places: Centres  # azimuths from driver to driven axis
    planes: tuple[int, ...]  # of every gear
    shafts: tuple[int, ...]  # of every gear: bodies that couplings join have one


def resolve_kinematics(scenario: Any) -> TrainKinematics:
    """Work out what turns how; the names of the scenario must be sound. InputError where it is no train."""
    parts = structure(scenario)
    source, output = ends_of(scenario)
    loads = [load.at for load in scenario.load if load.torque is not None]
    outputs = [parts.body(name) for name in (output, *loads) if name]
    given = [
        GivenSpeed(f"load.{number}.speed_ratio", parts.body(load.at), Fraction(str(load.speed_ratio)))
        for number, load in enumerate(scenario.load)
        if load.speed_ratio is not None
    ]
    motion = motion_of(parts, parts.body(source), SENSES[scenario.operating.sense], outputs, given)
    if parts.clutches:
        refuse_meshing_beyond(parts, motion, prescribed=scenario.operating.source == "speed")
    if scenario.drive is not None and motion.gears[0] != (0, 1):
        rule = "a drive file says that its pinion drives"
        raise InputError("operating.input", source, rule, f'write input = "{OF_DRIVE[0]}"')
    drives = tuple(
        drive_table(scenario, parts, parts.meshes[mesh], *gears)
        for mesh, gears in zip(motion.meshes, motion.gears, strict=True)
    )
    return TrainKinematics(parts, motion, drives)


def ends_of(scenario: Any) -> tuple[str, str | None]:
    """Names of what the power enters at and leaves at, beside [[load]]."""
    operating, default = scenario.operating, OF_DRIVE if scenario.drive is not None else ("", None)
    loads = [load.at for load in scenario.load]
    return operating.input or default[0], operating.output or (None if loads else default[1])


def place_train(train: TrainKinematics) -> PlacedTrain:
    """Put the teeth together and place the axes.

    Raises InputError where teeth cannot be made or differ between the meshes of one gear, loops do not close,
    or gears have no room.
    """
    parts = train.parts
    for own in parts.sets:
        planet = next(number for number, gear in enumerate(parts.gears) if gear.body == own.planets[0])
        met: list[tuple[Drive, Side]] = []
        for mesh, side in train.meshes_of(planet):
            drive = train.drives[mesh]
            if not drive.has_ring:  # the ring may need another path
                _checked(train, mesh, check_path)
            met.append((drive_of(drive), side))
        check_planet(f"{own.key}.family", own.table.family, met)
    assemblies = _assemblies(train)
    for number, gear in enumerate(parts.gears):
        seen: list[tuple[Assembly, Side]] = [
            (assemblies[mesh], side) for mesh, side in train.meshes_of(number)
        ]
        check_same_teeth(gear.key, gear.name, seen)
    new, couplings = train.numbers, train.couplings
    axes = _placed(train, assemblies)
    planes = _planes(parts)
    discs = [
        Disc(gear.name, gear.key, gear.body, plane, tip_radius(train, assemblies, number))
        for number, (gear, plane) in enumerate(zip(parts.gears, planes, strict=True))
    ]
    for own in parts.sets:
        arms = own.table.planets
        for alike in (own.planets[:arms], own.planets[arms:]):
            if tips := [disc.tip_radius for disc in discs if disc.body in alike[:1]]:
                refuse_overlap(own, max(tips), axes.centres[[new[planet] for planet in alike]])
    discs, meshing = in_planes(parts.sets, discs, [mesh.gears for mesh in parts.meshes])
    discs = [disc._replace(body=new[disc.body]) for disc in discs]
    check_room(discs, axes.centres, meshing)
    shafts = joined(len(parts.bodies), couplings)
    found = PlacedTrain(assemblies, axes, planes, tuple(shafts[new[gear.body]] for gear in parts.gears))
    _check_phases(train, found)
    return found


def _assemblies(train: TrainKinematics) -> tuple[Assembly, ...]:
    return tuple(_checked(train, mesh, check) for mesh in range(len(train.drives)))


def _checked(train: TrainKinematics, mesh: int, check: Callable[[Family, Drive], _Checked]) -> _Checked:
    """What a check of the teeth of a mesh returns; its errors have the keys of the train's scenario."""
    table = train.drives[mesh]
    try:
        return check(family(table.family), drive_of(table))
    except InputError as error:
        raise in_terms_of_train(error, train, mesh) from None


def in_terms_of_train(error: InputError, train: TrainKinematics, mesh: int) -> InputError:
    """The error of a mesh's pair of gears with the keys of the train's scenario."""
    if isinstance(error, InputErrors):
        return InputErrors([in_terms_of_train(one, train, mesh) for one in error.errors])
    key = key_in_train(error.key, train, mesh)
    if key == error.key:
        return error
    remedy = error.remedy.replace("drive.material for both", "material for all")
    for table in ("to [drive]", "[drive]"):
        remedy = remedy.replace(table, table.replace("[drive]", "[[stage]]"))
    return InputError(key, error.value, error.rule, remedy, error.file)


def key_in_train(key: str, train: TrainKinematics, mesh: int) -> str:
    """Where the train's scenario has a key of a mesh's pair of gears; other keys are its own."""
    part = train.parts.meshes[train.motion.meshes[mesh]]
    head, _, rest = key.partition(".")
    if head != "drive" or part.key == "drive":
        return key
    side, _, inner = rest.partition(".")
    if side in SIDES:
        return f"{train.parts.gears[train.motion.gears[mesh][SIDES.index(side)]].key}.{inner}"
    return f"{part.key}.{rest}" if hasattr(part.table, side) else rest


def _placed(train: TrainKinematics, assemblies: tuple[Assembly, ...]) -> Centres:
    """Axes, with azimuths from driver to driven."""
    parts, motion, new = train.parts, train.motion, train.numbers
    distances, turned = [], []
    follow = _following(train, assemblies)
    for number, assembly in zip(motion.meshes, assemblies, strict=True):
        mesh = parts.meshes[number]
        one, two = (new[parts.gears[gear].body] for gear in mesh.gears)
        path = assembly.path
        apart = float(path.pinion_pitch_radius + path.gear_pitch_radius)
        tolerance = LOOP_TOLERANCE * float(assembly.drive.module)
        azimuth = follow.get(number, mesh.azimuth)
        distances.append(Distance(mesh.key, (one, two), apart, azimuth, tolerance))
        turned.append(mesh.gears != motion.gears[motion.meshes.index(number)])
    on_one_axis = [(new[one], new[two]) for one, two in coaxial(parts.sets)]
    positions = places(len(parts.bodies), distances, [*train.couplings, *on_one_axis])
    azimuths = tuple(
        remainder(azimuth + pi * reverse, 2.0 * pi)
        for azimuth, reverse in zip(positions.azimuths, turned, strict=True)
    )
    return positions._replace(azimuths=azimuths)


def _following(train: TrainKinematics, assemblies: tuple[Assembly, ...]) -> dict[int, float]:
    """Directions of the meshes of planets in pairs by their numbers in the scenario, rad."""
    parts, found = train.parts, dict[int, float]()
    paths = dict(zip(train.motion.meshes, (assembly.path for assembly in assemblies), strict=True))
    for number, own in enumerate(parts.sets):
        if own.table.type not in IN_PAIRS:
            continue
        meshes: dict[str, list[int]] = {}
        for place, mesh in enumerate(parts.meshes):
            if mesh.of_set == number:
                meshes.setdefault(mesh.member, []).append(place)
        apart = {
            member: float(paths[of[0]].pinion_pitch_radius + paths[of[0]].gear_pitch_radius)
            for member, of in meshes.items()
        }
        for member, angles in directions(own, apart).items():
            found |= dict(zip(meshes[member], angles, strict=True))
    return found


def tip_radius(train: TrainKinematics, assemblies: tuple[Assembly, ...], gear: int) -> float:
    """Radius of the tip circle of a gear, m."""
    mesh, side = train.meshes_of(gear)[0]
    return float(tip_circle_radius(assemblies[mesh].drive, side))


def _planes(parts: Structure) -> tuple[int, ...]:
    """Axial plane of every gear; gears that stages join stand in one, by default in one of their own."""
    groups = joined(len(parts.gears), [mesh.gears for mesh in parts.meshes])
    stated: dict[int, int] = {}
    for gear, group in zip(parts.gears, groups, strict=True):
        if gear.plane is None:
            continue
        if stated.setdefault(group, gear.plane) != gear.plane:
            rule = f"gears that mesh stand in one plane, and another of these is in plane {stated[group]}"
            raise InputError(f"{gear.key}.plane", gear.plane, rule, "give both the same")
    free = (plane for plane in count(1) if plane not in set(stated.values()))
    plane_of = {group: stated[group] if group in stated else next(free) for group in dict.fromkeys(groups)}
    return tuple(plane_of[group] for group in groups)


def _check_phases(train: TrainKinematics, placed: PlacedTrain) -> None:
    """Raise InputError where the teeth of a loop do not meet."""
    parts, motion, new = train.parts, train.motion, train.numbers
    shafts = [
        ToothedShaft(
            gear.name,
            placed.shafts[number],
            gear.teeth,
            motion.sense[new[gear.body]],
            gear.tooth_angle,
            parts.places_of_planet(number),
        )
        for number, gear in enumerate(parts.gears)
    ]
    nominal_phases(
        shafts,
        [
            engagement(parts.meshes[mesh].key, motion.gears[number], placed.places.azimuths[number], assembly)
            for number, (mesh, assembly) in enumerate(zip(motion.meshes, placed.assemblies, strict=True))
        ],
    )
