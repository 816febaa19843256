"""The tables of a scenario file: what is done with a drive.

Field names are the interface of the command line (`--set operating.output_torque="600 N*m"`). Defaults stand
as they would be written in TOML. Names of laws, families and solvers stand in their registries.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from math import nan, pi
from typing import Annotated, ClassVar, Literal

import numpy as np

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
    broken_rules_in_time,
    broken_solver_rules,
    broken_source_rules,
)
from tribodyn.gears.scenario import (
    FilmKeys,
    GearboxTemperatureKeys,
    GearScenario,
    LossKeys,
    Oil,
    ShaftKeys,
    broken_gear_rules,
)
from tribodyn.gears.supports import has_supports
from tribodyn.geometry.drive import SIDES
from tribodyn.input.quantity import model_file, written
from tribodyn.input.tables.bearings import Bearings
from tribodyn.input.tables.duty import broken_duty_rules, duty_of
from tribodyn.input.tables.gears.drive_data import assembled_on_path, gives_backlash
from tribodyn.input.tables.gears.single_teeth import Damages, GearPlace
from tribodyn.input.tables.gears.tooth_data import driving_internal
from tribodyn.input.tables.sensors import Housing, Sensors, broken_sensor_rules
from tribodyn.input.tables.temperature import broken_gearbox_heat
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.duty import TrainOperating
from tribodyn.studies.motion.drivetrain.placed_train import PlacedTrain, TrainKinematics
from tribodyn.studies.motion.train.scenario import GearTrainScenario, TrainSolver
from tribodyn.studies.motion.train.scenario import case_of as case_of_train
from tribodyn.train.positions import Centres

#: Azimuth of the gear from the pinion, and their axes: as far apart as the path of contact says.
UPWARD, CENTRES = pi / 2.0, ((0.0, 0.0), (0.0, nan))


class GearPairScenario(GearScenario):
    """A scenario file."""

    internal_gears: ClassVar[bool] = True
    mesh_formulas: ClassVar[bool] = True

    kind: Literal["gear-pair"] = "gear-pair"
    lubricant: Oil
    bearings: Annotated[Bearings, model_file("bearings")] = written("rigid-1e9")
    shaft: ShaftKeys = None
    operating: Operating
    mesh: Mesh
    temperature: GearboxTemperatureKeys = None
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
    """Return the case of a scenario that has passed schema and rules: a train of one stage.

    Bodies have the names of the gears, however their shafts are called.
    """
    place = partial(_placed, held=has_supports(scenario))
    box = case_of_train(as_train(scenario), toml, sha256, place)
    bodies = tuple(
        replace(body, name=side, key=f"drive.{side}", centre=centre, floating=True)
        for body, side, centre in zip(box.bodies, SIDES, CENTRES, strict=True)
    )
    sides = [(link, SIDES[link.ends[0]]) for link in box.links]
    links = tuple(replace(link, name=f"bearing-{side}", key=f"bearings.{side}") for link, side in sides)
    return replace(box, bodies=bodies, links=links, named=False)


def as_train(scenario: Scenario) -> GearTrainScenario:
    """The scenario of the train that the pair is; its pinion is the input, its gear the output."""
    tables = {
        "operating": TrainOperating.model_construct(**dict(scenario.operating)),
        "solver": TrainSolver.model_construct(**dict(scenario.solver)),
    }
    return GearTrainScenario.model_construct(**dict(scenario) | tables)


def _placed(train: TrainKinematics, held: bool) -> PlacedTrain:
    """The gear above the pinion; their teeth are put together only where shafts or matrices hold them."""
    assemblies = (assembled_on_path(train.drives[0]),) if held else ()
    centres = np.zeros((2, 2))
    for path in (assembly.path for assembly in assemblies):
        centres[1, 1] = path.pinion_pitch_radius + path.gear_pitch_radius
    return PlacedTrain(assemblies, Centres(centres, (UPWARD,)), (1, 1), (0, 1))


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
    yield from broken_gearbox_heat(scenario.temperature, scenario.operating.oil_temperature, SIDES)
    if not of_drive:
        yield from broken_damage(scenario.damage, gears_of_pair(scenario))
    yield from broken_source_rules(scenario.operating)
    yield from broken_mesh_rules(scenario.mesh)
    yield from _load(scenario)
    yield from broken_solver_rules(scenario.solver)
    yield from broken_rules_in_time(scenario)
    yield from broken_output_rules(scenario.output, scenario.solver, scenario.drive.pinion.teeth)
    yield from broken_sensor_rules(scenario.sensor, scenario.housing)
    if scenario.housing is not None and scenario.housing.matrices is not None:
        rule = "holds the bearings of shafts in [[shaft]] of a train"
        yield InputError("housing.matrices", None, rule, "write a gear-train, or give [[housing.mode]]")


def _load(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules of speed and load; without one of each there is nothing else to say."""
    operating, drive, mesh = scenario.operating, scenario.drive, scenario.mesh
    if broken := broken_duty_rules(operating.load):
        yield from broken
        return
    torque = duty_of(operating.load, drive.pinion.teeth, drive.gear.teeth).gear_torque
    back_flanks = mesh.backlash is not None or gives_backlash(drive)
    yield from broken_flank_rules("operating.output_torque", torque, back_flanks, mesh)
