"""What a tooth has of its own over the roll of a pair and the face: missing material, compliance, friction.

A tooth has two flanks: the *leading* one, which drives another gear as this one turns nominally, and the
*trailing* one, which is driven. A planet between sun and ring is touched on both. Teeth are numbered from 0
in the order in which they come into contact; in scenarios and on pages from 1.
"""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.geometry.drive import Side
from tribodyn.numerics.shapes import Array, Float

#: Flanks of a tooth.
LEADING, TRAILING = range(2)
#: Flank with which either gear of a pair carries: the pinion drives.
CARRYING: dict[Side, int] = {"pinion": LEADING, "gear": TRAILING}


class FlankPlaces(NamedTuple):
    """Where the flank of one gear is touched in a mesh: nodes over a pair's roll, slices over the face."""

    roll: Float[Array, " node"]  # of the mesh's driver from the pitch point, rad
    distance: Float[Array, " node"]  # signed distance r of the contact from the pitch point, m
    radius: Float[Array, " node"]  # of the contact from this gear's axis, m; < 0 of an internal gear
    pressure_angle: Float[Array, " node"]  # rad
    lean: Float[Array, " node"]  # cosine of the normal's angle out of the transverse plane
    face: Float[Array, " slice"]  # middles of the slices, m from the middle of the face
    #: direction of the axis of tooth 0 while it is touched there, from the line of centres to the mate in the
    #: gear's own sense of rotation, rad; that of tooth n is 2πn/z behind
    turned: Float[Array, "slice node"]


class ToothFields(NamedTuple):
    """What a flank of one tooth has of its own at `FlankPlaces`."""

    gap: Float[Array, "slice node"]  # material missing along the flank's normal, m
    #: compliance added along the normal, as if the whole face were as the slice is, m/N
    compliance: Float[Array, "slice node"]
    friction: Float[Array, "slice node"]  # factor on the friction coefficient

    def beside(self, other: "ToothFields") -> "ToothFields":
        """What both together make of a tooth."""
        return ToothFields(
            self.gap + other.gap, self.compliance + other.compliance, self.friction * other.friction
        )


def sound(places: FlankPlaces) -> ToothFields:
    """A tooth as it was drawn."""
    shape = len(places.face), len(places.roll)
    return ToothFields(np.zeros(shape), np.zeros(shape), np.ones(shape))


class OwnFields(Protocol):
    """What teeth of a gear have of their own: deviations, a kind of damage, wear."""

    @property
    def of_gap_alone(self) -> bool:
        """Whether nothing but material is missing: compliance and friction are those of the drawn tooth."""
        ...

    @property
    def early(self) -> float:
        """By how much a flank may stand out against that of the next tooth, m."""
        ...

    def fields(self, tooth: int, flank: int, places: FlankPlaces) -> ToothFields | None:
        """What a flank (`LEADING`, `TRAILING`) of a tooth has at the places; None: nothing."""
        ...


#: Of one gear.
OwnTeeth = Sequence[OwnFields]


def height_share(places: FlankPlaces) -> Float[Array, " node"]:
    """Place along the profile over the path's length: 0 at its end near the root, 1 at that near the tip."""
    low, high = int(np.argmin(places.radius)), int(np.argmax(places.radius))
    return (places.distance - places.distance[low]) / (places.distance[high] - places.distance[low])
