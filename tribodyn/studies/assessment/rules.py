"""Rules that tie keys of an assessment together."""

from collections.abc import Iterator
from itertools import pairwise

from tribodyn.errors import InputError, unknown_name
from tribodyn.scenario.tables.drive_rules import broken_drive_rules
from tribodyn.scenario.tables.duty import broken_driving_rules
from tribodyn.scenario.tables.losses import broken_loss_rules
from tribodyn.scenario.tables.lubricant_rules import broken_lubricant_rules
from tribodyn.scenario.tables.modification_rules import Face, broken_slice_rules
from tribodyn.scenario.tables.quality import broken_sample_rules
from tribodyn.scenario.tables.spectrum import unnamed_duty
from tribodyn.scenario.tables.temperature import broken_temperature_rules
from tribodyn.scenario.tables.tolerances import tolerances_of
from tribodyn.studies.assessment.scenario import Scenario
from tribodyn.tribology.friction import FRICTION_LAWS


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks."""
    drive, operating, mesh = scenario.drive, scenario.operating, scenario.mesh
    yield from broken_drive_rules(drive)
    yield from unnamed_duty(scenario)
    yield from broken_slice_rules(Face(drive, mesh.misalignment, mesh.slices, True))
    yield from broken_sample_rules(drive, None, mesh.misalignment)
    if None in tolerances_of(drive):
        yield InputError(
            "drive.quality",
            rule="missing: the standards reckon with the deviations of a tolerance class by ISO 1328-1",
            remedy="add quality = 6 to [drive]",
        )
    if scenario.lubricant.viscosity_40 is None:
        yield InputError(
            "lubricant.viscosity_40",
            rule="missing: temperatures and margins need the oil over temperature, by its data sheet",
            remedy="give type, viscosity_40, viscosity_100 and density_15",
        )
    else:
        yield from broken_lubricant_rules(scenario.lubricant, operating.oil_temperature)
    yield from broken_temperature_rules(scenario.temperature, scenario.lubricant)
    yield from broken_loss_rules(scenario.losses)
    yield from broken_driving_rules(
        operating,
        (drive.pinion.teeth, drive.gear.teeth),
        "the standards' formulas are those of a driving pinion",
        ", or call the driving gear the pinion",
    )
    yield from _asked(scenario)


def _asked(scenario: Scenario) -> Iterator[InputError]:
    asked = scenario.assessment
    for lower, higher in pairwise(asked.torque_shares):
        if not lower < higher:
            rule = f"must increase: {higher:g} follows {lower:g}"
            yield InputError(
                "assessment.torque_shares", f"{higher:g}", rule, "write them in increasing order"
            )
    first, last = asked.speed_range
    if not first < last:
        rule = "the last speed must be above the first"
        yield InputError("assessment.speed_range", f"[{first:g}, {last:g}]", rule, "write [0.2, 2.5]")
    for name in asked.friction_laws:
        if name not in FRICTION_LAWS:
            yield unknown_name("assessment.friction_laws", name, FRICTION_LAWS, FRICTION_LAWS.what)
            continue
        needed = [key.name for key in FRICTION_LAWS[name].keys if key.default is None]
        if name == "none" or needed:
            rule = f"has keys of its own ({', '.join(needed)})" if needed else "has no losses"
            yield InputError("assessment.friction_laws", f'"{name}"', rule, "leave it out")
