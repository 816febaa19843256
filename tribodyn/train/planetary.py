"""One planetary set: speeds, torques and powers of its members, phases of its meshes, and its assembly.

The ring has negative teeth, as internal gears have: the rolling speeds ω − ω_c of sun, planets and ring
against the carrier are then as of external gears, z_s (ω_s − ω_c) = −z_p (ω_p − ω_c) = z_r (ω_r − ω_c).
Rotations and torques are counter-clockwise.
"""

from collections.abc import Sequence
from fractions import Fraction
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


def willis(teeth: SetTeeth) -> dict[str, int]:
    """Factors by which the speeds of the members add up to nothing: Willis' equation.

    Torques without losses are in their proportion, for these speeds are all that do not change the power.
    """
    return {SUN: teeth.sun, RING: -teeth.ring, CARRIER: teeth.ring - teeth.sun}


def speeds(teeth: SetTeeth, held: str, driving: str) -> dict[str, Fraction]:
    """Speeds of sun, ring, carrier and planets over that of the driving member; one member is held."""
    factors = willis(teeth)
    (driven,) = (member for member in MEMBERS if member not in (held, driving))
    relative = {held: Fraction(0), driving: Fraction(1), driven: Fraction(-factors[driving], factors[driven])}
    rolling = -Fraction(teeth.sun, teeth.planet) * (relative[SUN] - relative[CARRIER])
    return {**{member: relative[member] for member in MEMBERS}, "planet": relative[CARRIER] + rolling}


def mesh_frequency(teeth: SetTeeth, turning: dict[str, float]) -> float:
    """Frequency of all meshes of a set, Hz, by the speeds of its members (rad/s)."""
    return teeth.sun * abs(turning[SUN] - turning[CARRIER]) / (2.0 * pi)


def torques(
    teeth: SetTeeth, held: str, driving: str, torque: float, basic_efficiency: float = 1.0
) -> dict[str, float]:
    """Torques from outside on the members where one bears a `torque` (N m) and another is held.

    `basic_efficiency` is that of the set whose carrier is held, 0 … 1. Of sun and ring the one by which power
    then enters gives its share of that power to the other; the carrier's bears both torques.
    """
    turning, factors = speeds(teeth, held, driving), willis(teeth)
    rolling = turning[SUN] - turning[CARRIER]
    enters = factors[SUN] * rolling * torque / factors[driving]  # at the sun, against the carrier
    share = basic_efficiency if enters > 0.0 else 1.0 / basic_efficiency
    relative = {SUN: float(factors[SUN]), RING: factors[RING] * share}
    relative[CARRIER] = -relative[SUN] - relative[RING]
    return {member: torque * relative[member] / relative[driving] for member in MEMBERS}


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
