"""The tables of a scenario of ``kind = "ehl"``: the contact of a pair solved along its way."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.gears.scenario import GearScenario, Oil, broken_gear_rules, gear_fields, oil_fields
from tribodyn.input import units
from tribodyn.input.fields import LoadCurve
from tribodyn.input.quantity import InUnit, Switch, Table, csv_file, written
from tribodyn.input.tables.duty import OiledOperatingTable, broken_driving_rules
from tribodyn.studies.ehl.case import EhlCase
from tribodyn.tribology.ehl.grid import STEP
from tribodyn.tribology.law import FilmData


class EhlMesh(Table):
    """By what compliance the pairs in contact share the load."""

    compliance: Literal["energy", "fem"] = "energy"


def loads_of_record(path: Path, key: str) -> dict[str, Any]:
    """Loads of the last pair that passed through the whole mesh in a simulation over time, as columns.

    Raises InputError if the file is no such record, or too short.
    """
    from tribodyn.post.cycles import last_cycles
    from tribodyn.record.reader import Record

    def bad(rule: str, remedy: str) -> InputError:
        return InputError(key, quoted(path.name), rule, remedy, str(path))

    try:
        opened = Record(path)
    except InputError as error:
        raise bad(error.rule, error.remedy) from None
    with opened as record:
        if record.axis != "time" or "normal_load" not in record or "mesh_cycle" not in record.groups:
            raise bad("holds no loads of pairs over time", "give the record of a gear pair's simulation")
        cycle, numbers = record.mesh_cycle, np.asarray(record["pair"])
        if "face_position" in cycle:
            raise bad("is of a helical pair, whose load varies along its lines of contact", "give a table")
        ratio = float(cycle["contact_ratio"])
        window = last_cycles(record, int(np.ceil(ratio)))
        if window.phase[-1] < ratio:
            raise bad("ends before a pair has passed through the mesh", "let it run for more mesh cycles")
        age = window.phase[window.phase <= ratio]
        load = np.asarray(record["normal_load"])[window.part][: len(age)]
    # the pair that entered with the first sample is number 1, then 0, then -1
    column = np.searchsorted(numbers, 1 - np.floor(age + 1e-9).astype(int))
    roll = float(cycle["roll_start"]) + 2.0 * np.pi / float(cycle["pinion_teeth"]) * age
    values = np.nan_to_num(load[np.arange(len(age)), column])
    return {
        "roll_angle": {"unit": "rad", "values": roll.tolist()},
        "normal_load": {"unit": "N", "values": values.tolist()},
    }


LOADS = csv_file("roll_angle", "normal_load", record=loads_of_record)


class EhlContact(Table):
    """How the contact is solved."""

    transient: Switch = False
    loads: Annotated[LoadCurve, LOADS] | None = None
    face_position: Annotated[float, InUnit(units.LENGTH, "8 mm")] = written("0 mm")
    step: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.02, le=0.5)] = STEP


class EhlOutput(Table):
    """What is recorded."""

    positions: Annotated[int, Field(strict=True, ge=4)] = 40


class EhlScenario(GearScenario):
    """A scenario file of a study of the solved contact."""

    kind: Literal["ehl"]
    lubricant: Oil
    operating: OiledOperatingTable
    mesh: EhlMesh = written({})
    contact: EhlContact = written({})
    output: EhlOutput = written({})


Scenario = EhlScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> EhlCase:
    """Return the case of a scenario that has passed schema and rules."""
    contact = scenario.contact
    oil: dict[str, Any] = oil_fields(scenario)
    oil["film"] = FilmData()  # the contact is solved
    return EhlCase(
        **gear_fields(scenario, toml, sha256),
        **oil,
        positions=scenario.output.positions,
        transient=contact.transient,
        loads=contact.loads.in_si() if contact.loads else None,
        face_position=contact.face_position,
        step=contact.step,
    )


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    yield from broken_gear_rules(scenario)
    drive = scenario.drive
    yield from broken_driving_rules(scenario.operating, (drive.pinion.teeth, drive.gear.teeth))
    if place := scenario.contact.face_position:
        key, shown = "contact.face_position", f"{1e3 * place:g} mm"
        half = min(drive.pinion.face_width, drive.gear.face_width) / 2.0
        if not drive.helix_angle:
            yield InputError(
                key, shown, "is of helical pairs; all sections of a spur pair are alike", "leave it out"
            )
        elif abs(place) > half:
            rule = f"off the face, which ends at ±{1e3 * half:g} mm"
            yield InputError(key, shown, rule, "give a place on it, from its middle")
