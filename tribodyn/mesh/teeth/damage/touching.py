"""Flanks of which a part of the face is missing.

A slice's strips are told apart: where all of them lack material, the flank touches later by the least of it.
Where some lie deeper, the others carry alone, and the pair is softer: by what teeth and bodies deflect more
under a load on a part of the face (`coupled_slices`), and by the contact's own share.
"""

import numpy as np

from tribodyn.compliance.energy import hertz_linear, tooth_compliance, under_uneven_load
from tribodyn.mesh.slices.coupled import BODIES_LENGTH, TEETH_LENGTH, spread
from tribodyn.mesh.teeth.damage.gear import CLEAR, DamagedGear
from tribodyn.mesh.teeth.damage.patch import smooth
from tribodyn.mesh.teeth.fields import FlankPlaces, ToothFields
from tribodyn.numerics.shapes import Array, Float

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
