"""A mesh of a train's scenario as the scenario of a pair of gears: its teeth, and its share of the losses.

Every gear and every shaft counts once: a gear in its first mesh, all bearings in the first mesh of the train.
The formulas are of gears on fixed axes: those of planetary stages neither churn nor drive air here.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.gears.motion.settings import Friction, Mesh
from tribodyn.gears.rating.requested_losses import loaded_bearings
from tribodyn.gears.supports import GearSupport, GearSupports
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.input.tables.gears.single_teeth import GearPlace, damage_of, own_teeth_of
from tribodyn.input.tables.losses import LossesTable, broken_losses
from tribodyn.input.tables.shafts import listed
from tribodyn.mesh.teeth.fields import CARRYING, OwnTeeth
from tribodyn.studies.motion.drivetrain.duty import TrainOperating
from tribodyn.studies.motion.drivetrain.placed_train import TrainKinematics
from tribodyn.studies.motion.drivetrain.structure import MeshPart
from tribodyn.studies.motion.drivetrain.tables import BareMesh, PlanetaryStage, Stage
from tribodyn.tribology.losses.pair import LossData, ShaftLosses


class PairView(NamedTuple):
    """A mesh as a scenario of one pair of gears, for what those share; its pinion drives."""

    title: str
    name: str
    kind: str
    drive: DriveTable
    mesh: Mesh
    operating: TrainOperating
    lubricant: Any
    film: Any
    friction: Friction
    temperature: Any
    supports: GearSupports = GearSupports()  # what holds its gears


def pair_view(scenario: Any, train: TrainKinematics, mesh: int) -> PairView:
    """Look at a mesh, by its number in the train's order, as at a pair of gears."""
    part = train.parts.meshes[train.motion.meshes[mesh]]
    table, helical = _mesh_table(scenario, part), [bool(drive.helix_angle) for drive in train.drives]
    if any(helical) and not helical[mesh] and table.compliance != "fem":
        # slices are of the helical meshes
        table = table.model_copy(update={"slices": None, "slice_coupling": True})
    return PairView(
        scenario.title,
        scenario.name or "scenario",
        scenario.kind,
        train.drives[mesh],
        table,
        scenario.operating,
        scenario.lubricant,
        scenario.film,
        scenario.friction,
        scenario.temperature,
    )


def stiffness_key(mesh: str, planetary: str = "") -> str:
    """Which key of a stage gives the stiffness of a mesh; `planetary` is the name of a planetary stage."""
    if not planetary:
        return "stiffness"
    return "ring_stiffness" if mesh.startswith(f"{planetary}-ring-") else "sun_stiffness"


def _mesh_table(scenario: Any, mesh: MeshPart) -> Mesh:
    """The table [mesh] that holds for a mesh."""
    table = mesh.table
    if isinstance(table, BareMesh):
        plain = Mesh.model_validate({"damping_ratio": 0.0})
        keys = {name: getattr(table, name) for name in ("stiffness", "table", "damping_ratio", "backlash")}
        compliance = "constant" if table.table is None else "table"
        return plain.model_copy(update=keys | {"compliance": compliance})
    values = {}
    if isinstance(table, (Stage, PlanetaryStage)):
        values = {name: getattr(table, name) for name in ("damping_ratio", "backlash")}
        planetary = table.name if isinstance(table, PlanetaryStage) else ""
        values["stiffness"] = getattr(table, stiffness_key(mesh.name, planetary))
    return scenario.mesh.model_copy(
        update={name: value for name, value in values.items() if value is not None}
    )


def reference_teeth(train: TrainKinematics) -> int:
    """Teeth of the gear that drives the first mesh: its cycles in a revolution against the mesh's frame."""
    return abs(train.parts.gears[train.motion.gears[0][0]].teeth)


def own_teeth(scenario: Any, train: TrainKinematics, mesh: int, view: Any) -> tuple[OwnTeeth, OwnTeeth]:
    """What teeth of driver and driven gear of a mesh have; `view` is its `scenario.PairView`."""
    numbers = train.motion.gears[mesh]
    one, two = (tuple(sorted({CARRYING[side] for _, side in train.meshes_of(gear)})) for gear in numbers)
    deviations = own_teeth_of(view.drive, view.mesh.tooth_sample, numbers, (one, two))
    damaged, both_gears = gears_of_train(train), []
    for deviating, number in zip(deviations, numbers, strict=True):
        name = train.parts.gears[number].name
        tables = [table for table in scenario.damage if table.gear == name]
        both_gears.append((*deviating, *damage_of(tables, damaged[name])))
    return both_gears[0], both_gears[1]


def gears_of_train(train: TrainKinematics) -> dict[str, GearPlace]:
    """The gears that may be damaged, by name."""
    return {
        gear.name: GearPlace(tuple((train.drives[mesh], side) for mesh, side in train.meshes_of(number)))
        for number, gear in enumerate(train.parts.gears)
    }


def losses_of_meshes(
    table: LossesTable | None,
    train: TrainKinematics,
    speed: float,
    held: Mapping[int, GearSupport],
    drawn: Mapping[int, str],
) -> list[LossData | None]:
    """What every mesh counts of the losses; None: nothing. `speed` is that of the reference body, rad/s.

    `held` has the bearings of drawn shafts by body, `drawn` the names of these shafts.
    """
    motion, parts = train.motion, train.parts
    if table is None or not table.any:
        return [None] * len(motion.meshes)
    places = {body.name: number for number, body in enumerate(parts.bodies)}
    places |= {name: ends[0] for name, ends in parts.places.items()}
    numbers = {name: body for body, name in drawn.items()}
    numbers |= {name: train.numbers[place] for name, place in places.items()}
    shafts = [replace(shaft, body=numbers[name]) for name, shaft in table.shafts().items()]
    if table.bearings is not None:
        shafts += [
            ShaftLosses(name, body=body, bearings=loaded_bearings(name, support.bearings))
            for body, support in held.items()
            if support.bearings and (name := drawn.get(body, parts.bodies[motion.bodies[body]].name))
        ]
    turns = {shaft: speed * abs(_turn(train, shaft.body)) for shaft in shafts if shaft.body is not None}
    # one that stands loses nothing
    turning = [replace(shaft, speed=turn) for shaft, turn in turns.items() if turn]
    losses, counted_gears = [], set[int]()
    for mesh, gears in enumerate(motion.gears):
        fixed = motion.carrier[mesh] < 0
        one, two = (gear not in counted_gears and fixed for gear in gears)
        counted_gears |= set(gears)
        data = table.data(*(parts.gears[gear].name for gear in gears))
        in_oil = (fixed, fixed) if data.of_stage else (one, two)
        depths = [
            depth if dips else 0.0
            for depth, dips in zip((data.pinion_immersion, data.gear_immersion), in_oil, strict=True)
        ]
        losses.append(replace(data, pinion_immersion=depths[0], gear_immersion=depths[1], counted=(one, two)))
    losses[0] = replace(losses[0], shafts=tuple(turning))
    return list(losses)


def _turn(train: TrainKinematics, body: int) -> float:
    """Speed of a body over the reference's; of a planet that against its carrier, on whose pin it turns."""
    motion = train.motion
    planets = {train.numbers[planet] for gearset in train.parts.sets for planet in gearset.planets}
    carrier = -1
    if body in planets:
        ends = zip(motion.driver, motion.driven, motion.carrier, strict=True)
        carrier = next(of for one, two, of in ends if body in (one, two))
    return float(motion.ratio[body] - motion.carried(body, carrier))


def broken_train_losses(
    table: LossesTable | None, train: TrainKinematics, shafts: Any
) -> Iterator[InputError]:
    """Go through the rules that a train's losses break; `shafts` is its table of them."""
    parts = train.parts
    gears = [gear.name for gear in parts.gears]
    of_drawn = [shaft.name for shaft in listed(shafts) if shaft.drawn is not None]
    bodies = list(dict.fromkeys([*gears, *(body.name for body in parts.bodies), *of_drawn]))
    carriers = [
        parts.bodies[train.motion.bodies[body]].name
        for body in dict.fromkeys(train.motion.carrier)
        if body >= 0
    ]
    drawn = {
        name: [
            (f"shaft.{number}.drawn.bearing.{place}", table)
            for place, table in enumerate(shaft.drawn.bearing)
        ]
        for number, shaft in enumerate(listed(shafts))
        if shaft.drawn is not None
        for name in dict.fromkeys((shaft.name, *shaft.gears, *shaft.drawn.positions))
    }
    carried = {parts.gears[gear].name for gear in _carried(train)}
    yield from broken_losses(table, gears, bodies, carried, carriers, drawn)


def _carried(train: TrainKinematics) -> set[int]:
    """Gears of planetary stages."""
    motion = train.motion
    meshes = zip(motion.gears, motion.carrier, strict=True)
    return {gear for gears, carrier in meshes if carrier >= 0 for gear in gears}
