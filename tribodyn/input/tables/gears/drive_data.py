"""From the validated tables of a scenario to the plain data that the physics takes.

Papers and drawings print the distance of a pair without backlash to a few digits, and its profile shifts too.
Put together, such numbers leave an overlap of less than a micrometre. Where the distance without backlash is
larger than the one written, by no more than the rounding of these digits explains, it is the one meant. A
distance that is larger than that without backlash is taken as it is written, however near: it has a backlash.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple, cast

import numpy as np

from tribodyn.geometry.assembly import Assembly, tip_break
from tribodyn.geometry.backlash import normal_backlash
from tribodyn.geometry.drive import SIDES, BodyMass, Drive, MaterialData, body_of
from tribodyn.geometry.families import FAMILIES, family
from tribodyn.geometry.families.involute import overlap, shift_sensitivity, tight_centre_distance
from tribodyn.geometry.helix import from_written
from tribodyn.geometry.limits.checks import check_path
from tribodyn.input.quantity import shift_rounding
from tribodyn.input.tables.gears.model_files import DriveTable, Gear, Material
from tribodyn.input.tables.gears.tooth_data import (
    gear_body,
    gives_thickness,
    helix_of,
    pressure_angle_of,
    shape_of,
)
from tribodyn.tribology.contact import asperities_of

#: Rounding that is believed, at most, modules: about the backlash that gears are given. A larger overlap is a
#: mistake, whatever the digits ("0.1 m").
MOST = 0.05


class RoundedDistance(NamedTuple):
    """A printed centre distance, the rounding of the digits, and that without backlash which is meant; m."""

    printed: float
    rounding: float
    meant: float

    def remark(self) -> str:
        """What is to be said of it."""
        return (
            f"The centre distance {1e3 * self.printed:.9g} mm is that of the mesh without backlash, "
            f"{1e3 * self.meant:.8g} mm, within the rounding of its digits and of the profile shifts' "
            f"({1e3 * self.rounding:.2g} mm), and is taken as that."
        )

    def lines(self) -> dict[str, tuple[float, str]]:
        """Lines of the gear sheet."""
        return {
            "centre distance as printed": (1e3 * self.printed, "mm"),
            "rounding of the printed digits": (1e3 * self.rounding, "mm"),
        }


def rounded_distance(table: DriveTable, drive: Drive) -> RoundedDistance | None:
    """How the centre distance is rounded; None where none is written, and where it is meant as written."""
    if table.centre_distance is None or not FAMILIES[table.family].involute:
        return None
    printed, rounding = table.centre_distance
    printed *= _sense(table)
    with np.errstate(all="ignore"):  # where there is no such mesh: refused where the pair is put together
        # the shifts are in normal modules
        slope = float(shift_sensitivity(drive)) * math.cos(drive.helix_angle)
        if not overlap(drive._replace(centre_distance=printed)):
            return None
        meant = float(tight_centre_distance(drive))
    for side in SIDES:
        gear = getattr(table, side)
        if gear.span is None and gear.over_pins is None:  # measured teeth have their thickness at any shift
            rounding += slope * shift_rounding(gear.profile_shift)
    rounding = min(rounding, MOST * drive.module)
    return RoundedDistance(printed, rounding, meant) if meant <= printed + rounding else None


def _sense(drive: DriveTable) -> float:
    """Sign of the centre distance: negative of an internal pair (ISO 21771)."""
    return -1.0 if drive.has_ring else 1.0


def mean_roughness(drive: DriveTable) -> float:
    """Ra of the flanks, m: the mean of both gears' where they say it.

    σ/√π where only that is given, of two equal flanks with normally distributed heights.
    """
    both = _mean_roughnesses(drive)
    return cast(float, drive.roughness) / math.sqrt(math.pi) if None in both else sum(cast(Any, both)) / 2.0


def roughness_of(drive: DriveTable) -> float:
    """Composite rms roughness σ of the flanks, m: given, or √(R_q1² + R_q2²).

    R_q = √(π/2) Ra, of normally distributed heights.
    """
    if drive.roughness is not None:
        return drive.roughness
    return math.sqrt(math.pi / 2.0) * math.hypot(*cast(Any, _mean_roughnesses(drive)))


def _mean_roughnesses(drive: DriveTable) -> list[float | None]:
    of_gears = drive.pinion.mean_roughness, drive.gear.mean_roughness
    return [drive.mean_roughness if roughness is None else roughness for roughness in of_gears]


def teeth_of(drive: DriveTable) -> dict[str, Any]:
    """Return the fields of a case for the teeth of a drive file: their family, shape, material and flanks."""
    return {
        "family": drive.family,
        "drive": drive_of(drive),
        "materials": materials_of(drive),
        "roughness": roughness_of(drive),
        "mean_roughness": mean_roughness(drive),
        "asperities": asperities_of(drive.finish, drive.asperity_density, drive.asperity_slope),
    }


def drive_of(drive: DriveTable) -> Drive:
    """Return the geometry of a drive file: its transverse section."""
    teeth = family(drive.family)
    written = Drive(
        drive.module,
        pressure_angle_of(drive) or 0.0,
        gear_body(drive, drive.pinion),
        gear_body(drive, drive.gear),
        shape_of(drive, teeth),
        None if drive.centre_distance is None else _sense(drive) * drive.centre_distance.value,
        helix_of(drive),
    )
    sharp = from_written(teeth, written)
    if rounded := rounded_distance(drive, sharp):
        sharp = sharp._replace(centre_distance=rounded.meant)
    rounded = sharp
    for side in SIDES:
        if rounding := getattr(drive, side).tip_rounding:
            check_path(teeth, sharp)
            with np.errstate(all="ignore"):  # refused where the pair is put together
                height = float(tip_break(teeth, sharp, side, rounding))
            body = body_of(sharp, side)._replace(tip_break=height)
            rounded = rounded._replace(**{side: body})
    return rounded


def rounded_distance_of(drive: Mapping[str, Any]) -> RoundedDistance | None:
    """How the centre distance of a drive file's data is rounded, see `rounded_distance`."""
    if "family" not in drive or "centre_distance" not in drive:  # of another kind; most have none
        return None
    table = DriveTable.model_validate(drive)
    return rounded_distance(table, drive_of(table))


def with_axes_held(drive: dict[str, Any]) -> dict[str, Any]:
    """A drive file's data with the centre distance to the last digit, so that nothing of it is rounding."""
    if "family" not in drive or "centre_distance" not in drive:
        return drive
    table = DriveTable.model_validate(drive)
    distance = _sense(table) * drive_of(table).centre_distance
    return drive | {"centre_distance": f"{1e3 * distance:.12f} mm"}


def gives_backlash(drive: DriveTable) -> bool:
    """Whether a drive says more of its backlash than that its teeth are nominal."""
    gears = drive.pinion, drive.gear
    return drive.centre_distance is not None or any(gives_thickness(gear) for gear in gears)


def backlash_of(drive: DriveTable, backlash: float | None) -> float | None:
    """Return the normal backlash (m): as `backlash`, else of the drive; None where that says nothing."""
    if backlash is not None or not gives_backlash(drive):
        return backlash
    assembly = assembled_on_path(drive)
    with np.errstate(all="ignore"):  # teeth that cannot be made are refused where they are put together
        return max(float(normal_backlash(assembly)), 0.0)


def assembled_on_path(drive: DriveTable) -> Assembly:
    """Put a drive together that has a path of contact; its teeth are not checked, and are cut when needed.

    Raises InputError as `check_path`.
    """
    teeth, drive_numbers = family(drive.family), drive_of(drive)
    check_path(teeth, drive_numbers)
    return Assembly(teeth, drive_numbers)


def materials_of(drive: DriveTable) -> tuple[MaterialData, MaterialData]:
    """Return what pinion and gear are made of."""
    return _material(drive, drive.pinion), _material(drive, drive.gear)


def masses_of(drive: DriveTable) -> tuple[BodyMass, BodyMass]:
    """Return the masses that a drive file gives."""
    pinion, gear = (
        BodyMass(each.mass, each.inertia, each.rim_thickness, each.web_thickness)
        for each in (drive.pinion, drive.gear)
    )
    return pinion, gear


def _material(drive: DriveTable, gear: Gear) -> MaterialData:
    material = cast(Material, gear.material or drive.material)
    numbers = material.model_dump(exclude={"title", "source", "assumptions"})
    return MaterialData(name=material.title, **numbers)
