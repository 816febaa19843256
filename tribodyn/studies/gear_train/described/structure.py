"""From the names of a scenario to the bodies, gears, links and meshes of its train, each by its number.

Bodies are the gears that a rigid shaft joins, every other gear by itself, and the bodies without teeth. They
are in the order of the file here; the train's own order begins with the reference body, see
`train.kinematics`.
"""

from collections.abc import Iterator, Sequence
from math import pi
from typing import Any, NamedTuple

from tribodyn.scenario.quantity import Printed
from tribodyn.scenario.tables.bearings import Bearing
from tribodyn.scenario.tables.model_files import DriveTable, Gear
from tribodyn.studies.gear_train.described.tables import GROUND, BareMesh, Link, LinkTable, Shaft, Stage
from tribodyn.studies.gears.motion import Mesh
from tribodyn.train.kinematics import Joint, Named, Toothed, TrainSpeeds, kinematics

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


class MeshPart(NamedTuple):
    """A mesh before it is known which of its gears drives."""

    name: str
    key: str
    gears: tuple[int, int]
    azimuth: float | None  # from the first gear's axis to the second's, rad
    table: Stage | BareMesh | DriveTable


class LinkPart(NamedTuple):
    """A link between bodies; −1 is the housing. Directions x, y and rotation."""

    name: str
    key: str
    ends: tuple[int, int]
    stiffness: tuple[float, float, float]
    damping: tuple[float, float, float]
    damping_ratio: tuple[float, float, float]
    table: LinkTable


class Structure(NamedTuple):
    """A train as its scenario writes it."""

    bodies: tuple[BodyPart, ...]
    gears: tuple[GearPart, ...]
    meshes: tuple[MeshPart, ...]
    links: tuple[LinkPart, ...]
    places: dict[str, tuple[int, ...]]  # name of a gear, shaft or body -> its body, both of a compliant shaft

    def body(self, name: str) -> int:
        """The body of that name; of a compliant shaft the first."""
        return self.places[name][0]

    def couplings(self) -> list[tuple[LinkPart, tuple[int, int]]]:
        """Links that make two bodies turn alike."""
        return [(link, link.ends) for link in self.links if link.stiffness[2] > 0.0]


def structure(scenario: Any) -> Structure:
    """Number the parts of a scenario whose names are sound, see `names.broken_names`."""
    if isinstance(scenario.mesh, tuple):
        return _bare(scenario)
    tables: dict[str, Gear] = dict(scenario.gear)
    if scenario.drive is not None:
        tables = dict(zip(OF_DRIVE, (scenario.drive.pinion, scenario.drive.gear), strict=True))
    rigid = [(number, shaft) for number, shaft in enumerate(scenario.shaft) if shaft.stiffness is None]
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
    springs: list[LinkPart] = []
    for number, shaft in enumerate(scenario.shaft):
        if shaft.stiffness is not None:
            springs.append(_spring(number, shaft, places))
            for end in springs[-1].ends:  # half of the shaft turns with either gear
                body = bodies[end]
                bodies[end] = body._replace(
                    mass=body.mass + shaft.mass / 2, inertia=body.inertia + shaft.inertia / 2
                )
            places[shaft.name] = springs[-1].ends
    gears = tuple(
        GearPart(
            name,
            _gear_key(scenario, name),
            places[name][0],
            table,
            getattr(table, "plane", None),
            getattr(table, "tooth_angle", 0.0),
            getattr(table, "axial_position", 0.0),
        )
        for name, table in tables.items()
    )
    return Structure(
        tuple(bodies), gears, _stages(scenario, gears), (*springs, *_links(scenario, places)), places
    )


def _gear_key(scenario: Any, name: str) -> str:
    return f"gear.{name}" if scenario.drive is None else f"drive.{name}"


def _own_bodies(scenario: Any, bodies: list[BodyPart], places: dict[str, tuple[int, ...]]) -> None:
    for number, body in enumerate(scenario.body):
        places[body.name] = (len(bodies),)
        bodies.append(BodyPart(body.name, f"body.{number}", body.mass, body.inertia))


def _stages(scenario: Any, gears: Sequence[GearPart]) -> tuple[MeshPart, ...]:
    if scenario.drive is not None:
        # as a pair is drawn: the gear above the pinion
        return (MeshPart("mesh", "drive", (0, 1), pi / 2, scenario.drive),)
    numbers = {gear.name: number for number, gear in enumerate(gears)}
    return tuple(
        MeshPart(
            stage.name or "-".join(stage.gears),
            f"stage.{number}",
            (numbers[stage.gears[0]], numbers[stage.gears[1]]),
            stage.azimuth,
            stage,
        )
        for number, stage in enumerate(scenario.stage)
    )


def _spring(number: int, shaft: Shaft, places: dict[str, tuple[int, ...]]) -> LinkPart:
    ends = places[shaft.gears[0]][0], places[shaft.gears[1]][0]
    return LinkPart(
        shaft.name,
        f"shaft.{number}",
        ends,
        (0.0, 0.0, shaft.stiffness or 0.0),
        (0.0, 0.0, shaft.damping),
        (0.0, 0.0, shaft.damping_ratio),
        shaft,
    )


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


def _bare(scenario: Any) -> Structure:
    """A bare model: ends of meshes with the same teeth on one body are one gear."""
    bodies: list[BodyPart] = []
    places: dict[str, tuple[int, ...]] = {}
    _own_bodies(scenario, bodies, places)
    gears: list[GearPart] = []
    known: dict[tuple, int] = {}
    meshes = []
    for number, mesh in enumerate(scenario.mesh):
        key, ends = f"mesh.{number}", []
        for name, teeth, shift in zip(mesh.bodies, mesh.teeth, mesh.profile_shift, strict=True):
            which = (name, teeth, shift, mesh.module, mesh.pressure_angle, mesh.face_width)
            if which not in known:
                known[which] = len(gears)
                table = Gear.model_validate({"teeth": teeth, "face_width": "1 mm", "profile_shift": shift})
                table = table.model_copy(update={"face_width": mesh.face_width})
                gears.append(GearPart(name, key, places[name][0], table, None, 0.0))
            ends.append(known[which])
        name = mesh.name or "-".join(mesh.bodies)
        meshes.append(MeshPart(name, key, (ends[0], ends[1]), mesh.azimuth, mesh))
    return Structure(
        tuple(bodies), _named_apart(gears), tuple(meshes), tuple(_links(scenario, places)), places
    )


def _named_apart(gears: Sequence[GearPart]) -> tuple[GearPart, ...]:
    """Number the gears of bodies that have several: shaft, shaft-2."""
    named, count = [], dict[str, int]()
    for gear in gears:
        count[gear.name] = count.get(gear.name, 0) + 1
        number = count[gear.name]
        named.append(gear if number == 1 else gear._replace(name=f"{gear.name}-{number}"))
    return tuple(named)


def motion_of(parts: Structure, source: int, sense: int) -> TrainSpeeds:
    """Speeds and order of a train; raises as `train.kinematics.kinematics` does."""
    return kinematics(
        [Named(body.name, body.key) for body in parts.bodies],
        [Toothed(gear.name, gear.key, gear.body, gear.table.teeth) for gear in parts.gears],
        [Joint(mesh.key, mesh.gears) for mesh in parts.meshes],
        [Joint(link.key, ends) for link, ends in parts.couplings()],
        source,
        sense,
    )


def drive_table(scenario: Any, parts: Structure, mesh: MeshPart, driver: int, driven: int) -> DriveTable:
    """What a drive file would say of a mesh whose gears drive and are driven."""
    table = mesh.table
    if isinstance(table, DriveTable):
        return table
    pinion, gear = parts.gears[driver].table, parts.gears[driven].table
    common = {
        "module": table.module,
        "pressure_angle": table.pressure_angle,
        "mean_roughness": scenario.mean_roughness,
        "material": scenario.material,
        "quality": scenario.quality,
        "pinion": pinion,
        "gear": gear,
    }
    if isinstance(table, BareMesh):
        return DriveTable.model_construct(family="involute", **common)
    own = {name: getattr(table, name) for name in ("family", "rack", "shape", "roughness", "helix_angle")}
    distance: Printed | None = table.centre_distance
    return DriveTable.model_construct(**common, **own, centre_distance=distance)


def mesh_table(scenario: Any, mesh: MeshPart) -> Mesh:
    """The table [mesh] that holds for a mesh."""
    table = mesh.table
    if isinstance(table, BareMesh):
        plain = Mesh.model_validate({"damping_ratio": 0.0})
        own = {name: getattr(table, name) for name in ("stiffness", "table", "damping_ratio", "backlash")}
        compliance = "constant" if table.table is None else "table"
        return plain.model_copy(update=own | {"compliance": compliance})
    given = {}
    if isinstance(table, Stage):
        given = {name: getattr(table, name) for name in ("damping_ratio", "backlash")}
    return scenario.mesh.model_copy(update={name: own for name, own in given.items() if own is not None})


def bearings_by_body(scenario: Any, parts: Structure) -> list[Bearing | None]:
    """The bearings of every body: its own, else "default", else the gear's of a bearings file; None: none."""
    by_name = scenario.bearings.by_name
    usual = by_name.get("default", by_name.get("gear"))
    found: list[Bearing | None] = [usual] * len(parts.bodies)
    for name, bearing in by_name.items():
        for body in parts.places.get(name, ()):
            found[body] = bearing
    return found
