"""A patch of a flank: a rectangle or an ellipse over profile and face, with a soft edge."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from tribodyn.compliance.energy import hertz_linear, tooth_compliance, under_uneven_load
from tribodyn.mesh.slices.held import BODIES_LENGTH, TEETH_LENGTH, spread
from tribodyn.mesh.teeth.damage.gear import CLEAR, DamagedGear, arc, strips
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields, height_share, sound
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


# Flanks of which a part of the face is missing.
#
# A slice's strips are told apart: where all of them lack material, the flank touches later by the least of
# it. Where some lie deeper, the others carry alone, and the pair is softer: by what teeth and bodies deflect
# more under a load on a part of the face (`coupled_slices`), and by the contact's own share.


#: Part of its width that a strip carries with, at least; it makes a strip that does not touch soft.
_LEAST = 1e-6
_WAVES = 3  # of the face, per strip


def partly_touching(
    gear: DamagedGear, places: FlankPlaces, missing: Float[Array, "slice strip node"]
) -> ToothFields:
    """Fields of a flank with so much material missing (m) in every strip of its slices.

    What a spall over a part of the face adds is 0.7 to 0.85 of that by finite elements whose slices hold each
    other (`test_touching`): here the contact is linear. Of a face in several slices, one that is damaged in
    part has its contact's share alone.
    """
    gap = missing.min(axis=1)
    carries = np.clip(1.0 - smooth((missing - gap[:, None]) / CLEAR), _LEAST, 1.0)  # (slice, strip, node)
    contact = float(hertz_linear(*gear.materials, gear.width))
    if len(gap) > 1:
        return ToothFields(gap, contact * (1.0 / carries.mean(axis=1) - 1.0), np.ones_like(gap))
    added = np.zeros_like(gap)
    damaged = np.flatnonzero(carries[0].min(axis=0) < 1.0)
    if damaged.size:
        r = places.distance[damaged]
        parts = [
            tooth_compliance(under_uneven_load(tooth), material, gear.width, r, "ring")
            for tooth, material in zip(gear.teeth, gear.materials, strict=True)
        ]
        bodies = parts[0].foundation + parts[1].foundation
        teeth = parts[0].total + parts[1].total - bodies
        added[0, damaged] = softer(gear, teeth, bodies, contact, carries[0][:, damaged])
    return ToothFields(gap, added, np.ones_like(gap))


def softer(
    gear: DamagedGear,
    teeth: Float[Array, " node"],
    bodies: Float[Array, " node"],
    contact: float,
    carries: Float[Array, "strip node"],
) -> Float[Array, " node"]:
    """Compliance (m/N) that a pair gains where its strips carry with these parts of their width.

    `teeth`, `bodies` and `contact` are the parts of its compliance, m/N.
    """
    count = len(carries)
    middle = ((np.arange(count) + 0.5) / count)[None]
    wave = np.pi * np.arange(_WAVES * count) / gear.width * gear.module
    falling = 1.0 / (1.0 + (TEETH_LENGTH * wave) ** 2), 1.0 / (1.0 + BODIES_LENGTH * wave)
    of_teeth, of_bodies = (along[0] for along in spread(middle, np.ones_like(middle), falling, count))
    held = teeth[:, None, None] * of_teeth + bodies[:, None, None] * of_bodies
    matrix = count * held + contact * count * np.eye(count) / carries.T[:, :, None]
    loads = np.linalg.solve(matrix, np.ones((len(teeth), count, 1)))[..., 0]
    return 1.0 / loads.sum(axis=1) - (teeth + bodies + contact)


# Spalls and pits: material that has broken out of a flank, in a patch or over a measured map.
#
# Loaded teeth approach by some micrometres, a spall is some tenths of a millimetre deep: its floor does not
# touch, so that it is its outline that counts, and its depth where it reaches over the whole face.


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


@dataclass(frozen=True)
class BrokenTip:
    """Break across a tooth; contact ends there, over a part of the face.

    Beyond the break the gap grows like a slope of 45 degrees, which begins within `edge`.
    """

    tooth: int
    #: height, radius: of the break, as of `patch.Patch`
    height: float | None
    radius: float | None
    face: float  # middle of the broken part, m from the middle of the face
    width: float  # of the broken part, m; infinite: the whole face
    edge: float  # m

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return CLEAR

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        up = arc(gear, places)
        beyond = np.maximum(up - middle_of(self.height, self.radius, up, places), 0.0)
        gap = np.where(beyond < self.edge, beyond**2 / (2.0 * self.edge), beyond - self.edge / 2.0)
        across = np.abs(strips(gear, places) - self.face)[..., None]
        return partly_touching(gear, places, gap * smooth((self.width / 2.0 - across) / self.edge))


@dataclass(frozen=True)
class Scuffing:
    """A patch in which friction is so many times that of the sound flank; a slice has its mean."""

    tooth: int
    flank: int
    patch: Patch
    factor: float

    @property
    def early(self) -> float:
        """See `gear.Damage`."""
        return 0.0

    def on_flank(self, gear: DamagedGear, flank: int, places: FlankPlaces) -> ToothFields | None:
        """See `gear.Damage`."""
        if flank != self.flank:
            return None
        scuffed = self.patch.share(gear, places).mean(axis=1)
        return sound(places)._replace(friction=1.0 + (self.factor - 1.0) * scuffed)
