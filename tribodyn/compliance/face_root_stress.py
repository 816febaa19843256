"""Stress at the roots of teeth whose load varies along the face, their neighbours' loads included."""

from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from tribodyn.compliance.gear_compliance import NEIGHBOURS
from tribodyn.compliance.lead_harmonics import at_wave_numbers
from tribodyn.compliance.load_sharing import PairFlexibility
from tribodyn.compliance.slices import modes, wave_numbers
from tribodyn.geometry.corner_contact import PairGeometry

Array = Any

# Positions (of the mesh) taken at a time, to bound the memory.
_BATCH = 64


def root_stress(
    flexible: PairFlexibility, geometry: PairGeometry, line_load: Array, coupled: bool = True
) -> tuple[Array, Array]:
    """Greatest tension and greatest compression along the root of every tooth.

    Stresses along the profile, of both fillets, from the middle of one gap to the middle of the next; those
    that the neighbours' loads make in the rim add to the tooth's own.

    Parameters
    ----------
    flexible : PairFlexibility
        Solved with `lead`.
    geometry : PairGeometry
        Of the pairs (position, pair), one pitch apart, the one that entered first in front.
    line_load : (position, pair, slice)
        N/m.
    coupled : bool
        Whether a slice's load strains the others' roots too; else each slice is in plane strain by itself.

    Returns
    -------
    (2, position, pair, slice), (2, position, pair, slice)
        Of pinion and gear; tension positive, compression negative, Pa.
    """
    positions, _, slices = line_load.shape
    wave_number = wave_numbers(flexible.width, slices, coupled)
    basis = modes(len(wave_number), slices)
    amplitude = line_load @ basis.T / slices
    tension, compression = np.empty((2, *line_load.shape)), np.empty((2, *line_load.shape))
    reaches = geometry.pinion_radius, geometry.gear_radius
    # on the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other
    for body, (gear, material, reach, sign) in enumerate(
        zip(flexible.gears, flexible.materials, reaches, (1, -1), strict=True)
    ):
        per_load = at_wave_numbers(gear, wave_number, material.poisson_ratio).root_stress
        place = CubicSpline(gear.radius, np.eye(len(gear.radius)))
        for first in range(0, positions, _BATCH):
            rows = slice(first, first + _BATCH)
            at = np.clip(reach[rows], gear.radius[0], gear.radius[-1])
            found = _of_one_gear(per_load, place(at), amplitude[rows], sign) @ basis
            tension[body, rows], compression[body, rows] = np.max(found, axis=0), np.min(found, axis=0)
    return tension, compression


def _of_one_gear(per_load: Array, place: Array, amplitude: Array, sign: int) -> Array:
    """Amplitudes (point, position, pair, n) of the stress, Pa, at the points of both fillets.

    `per_load` (1 or n, sector, fillet, point, M) per unit line load, `place` (position, pair, M) the weights
    of the flank's positions, `amplitude` (position, pair, n) of the line loads, N/m.
    """
    positions, pairs, count = amplitude.shape
    every = np.broadcast_to(per_load, (count, *per_load.shape[1:]))
    total = np.zeros((count, np.prod(per_load.shape[2:4]), positions, pairs))
    for pitches in range(-min(pairs - 1, NEIGHBOURS), min(pairs - 1, NEIGHBOURS) + 1):
        # the tooth that is read entered `pitches` before the loaded one
        read = slice(max(-pitches, 0), pairs - max(pitches, 0))
        loaded = slice(max(pitches, 0), pairs - max(-pitches, 0))
        rows = every[:, NEIGHBOURS + sign * pitches].reshape(count, -1, per_load.shape[-1])
        loads = place[:, loaded, :, None] * amplitude[:, loaded, None, :]
        total[..., read] += np.einsum("npm,tjmn->nptj", rows, loads, optimize=True)
    return total.transpose(1, 2, 3, 0)
