"""Rules that tie several keys of a gear pair's scenario together: what contradicts, what needs what."""

from collections.abc import Iterator

from tribodyn.errors import InputError
from tribodyn.gears.damage_rules import broken_damage
from tribodyn.gears.motion.settings import (
    broken_flank_rules,
    broken_mesh_rules,
    broken_output_rules,
    broken_solver_rules,
    broken_source_rules,
)
from tribodyn.gears.scenario import broken_gear_rules
from tribodyn.input.tables.duty import broken_duty_rules, duty_of
from tribodyn.input.tables.gears.drive_data import gives_backlash
from tribodyn.input.tables.gears.internal_gear import driving_internal
from tribodyn.input.tables.sensors import broken_sensor_rules
from tribodyn.studies.motion.pair.scenario import Scenario, gears_of_pair


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks; none: it is consistent."""
    of_drive = [
        *driving_internal(scenario.drive),
        *broken_gear_rules(scenario, every_tooth=True),
    ]
    yield from of_drive
    if not of_drive:
        yield from broken_damage(scenario.damage, gears_of_pair(scenario))
    yield from broken_source_rules(scenario.operating)
    yield from broken_mesh_rules(scenario.mesh)
    yield from _load(scenario)
    yield from broken_solver_rules(scenario.solver)
    yield from broken_output_rules(scenario.output, scenario.solver, scenario.drive.pinion.teeth)
    yield from broken_sensor_rules(scenario.sensor, scenario.housing)


def _load(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules of speed and load; without one of each there is nothing else to say."""
    operating, drive, mesh = scenario.operating, scenario.drive, scenario.mesh
    if broken := broken_duty_rules(operating.load):
        yield from broken
        return
    torque = duty_of(operating.load, drive.pinion.teeth, drive.gear.teeth).gear_torque
    back_flanks = mesh.backlash is not None or gives_backlash(drive)
    yield from broken_flank_rules("operating.output_torque", torque, back_flanks, mesh)
