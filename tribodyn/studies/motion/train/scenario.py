"""The scenario of a train, and the case that is made of it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import ceil
from typing import Annotated, Any, Literal, cast

from pydantic import Discriminator, Field, Tag

from tribodyn.dynamics.data import OperatingData
from tribodyn.gears.case import LubricatedCase, with_chosen
from tribodyn.gears.drawn_system import DrawnSystem
from tribodyn.gears.motion.settings import (
    Friction,
    Mesh,
    Output,
    Solver,
    moving_mesh_of,
    output_data,
    solver_data,
)
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.scenario import FilmKeys, GearboxTemperatureKeys, LossKeys, Oil, gear_fields, oil_fields
from tribodyn.gears.supports import GearSupport
from tribodyn.geometry.drive import SIDES, BodyMass
from tribodyn.input.fields import PartName, head_of
from tribodyn.input.quantity import Count, model_file, written
from tribodyn.input.tables.bearings import Bearing, Bearings, bearing_of
from tribodyn.input.tables.duty import SpectrumScenario
from tribodyn.input.tables.gears.drive_data import materials_of
from tribodyn.input.tables.gears.model_files import (
    DriveTable,
    MaterialReference,
    QualityEdition,
    QualityGrade,
    Roughness,
)
from tribodyn.input.tables.gears.single_teeth import Damages, with_own_teeth
from tribodyn.input.tables.laws import law_values
from tribodyn.input.tables.sensors import Housing, Sensors, housing_of, sensors_of
from tribodyn.input.tables.shafts import Shafts
from tribodyn.input.tables.temperature import gearbox_heat_of
from tribodyn.studies.motion.case import (
    HOUSING,
    BodyData,
    Gearbox,
    GearData,
    LinkData,
    SourceData,
    TrainMesh,
)
from tribodyn.studies.motion.drivetrain.clutch_rules import clutch_data
from tribodyn.studies.motion.drivetrain.duty import (
    LoadTable,
    TrainDuty,
    TrainOperating,
    duty_of,
    motor_torque,
)
from tribodyn.studies.motion.drivetrain.placed_train import (
    PlacedTrain,
    TrainKinematics,
    place_train,
    resolve_kinematics,
)
from tribodyn.studies.motion.drivetrain.tables import (
    MOST_PARTS,
    AnyStage,
    BareBody,
    BareMesh,
    Clutch,
    Link,
    TrainGear,
)
from tribodyn.studies.motion.planetary.frames import reference_pitch
from tribodyn.studies.motion.planetary.links import links_of_set, links_of_speeds, set_data
from tribodyn.studies.motion.train.pair_view import losses_of_meshes, own_teeth, pair_view, reference_teeth
from tribodyn.studies.motion.train.shared_forces import with_shared_forces
from tribodyn.studies.motion.train.supports import (
    bearings_by_body,
    drawn_system,
    supports_of_bodies,
    supports_of_mesh,
)
from tribodyn.train.links import LINK_LAWS
from tribodyn.train.schedule import common_period


def _sort(mesh: Any) -> str:
    """Whether [mesh] is written, or [[mesh]] of a bare model."""
    return "(list)" if isinstance(mesh, (list, tuple)) else "(table)"


Meshes = Annotated[
    Annotated[Mesh, Tag("(table)")]
    | Annotated[tuple[BareMesh, ...], Tag("(list)"), Field(max_length=MOST_PARTS)],
    Discriminator(_sort),
]


class TrainSolver(Solver):
    """How the equations are solved."""

    max_period: Count = 200


class GearTrainScenario(SpectrumScenario):
    """A scenario file."""

    kind: Literal["gear-train"] = "gear-train"
    drive: Annotated[DriveTable | None, model_file("drives")] = None
    gear: dict[PartName, TrainGear] = written({})
    stage: tuple[AnyStage, ...] = Field((), max_length=MOST_PARTS)
    shaft: Shafts = ()
    body: tuple[BareBody, ...] = Field((), max_length=MOST_PARTS)
    link: tuple[Link, ...] = Field((), max_length=MOST_PARTS)
    clutch: tuple[Clutch, ...] = Field((), max_length=MOST_PARTS)
    material: MaterialReference | None = None
    mean_roughness: Roughness | None = None
    quality: QualityGrade | None = None
    quality_edition: QualityEdition = 2013
    lubricant: Oil
    bearings: Annotated[Bearings, model_file("bearings")] = written("rigid-1e9")
    operating: TrainOperating
    load: tuple[LoadTable, ...] = Field((), max_length=MOST_PARTS)
    mesh: Meshes
    temperature: GearboxTemperatureKeys = None
    losses: LossKeys = None
    film: FilmKeys = None
    friction: Friction
    solver: TrainSolver = written({})
    output: Output = written({})
    damage: Damages = ()
    sensor: Sensors = ()
    housing: Housing | None = None


Scenario = GearTrainScenario


def case_of(
    scenario: Any,
    toml: str,
    sha256: str,
    place: Callable[[TrainKinematics], PlacedTrain] = place_train,
) -> Gearbox:
    """Return the case of a scenario that has passed schema and rules; `place` puts its teeth and axes."""
    train = resolve_kinematics(scenario)
    placed = place(train)
    duty = duty_of(scenario, train)
    gears = _gears(train, placed)
    teeth = reference_teeth(train)
    system = drawn_system(scenario, train, placed, duty)
    held = supports_of_bodies(scenario, train, placed, duty.torques.driven)
    held |= system.supports() if system is not None else {}
    drawn = {shaft.points[0][0]: shaft.name for shaft in system.shafts} if system is not None else {}
    meshes = _meshes(scenario, train, placed, duty, (toml, sha256), held, drawn)
    head: dict[str, Any] = {**head_of(scenario, toml, sha256)}
    sets = tuple(set_data(gearset, train, placed) for gearset in train.parts.sets)
    rims = [gearset.rim for gearset in sets if gearset.rim is not None]
    box = Gearbox(
        **head,
        gears=gears,
        bodies=_bodies(scenario, train, placed, duty),
        links=_links(scenario, train, placed, held, system, duty.torques.given),
        supports=held,
        system=system,
        meshes=meshes,
        source=_source(scenario, train, duty),
        loads=duty.loads,
        period=common_period([*train.motion.rate, *(rim.pin_rate for rim in rims if rim.pins_pass)]),
        max_period=scenario.solver.max_period,
        solver=solver_data(scenario.solver, teeth),
        output=output_data(
            scenario.output, scenario.solver, teeth, differ=any(any(mesh.pair.teeth) for mesh in meshes)
        ),
        sensors=sensors_of(scenario.sensor),
        housing=housing_of(scenario.housing),
        sets=sets,
        clutches=tuple(clutch_data(part, train.numbers) for part in train.parts.clutches),
        heat=gearbox_heat_of(
            scenario.temperature,
            scenario.operating.oil_temperature,
            None if scenario.losses is None else scenario.losses.oil_volume,
        ),
    )
    box = with_shared_forces(box)
    return _in_nominal_cycles(box) if box.in_time else box


def _in_nominal_cycles(box: Gearbox) -> Gearbox:
    """The gearbox with the cycles of nominal speed, whole ones, that its run by time lasts."""
    speed = box.source.speed / float(box.bodies[box.source.body].ratio)
    cycles = max(1, ceil((box.solver.duration or 0.0) * speed / reference_pitch(box) - 1e-9))
    return replace(box, solver=replace(box.solver, cycles=cycles), output=replace(box.output, revolution=0))


def _gears(train: TrainKinematics, placed: PlacedTrain) -> tuple[GearData, ...]:
    new, gears = train.numbers, []
    for number, gear in enumerate(train.parts.gears):
        meshes = train.meshes_of(number)
        mesh, side = meshes[0]
        material = materials_of(train.drives[mesh])[SIDES.index(side)]
        gears.append(
            GearData(
                gear.name,
                gear.key,
                new[gear.body],
                placed.shafts[number],
                gear.teeth,
                placed.planes[number],
                gear.tooth_angle,
                _given_mass(train, number),
                material.density,
                meshes,
                float(gear.table.face_width),
                gear.axial_position,
                train.parts.places_of_planet(number),
            )
        )
    return tuple(gears)


def _given_mass(train: TrainKinematics, number: int) -> BodyMass:
    """Mass and inertia of a gear; gears of a bare model have none, for their bodies have it."""
    gear = train.parts.gears[number]
    if gear.key.startswith("mesh."):
        return BodyMass(0.0, 0.0)
    return BodyMass(gear.table.mass, gear.table.inertia)


def _bodies(
    scenario: Any, train: TrainKinematics, placed: PlacedTrain, duty: TrainDuty
) -> tuple[BodyData, ...]:
    motion, operating, bodies = train.motion, scenario.operating, []
    floating = {body for inertia in train.parts.sets for body in inertia.floating}
    for number, body in enumerate(motion.bodies):
        part = train.parts.bodies[body]
        attached = sum(inertia for at, inertia in duty.inertias if at == number)
        if number == motion.input and operating.shaft_stiffness is None:
            attached += operating.drive_inertia
        x, y = placed.places.centres[number]
        gears = tuple(place for place, gear in enumerate(train.parts.gears) if gear.body == body)
        bodies.append(
            BodyData(
                part.name,
                part.key,
                gears,
                part.mass,
                part.inertia + attached,
                motion.ratio[number],
                motion.sense[number],
                (float(x), float(y)),
                attached,
                body in floating,
            )
        )
    return tuple(bodies)


def _links(
    scenario: Any,
    train: TrainKinematics,
    placed: PlacedTrain,
    held: Mapping[int, GearSupport],
    system: DrawnSystem | None,
    given: Sequence[float],
) -> tuple[LinkData, ...]:
    new, links = train.numbers, []
    on_shafts = system.bodies if system is not None else ()
    bearings = bearings_by_body(scenario, train.parts)
    without = {body for gearset in train.parts.sets for body in (*gearset.planets, *gearset.floating)}
    for number, body in enumerate(train.motion.bodies):
        bearing = bearings[body]
        if (bearing is not None or number in held) and body not in without and number not in on_shafts:
            data = held[number].data if number in held else bearing_of(cast(Bearing, bearing))
            name = f"bearing-{train.parts.bodies[body].name}"
            links.append(LinkData.of_bearing(name, "bearings", (number, HOUSING), data, bearing=data))
    for gearset in train.parts.sets:
        links += links_of_set(gearset, train, placed, bearings)
    links += links_of_speeds(scenario, train, placed, given)
    for link in train.parts.links:
        one, two = (HOUSING if end < 0 else new[end] for end in link.ends)
        ends = (two, one) if one == HOUSING else (one, two)
        law, values = LINK_LAWS[link.table.law], law_values(link.table)
        links.append(
            LinkData(link.name, link.key, ends, link.stiffness, link.damping, link.damping_ratio, law, values)
        )
    return tuple(links)


def _meshes(
    scenario: Any,
    train: TrainKinematics,
    placed: PlacedTrain,
    duty: TrainDuty,
    text: tuple[str, str],
    held: Mapping[int, GearSupport],
    drawn: Mapping[int, str],
) -> tuple[TrainMesh, ...]:
    motion, meshes = train.motion, []
    losses = losses_of_meshes(scenario.losses, train, duty.speed, held, drawn)
    first: LubricatedCase | None = None
    for mesh, place in enumerate(motion.meshes):
        supports = supports_of_mesh(held, train, placed, mesh)
        view = pair_view(scenario, train, mesh)._replace(supports=supports)
        driver, carrier = motion.driver[mesh], motion.carrier[mesh]
        teeth = own_teeth(scenario, train, mesh, view)
        speed = duty.speed * float(motion.ratio[driver] - motion.carried(driver, carrier))
        operating = OperatingData(speed, duty.torques.driven[mesh])
        moving = with_own_teeth(moving_mesh_of(view), teeth)
        oiled: dict[str, Any] = oil_fields(view) | {"losses": losses[mesh]}
        gears = gear_fields(view, *text, operating=operating, mesh=moving, teeth=teeth)
        pair = LubricatedCase(**gears, **oiled)
        # one film and one friction law hold in the whole train: where "auto" chooses, for its first mesh
        pair = with_chosen_laws(pair) if first is None else with_chosen(pair, first)
        first = first or pair
        part = train.parts.meshes[place]
        meshes.append(
            TrainMesh(
                part.name,
                part.key,
                motion.driver[mesh],
                motion.driven[mesh],
                motion.gears[mesh],
                placed.places.azimuths[mesh],
                motion.rate[mesh],
                pair,
                carrier,
            )
        )
    return tuple(meshes)


def _source(scenario: Any, train: TrainKinematics, duty: TrainDuty) -> SourceData:
    torque = motor_torque(scenario)
    torque = duty.torques.source if torque is None else torque
    return SourceData.of(scenario.operating, train.motion.input, duty.speed, torque)
