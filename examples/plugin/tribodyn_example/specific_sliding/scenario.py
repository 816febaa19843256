"""The tables of a scenario of ``kind = "specific-sliding"``, and the case that is made of them."""

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.geometry.drive import Drive, MaterialData
from tribodyn.input import units
from tribodyn.input.fields import Name
from tribodyn.input.quantity import InUnit, Table, Text, model_file, written
from tribodyn.input.tables.gears.drive_data import drive_of, materials_of
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.studies.protocol.study import CaseHead


@dataclass(frozen=True)
class SlidingCase(CaseHead):
    """One study, complete; SI units.

    Parameters
    ----------
    family : str
        Name of the family of the path of contact.
    drive : Drive
    materials : (MaterialData, MaterialData)
        Of pinion and gear.
    pinion_speed : float
        ω_p, rad/s.
    positions : int
        Points along the path of contact.
    """

    family: str
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    pinion_speed: float
    positions: int


class SlidingOperating(Table):
    """At which speed."""

    pinion_speed: Annotated[float, InUnit(units.positive(units.ANGULAR_SPEED))]


class SlidingOutput(Table):
    """What is recorded."""

    positions: Annotated[int, Field(strict=True, ge=2)] = Field(201, description="along the path of contact")


class SlidingScenario(Table):
    """A scenario file."""

    title: Text = Field(description="what it shows, in a line")
    name: Name | None = Field(None, description="names the record; default: the file's own name")
    kind: Literal["specific-sliding"]
    drive: Annotated[DriveTable, model_file("drives")]
    operating: SlidingOperating
    output: SlidingOutput = written({})


Scenario = SlidingScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> SlidingCase:
    """Return the case of a scenario that has passed schema and rules."""
    return SlidingCase(
        title=scenario.title,
        name=scenario.name or "scenario",
        kind=scenario.kind,
        toml=toml,
        sha256=sha256,
        family=scenario.drive.family,
        drive=drive_of(scenario.drive),
        materials=materials_of(scenario.drive),
        pinion_speed=scenario.operating.pinion_speed,
        positions=scenario.output.positions,
    )
