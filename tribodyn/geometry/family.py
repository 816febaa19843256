"""A tooth family: which path two gears work on, and which path generates each of them."""

from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.geometry.drive import Drive, Side
from tribodyn.geometry.path import Path


class Family(NamedTuple):
    """What distinguishes one tooth form from another; everything else follows from the paths.

    Parameters
    ----------
    name : str
        Name of the family, as a drive file gives it.
    working_path : callable
        drive -> the path of contact of the pair.
    generating_path : callable
        (drive, side) -> (path, shift): the path of contact of that body with its rack, seen from the
        body (the body is the path's pinion and rolls on the circle of `path.pinion_pitch_radius`), and the
        distance x m (m) by which the rack is shifted away from the axis.
    shiftable : bool
        Whether a gear of this family can be profile-shifted.
    check : callable
        drive -> None; raises InputError for numbers that this family in particular cannot use.
    """

    name: str
    working_path: Callable[[Drive], Path]
    generating_path: Callable[[Drive, Side], tuple[Path, Any]]
    shiftable: bool
    check: Callable[[Drive], None]
