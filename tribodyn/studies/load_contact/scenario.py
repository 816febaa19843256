"""The tables of a scenario of ``kind = "load-contact"``: teeth in slow rotation under load."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.scenario import (
    FaceSlices,
    FilmKeys,
    GearBodySupport,
    GearScenario,
    MatrixKeys,
    Oil,
    SampleNumber,
    ShaftKeys,
    SliceCoupling,
    broken_gear_rules,
    broken_support_keys,
    gear_fields,
    mesh_data,
    oil_fields,
)
from tribodyn.input import units
from tribodyn.input.quantity import Count, InUnit, NotNegative, Table, written
from tribodyn.input.tables.duty import OiledOperatingTable, broken_driving_rules
from tribodyn.input.tables.gears.internal_gear import driving_internal
from tribodyn.input.tables.gears.model_files import MisalignmentTable
from tribodyn.studies.load_contact.case import LoadContactCase

Load = Annotated[float, InUnit(units.positive(units.TORQUE))]


class LoadContactOperating(OiledOperatingTable):
    """The load, against the gear's motion; a speed only where the load is given as power, or for the film."""

    gear_torques: tuple[Load, ...] = Field((), max_length=1000)


class LoadContactMesh(Table):
    """Slices of the face, friction, and how the axes stand."""

    slices: FaceSlices = None
    slice_coupling: SliceCoupling = True
    body: GearBodySupport = "free"
    friction_coefficient: NotNegative = 0.0
    deviation_sample: SampleNumber = None
    misalignment: MisalignmentTable = written({})


class LoadContactOutput(Table):
    """What is recorded."""

    positions_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 60
    cycles: Count = 1


class LoadContactScenario(GearScenario):
    """A scenario file of a load contact study."""

    internal_gears: ClassVar[bool] = True
    driving_rings: ClassVar[bool] = False
    kind: Literal["load-contact"]
    lubricant: Oil | None = None
    operating: LoadContactOperating
    bearings: MatrixKeys = None
    shaft: ShaftKeys = None
    mesh: LoadContactMesh = written({})
    film: FilmKeys = None
    output: LoadContactOutput = written({})


Scenario = LoadContactScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> LoadContactCase:
    """Return the case of a scenario that has passed schema and rules."""
    gears: dict[str, Any] = gear_fields(scenario, toml, sha256) | {
        "mesh": mesh_data(scenario, every_tooth=True)
    }
    oiled = None
    if scenario.lubricant is not None:
        oiled = with_chosen_laws(LubricatedCase(**gears, **oil_fields(scenario)))
    return LoadContactCase(
        **gears,
        gear_torques=scenario.operating.gear_torques,
        friction_coefficient=scenario.mesh.friction_coefficient,
        positions_per_cycle=scenario.output.positions_per_cycle,
        cycles=scenario.output.cycles,
        lubricated=oiled,
    )


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    yield from broken_gear_rules(scenario)
    yield from driving_internal(scenario.drive)
    yield from broken_support_keys(scenario)
    drive, operating, oiled = scenario.drive, scenario.operating, scenario.lubricant is not None
    yield from broken_driving_rules(operating, (drive.pinion.teeth, drive.gear.teeth), speed_needed=oiled)
    if not oiled:
        yield from _without_oil(scenario)
    torques = operating.gear_torques
    if len(torques) == 1:
        rule = "a single torque makes no map"
        yield InputError("operating.gear_torques", f"{torques[0]:g} N*m", rule, "give at least two")
    for number, (torque, after) in enumerate(pairwise(torques), start=1):
        if after <= torque:
            key, rule = f"operating.gear_torques.{number}", f"not greater than the {torque:g} N*m before it"
            yield InputError(key, f"{after:g} N*m", rule, "give the torques in increasing order")
            break


def _without_oil(scenario: Scenario) -> Iterator[InputError]:
    """Refuse what says something of a film that is not computed."""
    remedy = 'add lubricant = "iso-vg-220-mineral", or leave it out'
    film_keys = {"operating.oil_temperature": scenario.operating.oil_temperature, "film": scenario.film}
    for key, value in film_keys.items():
        if value is not None:
            yield InputError(key, rule="without a lubricant there is no film", remedy=remedy)
