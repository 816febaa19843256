"""Shape and limits of the cycloid gear with intermediate rolling elements and a free cage.

The shaft turns an eccentric; on it runs the cam (Z2 − 1 teeth); Z2 rolling elements in a free cage lie
between the cam and the fixed crown (Z2 + 1 inner teeth). The pitch circles of cam, cage and crown have radii
r2 (Z2 − 1)/Z2, r2 and r2 (Z2 + 1)/Z2 and touch in one point, the pitch point P, so that their centres lie
r2/Z2 apart on the line through P.

Frame: turns with the eccentric; origin on the shaft's axis, which is the crown's; x through P. An element
stands at the angle φ about the cage's centre from the x axis, counter-clockwise as the shaft turns: φ = 0 in
a depression of the cam, φ = π on a protrusion. The common normals of all contacts pass through P.

Source: E. A. Efremenkov et al., Mathematics 12:873 (2024), equations (7) to (13). Lengths in m, angles in
rad.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tribodyn.errors import InputError

Array = NDArray[np.floating]

#: With two elements both stand at their dead points at the same time and no torque can be carried.
MINIMUM_ELEMENTS = 3
#: Angles at which the curvature is looked at; the limits are smooth and wide, the grid errs by 1e-7 of them.
_ANGLES = 4001


class RollingDrive(NamedTuple):
    """A gear with intermediate rolling elements."""

    pitch_radius: float  # r2, radius of the cage's pitch circle ("generating circle"), m
    elements: int  # Z2, number of rolling elements
    displacement: float  # χ, radius of the circle of the elements' centres over `pitch_radius`; above 1
    element_radius: float  # r_b, m

    @property
    def centre_distance(self) -> float:
        """Distance of the cage's centre from the crown's and from the cam's, r2/Z2, m."""
        return self.pitch_radius / self.elements

    @property
    def eccentricity(self) -> float:
        """Distance of the cam's centre from the shaft's axis, 2 r2/Z2, m."""
        return 2.0 * self.centre_distance

    @property
    def cam_pitch_radius(self) -> float:
        """Radius of the cam's pitch circle, m."""
        return self.pitch_radius - self.centre_distance

    @property
    def crown_pitch_radius(self) -> float:
        """Radius of the crown's pitch circle, m: also the distance of P from the shaft's axis."""
        return self.pitch_radius + self.centre_distance

    @property
    def ratio(self) -> float:
        """Speed of the input over that of the cam, which turns the other way: (Z2 − 1)/2, from (13)."""
        return (self.elements - 1) / 2.0

    @property
    def element_pitch(self) -> float:
        """Angle between neighbouring elements, rad."""
        return 2.0 * np.pi / self.elements


def pitch_point_distance(drive: RollingDrive, angle: ArrayLike) -> Array:
    """L, distance of an element's centre from the pitch point, m, of the shape of `angle`: (7)."""
    chi = drive.displacement
    return drive.pitch_radius * np.sqrt(1.0 + chi**2 - 2.0 * chi * np.cos(angle))


def lever_arm(drive: RollingDrive, angle: ArrayLike) -> Array:
    """a, distance of the contacts' common normal from the cage's centre, m; positive for 0 < φ < π.

    The arm about the cam's centre is a (Z2 − 1)/Z2, that about the crown's a (Z2 + 1)/Z2.
    """
    across = drive.displacement * drive.pitch_radius**2 * np.sin(angle)
    return across / pitch_point_distance(drive, angle)


def normal_direction(drive: RollingDrive, angle: ArrayLike) -> Array:
    """Unit vectors (…, 2) from the pitch point to the elements' centres."""
    angle = np.asarray(angle, dtype=float)
    along = np.stack([drive.displacement * np.cos(angle) - 1.0, drive.displacement * np.sin(angle)], axis=-1)
    return along * (drive.pitch_radius / pitch_point_distance(drive, angle))[..., None]


def element_centres(drive: RollingDrive, angle: ArrayLike) -> Array:
    """Centres (…, 2) of the elements, m."""
    angle = np.asarray(angle, dtype=float)
    radius = drive.displacement * drive.pitch_radius
    around = radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return around + np.array([drive.centre_distance, 0.0])


def contact_points(drive: RollingDrive, angle: ArrayLike) -> tuple[Array, Array]:
    """Contacts A with the cam and B with the crown, each (…, 2), m."""
    reach = drive.element_radius * normal_direction(drive, angle)
    centres = element_centres(drive, angle)
    return centres - reach, centres + reach


def centre_path_curvature(drive: RollingDrive, angle: ArrayLike) -> tuple[Array, Array]:
    """Curvatures of the path of an element's centre on the cam and on the crown, 1/m.

    Positive where the centre of curvature lies on the pitch point's side. From the rolling of the pitch
    circles on each other (Euler and Savary): κ = 1/L ∓ r2 (Z2 ∓ 1) cos θ / L² with θ the angle of the normal
    from the line of centres.
    """
    distance = pitch_point_distance(drive, angle)
    cosine = normal_direction(drive, angle)[..., 0]
    by_cam = (drive.elements - 1) * drive.pitch_radius * cosine / distance**2
    by_crown = (drive.elements + 1) * drive.pitch_radius * cosine / distance**2
    return 1.0 / distance - by_cam, 1.0 / distance + by_crown


def cam_outline(drive: RollingDrive, points: int = 60) -> Array:
    """Closed profile of the cam about its centre, (points · (Z2 − 1) + 1, 2), m, as it stands at φ_1 = 0."""
    return _outline(drive, drive.elements - 1, points)


def crown_outline(drive: RollingDrive, points: int = 60) -> Array:
    """Closed profile of the crown about its centre, (points · (Z2 + 1) + 1, 2), m; it does not move."""
    return _outline(drive, drive.elements + 1, points)


def _outline(drive: RollingDrive, teeth: int, points: int) -> Array:
    angle = np.linspace(0.0, 2.0 * np.pi * teeth, points * teeth + 1)
    on_cam, on_crown = contact_points(drive, angle)
    x, y = (on_cam - np.array([drive.eccentricity, 0.0]) if teeth < drive.elements else on_crown).T
    turn = -angle * drive.elements / teeth
    cosine, sine = np.cos(turn), np.sin(turn)
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def element_radius_limits(drive: RollingDrive) -> dict[str, float]:
    """Radii, m, that an element must stay below, by what happens at them."""
    cam, crown = centre_path_curvature(drive, np.linspace(0.0, np.pi, _ANGLES))
    half_chord = drive.displacement * drive.pitch_radius * math.sin(math.pi / drive.elements)
    return {
        "neighbouring elements overlap": half_chord,
        "the protrusions of the cam are undercut": float(1.0 / cam.max()),
        "the protrusions of the crown are undercut": float(-1.0 / crown.min()),
    }


def check_drive(drive: RollingDrive) -> None:
    """Refuse a gear that cannot be made or cannot carry a torque: InputError with a key below ``drive``."""
    if drive.elements < MINIMUM_ELEMENTS:
        rule = "too few: all of them stand at dead points at the same time and carry no torque"
        raise InputError("drive.elements", drive.elements, rule, f"use {MINIMUM_ELEMENTS} or more")
    if drive.displacement <= 1.0:
        rule = "the elements' centres lie on or inside the pitch circle, and the profiles have cusps or loops"
        raise InputError("drive.displacement", drive.displacement, rule, "use more than 1, such as 1.4")
    limits = element_radius_limits(drive)
    smallest = min(limits.values())
    if drive.element_radius >= smallest:
        broken = ", ".join(
            f"{what} (from {_millimetres(limit)})"
            for what, limit in limits.items()
            if drive.element_radius >= limit
        )
        remedy = f"use less than {_millimetres(smallest)}, fewer elements or a larger pitch_radius"
        raise InputError("drive.element_radius", f"{drive.element_radius * 1e3:g} mm", broken, remedy)


def _millimetres(length: float) -> str:
    """Write a limit rounded down, so that what it says may be used."""
    if length <= 0.0:
        return "0 mm"
    digits = 3 - math.floor(math.log10(length * 1e3))
    scale = 10.0**digits
    return f"{math.floor(length * 1e3 * scale) / scale:g} mm"
