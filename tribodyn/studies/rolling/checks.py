"""Can such a gear be made: room for the elements, profiles without cusps, a torque at every instant."""

import math

import numpy as np

from tribodyn.errors import InputError
from tribodyn.studies.rolling.geometry import RollingDrive, centre_path_curvature

#: With two elements both stand at their dead points at the same time and no torque can be carried.
MINIMUM_ELEMENTS = 3
#: Angles at which the curvature is looked at; the limits are smooth and wide, the grid errs by 1e-7 of them.
_ANGLES = 4001


def element_radius_limits(drive: RollingDrive) -> dict[str, float]:
    """Radii, m, that an element must stay below, by what happens at them."""
    cam, crown = centre_path_curvature(drive, np.linspace(0.0, np.pi, _ANGLES))
    half_chord = drive.displacement * drive.pitch_radius * math.sin(math.pi / drive.elements)
    return {
        "neighbouring elements overlap": half_chord,
        "the protrusions of the cam are undercut": float(1.0 / cam.max()),
        "the protrusions of the crown are undercut": float(-1.0 / crown.min()),
    }


def check(drive: RollingDrive) -> None:
    """Refuse a gear that cannot be made or cannot carry a torque.

    Raises
    ------
    InputError
        With a key below ``drive`` and a remedy.
    """
    if drive.elements < MINIMUM_ELEMENTS:
        raise InputError(
            "drive.elements",
            drive.elements,
            "too few: all of them stand at dead points at the same time and carry no torque",
            f"use {MINIMUM_ELEMENTS} or more",
        )
    if drive.displacement <= 1.0:
        raise InputError(
            "drive.displacement",
            drive.displacement,
            "the elements' centres lie on or inside the pitch circle, and the profiles have cusps or loops",
            "use more than 1, such as 1.4",
        )
    limits = element_radius_limits(drive)
    smallest = min(limits.values())
    if drive.element_radius >= smallest:
        broken = ", ".join(
            f"{what} (from {_millimetres(limit)})"
            for what, limit in limits.items()
            if drive.element_radius >= limit
        )
        raise InputError(
            "drive.element_radius",
            f"{drive.element_radius * 1e3:g} mm",
            broken,
            f"use less than {_millimetres(smallest)}, fewer elements or a larger pitch_radius",
        )


def _millimetres(length: float) -> str:
    """Write a limit rounded down, so that what it says may be used."""
    if length <= 0.0:
        return "0 mm"
    digits = 3 - math.floor(math.log10(length * 1e3))
    scale = 10.0**digits
    return f"{math.floor(length * 1e3 * scale) / scale:g} mm"
