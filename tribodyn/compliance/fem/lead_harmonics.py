"""Deflection of a flank under a line load that runs like cos kz along the tooth, at any wave number k.

The finite elements answer at some wave numbers; between them a spline does, in asinh(k/k_0), in which they
stand evenly. Responses are even in k. Next to the load the body is a half-space, whose displacement at the
depth d below a line load q cos kz follows from Boussinesq's point load,

    h_s(d; k) = (1 + ν)/(π E) [kd K_1(kd) + 2 (1 − ν) K_0(kd)] q cos kz,

and with Weber-Banaschek's deflection down to the depth h its surface deflects by that and

    B(k) = (1 + ν)/(π E) {1 + 2 (1 − ν) [−ln(kh/2) − γ]},

the limit of h_s(h; k) for kh → 0. What a tooth has more than a half-space, u − h_s, is read at h and 2h and
taken on to the surface, as `local.freed_of_depth` does for k = 0. As k grows only B is left.
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.special import k0, k1

from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.compliance.local import freed_of_depth
from tribodyn.numerics.shapes import Array, Float

#: Largest wave number solved, in 1/module; beyond it loads act on their neighbourhood only.
LARGEST = 6.0
#: The same for what free ends add, which is to be resolved along the face.
LARGEST_AT_ENDS = 12.0
# Wave number, over 1/root radius, at which the grid turns from even to geometric, and its step in the
# logarithm: interpolation within 0.2 % (test_lead_harmonics).
_TURN = 0.6
_STEP = 0.42
_ORDER = 5  # of the spline


class LeadCompliance(NamedTuple):
    """Response at N wave numbers, for unit Young's modulus; M positions of the load, P along the root."""

    radius: Float[Array, " radius"]  # (M,), m
    #: (N, M), displacement along the load per line load, freed of the depth: to be added to Weber-Banaschek's
    #: deflection from the surface to `GearCompliance.depth`
    own: Float[Array, "wave radius"]
    between: Float[Array, "wave sector radius radius"]  # (N, 2 NEIGHBOURS + 1, M, M), as in `GearCompliance`
    #: (N, 2 NEIGHBOURS + 1, 2, P, M), as in `LeadHarmonics`, 1/m
    root_stress: Float[Array, "wave sector 2 point radius"]


def wave_numbers(module: float, root_radius: float, most: float = LARGEST) -> Float[Array, " wave"]:
    """Wave numbers to solve, rad/m: from 0, dense enough for body and teeth, to `most`/module."""
    turn, largest = _TURN / root_radius, most / module
    reach = np.arcsinh(largest / turn)
    return turn * np.sinh(np.linspace(0.0, reach, int(np.ceil(reach / _STEP)) + 1))


def at_wave_numbers(
    gear: GearCompliance, wave_number: Float[Array, " wave"], poisson_ratio: float
) -> LeadCompliance:
    """Response of a gear to line loads cos kz.

    Parameters
    ----------
    gear : solved with its `lead`
    wave_number : (N,); k ≥ 0, rad/m. Beyond the largest that was solved, `own` follows the half-space and the
        others are 0.
    poisson_ratio : ν that the gear was solved with
    """
    lead = gear.lead
    if lead is None:
        raise ValueError("the gear was solved for loads that are even along the teeth only")
    k = np.asarray(wave_number, dtype=float)
    largest = lead.wave_number[-1]
    # the half-space's logarithm, rounded off at k = 0, is taken out of what is interpolated
    rounding = largest / LARGEST

    def smooth(at: Float[Array, " wave"]) -> Float[Array, "wave 1"]:
        return half_space_surface(np.hypot(at, rounding), gear.depth, poisson_ratio)[:, None]

    within = np.minimum(k, largest)
    weights = spline_weights(lead.wave_number, within)
    value = weights @ (own_at_solved(gear, poisson_ratio) - smooth(lead.wave_number)) + smooth(within)
    beyond = k > largest
    surface = half_space_surface(np.where(beyond, k, largest), gear.depth, poisson_ratio)
    value += (surface - half_space_surface(np.array([largest]), gear.depth, poisson_ratio))[:, None]
    weights = np.where(beyond[:, None], 0.0, weights)
    between, root_stress = (np.tensordot(weights, part, 1) for part in (lead.between, lead.root_stress))
    return LeadCompliance(gear.radius, value, between, root_stress)


def own_at_solved(gear: GearCompliance, poisson_ratio: float) -> Float[Array, "solved radius"]:
    """Displacement (K, M) of a loaded position, freed of the depth, at the wave numbers solved."""
    lead: Any = gear.lead
    k, depth = lead.wave_number[1:], gear.depth
    excess = [
        lead.inside[1:, which] - half_space(factor * depth, k, poisson_ratio)[:, None]
        for which, factor in enumerate((1.0, 2.0))
    ]
    surface = half_space_surface(k, depth, poisson_ratio)[:, None]
    plane = freed_of_depth(lead.inside[0], poisson_ratio)
    return np.concatenate([plane[None], surface + 2.0 * excess[0] - excess[1]])


def half_space(
    depth: float, wave_number: Float[Array, " wave"], poisson_ratio: float
) -> Float[Array, " wave"]:
    """h_s(d; k) per unit amplitude of the line load, for unit Young's modulus; depth > 0, k > 0."""
    reach = wave_number * depth
    return (1 + poisson_ratio) / np.pi * (reach * k1(reach) + 2 * (1 - poisson_ratio) * k0(reach))


def half_space_surface(
    wave_number: Float[Array, " wave"], depth: float, poisson_ratio: float
) -> Float[Array, " wave"]:
    """B(k) for unit Young's modulus: surface of a half-space less Weber-Banaschek's deflection; k > 0."""
    logarithm = -np.log(wave_number * depth / 2) - np.euler_gamma
    return (1 + poisson_ratio) / np.pi * (1 + 2 * (1 - poisson_ratio) * logarithm)


def spline_weights(
    solved: Float[Array, " solved"], wave_number: Float[Array, " wave"]
) -> Float[Array, "wave solved"]:
    """Weights (N, K) with which values at the wave numbers solved, even in k, count at others up to them."""
    scale = solved[1]
    at, weights = np.arcsinh(solved / scale), np.eye(len(solved))
    mirrored = np.concatenate([-at[:0:-1], at]), np.concatenate([weights[:0:-1], weights])
    return make_interp_spline(*mirrored, k=_ORDER)(np.arcsinh(wave_number / scale))
