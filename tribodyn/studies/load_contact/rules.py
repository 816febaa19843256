"""Rules that tie several keys of a scenario together: what contradicts, what needs what."""

from collections.abc import Iterator
from itertools import pairwise

from tribodyn.errors import InputError
from tribodyn.scenario.tables.drive_rules import broken_drive_rules
from tribodyn.scenario.tables.duty import broken_driving_rules
from tribodyn.scenario.tables.lubricant_rules import broken_lubricant_rules
from tribodyn.scenario.tables.modification_rules import Face, broken_slice_rules
from tribodyn.scenario.tables.quality import broken_sample_rules
from tribodyn.scenario.tables.spectrum import unnamed_duty
from tribodyn.studies.load_contact.scenario import Scenario


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that tie keys of such a scenario together."""
    mesh = scenario.mesh
    yield from broken_drive_rules(scenario.drive)
    yield from unnamed_duty(scenario)
    yield from broken_slice_rules(Face(scenario.drive, mesh.misalignment, mesh.slices, mesh.slice_coupling))
    yield from broken_sample_rules(scenario.drive, mesh.deviation_sample, mesh.misalignment)
    drive, operating = scenario.drive, scenario.operating
    oiled = scenario.lubricant is not None
    yield from broken_driving_rules(operating, (drive.pinion.teeth, drive.gear.teeth), speed_needed=oiled)
    if scenario.lubricant is not None:
        yield from broken_lubricant_rules(scenario.lubricant, operating.oil_temperature)
    else:
        yield from _without_oil(scenario)
    torques = operating.gear_torques
    if len(torques) == 1:
        rule = "a single torque makes no map"
        yield InputError("operating.gear_torques", f"{torques[0]:g} N*m", rule, "give at least two")
    for number, (one, next_one) in enumerate(pairwise(torques), start=1):
        if next_one <= one:
            yield InputError(
                f"operating.gear_torques.{number}",
                f"{next_one:g} N*m",
                f"not greater than the {one:g} N*m before it",
                "give the torques in increasing order",
            )
            break


def _without_oil(scenario: Scenario) -> Iterator[InputError]:
    """Refuse what says something of a film that is not computed."""
    remedy = 'add lubricant = "iso-vg-220-mineral", or leave it out'
    given = {
        "operating.oil_temperature": scenario.operating.oil_temperature,
        "film": scenario.film,
    }
    for key, value in given.items():
        if value is not None:
            yield InputError(key, rule="without a lubricant there is no film", remedy=remedy)
