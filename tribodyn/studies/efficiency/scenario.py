"""The scenario of ``kind = "efficiency"``, loads, friction and losses without dynamics, and its case."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from tribodyn.cases import cost
from tribodyn.compliance.foundation import Foundation
from tribodyn.errors import InputError
from tribodyn.gears.case import LubricatedCase, with_chosen
from tribodyn.gears.motion.recorded import LAYOUT
from tribodyn.gears.prepare import with_chosen_laws
from tribodyn.gears.scenario import (
    FilmKeys,
    GearScenario,
    LossKeys,
    MatrixKeys,
    MeshTable,
    Oil,
    ShaftKeys,
    TemperatureKeys,
    broken_gear_rules,
    broken_stiffness_rules,
    broken_support_keys,
    gear_fields,
    oil_fields,
)
from tribodyn.input.quantity import Switch, Table, written
from tribodyn.input.tables.bearings import Stiffness
from tribodyn.input.tables.duty import OiledOperatingTable, broken_duty_rules, duty_of, spectrum_of
from tribodyn.input.tables.gears.tooth_data import driving_internal
from tribodyn.input.tables.laws import FrictionTable

if TYPE_CHECKING:
    from tribodyn.studies.efficiency.mesh_positions import Sharing


@dataclass(frozen=True, kw_only=True)
class EfficiencyCase(LubricatedCase):
    """One efficiency study, complete; its mesh compliance is that of the elastic load sharing."""

    #: {"elastic", "uniform", "single-pair"} That of the samples recorded; the summary has all three.
    load_sharing: "Sharing" = "elastic"
    samples_per_cycle: int = 200  # samples over the one mesh cycle recorded
    #: (float, EfficiencyCase); share of time and case of every duty of a load spectrum; empty: there is none
    spectrum: tuple[tuple[float, "EfficiencyCase"], ...] = ()


#: Positions at which the cycle means share the load.
_POSITIONS = 3000.0


def estimate(case: EfficiencyCase) -> cost.Estimate:
    """What a run of a case takes."""
    samples, slices = float(case.samples_per_cycle), case.mesh.slices
    sizes = {"time": case.samples_per_cycle + 1, "pair": cost.PAIRS, "dof": 6}
    parts = [cost.recorded(LAYOUT, sizes, outlines=True), cost.quasi_static_cycle(samples)]
    if case.mesh.at_load:
        parts += [cost.FINITE_ELEMENTS, cost.load_sharing(samples + _POSITIONS, slices, samples)]
    drivers = cost.CostKey("output.samples_per_cycle", samples, 200), cost.CostKey("mesh.slices", slices, 21)
    return cost.total(drivers, *parts)


class EfficiencyMesh(MeshTable):
    """How the pairs in contact share the load, and the compliance they share it by."""

    compliance: Literal["energy", "fem", "constant"] = "energy"
    stiffness: Stiffness | None = None
    load_sharing: Literal["elastic", "uniform", "single-pair"] = "elastic"
    hertz: Literal["linear", "load-dependent"] = "linear"
    foundation: Foundation = "sainsot-velex"
    foundation_coupling: Switch = True


class EfficiencyFriction(FrictionTable):
    """Which law acts between the flanks, and the law's own keys."""

    rolling_speeds: Literal["exact", "lever-arms"] = "exact"


class EfficiencyOutput(Table):
    """What is recorded: one mesh cycle."""

    samples_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 200


class EfficiencyScenario(GearScenario):
    """A scenario file of an efficiency study."""

    internal_gears: ClassVar[bool] = True

    kind: Literal["efficiency"]
    lubricant: Oil
    operating: OiledOperatingTable
    bearings: MatrixKeys = None
    shaft: ShaftKeys = None
    mesh: EfficiencyMesh = written({})
    temperature: TemperatureKeys = None
    losses: LossKeys = None
    film: FilmKeys = None
    friction: EfficiencyFriction
    output: EfficiencyOutput = written({})


Scenario = EfficiencyScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> EfficiencyCase:
    """Return the case of a scenario that has passed schema and rules."""
    duties = spectrum_of(scenario) if scenario.operating.duty is None else ()
    case = with_chosen_laws(_at_duty(scenario, toml, sha256))
    spectrum = tuple((share, with_chosen(_at_duty(duty, toml, sha256), case)) for share, duty in duties)
    return replace(case, spectrum=spectrum)


def _at_duty(scenario: Scenario, toml: str, sha256: str) -> EfficiencyCase:
    return EfficiencyCase(
        **gear_fields(scenario, toml, sha256),
        **oil_fields(scenario),
        load_sharing=scenario.mesh.load_sharing,
        samples_per_cycle=scenario.output.samples_per_cycle,
    )


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    yield from driving_internal(scenario.drive)
    yield from broken_gear_rules(scenario, every_duty=True)
    yield from broken_support_keys(scenario)
    yield from broken_stiffness_rules(scenario.mesh, ("constant",))
    drive, operating = scenario.drive, scenario.operating
    if scenario.friction.rolling_speeds == "lever-arms" and drive.helix_angle:
        rule = "is of spur gears: the lever arms are those of one transverse section"
        yield InputError("friction.rolling_speeds", '"lever-arms"', rule, 'use "exact"')
    broken = broken_duty_rules(operating)
    yield from broken
    if not broken and duty_of(operating, drive.pinion.teeth, drive.gear.teeth).gear_torque == 0:
        yield InputError(
            "operating.gear_torque",
            "0 N*m",
            "must not be zero: an unloaded mesh transmits nothing",
            'write a torque such as "500 N*m", or "-500 N*m" where the gear drives',
        )
