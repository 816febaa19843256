"""What gears take that several studies compute: finite elements, and slices pressed together."""

import math

from tribodyn.geometry.drive import Drive

#: Pairs that can touch at once, corners included, as the load contact model has them.
TOUCHING = 3
#: Seconds: finite elements of both gears with free ends; a position of the load contact model, and what is
#: added for every pair of places in contact.
FINITE_ELEMENTS, A_POSITION, A_PLACE = 20.0, 4e-5, 1.8e-6
#: Bytes of the outlines in a record.
OUTLINES = 0.15 * 2.0**20
#: Bytes of the model; entries of the systems that are solved at a time, and bytes that one takes meanwhile.
MODEL, ENTRIES, AN_ENTRY = 25 * 2.0**20, 2e6, 60.0


def pressed_seconds(positions: float, slices: float) -> float:
    """Seconds in which loads are shared at some positions."""
    return positions * (A_POSITION + A_PLACE * (TOUCHING * slices) ** 2)


def pressed_memory(positions: float, slices: float) -> float:
    """Bytes that sharing loads takes at once."""
    places = (TOUCHING * slices) ** 2
    return MODEL + AN_ENTRY * min(positions * places, max(ENTRIES, places))


def stiffest(drive: Drive, stiffness: float, density: float, bearings: tuple[float, float]) -> float:
    """About the largest angular frequency of a gear pair, rad/s: of its mesh, or of a gear on its bearing.

    Parameters
    ----------
    drive : Drive
    stiffness : float
        Of the mesh, N/m.
    density : float
        Of the gears, kg/m³.
    bearings : (float, float)
        Stiffness of the pinion's and the gear's, N/m.
    """
    masses = [
        density * math.pi * ((drive.module * one.teeth / 2) ** 2 - one.bore_radius**2) * one.face_width
        for one in (drive.pinion, drive.gear)
    ]
    light = [max(mass, 1e-9) for mass in masses]
    mesh = stiffness * (2.0 / light[0] + 2.0 / light[1])
    return math.sqrt(max(mesh, *(k / m for k, m in zip(bearings, light, strict=True))))
