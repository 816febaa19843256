"""Tooth families: which path two gears work on, and which path generates each; one per file, listed here."""

from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.geometry.drive import Drive, Side
from tribodyn.geometry.path import Path, seen_from
from tribodyn.numerics.parameter import Parameter
from tribodyn.numerics.registry import Registry


class Family(NamedTuple):
    """What distinguishes one tooth form from another; everything else follows from the paths.

    Parameters
    ----------
    name : name of the family, as a drive file gives it
    working_path : drive -> the path of contact of the pair
    generating_path : (drive, side) -> (path, shift): the path of contact of that body with its rack, seen
        from the body (the body is the path's pinion and rolls on the circle of `path.pinion_pitch_radius`),
        and the distance x m (m) by which the rack is shifted away from the axis
    shiftable : whether a gear of this family can be profile-shifted
    check : drive -> None; raises InputError for numbers that this family in particular cannot use
    shape : callable, optional
        Makes a drive's `shape` from the values of `parameters`, by name: a NamedTuple of numbers or arrays.
    parameters : what `shape` holds: the keys of the drive's table ``[shape]``
    pressure_angle : whether a drive gives its pressure angle; where not, it is 0 at the pitch point
    corner : whether α(r) has a corner at the pitch point; the mesh cycle then begins a segment there
    cutter_path : callable, optional
        (drive, side) -> the path of contact of a body with its pinion-type cutter, seen from the body, where
        it is another than that with its rack; both rolling circles have their teeth's ratio.
    involute : whether flanks are involutes, for which the formulas of ISO 6336 and of loss factors hold
    about : what it is, in a line
    """

    name: str
    working_path: Callable[[Drive], Path]
    generating_path: Callable[[Drive, Side], tuple[Path, Any]]
    shiftable: bool
    check: Callable[[Drive], None]
    shape: Callable[..., Any] | None = None
    parameters: tuple[Parameter, ...] = ()
    pressure_angle: bool = True
    corner: bool = False
    cutter_path: Callable[[Drive, Side], Path] | None = None
    involute: bool = False
    about: str = ""


def unshifted(working_path: Callable[[Drive], Path]) -> Callable[[Drive, Side], tuple[Path, Any]]:
    """Generating path of a family whose rack and mate share the one path of contact.

    The rack of such a family cannot be shifted; its path is the working one, seen from the body.
    """

    def generating_path(drive: Drive, side: Side) -> tuple[Path, Any]:
        return seen_from(working_path(drive), side), 0.0 * drive.module

    return generating_path


FAMILIES: Registry[Family] = Registry(
    "drive.family",
    "family of paths of contact",
    {
        "involute": "tribodyn.geometry.families.involute:FAMILY",
        "crc": "tribodyn.geometry.families.crc:FAMILY",
        "cycloidal": "tribodyn.geometry.families.cycloidal:FAMILY",
        "parabolic": "tribodyn.geometry.families.parabolic:FAMILY",
        "s-gear": "tribodyn.geometry.families.s_gear:FAMILY",
        "points": "tribodyn.geometry.families.points:FAMILY",
        "spline": "tribodyn.geometry.families.spline:FAMILY",
        "circular-arc": "tribodyn.geometry.families.circular_arc:FAMILY",
    },
    "tribodyn.families",
    Family,
)


def family(name: str) -> Family:
    """Return the family of paths of contact of that name; InputError where there is none."""
    return FAMILIES[name]
