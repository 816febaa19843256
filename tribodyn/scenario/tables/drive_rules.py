"""Rules that tie several keys of a scenario together: what contradicts, what needs what."""

from collections.abc import Iterator

from tribodyn.errors import InputError, unknown_name
from tribodyn.geometry.families import FAMILIES
from tribodyn.scenario.tables.face import broken_modification_rules
from tribodyn.scenario.tables.model_files import DriveTable
from tribodyn.scenario.tables.quality import broken_quality_rules
from tribodyn.scenario.tables.tooth_data import broken_tooth_rules, shape_errors


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
    yield from broken_tooth_rules(drive)
    yield from broken_modification_rules(drive)
    yield from broken_quality_rules(drive)
    if drive.family in FAMILIES:
        yield from shape_errors(drive, FAMILIES[drive.family])
    else:
        yield unknown_name(FAMILIES.key, drive.family, FAMILIES, FAMILIES.what)


def broken_part_rules(hertz: str, foundation: str, compliance: str) -> Iterator[InputError]:
    """Go through what contradicts between the parts of a compliance, contact and body, and the compliance."""
    if hertz == "load-dependent" and compliance != "energy":
        yield InputError(
            "mesh.hertz",
            '"load-dependent"',
            f'contradicts compliance = "{compliance}", which contains the Hertz contact',
            'leave hertz out, or write compliance = "energy"',
        )
    if foundation == "ring" and compliance != "energy":
        yield InputError(
            "mesh.foundation",
            '"ring"',
            f'contradicts compliance = "{compliance}", which contains the gear bodies',
            'leave foundation out, or write compliance = "energy"',
        )
