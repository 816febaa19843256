"""One planetary set: its teeth, its assembly, and what its meshes excite."""

from collections.abc import Iterator, Sequence
from math import gcd, pi
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float

SUN, RING, CARRIER, SECOND_SUN = "sun", "ring", "carrier", "second_sun"
MEMBERS = (SUN, RING, CARRIER)
#: What meshes of planets with each other are called.
PLANETS = "planets"
#: Sorts of sets: every planet has one gear; two that turn together; two planets that mesh with each other, on
#: pins of their own; such ones, and a second sun that meshes with the second ones.
SETS = SIMPLE, STEPPED, MESHED, RAVIGNEAUX = ("planetary", "stepped", "meshed", "ravigneaux")
#: Those whose second planets have pins of their own.
IN_PAIRS = (MESHED, RAVIGNEAUX)
#: Pitches by which planets may stand beside their gaps: angles are given with few decimals.
ASSEMBLY_TOLERANCE = 0.01


class SetTeeth(NamedTuple):
    """Numbers of teeth."""

    sun: int
    planet: int
    ring: int  # < 0
    second_planet: int = 0  # between the first ones and the ring; 0: none
    kind: str = SIMPLE  # one of `SETS`
    second_sun: int = 0  # 0: none

    def loops(self) -> Iterator["Loop"]:
        """The loops of teeth that close over every planet, each from a sun to the ring."""
        if self.second_sun:
            yield Loop(self.second_sun - self.ring, 1.0, f"({self.second_sun} + {-self.ring})")
        if self.kind in IN_PAIRS:
            yield Loop(-self.ring - self.sun, 1.0, f"({-self.ring} − {self.sun})")
        elif self.kind == STEPPED:
            step = gcd(self.planet, self.second_planet)
            whole = (self.sun * self.second_planet - self.ring * self.planet) // step
            sums = f"({self.sun} · {self.second_planet} + {-self.ring} · {self.planet})"
            sums += f"/{step}" if step > 1 else ""
            yield Loop(whole, step / self.planet, sums)
        else:
            yield Loop(self.sun - self.ring, 1.0, f"({self.sun} + {-self.ring})")


class Loop(NamedTuple):
    """A planet turned by an angle about the set's axis closes it where `whole` times this is whole turns."""

    whole: int
    pitches: float  # by which its last teeth miss where the product is one turn off
    sums: str  # the whole number as the numbers of teeth make it


def check_assembly(teeth: SetTeeth, angles: Sequence[float], key: str) -> None:
    """Raise InputError where planets at these angles (rad) do not fit between the teeth of sun and ring."""
    turns = (np.asarray(angles, dtype=float) - angles[0]) / (2.0 * pi)
    for loop in teeth.loops():
        missed = _missed(loop, turns)
        apart = np.flatnonzero(missed > ASSEMBLY_TOLERANCE)
        if not len(apart):
            continue
        first = int(apart[0])
        whole = gcd(*(each.whole for each in teeth.loops()))
        near = np.degrees(angles[0] + 2.0 * pi * np.round(whole * turns[first]) / whole) % 360.0
        rule = (
            f"planet {first + 1} stands {missed[first]:.3g} pitches beside the gaps of sun and ring: "
            f"{loop.sums} times its angle from the first one is no whole number of turns"
        )
        remedy = f"stand it at {near:.6g} deg"
        if others := nearest_teeth(teeth, angles):
            named = " or ".join(f"{sun} and {-ring}" for sun, ring in others)
            remedy += f", or give sun and ring {named} teeth"
        raise InputError(key, f"{np.degrees(angles[first]):.6g} deg", rule, remedy)


def _missed(loop: Loop, turns: Float[Array, " planet"]) -> Float[Array, " planet"]:
    """Pitches by which the teeth of planets miss that are so many turns from the first one."""
    places = loop.whole * turns
    return loop.pitches * np.abs(places - np.round(places))


def nearest_teeth(teeth: SetTeeth, angles: Sequence[float], most: int = 12) -> list[tuple[int, int]]:
    """Teeth of sun and ring (< 0) with which planets fit at these angles, of the fewest teeth more or less.

    Nothing where more than `most` would have to change.
    """
    turns = (np.asarray(angles, dtype=float) - angles[0]) / (2.0 * pi)

    def fits(sun: int, ring: int) -> bool:
        loops = teeth._replace(sun=sun, ring=ring).loops()
        return all(np.all(_missed(loop, turns) <= ASSEMBLY_TOLERANCE) for loop in loops)

    for change in range(most + 1):
        steps = {(0, change), (0, -change), (change, 0), (-change, 0)}
        tried = sorted((teeth.sun + sun, teeth.ring + ring) for sun, ring in steps)
        if fitting := [(sun, ring) for sun, ring in tried if sun > 0 > ring and fits(sun, ring)]:
            return fitting
    return []
