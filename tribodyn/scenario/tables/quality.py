"""Samples of deviations within the tolerances of a drive's gears."""

from collections.abc import Iterator
from typing import Annotated

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.families import family
from tribodyn.geometry.flanks.deviations import Deviations, Limits, deviating, profile_curve, sampled, summed
from tribodyn.geometry.flanks.modification import Modifications
from tribodyn.numerics.curve import Table
from tribodyn.scenario.quantity import Draws
from tribodyn.scenario.tables.drive_data import drive_of
from tribodyn.scenario.tables.model_files import DriveTable
from tribodyn.scenario.tables.modification import MisalignmentTable
from tribodyn.scenario.tables.tolerances import tolerances_of

DeviationSample = Annotated[int, Field(strict=True, ge=0, le=2**31 - 1), Draws()]


def broken_sample_rules(
    drive: DriveTable, sample: int | None, misalignment: MisalignmentTable
) -> Iterator[InputError]:
    """Refuse what is taken from the tolerances of gears without a quality."""
    if None not in tolerances_of(drive):
        return
    for key, value in (
        ("mesh.deviation_sample", sample),
        ("mesh.misalignment.from_quality", misalignment.from_quality or None),
    ):
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

    Parameters
    ----------
    drive : DriveTable
    modifications : Modifications
    sample : int or None
    every_tooth : bool
        Whether the study knows teeth that differ.
    slices : int or None
        As given; with a single one nothing varies along the face, the helix included.
    """
    if sample is None:
        return modifications
    pinion, gear = _deviations(drive, sample)
    if slices == 1:
        pinion, gear = pinion._replace(helix=0.0), gear._replace(helix=0.0)
    with np.errstate(all="ignore"):  # teeth that cannot be made are refused where they are put together
        return deviating(modifications, _assembly(drive), pinion, gear, every_tooth)


def error_with_sample(drive: DriveTable, error: Table | None, sample: int | None) -> Table | None:
    """Add the sample's profile and base pitch deviations to the transmission error of a pair (rad, m)."""
    if sample is None:
        return error
    with np.errstate(all="ignore"):
        curve = profile_curve(_assembly(drive), *_deviations(drive, sample), base_pitch=True)
    return curve if error is None else summed(error, curve)


def _assembly(drive: DriveTable) -> Assembly:
    return Assembly(family(drive.family), drive_of(drive))


def _deviations(drive: DriveTable, sample: int) -> tuple[Deviations, Deviations]:
    both = []
    for number, (gear, allowed) in enumerate(
        zip((drive.pinion, drive.gear), tolerances_of(drive), strict=True)
    ):
        if allowed is None:  # refused by the rules
            raise InputError("drive.quality", rule="missing", remedy="add quality = 6 to [drive]")
        limits = Limits(
            allowed.single_pitch,
            allowed.total_pitch,
            allowed.profile_slope,
            allowed.profile_form,
            allowed.helix_slope,
        )
        both.append(sampled(limits, gear.teeth, sample, number))
    return both[0], both[1]
