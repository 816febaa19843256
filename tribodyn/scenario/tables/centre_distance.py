"""The centre distance of a drive as it is meant: printed digits are rounded.

Papers and drawings print the distance of a pair without backlash to a few digits, and its profile shifts too.
Put together, such numbers leave an overlap of less than a micrometre. Where the distance without backlash is
larger than the one written, by no more than the rounding of these digits explains, it is the one meant. A
distance that is larger than that without backlash is taken as it is written, however near: it has a backlash.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.geometry.drive import SIDES, Drive
from tribodyn.geometry.families import FAMILIES
from tribodyn.geometry.families.involute import overlap, shift_sensitivity, tight_centre_distance
from tribodyn.scenario.printed import shift_rounding
from tribodyn.scenario.tables.model_files import DriveTable

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
    """How the centre distance is rounded; None where none is written, and where it is meant as written.

    Parameters
    ----------
    drive : its numbers, whatever their centre distance
    """
    if table.centre_distance is None or not FAMILIES[table.family].involute:
        return None
    printed, rounding = table.centre_distance
    with np.errstate(all="ignore"):  # where there is no such mesh: refused where the pair is put together
        if not overlap(drive._replace(centre_distance=printed)):
            return None
        meant, slope = float(tight_centre_distance(drive)), float(shift_sensitivity(drive))
    for side in SIDES:
        gear = getattr(table, side)
        if gear.span is None and gear.over_pins is None:  # measured teeth have their thickness at any shift
            rounding += slope * shift_rounding(gear.profile_shift)
    rounding = min(rounding, MOST * drive.module)
    return RoundedDistance(printed, rounding, meant) if meant <= printed + rounding else None
