"""Rules that tie several keys of a scenario together: what contradicts, what needs what."""

from collections.abc import Iterator

from tribodyn.errors import InputError
from tribodyn.scenario.tables.drive_rules import broken_drive_rules
from tribodyn.scenario.tables.duty import broken_driving_rules
from tribodyn.scenario.tables.lubricant_rules import broken_lubricant_rules
from tribodyn.scenario.tables.modification import MisalignmentTable
from tribodyn.scenario.tables.modification_rules import Face, broken_face_rules
from tribodyn.scenario.tables.spectrum import unnamed_duty
from tribodyn.studies.ehl.scenario import Scenario


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    drive, operating = scenario.drive, scenario.operating
    yield from broken_drive_rules(drive)
    yield from unnamed_duty(scenario)
    yield from broken_lubricant_rules(scenario.lubricant, operating.oil_temperature)
    yield from broken_face_rules(
        Face(drive, MisalignmentTable(from_quality=0.0), None, True), scenario.mesh.compliance
    )
    yield from broken_driving_rules(operating, (drive.pinion.teeth, drive.gear.teeth))
