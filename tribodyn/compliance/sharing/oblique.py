"""Face of a helical pair in slices: how a load at one place and radius of a tooth moves others elsewhere.

At one instant the slices of a helical tooth touch at different radii. Between slice s, touched at r_s, and
slice t the harmonics of `slices` are those of both radii,

    Λ_st = (1/l) Σ_n c_n λ(k_n; r_s, r_t) cos k_n z_s cos k_n z_t

on the length l of a tooth of the elastic section (`section`). For r_s → r_t λ grows like the half-space's
K_0(k |x_s − x_t|), x along the profile, as far as the local deflection, which is each slice's own. So λ less
the half-space's 2 (1 − ν²)/(π E) K_0(kx) is interpolated between the radii solved, and what is put back is

    m(k, x) = B(k) K_0(k √(x² + d²))/K_0(k d),   m(0, x) = −(1 − ν²)/(π E) ln(1 + x²/d²),

at x = 0 the surface's B(k) (`fem.gear_compliance`), beyond d = h exp(−1/(2 (1 − ν))) the half-space's; for
small k both meet. End faces are taken as perpendicular to the tooth, and free.
"""

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import k0

from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, GearCompliance, at_radii, half_space_surface
from tribodyn.compliance.sharing.section import elastic_section, length_per_width, raised
from tribodyn.compliance.sharing.slices import PairFlexibility, end_modes, modes, responses, wave_numbers
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.tooth import Tooth, flank_point
from tribodyn.numerics.shapes import Array, Float

# Places along the profile at which the half-space's part is tabulated, evenly in asinh(x/d).
_PLACES = 65
# Points of the profile from which its length over the radius follows.
_PROFILE = 401


def oblique_compliance(
    flexible: PairFlexibility, contact: tuple[Float[Array, "position pair slice"], ...], coupled: bool = True
) -> Float[Array, "position pair slice pair slice"]:
    """Λ (position, pair, slice, pair, slice), m/N, without the slices' own local deflection.

    `contact`: radii (m) at which the slices of pinion and gear are touched, and the part of the load in the
    elastic section (`ObliqueFaces.at`); pairs one pitch apart, the one that entered first in front. Not
    `coupled` each slice is in plane strain by itself, with its neighbours' slices at the same place.
    """
    *reach, within = contact
    positions, pairs, slices = within.shape
    length = flexible.width * length_per_width(flexible.assembly)
    section = elastic_section(flexible.assembly)
    matrix = np.zeros((positions, pairs, slices, pairs, slices))
    # On the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other.
    for side, gear, material, radius, sign in zip(
        SIDES, flexible.gears, flexible.materials, reach, (1, -1), strict=True
    ):
        at = radius + raised(flexible.assembly, section, side)
        wave_number = wave_numbers(length, slices, coupled)
        same_tooth, between = responses(gear, material.poisson_ratio, wave_number)
        place = at_radii(gear.radius, at)
        scale = material.youngs_modulus * length
        basis = modes(len(wave_number), slices)
        if len(wave_number) == 1:
            _add_apart(matrix, same_tooth[0], between[0], place, sign, scale / slices)
            continue
        wave = basis.T[:, :, None] * place[..., None, :]  # (position, pair, slice, n, M)
        for later in range(pairs):
            for earlier in range(max(0, later - NEIGHBOURS), later):
                rows = between[:, NEIGHBOURS + sign * (later - earlier)]
                _add_both(matrix, earlier, later, _by_modes(wave[:, earlier], rows, wave[:, later]) / scale)
        tooth = _OneTooth(gear, section.tooth(side), material.poisson_ratio, wave_number, same_tooth, between)
        for pair in range(pairs):
            matrix[:, pair, :, pair] += tooth.compliance(at[:, pair], wave[:, pair], basis) / scale
        _add_free_ends(matrix, gear, at, length, sign, material.youngs_modulus)
    return matrix * within[..., None, None] * within[:, None, None]


def _add_apart(
    matrix: Float[Array, "position pair slice pair slice"],
    same_tooth: Float[Array, " radius"],
    between: Float[Array, "sector radius radius"],
    place: Float[Array, "position pair slice radius"],
    sign: int,
    scale: float,
) -> None:
    """Add slices that do not feel each other, each in plane strain."""
    pairs, slices = matrix.shape[1:3]
    along = np.arange(slices)
    for later in range(pairs):
        matrix[:, later, along, later, along] += place[:, later] @ same_tooth / scale
        for earlier in range(max(0, later - NEIGHBOURS), later):
            rows = between[NEIGHBOURS + sign * (later - earlier)]
            value = np.sum(place[:, earlier] @ rows * place[:, later], axis=-1) / scale
            matrix[:, earlier, along, later, along] += value
            matrix[:, later, along, earlier, along] += value


def _by_modes(
    first: Float[Array, "position slice wave radius"],
    rows: Float[Array, "wave radius radius"],
    second: Float[Array, "position slice wave radius"],
) -> Float[Array, "position slice slice"]:
    """Σ over the modes of what tables (n, M, M) between two radii give."""
    turned = np.einsum("tsnm,nmk->tsnk", first, rows, optimize=True)
    count = turned.shape[2] * turned.shape[3]
    flat = turned.reshape(*turned.shape[:2], count), second.reshape(*second.shape[:2], count)
    return flat[0] @ flat[1].swapaxes(1, 2)


def _add_both(
    matrix: Float[Array, "position pair slice pair slice"],
    earlier: int,
    later: int,
    value: Float[Array, "position slice slice"],
) -> None:
    matrix[:, earlier, :, later] += value
    matrix[:, later, :, earlier] += value.swapaxes(1, 2)


class _OneTooth:
    """A tooth under loads at two of its radii, for unit Young's modulus and length."""

    def __init__(
        self,
        gear: GearCompliance,
        tooth: Tooth,
        poisson_ratio: float,
        wave_number: Float[Array, " wave"],
        same_tooth: Float[Array, "wave radius"],
        between: Float[Array, "wave sector radius radius"],
    ) -> None:
        """Take the half-space out of what was solved."""
        self.wave_number, self.poisson_ratio = wave_number, poisson_ratio
        self.near = gear.depth * np.exp(-0.5 / (1.0 - poisson_ratio))
        self.surface = np.zeros(len(wave_number))
        self.surface[1:] = half_space_surface(wave_number[1:], gear.depth, poisson_ratio)
        self.radius = gear.radius
        r = np.linspace(float(tooth.form_distance), float(tooth.tip_distance), _PROFILE)
        profile = np.stack(flank_point(tooth, r))
        steps = np.hypot(*np.diff(profile, axis=1))
        radii = np.sign(gear.radius[0]) * np.hypot(*profile)  # negative of an internal gear, and growing
        self._profile = radii, np.concatenate([[0.0], np.cumsum(steps)])
        along = self.along(gear.radius)
        self.mean = same_tooth - self.surface[:, None]
        apart = np.abs(along[:, None] - along) + np.eye(len(along))
        softness = 2.0 * (1.0 - poisson_ratio**2) / np.pi
        line = [np.log(self.near / apart), *(k0(k * apart) for k in wave_number[1:])]
        smooth = between[:, NEIGHBOURS] - softness * np.stack(line)
        smooth -= (self.mean[:, :, None] + self.mean[:, None, :]) / 2.0
        smooth[:, np.arange(len(along)), np.arange(len(along))] = 0.0
        solved = wave_number <= (0.0 if gear.lead is None else gear.lead.wave_number[-1])
        self.smooth = solved[:, None, None] * (smooth + smooth.swapaxes(1, 2)) / 2.0

    def along(self, radius: Float[Array, "*place"]) -> Float[Array, "*place"]:
        """Length of the profile (m) up to a radius (m)."""
        return np.interp(radius, *self._profile)

    def half_space(self, apart: Float[Array, "..."]) -> Float[Array, "wave ..."]:
        """m(k, x) at distances x ≥ 0 (m) along the profile, of all modes."""
        k = self.wave_number[1:].reshape(-1, *[1] * apart.ndim)
        reached = self.surface[1:].reshape(k.shape)
        rest = reached * k0(k * np.hypot(apart, self.near)) / k0(k * self.near)
        logarithm = np.log1p((apart / self.near) ** 2)
        even = -(1.0 - self.poisson_ratio**2) / np.pi * logarithm
        return np.concatenate([even[None], rest])

    def compliance(
        self,
        radius: Float[Array, "position slice"],
        wave: Float[Array, "position slice wave radius"],
        basis: Float[Array, "wave slice"],
    ) -> Float[Array, "position slice slice"]:
        """Deflection of slices per load on slices, of one pair."""
        value = _by_modes(wave, self.smooth, wave)
        mode = basis.T  # (slice, n)
        place = at_radii(self.radius, radius)
        on_diagonal = np.einsum("tsm,nmk,tsk->tsn", place, self.smooth, place, optimize=True)
        rest = mode * (place @ self.mean.T - on_diagonal) @ basis
        value += (rest + rest.swapaxes(1, 2)) / 2.0
        along = self.along(radius)
        return value + self._between_slices(np.abs(along[:, :, None] - along[:, None, :]), basis)

    def _between_slices(
        self, apart: Float[Array, "position slice slice"], basis: Float[Array, "wave slice"]
    ) -> Float[Array, "position slice slice"]:
        """The half-space's part, from a table over the distance."""
        most = float(np.max(apart)) + 1e-3 * self.near
        step = np.arcsinh(most / self.near) / (_PLACES - 1)
        places = self.near * np.sinh(step * np.arange(_PLACES))
        slices = basis.shape[1]
        product = (basis[:, :, None] * basis[:, None, :]).reshape(len(basis), -1)
        table = CubicSpline(np.arange(_PLACES), self.half_space(places).T @ product)
        at = np.arcsinh(apart / self.near) / step
        cell = np.clip(at.astype(int), 0, _PLACES - 2)
        number = np.arange(slices**2).reshape(slices, slices)
        u, value = at - cell, np.zeros_like(at)
        for power in range(4):
            value = value * u + table.c[power][cell, number]
        return value


def _add_free_ends(
    matrix: Float[Array, "position pair slice pair slice"],
    gear: GearCompliance,
    radius: Float[Array, "position pair slice"],
    length: float,
    sign: int,
    modulus: float,
) -> None:
    ends = gear.ends
    if ends is None:
        return
    pairs, slices = matrix.shape[1:3]
    along, place = end_modes(ends, length, slices), at_radii(ends.radius, radius)
    for parity in (0, 1):
        # between slices first: they are few against the waves, and the same at all positions
        waves = along[parity]
        spread = np.einsum("sk,klpmn,ul->psmun", waves, ends.between[parity], waves, optimize=True)
        itself = np.einsum("sk,klm,ul->smu", waves, ends.own[parity], waves, optimize=True)
        for later in range(pairs):
            for earlier in range(max(0, later - NEIGHBOURS), later + 1):
                rows = spread[NEIGHBOURS + sign * (later - earlier)]
                if earlier == later:
                    at = place[:, later]
                    missed = np.einsum("tsm,smu->tsu", at, itself, optimize=True)
                    missed -= np.einsum("tsm,smun,tsn->tsu", at, rows, at, optimize=True)
                    value = _between(at, rows, at) + (missed + missed.swapaxes(1, 2)) / 2.0
                    matrix[:, later, :, later] += value / modulus
                else:
                    value = _between(place[:, earlier], rows, place[:, later])
                    _add_both(matrix, earlier, later, value / modulus)


def _between(
    first: Float[Array, "position slice radius"],
    rows: Float[Array, "slice radius slice radius"],
    second: Float[Array, "position slice radius"],
) -> Float[Array, "position slice slice"]:
    """Deflection of slices at the radii of the second per load on slices at those of the first."""
    half = (first.swapaxes(0, 1) @ rows.reshape(*rows.shape[:2], -1)).reshape(
        first.shape[1], len(first), *second.shape[1:]
    )
    return np.einsum("stun,tun->tsu", half, second, optimize=True)
