"""Deflection of slices of the face under each other's loads: harmonics of the face, and its free ends."""

import numpy as np

from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, FreeEnds, at_radii
from tribodyn.compliance.fem.lead_harmonics import spline_weights
from tribodyn.compliance.sharing.slices import PairFlexibility, by_slices, face_positions, pair_harmonics
from tribodyn.geometry.flanks.corner_contact import PairGeometry
from tribodyn.numerics.shapes import Array, Float


def slice_compliance(
    flexible: PairFlexibility, geometry: PairGeometry, slices: int = 1, coupled: bool = True
) -> Float[Array, "position pair slice pair slice"]:
    """Λ (position, pair, slice, pair, slice), m/N, without the slices' own local deflection.

    Parameters
    ----------
    geometry : of the pairs (position, pair), one pitch apart, the one that entered first in front
    slices : one is plane strain
    coupled : whether slices hold each other through the teeth and bodies, and the end faces are free; else
        each slice is in plane strain by itself
    """
    matrix = by_slices(pair_harmonics(flexible, geometry, slices, coupled), slices)
    if coupled and slices > 1:
        _add_free_ends(matrix, flexible, geometry)
    return matrix


def end_modes(ends: FreeEnds, width: float, slices: int) -> Float[Array, "2 slice wave"]:
    """What loads on slices count for in `FreeEnds`' waves, and what slices see of them: (2, S, K), 1/m.

    For even and odd numbers of half waves; of loads in N that are even in a slice, and the mean over a slice
    of what is seen. Over the last octave of the wave numbers that were solved they fade away.
    """
    largest = ends.wave_number[-1]
    number = np.arange(int(largest * width / np.pi) + 1)
    wave_number = number * np.pi / width
    from_end = face_positions(width, slices)[:, None] + width / 2.0
    # sinc: the mean of the cosine over a slice
    wave = np.cos(wave_number * from_end) * np.sinc(number / (2.0 * slices))
    wave = wave * np.where(number > 0, 2.0, 1.0) / width
    # cut off at once they would ripple along the face
    wave = wave * np.cos(np.pi / 2.0 * np.clip(2.0 * wave_number / largest - 1.0, 0.0, 1.0)) ** 2
    weights = spline_weights(ends.wave_number, wave_number)
    return np.stack([wave[:, parity::2] @ weights[parity::2] for parity in (0, 1)])


def _add_free_ends(
    matrix: Float[Array, "position pair slice pair slice"],
    flexible: PairFlexibility,
    geometry: PairGeometry,
) -> None:
    pairs, slices = matrix.shape[1:3]
    reaches = geometry.pinion_radius, geometry.gear_radius
    # On the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other.
    for gear, material, reach, sign in zip(flexible.gears, flexible.materials, reaches, (1, -1), strict=True):
        ends = gear.ends
        if ends is None:
            continue
        along = end_modes(ends, flexible.width, slices)
        place = at_radii(ends.radius, reach)
        for later in range(pairs):
            own = np.einsum("pklm,tm->tpkl", ends.own, place[:, later])
            matrix[:, later, :, later] += _spread(along, own) / material.youngs_modulus
            for earlier in range(max(0, later - NEIGHBOURS), later):
                rows = ends.between[:, :, :, NEIGHBOURS + sign * (later - earlier)]
                opened = np.einsum(
                    "pklmn,tm,tn->tpkl", rows, place[:, earlier], place[:, later], optimize=True
                )
                value = _spread(along, opened) / material.youngs_modulus
                matrix[:, earlier, :, later] += value
                matrix[:, later, :, earlier] += value.swapaxes(1, 2)


def _spread(
    along: Float[Array, "2 slice wave"], amplitudes: Float[Array, "position 2 wave wave"]
) -> Float[Array, "position slice slice"]:
    """Matrices (position, slice, slice) of those over the wave numbers (position, parity, K, K)."""
    return np.sum(along @ amplitudes @ along.swapaxes(1, 2), axis=1)
