"""From the names of a scenario to the bodies, gears, links and meshes of its train, each by its number.

Bodies are the gears that a rigid shaft joins, every other gear by itself, and the bodies without teeth. They
are in the order of the file here, the planets behind them; the train's own order begins with the reference
body, see `train.kinematics`.
"""

from collections.abc import Iterator, Sequence
from math import pi
from typing import Any, NamedTuple

from tribodyn.input.tables.gears.model_files import DriveTable, Gear
from tribodyn.input.tables.laws import LinkTable
from tribodyn.input.tables.shafts import Shaft, in_order, listed, torsional_springs
from tribodyn.studies.motion.drivetrain.tables import (
    GROUND,
    BareMesh,
    Clutch,
    Link,
    PlanetaryStage,
    Stage,
)
from tribodyn.studies.motion.planetary.stages import (
    SetPart,
    gears_with_hands,
    meshes_of_set,
    planet_names,
    planetary_stages,
    set_of,
)
from tribodyn.train.joints import GivenSpeed, Joint, Named, Toothed
from tribodyn.train.kinematics import TrainSpeeds, kinematics

#: Names of the gears of a drive file.
OF_DRIVE = ("pinion", "gear")


class BodyPart(NamedTuple):
    """A body before the train is put in order."""

    name: str
    key: str
    mass: float  # of what is no gear, kg
    inertia: float  # likewise, kg m²


class GearPart(NamedTuple):
    """A gear before the train is put in order."""

    name: str
    key: str
    body: int
    table: Gear
    plane: int | None
    tooth_angle: float  # rad
    axial_position: float = 0.0  # m

    @property
    def teeth(self) -> int:
        """Number of teeth; negative of an internal gear."""
        return -self.table.teeth if self.table.internal else self.table.teeth


class MeshPart(NamedTuple):
    """A mesh before it is known which of its gears drives."""

    name: str
    key: str
    gears: tuple[int, int]
    azimuth: float | None  # from the first gear's axis to the second's, rad
    table: Stage | PlanetaryStage | BareMesh | DriveTable
    of_set: int = -1  # number of its planetary set; −1: none
    member: str = ""  # which of the set's gears it is a mesh of


class LinkPart(NamedTuple):
    """A link between bodies; −1 is the housing. Directions x, y and rotation."""

    name: str
    key: str
    ends: tuple[int, int]
    stiffness: tuple[float, float, float]
    damping: tuple[float, float, float]
    damping_ratio: tuple[float, float, float]
    table: LinkTable


class ClutchPart(NamedTuple):
    """A clutch between bodies, or a brake, whose second end is −1, the housing."""

    name: str
    key: str
    ends: tuple[int, int]
    table: Clutch


class Structure(NamedTuple):
    """A train as its scenario writes it."""

    bodies: tuple[BodyPart, ...]
    gears: tuple[GearPart, ...]
    meshes: tuple[MeshPart, ...]
    links: tuple[LinkPart, ...]
    #: name of a gear, shaft or body -> its body, both of a compliant shaft, all planets of a planet
    places: dict[str, tuple[int, ...]]
    sets: tuple[SetPart, ...] = ()
    clutches: tuple[ClutchPart, ...] = ()

    def body(self, name: str) -> int:
        """The body of that name; of a compliant shaft the first."""
        return self.places[name][0]

    def places_of_planet(self, gear: int) -> int:
        """Places in which a planet may stand while the other of its two gears stays in its gaps; else 1."""
        body = self.gears[gear].body
        others = [one.teeth for k, one in enumerate(self.gears) if one.body == body and k != gear]
        return others[0] if others and any(body in one.planets for one in self.sets) else 1

    def springs(self) -> list[tuple[LinkPart, tuple[int, int]]]:
        """Links that twist."""
        return [(link, link.ends) for link in self.links if link.stiffness[2] > 0.0]

    def couplings(self) -> list[tuple[LinkPart | ClutchPart, tuple[int, int]]]:
        """Links that make two bodies turn alike, and clutches, which do so when they are closed."""
        return [*self.springs(), *((one, one.ends) for one in self.clutches if one.ends[1] >= 0)]


def structure(scenario: Any) -> Structure:
    """Number the parts of a scenario whose names are sound, see `names.broken_names`."""
    if isinstance(scenario.mesh, tuple):
        return _bare(scenario)
    stages = planetary_stages(scenario)
    of_planets = {name for _, stage in stages for name in stage.planet_gears}
    with_hands = gears_with_hands(scenario)
    tables: dict[str, Gear] = {name: gear for name, gear in with_hands.items() if name not in of_planets}
    if scenario.drive is not None:
        tables = dict(zip(OF_DRIVE, (scenario.drive.pinion, scenario.drive.gear), strict=True))
    shafts = list(enumerate(listed(scenario.shaft)))
    rigid = [(number, shaft) for number, shaft in shafts if shaft.rigid]
    bodies: list[BodyPart] = []
    places: dict[str, tuple[int, ...]] = {}
    for number, shaft in rigid:
        for name in (shaft.name, *shaft.gears):
            places[name] = (len(bodies),)
        bodies.append(BodyPart(shaft.name, f"shaft.{number}", shaft.mass, shaft.inertia))
    for name in tables:
        if name not in places:
            places[name] = (len(bodies),)
            bodies.append(BodyPart(name, _gear_key(scenario, name), 0.0, 0.0))
    _own_bodies(scenario, bodies, places)
    for _, stage in stages:
        for planet in stage.planet_bodies:
            places[planet] = tuple(range(len(bodies), len(bodies) + stage.planets))
            names = planet_names(stage, planet)
            bodies += [BodyPart(name, f"gear.{planet}", 0.0, 0.0) for name in names]
        places.setdefault(stage.planet_gears[-1], places[stage.planet])
    springs: list[LinkPart] = []
    for number, shaft in shafts:
        if shaft.stiffness is not None:
            springs.append(_spring(number, shaft, places))
            for end in springs[-1].ends:  # half of the shaft turns with either gear
                half = bodies[end]
                bodies[end] = half._replace(
                    mass=half.mass + shaft.mass / 2, inertia=half.inertia + shaft.inertia / 2
                )
            places[shaft.name] = springs[-1].ends
        elif not shaft.rigid:
            for one, two, stiffness, ratio in torsional_springs(shaft):
                ends = places[one][0], places[two][0]
                springs.append(
                    _torsion(f"{shaft.name}-{one}-{two}", number, ends, (stiffness, 0.0, ratio), shaft)
                )
            places[shaft.name] = tuple(places[name][0] for name in in_order(shaft))
    gears = [_gear(name, _gear_key(scenario, name), places[name][0], table) for name, table in tables.items()]
    for _, stage in stages:
        for planet in stage.planet_gears:
            each = zip(planet_names(stage, planet), places[planet], strict=True)
            gears += [_gear(name, f"gear.{planet}", body, with_hands[planet]) for name, body in each]
    return Structure(
        tuple(bodies),
        tuple(gears),
        tuple(_stages(scenario, gears)),
        (*springs, *_links(scenario, places)),
        places,
        tuple(set_of(scenario, key, stage, places) for key, stage in stages),
        tuple(_clutches(scenario, places)),
    )


def _gear(name: str, key: str, body: int, table: Gear) -> GearPart:
    placement = getattr(table, "plane", None), getattr(table, "tooth_angle", 0.0)
    return GearPart(name, key, body, table, *placement, getattr(table, "axial_position", 0.0))


def _gear_key(scenario: Any, name: str) -> str:
    return f"gear.{name}" if scenario.drive is None else f"drive.{name}"


def _own_bodies(scenario: Any, bodies: list[BodyPart], places: dict[str, tuple[int, ...]]) -> None:
    for number, body in enumerate(scenario.body):
        places[body.name] = (len(bodies),)
        bodies.append(BodyPart(body.name, f"body.{number}", body.mass, body.inertia))


def _stages(scenario: Any, gears: Sequence[GearPart]) -> Iterator[MeshPart]:
    if scenario.drive is not None:
        # as a pair is drawn: the gear above the pinion
        yield MeshPart("mesh", "drive", (0, 1), pi / 2, scenario.drive)
    numbers = {gear.name: number for number, gear in enumerate(gears)}
    sets = 0
    for place, stage in enumerate(scenario.stage):
        key = f"stage.{place}"
        if isinstance(stage, PlanetaryStage):
            for member, name, one, two, angle in meshes_of_set(stage):
                yield MeshPart(name, key, (numbers[one], numbers[two]), angle, stage, sets, member)
            sets += 1
        else:
            ends = numbers[stage.gears[0]], numbers[stage.gears[1]]
            yield MeshPart(stage.name or "-".join(stage.gears), key, ends, stage.azimuth, stage)


def _spring(number: int, shaft: Shaft, places: dict[str, tuple[int, ...]]) -> LinkPart:
    ends = places[shaft.gears[0]][0], places[shaft.gears[1]][0]
    acts = shaft.stiffness or 0.0, shaft.damping, shaft.damping_ratio
    return _torsion(shaft.name, number, ends, acts, shaft)


def _torsion(
    name: str, number: int, ends: tuple[int, int], acts: tuple[float, float, float], shaft: Shaft
) -> LinkPart:
    """A link that twists alone: stiffness, damping and damping ratio."""
    stiffness, damping, ratio = ((0.0, 0.0, each) for each in acts)
    return LinkPart(name, f"shaft.{number}", ends, stiffness, damping, ratio, shaft)


def _links(scenario: Any, places: dict[str, tuple[int, ...]]) -> Iterator[LinkPart]:
    link: Link
    for number, link in enumerate(scenario.link):
        ends = [-1 if name == GROUND else places[name][0] for name in link.ends]
        stiffness = link.stiffness_x, link.stiffness_y, link.stiffness or 0.0
        yield LinkPart(
            link.name or "-".join(link.ends),
            f"link.{number}",
            (ends[0], ends[1]),
            stiffness,
            (link.damping_x, link.damping_y, link.damping),
            (link.damping_ratio, link.damping_ratio, link.damping_ratio),
            link,
        )


def _clutches(scenario: Any, places: dict[str, tuple[int, ...]]) -> Iterator[ClutchPart]:
    clutch: Clutch
    for number, clutch in enumerate(scenario.clutch):
        one, two = (-1 if name == GROUND else places[name][0] for name in clutch.ends)
        ends = (two, one) if one < 0 else (one, two)
        yield ClutchPart(clutch.name or "-".join(clutch.ends), f"clutch.{number}", ends, clutch)


def _bare(scenario: Any) -> Structure:
    """A bare model: ends of meshes with the same teeth on one body are one gear."""
    bodies: list[BodyPart] = []
    places: dict[str, tuple[int, ...]] = {}
    _own_bodies(scenario, bodies, places)
    gears: list[GearPart] = []
    gear_of: dict[tuple, int] = {}
    meshes = []
    for number, mesh in enumerate(scenario.mesh):
        key, ends = f"mesh.{number}", []
        for name, teeth, shift in zip(mesh.bodies, mesh.teeth, mesh.profile_shift, strict=True):
            which = (name, teeth, shift, mesh.module, mesh.pressure_angle, mesh.face_width)
            if which not in gear_of:
                gear_of[which] = len(gears)
                table = Gear.model_validate({"teeth": teeth, "face_width": "1 mm", "profile_shift": shift})
                table = table.model_copy(update={"face_width": mesh.face_width})
                gears.append(GearPart(name, key, places[name][0], table, None, 0.0))
            ends.append(gear_of[which])
        name = mesh.name or "-".join(mesh.bodies)
        meshes.append(MeshPart(name, key, (ends[0], ends[1]), mesh.azimuth, mesh))
    return Structure(
        tuple(bodies),
        _named_apart(gears),
        tuple(meshes),
        tuple(_links(scenario, places)),
        places,
        clutches=tuple(_clutches(scenario, places)),
    )


def _named_apart(gears: Sequence[GearPart]) -> tuple[GearPart, ...]:
    """Number the gears of bodies that have several: shaft, shaft-2."""
    named, count = [], dict[str, int]()
    for gear in gears:
        count[gear.name] = count.get(gear.name, 0) + 1
        number = count[gear.name]
        named.append(gear if number == 1 else gear._replace(name=f"{gear.name}-{number}"))
    return tuple(named)


def motion_of(
    parts: Structure, source: int, sense: int, outputs: Sequence[int], given: Sequence[GivenSpeed] = ()
) -> TrainSpeeds:
    """Speeds and order of a train; raises as `train.kinematics.kinematics` does."""
    return kinematics(
        [Named(body.name, body.key) for body in parts.bodies],
        [Toothed(gear.name, gear.key, gear.body, gear.teeth) for gear in parts.gears],
        [Joint(mesh.key, mesh.gears, mesh.of_set) for mesh in parts.meshes],
        [Joint(link.key, ends) for link, ends in parts.couplings()],
        source,
        sense,
        [one.turning() for one in parts.sets],
        outputs,
        given,
    )
