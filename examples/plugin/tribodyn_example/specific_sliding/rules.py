"""Rules that tie several keys of a scenario together."""

from collections.abc import Iterator

from tribodyn import InputError
from tribodyn.input.tables.gears.drive_rules import broken_drive_rules
from tribodyn_example.specific_sliding.scenario import Scenario


def broken_rules(scenario: Scenario) -> Iterator[InputError]:
    """Go through the rules that a scenario breaks: here those of every drive."""
    yield from broken_drive_rules(scenario.drive)
