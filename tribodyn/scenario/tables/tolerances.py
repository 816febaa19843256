"""Tolerances of a drive's gears by ISO 1328-1."""

import math
from collections.abc import Iterator

from tribodyn.errors import InputError
from tribodyn.scenario.tables.model_files import DriveTable, Gear
from tribodyn.standards.flank_tolerances import FlankTolerances, flank_tolerances, outside, rounded

#: Lines of the gear sheet.
_LINES = {
    "f_pT, single pitch": "single_pitch",
    "F_pT, total pitch": "total_pitch",
    "f_H alpha T, profile slope": "profile_slope",
    "f_f alpha T, profile form": "profile_form",
    "F_alpha T, total profile": "total_profile",
    "f_H beta T, helix slope": "helix_slope",
    "f_f beta T, helix form": "helix_form",
    "F_beta T, total helix": "total_helix",
    "F_rT, runout": "runout",
}


def tolerances_of(drive: DriveTable) -> tuple[FlankTolerances | None, FlankTolerances | None]:
    """Return the tolerances of pinion and gear; None where no quality is given."""
    return _tolerances(drive, drive.pinion), _tolerances(drive, drive.gear)


def helix_allowance(drive: DriveTable) -> float:
    """Misalignment (rad) of both gears' helix slope tolerances, √(f_HβT1² + f_HβT2²), over the common face.

    ISO 6336-1 takes the same root as f_ma; 0 where no quality is given.
    """
    slopes = [one.helix_slope if one else 0.0 for one in tolerances_of(drive)]
    return math.hypot(*slopes) / min(drive.pinion.face_width, drive.gear.face_width)


def tolerance_lines(drive: DriveTable) -> tuple[dict[str, tuple[float, str]], dict[str, tuple[float, str]]]:
    """Return the lines of the gear sheet, of pinion and gear, µm, rounded as the standard does."""
    lines: list[dict[str, tuple[float, str]]] = []
    for gear, allowed in zip((drive.pinion, drive.gear), tolerances_of(drive), strict=True):
        lines.append({})
        if allowed is not None:
            lines[-1]["tolerance class by ISO 1328-1"] = float(grade_of(drive, gear) or 0), ""
            for label, name in _LINES.items():
                lines[-1][label] = 1e6 * rounded(getattr(allowed, name)), "um"
    return lines[0], lines[1]


def broken_quality_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what is outside the standard's range."""
    for name, gear in (("pinion", drive.pinion), ("gear", drive.gear)):
        if (grade := grade_of(drive, gear)) is None:
            continue
        key = "drive.quality" if gear.quality is None else f"drive.{name}.quality"
        for said in outside(gear.teeth, drive.module, drive.module * gear.teeth, gear.face_width):
            rule = f"the tolerances of ISO 1328-1 do not cover the {name}: {said}"
            yield InputError(key, grade, rule, "leave the quality out, and give deviations of your own")


def grade_of(drive: DriveTable, gear: Gear) -> int | None:
    """Return a gear's tolerance class: its own, or the drive's."""
    return drive.quality if gear.quality is None else gear.quality


def _tolerances(drive: DriveTable, gear: Gear) -> FlankTolerances | None:
    grade = grade_of(drive, gear)
    if grade is None:
        return None
    return flank_tolerances(grade, drive.module, drive.module * gear.teeth, gear.face_width)
