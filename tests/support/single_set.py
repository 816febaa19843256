"""Speeds, torques and mesh frequency of one planetary set in closed form, a member held: Willis' equation.

The ring has negative teeth, as internal gears have: the rolling speeds ω − ω_c of sun, planets and ring
against the carrier are then as of external gears, z_s (ω_s − ω_c) = −z_p (ω_p − ω_c) = z_r (ω_r − ω_c).
Rotations and torques are counter-clockwise.
"""

from fractions import Fraction
from math import pi

from tribodyn.train.planetary import CARRIER, MEMBERS, RING, SUN, SetTeeth


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


def excited(teeth: SetTeeth, planets: int, harmonic: int) -> tuple[str, ...]:
    """Kinds of modes that a harmonic of the mesh excites in a set of equally spaced planets.

    By k = h z_s mod N (Kahraman 1994; Parker 2000): the forces of the planets on a central member add up to a
    torque where k = 0, to a force where k = 1 or N − 1, and otherwise cancel.
    """
    k = harmonic * teeth.sun % planets
    if k == 0:
        return ("rotational",)
    return ("translational",) if k in (1, planets - 1) else ("planet",)
