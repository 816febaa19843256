"""The tables of a scenario of ``kind = "wear"``: a gear pair whose flanks wear over many revolutions."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.scenario import (
    FilmKeys,
    GearScenario,
    MatrixKeys,
    MeshTable,
    Oil,
    ShaftKeys,
    broken_film_keys,
    broken_gear_rules,
    broken_support_keys,
    gear_fields,
    mesh_data,
    oil_fields,
)
from tribodyn.geometry.modification import uneven_teeth
from tribodyn.input.quantity import Positive, Table, Text, written
from tribodyn.input.tables.duty import OiledOperatingTable, broken_driving_rules
from tribodyn.input.tables.gears.drive_rules import modifications_of
from tribodyn.input.tables.gears.single_teeth import ToothSampleNumber, own_teeth_of
from tribodyn.input.tables.gears.tooth_data import driving_internal
from tribodyn.input.tables.laws import FrictionTable, LawTable, law_values
from tribodyn.mesh.teeth.deviations import PitchErrors
from tribodyn.mesh.teeth.fields import OwnTeeth
from tribodyn.studies.wear.case import ALIKE, EACH, WearCase
from tribodyn.tribology.law import FilmData
from tribodyn.tribology.wear import WEAR_LAWS
from tribodyn.tribology.wear.law import RunningIn, WearData

#: Rows of a record where the scenario says nothing, beside the unworn flanks.
ROWS = 20
#: Rows of a record at most.
MOST_ROWS = 100_000
_TABULATED = "solved"
_NOT_ALIKE, _EACH = 'contradicts wear.teeth = "alike"', 'leave it out, or write wear.teeth = "each"'
#: Friction laws that need no lubricant.
DRY = ("coulomb", "none")


class WearTable(LawTable):
    """By which law the flanks wear, with the law's own keys, how long, and how the steps are chosen."""

    place = "wear"
    laws = WEAR_LAWS
    automatic = False
    law: Text = "priest-taylor"
    revolutions: Positive
    teeth: Literal["alike", "each"] = "alike"
    load_change: Annotated[float, Field(strict=True, gt=0.0, le=0.2)] = 0.02


class WearFriction(FrictionTable):
    """Which law acts between the flanks, and the law's own keys."""


class RunningInTable(Table):
    """How the roughness of new flanks falls in running in."""

    roughness_share: Annotated[float, Field(strict=True, gt=0.0, le=1.0)]
    revolutions: Positive


class WearMesh(MeshTable):
    """Slices of the face, and how the axes stand."""

    tooth_sample: ToothSampleNumber = None


class WearOutput(Table):
    """What is recorded."""

    positions_per_cycle: Annotated[int, Field(strict=True, ge=12)] = 60
    every: Positive | None = None


class WearScenario(GearScenario):
    """A scenario file of a wear study."""

    internal_gears: ClassVar[bool] = True

    kind: Literal["wear"]
    lubricant: Oil | None = None
    operating: OiledOperatingTable
    wear: WearTable
    running_in: RunningInTable | None = None
    bearings: MatrixKeys = None
    shaft: ShaftKeys = None
    mesh: WearMesh = written({})
    film: FilmKeys = None
    friction: WearFriction | None = None
    output: WearOutput = written({})


Scenario = WearScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> WearCase:
    """Return the case of a scenario that has passed schema and rules."""
    wear = scenario.wear
    mesh, teeth = mesh_data(scenario, every_tooth=wear.teeth == EACH), _own_teeth(scenario)
    early = sum(each.early for gear in teeth for each in gear)
    gears: dict[str, Any] = gear_fields(scenario, toml, sha256)
    gears |= {"mesh": replace(mesh, early=early), "teeth": teeth}
    oiled, friction = None, 0.0
    if scenario.lubricant is not None:
        oil, film = oil_fields(scenario), WEAR_LAWS[wear.law].film
        if scenario.film is None and film is not None:
            oil["film"] = FilmData(film)
        oiled = with_chosen_laws(LubricatedCase(**gears, **oil))
    elif scenario.friction is not None:
        friction = law_values(scenario.friction).get("coefficient", 0.0)
    return WearCase(
        **gears,
        wear=WearData(wear.law, law_values(wear)),
        revolutions=wear.revolutions,
        every=scenario.output.every or wear.revolutions / ROWS,
        load_change=wear.load_change,
        each_tooth=wear.teeth == EACH,
        positions_per_cycle=scenario.output.positions_per_cycle,
        running_in=scenario.running_in and RunningIn(**scenario.running_in.model_dump()),
        friction_coefficient=friction,
        lubricated=oiled,
    )


def _own_teeth(scenario: Scenario) -> tuple[OwnTeeth, OwnTeeth]:
    """What teeth have of their own, where each wears by itself; pitch errors are modifications here."""
    if scenario.wear.teeth == ALIKE:
        return (), ()
    every = own_teeth_of(scenario.drive, scenario.mesh.tooth_sample)
    pinion, gear = (tuple(one for one in of if not isinstance(one, PitchErrors)) for of in every)
    return pinion, gear


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    yield from driving_internal(scenario.drive)
    yield from broken_gear_rules(scenario, every_tooth=scenario.wear.teeth == EACH)
    yield from broken_support_keys(scenario)
    drive, wear = scenario.drive, scenario.wear
    yield from broken_driving_rules(scenario.operating, (drive.pinion.teeth, drive.gear.teeth))
    yield from _broken_law(scenario)
    if scenario.lubricant is None:
        yield from broken_film_keys(scenario)
        if scenario.friction is not None and scenario.friction.law not in DRY:
            rule = "is a law of lubricated flanks, and there is no lubricant"
            value = quoted(scenario.friction.law)
            yield InputError("friction.law", value, rule, 'use "coulomb", or add one')
    for table in (scenario.film, scenario.friction):
        if scenario.running_in is not None and table is not None and table.law == _TABULATED:
            rule = f'contradicts {table.place}.law = "{_TABULATED}", a table of contacts of one roughness'
            yield InputError("running_in", None, rule, "use another law, or leave it out")
    if wear.teeth == ALIKE:
        for uneven in uneven_teeth(modifications_of(drive, scenario.mesh.misalignment)):
            yield InputError(uneven.key, uneven.value, _NOT_ALIKE, _EACH)
        if (sample := scenario.mesh.tooth_sample) is not None:
            yield InputError("mesh.tooth_sample", sample, _NOT_ALIKE, _EACH)
    every = scenario.output.every
    if every is not None and wear.revolutions / every > MOST_ROWS:
        rule = f"makes more than {MOST_ROWS} records of {wear.revolutions:g} revolutions"
        yield InputError("output.every", f"{every:g}", rule, "write a larger number")


def _broken_law(scenario: Scenario) -> Iterator[InputError]:
    """A law whose values contradict each other, or that needs what is not there."""
    wear, law = scenario.wear, WEAR_LAWS[scenario.wear.law]
    try:
        law.made(None, law_values(wear))
    except InputError as error:
        yield error
    if law.needs_film and scenario.lubricant is None:
        remedy = 'add lubricant = "iso-vg-220-mineral", or use law = "archard"'
        yield InputError("wear.law", quoted(wear.law), "goes by the film, and there is no lubricant", remedy)
    if law.needs_friction and (scenario.friction is None or scenario.friction.law == "none"):
        remedy = 'add [friction] with a law, such as law = "coulomb" with coefficient = 0.1'
        yield InputError("wear.law", quoted(wear.law), "goes by friction, and there is none", remedy)
