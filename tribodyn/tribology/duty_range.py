"""Loads, speeds and radii that the contacts of a mesh meet, for laws that are tabulated before a run."""

from typing import NamedTuple

from tribodyn.errors import InputError


class DutyRange(NamedTuple):
    """Least and greatest of each, as `LocalContact` has them; SI.

    Attributes
    ----------
    line_load : N/m
    entrainment : m/s
    curvature : 1/m
    slide_to_roll : |v_s|/u
    places : entrainment at nominal speed, curvature and slide-to-roll ratio at places along the path of
        contact, where they belong together; none: they vary each for itself
    """

    line_load: tuple[float, float]
    entrainment: tuple[float, float]
    curvature: tuple[float, float]
    slide_to_roll: tuple[float, float]
    places: tuple[tuple[float, float, float], ...] = ()


def without_duty() -> DutyRange:
    """Stand for the duty where there is no mesh: raise InputError."""
    raise InputError(
        "film.law", '"solved"', "is tabulated over the duty of a mesh, and there is none", "use another law"
    )
