"""From the validated tables of a scenario to the plain data that the physics takes."""

import math
from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from tribodyn.geometry.assembly import Assembly, normal_backlash
from tribodyn.geometry.drive import SIDES, BodyMass, Drive, MaterialData, body_of
from tribodyn.scenario.tables import model_files
from tribodyn.scenario.tables.centre_distance import RoundedDistance, rounded_distance
from tribodyn.scenario.tables.tooth_data import gear_body, gives_thickness, pressure_angle_of, shape_of


def mean_roughness(drive: model_files.DriveTable) -> float:
    """Ra of the flanks, m: the mean of both gears' where they say it.

    σ/√π where only that is given, of two equal flanks with normally distributed heights.
    """
    own = _mean_roughnesses(drive)
    return cast(float, drive.roughness) / math.sqrt(math.pi) if None in own else sum(cast(Any, own)) / 2.0


def roughness_of(drive: model_files.DriveTable) -> float:
    """Composite rms roughness σ of the flanks, m: given, or √(R_q1² + R_q2²).

    R_q = √(π/2) Ra, of normally distributed heights.
    """
    if drive.roughness is not None:
        return drive.roughness
    return math.sqrt(math.pi / 2.0) * math.hypot(*cast(Any, _mean_roughnesses(drive)))


def _mean_roughnesses(drive: model_files.DriveTable) -> list[float | None]:
    gears = drive.pinion, drive.gear
    return [drive.mean_roughness if one.mean_roughness is None else one.mean_roughness for one in gears]


def teeth_of(drive: model_files.DriveTable) -> dict[str, Any]:
    """Return the fields of a case for the teeth of a drive file: their family, shape, material and flanks."""
    return {
        "family": drive.family,
        "drive": drive_of(drive),
        "materials": materials_of(drive),
        "roughness": roughness_of(drive),
        "mean_roughness": mean_roughness(drive),
    }


def drive_of(drive: model_files.DriveTable) -> Drive:
    """Return the geometry of a drive file."""
    from tribodyn.geometry.assembly import tip_break
    from tribodyn.geometry.families import family

    teeth = family(drive.family)
    sharp = Drive(
        drive.module,
        pressure_angle_of(drive) or 0.0,
        gear_body(drive, drive.pinion),
        gear_body(drive, drive.gear),
        shape_of(drive, teeth),
        None if drive.centre_distance is None else drive.centre_distance.value,
    )
    if rounded := rounded_distance(drive, sharp):
        sharp = sharp._replace(centre_distance=rounded.meant)
    rounded = sharp
    for side in SIDES:
        if rounding := getattr(drive, side).tip_rounding:
            with np.errstate(all="ignore"):  # refused where the pair is put together
                height = float(tip_break(teeth, sharp, side, rounding))
            body = body_of(sharp, side)._replace(tip_break=height)
            rounded = rounded._replace(**{side: body})
    return rounded


def rounded_distance_of(drive: Mapping[str, Any]) -> RoundedDistance | None:
    """How the centre distance of a drive file's data is rounded, see `rounded_distance`."""
    if "family" not in drive or "centre_distance" not in drive:  # of another kind; most have none
        return None
    table = model_files.DriveTable.model_validate(drive)
    return rounded_distance(table, drive_of(table))


def with_axes_held(drive: dict[str, Any]) -> dict[str, Any]:
    """A drive file's data with the centre distance to the last digit, so that nothing of it is rounding."""
    if "family" not in drive or "centre_distance" not in drive:
        return drive
    distance = drive_of(model_files.DriveTable.model_validate(drive)).centre_distance
    return drive | {"centre_distance": f"{1e3 * distance:.12f} mm"}


def gives_backlash(drive: model_files.DriveTable) -> bool:
    """Whether a drive says more of its backlash than that its teeth are nominal."""
    gears = drive.pinion, drive.gear
    return drive.centre_distance is not None or any(gives_thickness(gear) for gear in gears)


def backlash_of(drive: model_files.DriveTable, given: float | None) -> float | None:
    """Return the normal backlash (m): as `given`, else of the drive; None where that says nothing."""
    if given is not None or not gives_backlash(drive):
        return given
    from tribodyn.geometry.families import family

    numbers = drive_of(drive)
    with np.errstate(all="ignore"):  # teeth that cannot be made are refused where they are put together
        backlash = float(normal_backlash(Assembly(family(drive.family), numbers)))
    return max(backlash, 0.0)


def materials_of(drive: model_files.DriveTable) -> tuple[MaterialData, MaterialData]:
    """Return what pinion and gear are made of."""
    return _material(drive, drive.pinion), _material(drive, drive.gear)


def masses_of(drive: model_files.DriveTable) -> tuple[BodyMass, BodyMass]:
    """Return the masses that a drive file gives."""
    return _mass(drive.pinion), _mass(drive.gear)


def _material(drive: model_files.DriveTable, gear: model_files.Gear) -> MaterialData:
    material = cast(model_files.Material, gear.material or drive.material)
    numbers = material.model_dump(exclude={"title", "source", "assumptions"})
    return MaterialData(name=material.title, **numbers)


def _mass(gear: model_files.Gear) -> BodyMass:
    return BodyMass(gear.mass, gear.inertia)
