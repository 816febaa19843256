"""The tables of a scenario file: what is done with a drive.

Field names are the interface of the command line (`--set operating.output_torque="600 N*m"`). Defaults stand
as they would be written in TOML. Names of laws, families and solvers stand in their registries.
"""

from collections.abc import Iterator
from fractions import Fraction
from math import nan, pi
from typing import Annotated, Any, ClassVar, Literal

from tribodyn.dynamics.data import OperatingData
from tribodyn.errors import InputError
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.damage_rules import broken_damage
from tribodyn.gears.motion.settings import (
    Friction,
    Mesh,
    Operating,
    Output,
    Solver,
    broken_flank_rules,
    broken_mesh_rules,
    broken_output_rules,
    broken_solver_rules,
    broken_source_rules,
    harmonics_of,
    moving_mesh_of,
    output_data,
    solver_data,
)
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.scenario import (
    FilmKeys,
    GearScenario,
    LossKeys,
    Oil,
    ShaftKeys,
    TemperatureKeys,
    broken_gear_rules,
    gear_fields,
    oil_fields,
)
from tribodyn.gears.supports import bearings_of
from tribodyn.geometry.drive import SIDES, internal_side
from tribodyn.input.fields import head_of
from tribodyn.input.quantity import model_file, written
from tribodyn.input.tables.bearings import Bearings
from tribodyn.input.tables.duty import broken_duty_rules, duty_of
from tribodyn.input.tables.gears.drive_data import gives_backlash
from tribodyn.input.tables.gears.single_teeth import (
    Damages,
    GearPlace,
    damage_of,
    own_teeth_of,
    with_own_teeth,
)
from tribodyn.input.tables.gears.tooth_data import driving_internal
from tribodyn.input.tables.sensors import Housing, Sensors, broken_sensor_rules, housing_of, sensors_of
from tribodyn.input.tables.shafts import listed
from tribodyn.studies.motion.case import (
    HOUSING,
    BodyData,
    Gearbox,
    GearData,
    LinkData,
    LoadData,
    SourceData,
    TrainMesh,
)

#: Name of the mesh; the bodies have those of the gears.
MESH = "mesh"
#: The gear stands above the pinion, which turns clockwise: x is along the pitch tangent.
UPWARD, CLOCKWISE = pi / 2.0, -1


class GearPairScenario(GearScenario):
    """A scenario file."""

    internal_gears: ClassVar[bool] = True

    kind: Literal["gear-pair"] = "gear-pair"
    lubricant: Oil
    bearings: Annotated[Bearings, model_file("bearings")] = written("rigid-1e9")
    shaft: ShaftKeys = None
    operating: Operating
    mesh: Mesh
    temperature: TemperatureKeys = None
    losses: LossKeys = None
    film: FilmKeys = None
    friction: Friction
    solver: Solver = written({})
    output: Output = written({})
    damage: Damages = ()
    sensor: Sensors = ()
    housing: Housing | None = None


Scenario = GearPairScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> Gearbox:
    """Return the case of a scenario that has passed schema and rules: a gearbox of one pair of gears."""
    drive = scenario.drive
    teeth = own_teeth_of(drive, scenario.mesh.tooth_sample)
    damaged = gears_of_pair(scenario)
    one, two = (
        (*each, *damage_of([one for one in scenario.damage if one.gear == side], damaged[side]))
        for each, side in zip(teeth, SIDES, strict=True)
    )
    teeth = one, two
    duty = duty_of(scenario.operating.load, drive.pinion.teeth, drive.gear.teeth)
    own = {"mesh": with_own_teeth(moving_mesh_of(scenario), teeth), "teeth": teeth}
    gears = gear_fields(scenario, toml, sha256, operating=OperatingData(*duty), **own)
    pair = with_chosen_laws(LubricatedCase(**gears, **oil_fields(scenario)))
    return _gearbox(scenario, pair)


def _gearbox(scenario: Scenario, pair: LubricatedCase) -> Gearbox:
    """A train of one stage: gears, bearings, drive and load by their names."""
    operating, drive = scenario.operating, pair.drive
    teeth = [round(float(gear.teeth)) for gear in (drive.pinion, drive.gear)]
    ratio = Fraction(abs(teeth[0]), abs(teeth[1]))
    rigid = operating.source == "speed" or operating.shaft_stiffness is None
    attached = operating.drive_inertia if rigid else 0.0, operating.load_inertia
    shafts = {shaft.gears[0]: (shaft.mass, shaft.inertia) for shaft in listed(scenario.shaft)}
    further = [shafts.get(side, (0.0, 0.0)) for side in SIDES]
    # both gears of a ring turn alike
    senses = CLOCKWISE, -CLOCKWISE if internal_side(drive) is None else CLOCKWISE
    torque, curve = operating.motor_torque, operating.output_torque_table
    bearings = bearings_of(scenario)
    head: dict[str, Any] = {**head_of(scenario, pair.toml, pair.sha256)}
    return Gearbox(
        **head,
        gears=tuple(
            GearData(
                name=side,
                key=f"drive.{side}",
                body=number,
                shaft=number,
                teeth=teeth[number],
                plane=1,
                tooth_angle=0.0,
                stated=pair.masses[number],
                density=pair.materials[number].density,
                meshes=((0, side),),
                face_width=float((drive.pinion, drive.gear)[number].face_width),
            )
            for number, side in enumerate(SIDES)
        ),
        bodies=tuple(
            BodyData(
                name=side,
                key=f"drive.{side}",
                gears=(number,),
                mass=further[number][0],
                inertia=attached[number] + further[number][1],
                ratio=(Fraction(1), ratio)[number],
                sense=senses[number],
                centre=((0.0, 0.0), (0.0, nan))[number],  # as far apart as its path of contact says
                attached=attached[number],
                floating=True,
            )
            for number, side in enumerate(SIDES)
        ),
        links=tuple(
            LinkData.of_bearing(f"bearing-{side}", f"bearings.{side}", (number, HOUSING), held, bearing=held)
            for number, (side, held) in enumerate(zip(SIDES, bearings, strict=True))
        ),
        meshes=(TrainMesh(MESH, "drive", 0, 1, (0, 1), UPWARD, Fraction(1), pair),),
        source=SourceData.of(
            operating,
            0,
            pair.operating.pinion_speed,
            pair.operating.gear_torque * float(ratio) if torque is None else torque,
        ),
        loads=(
            LoadData(
                1,
                pair.operating.gear_torque,
                operating.load_damping,
                curve.in_si() if curve else None,
                harmonics_of(operating.output_torque_harmonics),
            ),
        ),
        period=1,
        max_period=1,
        solver=solver_data(scenario.solver, teeth[0]),
        output=output_data(scenario.output, scenario.solver, teeth[0], differ=any(pair.teeth)),
        sensors=sensors_of(scenario.sensor),
        housing=housing_of(scenario.housing),
        named=False,
    )


def gears_of_pair(scenario: Scenario) -> dict[str, GearPlace]:
    """The gears that may be damaged."""
    return {side: GearPlace(((scenario.drive, side),)) for side in SIDES}


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks; none: it is consistent."""
    of_drive = [
        *driving_internal(scenario.drive),
        *broken_gear_rules(scenario, every_tooth=True),
    ]
    yield from of_drive
    if not of_drive:
        yield from broken_damage(scenario.damage, gears_of_pair(scenario))
    yield from broken_source_rules(scenario.operating)
    yield from broken_mesh_rules(scenario.mesh)
    yield from _load(scenario)
    yield from broken_solver_rules(scenario.solver)
    yield from broken_output_rules(scenario.output, scenario.solver, scenario.drive.pinion.teeth)
    yield from broken_sensor_rules(scenario.sensor, scenario.housing)


def _load(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules of speed and load; without one of each there is nothing else to say."""
    operating, drive, mesh = scenario.operating, scenario.drive, scenario.mesh
    if broken := broken_duty_rules(operating.load):
        yield from broken
        return
    torque = duty_of(operating.load, drive.pinion.teeth, drive.gear.teeth).gear_torque
    back_flanks = mesh.backlash is not None or gives_backlash(drive)
    yield from broken_flank_rules("operating.output_torque", torque, back_flanks, mesh)
