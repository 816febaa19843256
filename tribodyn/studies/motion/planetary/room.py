"""Room of planetary sets: where the second planets of pairs stand, and whether all have place."""

from collections.abc import Mapping, Sequence
from math import acos, atan2, cos, sin

import numpy as np

from tribodyn.errors import InputError, quoted
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.planetary.stages import SetPart
from tribodyn.train.planetary import PLANETS, RAVIGNEAUX, RING, SUN
from tribodyn.train.positions import Disc


def directions(gearset: SetPart, apart: Mapping[str, float]) -> dict[str, list[float]]:
    """Directions between the axes of the meshes of every planet, by member, rad, of a set of pairs.

    A second planet stands counter-clockwise of the first one that it meshes with, where the triangle of
    their distances (m) from the axis and from each other closes: `apart`, by the members of the meshes.
    """
    first, second, between = abs(apart[SUN]), abs(apart[RING]), apart[PLANETS]
    cosine = (first**2 + second**2 - between**2) / (2.0 * first * second)
    if not abs(cosine) < 1.0:
        one, two = gearset.table.planet_gears
        far = " and ".join(f"{1e3 * each:.6g}" for each in (first, second))
        rule = f"{one} and {two} mesh {1e3 * between:.6g} mm apart, {far} mm from the axis: no such triangle"
        remedy = "change numbers of teeth or profile shifts"
        raise InputError(f"{gearset.key}.second_planet", quoted(two), rule, remedy)
    placed = gearset.table.placed
    onwards = [angle + acos(cosine) for angle in placed]
    across = [
        atan2(second * sin(two) - first * sin(one), second * cos(two) - first * cos(one))
        for one, two in zip(placed, onwards, strict=True)
    ]
    return {member: onwards for member in apart} | {SUN: list(placed), PLANETS: across}


def in_planes(
    sets: Sequence[SetPart], discs: Sequence[Disc], meshing: Sequence[tuple[int, int]]
) -> tuple[list[Disc], list[tuple[int, int]]]:
    """Discs of gears, and which of them mesh, with what sets need.

    The suns of a Ravigneaux set stand beside each other: one with the first planets, the other with the ring,
    and the second planets with both.
    """
    placed, pairs = list(discs), list(meshing)
    for number, gearset in enumerate(sets):
        bodies = *gearset.members.values(), *gearset.planets
        own = [k for k, disc in enumerate(discs) if disc.body in bodies]
        for k in own:
            placed[k] = placed[k]._replace(remedy="use fewer planets, or other numbers of teeth")
        if gearset.table.type != RAVIGNEAUX:
            continue
        arms = gearset.table.planets
        for k in own:
            if discs[k].body in (gearset.members[SUN], *gearset.planets[:arms]):
                placed[k] = placed[k]._replace(plane=-1 - number)
            elif discs[k].body in gearset.planets[arms:]:
                pairs += [(len(placed), sum(pair) - k) for pair in meshing if k in pair]
                placed.append(placed[k]._replace(plane=-1 - number))
    return placed, pairs


def refuse_overlap(gearset: SetPart, tip_radius: float, centres: Float[Array, "planet 2"]) -> None:
    """Raise InputError where the tip circles of planets that are alike overlap; centres, m."""
    apart = np.hypot(*np.moveaxis(centres[:, None] - centres[None], -1, 0))
    apart[np.diag_indices(len(centres))] = np.inf
    overlap = 2.0 * tip_radius - float(apart.min())
    if overlap <= 0.0:
        return
    one, two = sorted(int(place) + 1 for place in np.unravel_index(int(np.argmin(apart)), apart.shape))
    radius = float(np.hypot(*(centres[0] - centres.mean(axis=0))))
    rule = f"the tip circles of planets {one} and {two} overlap by {1e3 * overlap:.3g} mm"
    remedy = "stand them further apart"
    if not gearset.table.angles:
        remedy = f"use at most {int(np.pi / np.arcsin(tip_radius / radius))}, or planets with fewer teeth"
    key = "angles" if gearset.table.angles else "planets"
    raise InputError(
        f"{gearset.key}.{key}", None if gearset.table.angles else gearset.table.planets, rule, remedy
    )
