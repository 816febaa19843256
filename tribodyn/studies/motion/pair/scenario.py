"""The tables of a scenario file: what is done with a drive.

Field names are the interface of the command line (`--set operating.output_torque="600 N*m"`). Defaults stand
as they would be written in TOML. Rules that tie fields together stand in `rules`; names of laws, families and
solvers in their registries.
"""

from typing import Annotated, Any, ClassVar, Literal

from tribodyn.dynamics.data import OperatingData
from tribodyn.gears.motion.settings import (
    Friction,
    Mesh,
    Operating,
    Output,
    Solver,
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
    gear_fields,
    oil_fields,
)
from tribodyn.gears.supports import bearings_of
from tribodyn.geometry.drive import SIDES
from tribodyn.input.quantity import model_file, written
from tribodyn.input.tables.duty import OiledOperatingTable, duty_of
from tribodyn.input.tables.gears.damage import Damages, GearPlace, damage_of
from tribodyn.input.tables.gears.single_teeth import own_teeth_of, with_own_teeth
from tribodyn.input.tables.sensors import Housing, Sensors, housing_of, sensors_of
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
    pair_fields: dict[str, Any] = {
        "operating": _operating(scenario),
        "mesh": with_own_teeth(moving_mesh_of(scenario), teeth),
        "teeth": teeth,
    }
    case = Case(
        **gear_fields(scenario, toml, sha256) | pair_fields,
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
