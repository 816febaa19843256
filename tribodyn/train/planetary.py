"""One planetary set: its teeth, its assembly, and what its meshes excite."""

from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError

SUN, RING, CARRIER = "sun", "ring", "carrier"
MEMBERS = (SUN, RING, CARRIER)
#: Pitches by which planets may stand beside their gaps: angles are given with few decimals.
ASSEMBLY_TOLERANCE = 0.01


class SetTeeth(NamedTuple):
    """Numbers of teeth."""

    sun: int
    planet: int
    ring: int  # < 0


def check_assembly(teeth: SetTeeth, angles: Sequence[float], key: str) -> None:
    """Raise InputError where planets at these angles (rad) do not fit between the teeth of sun and ring."""
    whole = teeth.sun - teeth.ring
    places = whole * (np.asarray(angles, dtype=float) - angles[0]) / (2.0 * pi)
    missed = np.abs(places - np.round(places))
    apart = np.flatnonzero(missed > ASSEMBLY_TOLERANCE)
    if not len(apart):
        return
    first = int(apart[0])
    near = np.degrees(angles[0] + 2.0 * pi * np.round(places[first]) / whole) % 360.0
    rule = (
        f"planet {first + 1} stands {missed[first]:.3g} pitches beside the gaps of sun and ring: "
        f"({teeth.sun} + {-teeth.ring}) times its angle from the first one is no whole number of turns"
    )
    remedy = f"stand it at {near:.6g} deg"
    if others := nearest_teeth(teeth, angles):
        named = " or ".join(f"{sun} and {-ring}" for sun, ring in others)
        remedy += f", or give sun and ring {named} teeth"
    raise InputError(key, f"{np.degrees(angles[first]):.6g} deg", rule, remedy)


def nearest_teeth(teeth: SetTeeth, angles: Sequence[float], most: int = 12) -> list[tuple[int, int]]:
    """Teeth of sun and ring (< 0) with which planets fit at these angles, of the fewest teeth more or less.

    Nothing where more than `most` would have to change.
    """
    turns = (np.asarray(angles, dtype=float) - angles[0]) / (2.0 * pi)

    def fits(sun: int, ring: int) -> bool:
        places = (sun - ring) * turns
        return bool(np.all(np.abs(places - np.round(places)) <= ASSEMBLY_TOLERANCE))

    for change in range(most + 1):
        steps = {(0, change), (0, -change), (change, 0), (-change, 0)}
        tried = sorted((teeth.sun + sun, teeth.ring + ring) for sun, ring in steps)
        if fitting := [(sun, ring) for sun, ring in tried if sun > 0 > ring and fits(sun, ring)]:
            return fitting
    return []


def excited(teeth: SetTeeth, planets: int, harmonic: int) -> tuple[str, ...]:
    """Kinds of modes that a harmonic of the mesh excites in a set of equally spaced planets.

    By k = h z_s mod N (Kahraman 1994; Parker 2000): the forces of the planets on a central member add up to a
    torque where k = 0, to a force where k = 1 or N − 1, and otherwise cancel.
    """
    k = harmonic * teeth.sun % planets
    if k == 0:
        return ("rotational",)
    return ("translational",) if k in (1, planets - 1) else ("planet",)
