"""The tables of a scenario of ``kind = "ehl"``: the contact of a pair solved along its way."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.dynamics.data import OperatingData
from tribodyn.mesh.data import MeshData
from tribodyn.scenario.common import head_of
from tribodyn.scenario.curves import LoadCurve
from tribodyn.scenario.quantity import Switch, Table, csv_or_record, model_file, written
from tribodyn.scenario.tables.drive_data import (
    lubricant_of,
    modifications_of,
    slices_of,
    teeth_of,
)
from tribodyn.scenario.tables.duty import duty_of
from tribodyn.scenario.tables.model_files import DriveTable, Lubricant
from tribodyn.scenario.tables.modification import MisalignmentTable
from tribodyn.scenario.tables.spectrum import OiledOperatingTable, SpectrumScenario
from tribodyn.studies.ehl.case import EhlCase
from tribodyn.tribology.data import FilmData, FrictionData
from tribodyn.tribology.ehl.grid import STEP


class EhlMesh(Table):
    """By what compliance the pairs in contact share the load."""

    compliance: Literal["energy", "fem"] = Field(
        "energy", description="by which the pairs share the load: the energy method, or finite elements"
    )


def _of_record(path: Path, key: str) -> dict[str, Any]:
    from tribodyn.studies.ehl.loads import loads_of_record

    return loads_of_record(path, key)


LOADS = csv_or_record("roll_angle", "normal_load", record=_of_record)


class EhlContact(Table):
    """How the contact is solved."""

    transient: Switch = Field(
        False,
        description="also solve the pair's way with squeeze, the film of one position carried to the next",
    )
    loads: Annotated[LoadCurve, LOADS] | None = Field(
        None, description="of the pair over its way: a record's, or a table; default: quasi-static"
    )
    step: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.02, le=0.5)] = Field(
        STEP, description="of the grid, over the distance from inlet and end of the film"
    )


class EhlOutput(Table):
    """What is recorded."""

    positions: Annotated[int, Field(strict=True, ge=4)] = Field(
        40, description="of the pair, from the beginning to the end of its contact"
    )


class EhlScenario(SpectrumScenario):
    """A scenario file of a study of the solved contact."""

    kind: Literal["ehl"]
    drive: Annotated[DriveTable, model_file("drives")]
    lubricant: Annotated[Lubricant, model_file("lubricants")]
    operating: OiledOperatingTable
    mesh: EhlMesh = written({})
    contact: EhlContact = written({})
    output: EhlOutput = written({})


Scenario = EhlScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> EhlCase:
    """Return the case of a scenario that has passed schema and rules."""
    drive, operating = scenario.drive, scenario.operating
    modifications = modifications_of(drive, MisalignmentTable(from_quality=0.0))
    return EhlCase(
        **head_of(scenario, toml, sha256),
        **teeth_of(drive),
        lubricant=lubricant_of(scenario.lubricant, operating.oil_temperature),
        operating=OperatingData("speed", *duty_of(operating, drive.pinion.teeth, drive.gear.teeth)),
        mesh=MeshData(
            scenario.mesh.compliance,
            damping_ratio=0.0,
            modifications=modifications,
            slices=slices_of(None, modifications),
        ),
        positions=scenario.output.positions,
        transient=scenario.contact.transient,
        loads=loads.in_si() if (loads := scenario.contact.loads) else None,
        step=scenario.contact.step,
        film=FilmData(),
        friction=FrictionData("none"),
    )
