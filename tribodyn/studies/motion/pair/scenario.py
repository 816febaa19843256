"""The tables of a scenario file: what is done with a drive.

Field names are the interface of the command line (`--set operating.output_torque="600 N*m"`). Defaults stand
as they would be written in TOML. Names of laws, families and solvers stand in their registries.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from tribodyn.dynamics.data import OperatingData
from tribodyn.errors import InputError
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
from tribodyn.geometry.drive import SIDES
from tribodyn.input.quantity import model_file, written
from tribodyn.input.tables.duty import OiledOperatingTable, broken_duty_rules, duty_of
from tribodyn.input.tables.gears.damage import Damages, GearPlace, damage_of
from tribodyn.input.tables.gears.drive_data import gives_backlash
from tribodyn.input.tables.gears.internal_gear import driving_internal
from tribodyn.input.tables.gears.single_teeth import own_teeth_of, with_own_teeth
from tribodyn.input.tables.sensors import Housing, Sensors, broken_sensor_rules, housing_of, sensors_of
from tribodyn.input.tables.supports.bearings import Bearings
from tribodyn.input.tables.supports.shafts import listed
from tribodyn.studies.motion.pair.case import Case


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


def case_of(scenario: Scenario, toml: str, sha256: str) -> Case:
    """Return the case of a scenario that has passed schema and rules."""
    teeth = own_teeth_of(scenario.drive, scenario.mesh.tooth_sample)
    damaged = gears_of_pair(scenario)
    one, two = (
        (*each, *damage_of([one for one in scenario.damage if one.gear == side], damaged[side]))
        for each, side in zip(teeth, SIDES, strict=True)
    )
    teeth = one, two
    own = {"mesh": with_own_teeth(moving_mesh_of(scenario), teeth), "teeth": teeth}
    case = Case(
        **gear_fields(scenario, toml, sha256, operating=_operating(scenario), **own),
        **oil_fields(scenario),
        bearings=bearings_of(scenario),
        shafts={shaft.gears[0]: (shaft.mass, shaft.inertia) for shaft in listed(scenario.shaft)},
        solver=solver_data(scenario.solver, scenario.drive.pinion.teeth),
        output=output_data(scenario.output, scenario.solver, scenario.drive.pinion.teeth, differ=any(teeth)),
        sensors=sensors_of(scenario.sensor),
        housing=housing_of(scenario.housing),
    )
    return with_chosen_laws(case)


def gears_of_pair(scenario: Scenario) -> dict[str, GearPlace]:
    """The gears that may be damaged."""
    return {side: GearPlace(((scenario.drive, side),)) for side in SIDES}


def _operating(scenario: Scenario) -> OperatingData:
    operating, drive = scenario.operating, scenario.drive
    curve = operating.output_torque_table
    return OperatingData(
        **duty_of(operating.load, drive.pinion.teeth, drive.gear.teeth)._asdict(),
        pinion_torque=operating.motor_torque,
        torque_table=curve.in_si() if curve else None,
        torque_harmonics=harmonics_of(operating.output_torque_harmonics),
        **operating.model_dump(
            exclude={"output_torque_table", "output_torque_harmonics", *OiledOperatingTable.model_fields}
        ),
    )


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
