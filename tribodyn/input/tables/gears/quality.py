"""A drive's quality: tolerances of its gears by ISO 1328-1:2013 or :1995, and samples within them."""

import math
from collections.abc import Iterator
from typing import Annotated

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.geometry.modification import (
    Deviations,
    Limits,
    Modifications,
    deviating,
    profile_curve,
    sampled,
    summed,
)
from tribodyn.input.quantity import Draws
from tribodyn.input.tables.gears.drive_data import assembled_on_path
from tribodyn.input.tables.gears.model_files import DriveTable, Gear, MisalignmentTable
from tribodyn.input.tables.gears.tooth_data import modules_of
from tribodyn.numerics.curve import Table
from tribodyn.standards.flank_tolerances import (
    FlankTolerances,
    flank_tolerances,
    flank_tolerances_1995,
    outside,
    rounded,
)

DeviationSample = Annotated[int, Field(strict=True, ge=0, le=2**31 - 1), Draws()]


def broken_sample_rules(
    drive: DriveTable, sample: int | None, misalignment: MisalignmentTable
) -> Iterator[InputError]:
    """Refuse what is taken from the tolerances of gears without a quality."""
    if None not in tolerances_of(drive):
        return
    share = misalignment.from_quality or None
    for key, value in (("mesh.deviation_sample", sample), ("mesh.misalignment.from_quality", share)):
        if value is not None:
            rule = "is taken from the tolerances of both gears, and they have no quality"
            yield InputError(key, value, rule, "add quality = 6 to [drive]")


def with_sample(
    drive: DriveTable,
    modifications: Modifications,
    sample: int | None,
    *,
    every_tooth: bool,
    slices: int | None,
) -> Modifications:
    """Add the sample of deviations to what is taken off the flanks; without one, return that.

    With a single slice nothing varies along the face, the helix included; `every_tooth`: teeth may differ.
    """
    if sample is None:
        return modifications
    pinion, gear = _deviations(drive, sample)
    if slices == 1:
        pinion, gear = pinion._replace(helix=0.0), gear._replace(helix=0.0)
    with np.errstate(all="ignore"):  # teeth that cannot be made are refused where they are put together
        return deviating(modifications, assembled_on_path(drive), pinion, gear, every_tooth)


def error_with_sample(drive: DriveTable, error: Table | None, sample: int | None) -> Table | None:
    """Add the sample's profile and base pitch deviations to the transmission error of a pair (rad, m)."""
    if sample is None:
        return error
    with np.errstate(all="ignore"):
        curve = profile_curve(assembled_on_path(drive), *_deviations(drive, sample), base_pitch=True)
    return curve if error is None else summed(error, curve)


def _deviations(drive: DriveTable, sample: int) -> tuple[Deviations, Deviations]:
    both = []
    gears = zip((drive.pinion, drive.gear), tolerances_of(drive), strict=True)
    for number, (gear, allowed) in enumerate(gears):
        if allowed is None:  # refused by the rules
            raise InputError("drive.quality", rule="missing", remedy="add quality = 6 to [drive]")
        limits = Limits(*(getattr(allowed, name) for name in Limits._fields))
        both.append(sampled(limits, gear.teeth, sample, number))
    return both[0], both[1]


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
    slopes = [allowed.helix_slope if allowed else 0.0 for allowed in tolerances_of(drive)]
    return math.hypot(*slopes) / min(drive.pinion.face_width, drive.gear.face_width)


def tolerance_lines(drive: DriveTable) -> tuple[dict[str, tuple[float, str]], dict[str, tuple[float, str]]]:
    """Return the lines of the gear sheet, of pinion and gear, µm, rounded as the standard does."""
    lines: list[dict[str, tuple[float, str]]] = []
    for gear, allowed in zip((drive.pinion, drive.gear), tolerances_of(drive), strict=True):
        lines.append({})
        if allowed is not None:
            label = f"tolerance class by ISO 1328-1:{drive.quality_edition}"
            lines[-1][label] = float(grade_of(drive, gear) or 0), ""
            for label, name in _LINES.items():
                lines[-1][label] = 1e6 * rounded(getattr(allowed, name)), "um"
    return lines[0], lines[1]


def broken_quality_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what is outside the standard's range."""
    for name, gear in (("pinion", drive.pinion), ("gear", drive.gear)):
        if (grade := grade_of(drive, gear)) is None:
            continue
        key = "drive.quality" if gear.quality is None else f"drive.{name}.quality"
        normal, transverse = modules_of(drive)
        sizes = gear.teeth, normal, transverse * gear.teeth, gear.face_width
        for limit in outside(*sizes, drive.quality_edition):
            rule = f"the tolerances of ISO 1328-1:{drive.quality_edition} do not cover the {name}: {limit}"
            yield InputError(key, grade, rule, "leave the quality out, and give deviations of your own")


def grade_of(drive: DriveTable, gear: Gear) -> int | None:
    """Return a gear's tolerance class: its own, or the drive's."""
    return drive.quality if gear.quality is None else gear.quality


def _tolerances(drive: DriveTable, gear: Gear) -> FlankTolerances | None:
    grade = grade_of(drive, gear)
    if grade is None:
        return None
    normal, transverse = modules_of(drive)
    formulas = flank_tolerances if drive.quality_edition == 2013 else flank_tolerances_1995
    return formulas(grade, normal, transverse * gear.teeth, gear.face_width)
