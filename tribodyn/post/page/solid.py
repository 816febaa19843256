"""What turns in space on a page: shafts, gears and bearings, bent by so many times what they are."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from tribodyn.numerics.shapes import Array, Float
from tribodyn.post.page.data import packed
from tribodyn.post.page.motion import kept_frames

#: Numbers of all positions together, about.
_MOST_NUMBERS, _LEAST_FRAMES = 200_000, 400


class CarriedDisc(NamedTuple):
    """A gear, or another body that a shaft carries: a cylinder along z with straight-sided teeth."""

    name: str
    z: float  # of its middle, m
    width: float
    tip: float  # radius, m
    root: float
    bore: float
    teeth: int  # 0: none
    twist: float  # rotation of a tooth over the width, rad
    tooth: float  # direction of a tooth where the body's angle is 0, rad
    centre: tuple[float, float]  # without load, m
    fill: str  # colour of the page: pinion, gear or ring
    pose: Float[Array, "time 6"]  # displacement in x, y, z, tilts about x, y, rotation


class Solid(NamedTuple):
    """Shafts along z with what they carry; m and N."""

    station: Float[Array, "station 4"]  # number of the shaft, x, y, z, shaft by shaft, z increasing
    moved: Float[Array, "time station 3"]
    section: Float[Array, "section 4"]  # number of the shaft, z of start and end, radius
    discs: Sequence[CarriedDisc]
    bearing: Float[Array, "bearing 4"]  # x, y, z, radius of the shaft there
    force: Float[Array, "time bearing 2"]  # of the shaft on it, in x and y
    carried: Float[Array, "time bearing 3"]  # what the housing moves them by; of none: it is stiff
    times: float  # displacements are drawn so many times as large


def solid_data(solid: Solid) -> dict[str, Any]:
    """A solid as the page reads it."""
    samples = len(solid.moved)
    numbers = (
        3 * len(solid.station) + 6 * len(solid.discs) + 2 * len(solid.bearing) + 3 * solid.carried.shape[1]
    )
    frames, kept = kept_frames(samples, max(_LEAST_FRAMES, _MOST_NUMBERS // numbers))
    return {
        "frames": kept,
        "discs": [disc._asdict() | {"pose": packed(disc.pose[frames])} for disc in solid.discs],
        "times": solid.times,
        **{name: packed(getattr(solid, name)) for name in ("station", "section", "bearing")},
        **{name: packed(getattr(solid, name)[frames]) for name in ("moved", "force", "carried")},
    }
