"""Rules that tie several keys of a scenario together: what contradicts, what needs what."""

from collections.abc import Iterator

from tribodyn.errors import InputError
from tribodyn.scenario.tables.drive_rules import broken_drive_rules, broken_part_rules
from tribodyn.scenario.tables.duty import broken_duty_rules, duty_of
from tribodyn.scenario.tables.losses import broken_loss_rules
from tribodyn.scenario.tables.lubricant_rules import broken_lubricant_rules
from tribodyn.scenario.tables.modification_rules import Face, broken_face_rules
from tribodyn.scenario.tables.quality import broken_sample_rules
from tribodyn.scenario.tables.temperature import broken_temperature_rules
from tribodyn.studies.efficiency.scenario import Scenario


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together and that this one breaks."""
    mesh = scenario.mesh
    yield from broken_drive_rules(scenario.drive)
    yield from broken_lubricant_rules(scenario.lubricant, scenario.operating.oil_temperature)
    yield from broken_temperature_rules(scenario.temperature, scenario.lubricant)
    yield from broken_loss_rules(scenario.losses)
    face = Face(scenario.drive, mesh.misalignment, mesh.slices, mesh.slice_coupling)
    yield from broken_face_rules(face, mesh.compliance)
    yield from broken_sample_rules(scenario.drive, mesh.deviation_sample, mesh.misalignment)
    yield from broken_part_rules(mesh.hertz, mesh.foundation, mesh.compliance)
    drive, operating = scenario.drive, scenario.operating
    broken = broken_duty_rules(operating)
    yield from broken
    if not broken and duty_of(operating, drive.pinion.teeth, drive.gear.teeth).gear_torque == 0:
        yield InputError(
            "operating.gear_torque",
            "0 N*m",
            "must not be zero: an unloaded mesh transmits nothing",
            'write a torque such as "500 N*m", or "-500 N*m" where the gear drives',
        )
