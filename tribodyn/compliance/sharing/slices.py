"""Face width in slices: how the load of one slice moves the others, of its own tooth and of the neighbours.

A spur tooth is the same all along z, so a line load q cos kz displaces it by λ(k) q cos kz. With planes of
symmetry at the end faces (z from one of them) the loads of S equal slices are the sum of the cosines

    q(z) = Σ_n q_n cos k_n z,  k_n = n π/b,  n = 0 … S − 1,

which passes through the slices' line loads at their middles; so the deflection there of slice s per load (N)
on slice t is

    Λ_st = (1/b) Σ_n c_n λ(k_n) cos k_n z_s cos k_n z_t,  c_0 = 1, c_n = 2.

Cosines at the middles of equal slices are orthogonal: λ the same for all n makes slices that do not feel
each other, Λ = λ S/b δ_st, and a uniform load meets λ(0), plane strain, alone. The local deflection under the
surface is each slice's own (`local`), with its line load; λ holds what a load that varies along the face
makes less than that, down to wavelengths of the contact's width. What free end faces add follows from
`fem.free_ends`.
"""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

from tribodyn.compliance.fem.gear_compliance import (
    NEIGHBOURS,
    FreeEnds,
    GearCompliance,
    at_radii,
    at_wave_numbers,
    spline_weights,
)
from tribodyn.compliance.local import freed_of_depth
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.helix import face_positions
from tribodyn.numerics.shapes import Array, Float


class PairFlexibility(NamedTuple):
    """Elasticity of both gears of a drive; see `load_sharing.flexibility`."""

    assembly: Assembly
    materials: tuple[MaterialData, MaterialData]
    width: float  # common face width, m
    gears: tuple[GearCompliance, GearCompliance]


def modes(count: int, slices: int) -> Float[Array, "slice slice"]:
    """Modes (S, S) of the face at the slices' middles: cosines times √c_n; each one's square sums up to S.

    Where `count` harmonics are one, the same for all modes, the slices themselves are as good: Λ = λ S/b δ.
    """
    if count == 1:
        return np.sqrt(slices) * np.eye(slices)
    number = np.arange(slices)
    basis = np.cos(np.pi * number[:, None] * (np.arange(slices) + 0.5) / slices)
    return basis * np.where(number > 0, np.sqrt(2.0), 1.0)[:, None]


def wave_numbers(width: float, slices: int, coupled: bool) -> Float[Array, " wave"]:
    """k_n (n,), 1/m, of the modes that differ: all of the face's, or the uniform one for all alike."""
    return np.pi * np.arange(slices if coupled else 1) / width


def pair_harmonics(
    flexible: PairFlexibility, geometry: PairGeometry, slices: int = 1, coupled: bool = True
) -> Float[Array, "mode position pair pair"]:
    """λ_jk(k_n)/b (n, position, pair, pair) of all modes of the face, or of the uniform one; m/N.

    Both gears: of a pair itself from the bores to the local regions' depth, of others through teeth and
    bodies. The pairs stand one pitch apart in the last axis of the geometry, the one that entered first in
    front.
    """
    wave_number = wave_numbers(flexible.width, slices, coupled)
    count = geometry.gap.shape[-1]
    matrix = np.zeros((len(wave_number), *geometry.gap.shape, count))
    diagonal = np.einsum("...ii->...i", matrix)
    reaches = geometry.pinion_radius, geometry.gear_radius
    # On the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other.
    for gear, material, reach, sign in zip(flexible.gears, flexible.materials, reaches, (1, -1), strict=True):
        same_tooth, between = responses(gear, material.poisson_ratio, wave_number)
        at = np.clip(reach, gear.radius[0], gear.radius[-1])
        scale = material.youngs_modulus * flexible.width
        diagonal += np.moveaxis(CubicSpline(gear.radius, same_tooth.T)(at), -1, 0) / scale
        for mode, rows in enumerate(between):
            for pitches in range(1, min(count - 1, NEIGHBOURS) + 1):
                surface = RectBivariateSpline(gear.radius, gear.radius, rows[NEIGHBOURS + sign * pitches])
                earlier, later = np.arange(count - pitches), np.arange(pitches, count)
                value = surface.ev(at[..., earlier], at[..., later]) / scale
                matrix[mode][..., earlier, later] += value
                matrix[mode][..., later, earlier] += value
    return matrix


def by_slices(
    harmonics: Float[Array, "mode position pair pair"], slices: int
) -> Float[Array, "position pair slice pair slice"]:
    """Λ (position, pair, slice, pair, slice), m/N, of `pair_harmonics` (n, position, pair, pair)."""
    if len(harmonics) == 1:
        return harmonics[0][:, :, None, :, None] * (slices * np.eye(slices))[:, None, :]
    basis = modes(len(harmonics), slices)
    _, positions, pairs, _ = harmonics.shape
    product = (basis[:, :, None] * basis[:, None, :]).reshape(slices, -1)
    spread = harmonics.reshape(slices, -1).T @ product
    return spread.reshape(positions, pairs, pairs, slices, slices).swapaxes(2, 3)


def responses(
    gear: GearCompliance, poisson_ratio: float, wave_number: Float[Array, " mode"]
) -> tuple[Float[Array, "mode radius"], Float[Array, "mode sector radius radius"]]:
    """Compliances freed of the local region (n, M) and of neighbours (n, sector, M, M) for E = b = 1."""
    if np.any(wave_number):
        response = at_wave_numbers(gear, wave_number, poisson_ratio)
        return response.own, response.between
    return freed_of_depth(gear.inside, poisson_ratio)[None], gear.between[None]


def friction_ratio(slice_load: Float[Array, "*pair slice"]) -> Float[Array, "*pair"]:
    """W/q̄ of loads (…, slice) ≥ 0, N, of equal slices; at least 1, and 1 where nothing is loaded.

    Friction on the slices of a face is ∫ μ(q) q dz. A coefficient that goes like q^m takes the same at an
    even line load W with (W/q̄)^m = ⟨s^(1+m)⟩, s = q/q̄ and ⟨⟩ the mean over the whole face. Laws of
    lubricated flanks have a small m, |m| < 0.3, and as m goes to zero this becomes

        W/q̄ = exp ⟨s ln s⟩,

    whatever the law: the load-weighted geometric mean of the line load. The next term of ln W is
    ½ m (⟨s ln² s⟩ − ⟨s ln s⟩²), 5 % of W for a triangle and m = 0.3, 1.5 % of the friction.
    """
    share = _share(slice_load)
    return np.exp(np.mean(share * np.log(np.where(share > 0.0, share, 1.0)), axis=-1))


def peak_ratio(slice_load: Float[Array, "*pair slice"]) -> Float[Array, "*pair"]:
    """K_Hβ (ISO 6336-1) of loads (…, slice) ≥ 0, N, of equal slices; 1 where nothing is loaded.

    There the film is thinnest, pressure and flash temperature are highest.
    """
    return np.max(_share(slice_load), axis=-1)


def _share(slice_load: Float[Array, "*pair slice"]) -> Float[Array, "*pair slice"]:
    mean = np.mean(slice_load, axis=-1, keepdims=True)
    return np.where(mean > 0.0, slice_load / np.where(mean > 0.0, mean, 1.0), 1.0)


def slice_compliance(
    flexible: PairFlexibility, geometry: PairGeometry, slices: int = 1, coupled: bool = True
) -> Float[Array, "position pair slice pair slice"]:
    """Λ (position, pair, slice, pair, slice), m/N, without the slices' own local deflection.

    Pairs (position, pair) stand one pitch apart, the one that entered first in front. One slice is plane
    strain. `coupled`: whether slices hold each other through the teeth and bodies, and the end faces are
    free; else each slice is in plane strain by itself.
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
    matrix: Float[Array, "position pair slice pair slice"], flexible: PairFlexibility, geometry: PairGeometry
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
            direct = np.einsum("pklm,tm->tpkl", ends.own, place[:, later])
            matrix[:, later, :, later] += _spread(along, direct) / material.youngs_modulus
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
