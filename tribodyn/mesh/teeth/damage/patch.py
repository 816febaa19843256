"""A patch of a flank: a rectangle or an ellipse over profile and face, with a soft edge."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tribodyn.mesh.teeth.damage.gear import DamagedGear, arc, strips
from tribodyn.mesh.teeth.fields import FlankPlaces, height_share
from tribodyn.numerics.shapes import Array, Float

PatchShape = Literal["rectangle", "ellipse"]


@dataclass(frozen=True)
class Patch:
    """Where a patch is; its sides lie along the face and along the profile."""

    #: height, radius: of its middle, as a share of the path of contact's length, 0 at the root's end, or in m
    height: float | None
    radius: float | None
    length: float  # along the profile, m
    face: float  # of its middle, m from the middle of the face
    width: float  # along the face, m; infinite: the whole face
    edge: float  # width over which it begins, inside its outline, m
    shape: PatchShape = "rectangle"

    def share(self, gear: DamagedGear, places: FlankPlaces) -> Float[Array, "slice strip node"]:
        """1 in the patch, 0 outside, C¹ at its edge."""
        up = arc(gear, places)
        along = np.abs(up - middle_of(self.height, self.radius, up, places))
        across = np.abs(strips(gear, places) - self.face)[..., None]
        if self.shape == "ellipse":
            half = min(self.length, self.width) / 2.0
            inside = half * (1.0 - np.hypot(2.0 * along / self.length, 2.0 * across / self.width))
            return smooth(inside / self.edge)
        return smooth((self.length / 2.0 - along) / self.edge) * smooth(
            (self.width / 2.0 - across) / self.edge
        )


def middle_of(
    height: float | None, radius: float | None, up: Float[Array, " node"], places: FlankPlaces
) -> float:
    """Place along the profile (m) at a share of the path of contact's length, or at a radius (m)."""
    place, at = (height, height_share(places)) if radius is None else (radius, np.abs(places.radius))
    order = np.argsort(at)
    return float(np.interp(place or 0.0, at[order], up[order]))


def smooth(x: Float[Array, "..."]) -> Float[Array, "..."]:
    """Rise from 0 to 1 over 0 … 1, C¹ and level outside."""
    within = np.clip(x, 0.0, 1.0)
    return within**2 * (3.0 - 2.0 * within)
