"""Spalls and pits: material that has broken out of a flank, in a patch or over a measured map.

Loaded teeth approach by some micrometres, a spall is some tenths of a millimetre deep: its floor does not
touch, so that it is its outline that counts, and its depth where it reaches over the whole face.
"""

from dataclasses import dataclass

import numpy as np

from tribodyn.mesh.teeth.damage.gear import CLEAR, DamagedGear, strips
from tribodyn.mesh.teeth.damage.patch import Patch
from tribodyn.mesh.teeth.damage.touching import partly_touching
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields, height_share
from tribodyn.numerics.shapes import Array, Float


@dataclass(frozen=True)
class Spall:
    """A patch of missing material."""

    tooth: int
    flank: int
    patch: Patch
    depth: float  # m along the normal

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return min(self.depth, CLEAR)

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        if flank != self.flank:
            return None
        return partly_touching(gear, places, self.depth * self.patch.share(gear, places))


@dataclass(frozen=True)
class MissingMap:
    """Missing material as it was measured, over height and face; linear between the points.

    None beyond the points.
    """

    tooth: int
    flank: int
    height: Float[Array, " height"]  # share of the path of contact's length, increasing
    face: Float[Array, " face"]  # m from the middle of the face, increasing; a single one: even along it
    depth: Float[Array, "height face"]  # m along the normal

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return min(float(np.max(self.depth)), CLEAR)

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        if flank != self.flank:
            return None
        up = height_share(places)
        by_height = np.stack(
            [np.interp(up, self.height, column, left=0.0, right=0.0) for column in self.depth.T]
        )  # (face, node)
        at = strips(gear, places)
        if len(self.face) == 1:
            return partly_touching(gear, places, np.broadcast_to(by_height[0], (*at.shape, len(up))))
        missing = [
            np.interp(at.ravel(), self.face, node, left=0.0, right=0.0).reshape(at.shape)
            for node in by_height.T
        ]
        return partly_touching(gear, places, np.stack(missing, axis=-1))
