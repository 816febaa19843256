"""The simulated pressure where ISO 6336-2 rates a flank, as a stress that σ_Hlim may be compared with.

The standard rates a nominal stress: Hertz at the pitch point, raised to the inner point of single pair
contact (B of the pinion, D of the gear), and lowered by Z_ε. σ_Hlim is such a stress of test gears, whose
real flanks were pressed harder elsewhere too, in tips' corners and at the ends of their path. So the
simulation counts by how its pressure at these points is to that of the standard there.
"""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import overlap_ratio
from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.pitting import contact_ratio_factor
from tribodyn.studies.assessment.results.margins import point_angles


class NominalLoad(NamedTuple):
    """What the standard takes of the path of contact, and of the load at the points where it rates it."""

    pitch: float  # roll angle of the pitch point, rad, within the path of contact
    inner: tuple[float, float]  # roll angles of B for the pinion and D for the gear, rad
    overlap: float  # ε_β, at most 1: from there on the pitch point counts alone
    carried: float  # X: share of the whole load per face width that presses at these points
    contact_ratio_factor: float  # Z_ε

    @property
    def credit(self) -> float:
        """Nominal stress of the standard over the Hertz pressure of the same load at the same point."""
        return self.contact_ratio_factor / math.sqrt(self.carried)


class RatedFlank(NamedTuple):
    """The pressure where the standard rates the flank of a gear, Pa."""

    pressure: Float[Array, " cycle"]  # at the place with the largest
    along_face: float  # largest over mean of all slices, the mean of line loads
    carried: float  # share of the whole load per face width there, NaN where loads are not given

    @property
    def largest(self) -> float:
        """Of all cycles."""
        return float(np.max(self.pressure))


def nominal_load(assembly: Assembly) -> NominalLoad:
    """What ISO 6336-2 takes for a pair; other families than the involute count as they are pressed."""
    start, end = map(float, assembly.roll_limits)
    angles = point_angles(assembly)
    single = sorted((float(angles[2]), float(angles[4])))
    # the whole load presses where one pair touches alone: a pitch point beside counts at the nearest place
    pitch = min(max(min(max(0.0, single[0]), single[1]), start), end)
    inner = min(max(float(angles[2]), start), pitch), max(min(float(angles[4]), end), pitch)
    teeth = assembly.drive.pinion.teeth, assembly.drive.gear.teeth
    # an internal gear is rated at the pitch point
    reach = [point if float(z) > 0.0 else pitch for point, z in zip(inner, teeth, strict=True)]
    ratio, overlap = float(assembly.contact_ratio), min(float(overlap_ratio(assembly)), 1.0)
    spur = 1.0 / max(math.floor(ratio), 1)
    carried = spur * (1.0 - overlap) + overlap / ratio
    factor = contact_ratio_factor(ratio, overlap) if assembly.family.involute else math.sqrt(carried)
    return NominalLoad(pitch, (reach[0], reach[1]), overlap, carried, factor)


def rated_flanks(
    roll: Float[Array, "position pair slice"],
    pressure: Float[Array, "cycle position pair slice"],
    nominal: NominalLoad,
    carried: Float[Array, "position pair"] | None = None,
) -> tuple[RatedFlank, RatedFlank]:
    """Pressures of pinion and gear where the standard rates them.

    `roll` are the angles of the slices from the pitch point in a mesh cycle, rad, the pair that entered first
    in front; `carried` is the share of the whole load per face width that a pair carries.
    """
    shares = np.full(roll.shape[:2], np.nan) if carried is None else carried
    wide = np.broadcast_to(shares[None, :, :, None], (1, *roll.shape))
    ways = _way(roll[None])[0], _way(pressure), _way(wide)[0]
    at_pitch = _largest(*ways, (nominal.pitch, nominal.pitch))
    flanks = []
    for inner in nominal.inner:
        widest = _largest(*ways, (min(inner, nominal.pitch), max(inner, nominal.pitch)))
        part = (1.0 - nominal.overlap) * (widest.pressure - at_pitch.pressure)
        flanks.append(
            widest._replace(pressure=at_pitch.pressure + part) if nominal.overlap < 1.0 else at_pitch
        )
    return flanks[0], flanks[1]


def _way(values: Float[Array, "cycle position pair slice"]) -> Float[Array, "cycle place slice"]:
    """Values along the way of one pair, which is younger in the places behind."""
    moved = np.moveaxis(values, 2, 1)[:, ::-1]
    return moved.reshape(len(values), -1, values.shape[-1])


def _largest(
    roll: Float[Array, "place slice"],
    pressure: Float[Array, "cycle place slice"],
    carried: Float[Array, "place slice"],
    stretch: tuple[float, float],
) -> RatedFlank:
    """The largest pressure of a stretch of the path, its ends by interpolation."""
    columns = []
    for part in range(roll.shape[1]):
        pair_roll = roll[:, part]
        places = np.unique([*stretch, *pair_roll[(pair_roll > stretch[0]) & (pair_roll < stretch[1])]])
        pressed = np.array([np.interp(places, pair_roll, cycle[:, part]) for cycle in pressure])
        top = int(np.argmax(np.max(pressed, axis=0)))
        columns.append((pressed[:, top], float(np.interp(places[top], pair_roll, carried[:, part]))))
    highest = np.array([np.max(pressed) for pressed, _ in columns])
    pressed, share = columns[int(np.argmax(highest))]
    even = math.sqrt(float(np.mean(highest**2)))
    return RatedFlank(pressed, float(np.max(highest)) / even if even > 0.0 else 1.0, share)
