"""Rules that tie several keys of a scenario together: what contradicts, what needs what."""

from collections.abc import Iterator

from tribodyn.errors import InputError
from tribodyn.scenario.model_files import DriveTable
from tribodyn.scenario.modification_rules import broken_flank_rules


def broken_drive_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through the rules that a drive breaks by itself."""
    for name in ("pinion", "gear"):
        gear = getattr(drive, name)
        if drive.material is None and gear.material is None:
            yield InputError(
                f"drive.{name}.material",
                rule="missing",
                remedy="give the name of a file in models/materials here, or drive.material for both gears",
            )
    yield from broken_flank_rules(drive)
