"""Compliance of the flanks of one gear: the result of its finite elements, without them.

The response to a line load that runs like cos kz along the tooth is wanted at any wave number k. The finite
elements answer at some; between them a spline does, in asinh(k/k_0), in which they stand evenly. Responses
are even in k. Next to the load the body is a half-space, whose displacement at the depth d below a line load
q cos kz follows from Boussinesq's point load,

    h_s(d; k) = (1 + ν)/(π E) [kd K_1(kd) + 2 (1 − ν) K_0(kd)] q cos kz,

and with Weber-Banaschek's deflection down to the depth h its surface deflects by that and

    B(k) = (1 + ν)/(π E) {1 + 2 (1 − ν) [−ln(kh/2) − γ]},

the limit of h_s(h; k) for kh → 0. What a tooth has more than a half-space, u − h_s, is read at h and 2h and
taken on to the surface, as `local.freed_of_depth` does for k = 0. As k grows only B is left.

A gear that is free (`cyclic_symmetry`) differs from one that is held at its bore under a load that is even
along the teeth, k = 0. Loads of k > 0 have no resultant, and the body hands them on from one part of the face
to another: its bore, which stays straight on a stiff shaft, counts as exp(−k(r_root − r_bore)).
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, make_interp_spline
from scipy.special import k0, k1

from tribodyn.compliance.local import freed_of_depth
from tribodyn.geometry.drive import GearBody
from tribodyn.geometry.tooth import Tooth
from tribodyn.numerics.shapes import Array, Float

#: Teeth on either side whose compliances are kept: as many pairs as can touch beside the loaded one.
NEIGHBOURS = 2


class ElasticGear(NamedTuple):
    """What a gear's compliance is solved of: plain numbers."""

    tooth: Tooth  # as cut
    teeth: int
    bore_radius: float  # > 0 (`meshed_bore`); keeps its shape, m
    poisson_ratio: float  # ν < 0.5
    #: depth below the flank at which the loaded tooth's displacement is read, m, as it is at twice that; a
    #: cell or more, so that the mesh resolves it
    depth: float
    level: int  # multiplies the number of cells in both directions
    #: whether the outside of an internal gear is held as a whole only, and free to bend
    free_rim: bool = False
    held: bool = False  # whether the bore is held, or else the whole body free


#: Bore over root radius at which the body of a free gear is meshed at least: a smaller bore changes its
#: compliance by less than 0.1 % (test_free_body).
_LEAST_BORE = 0.1


def meshed_bore(body: GearBody, tooth: Tooth, held: bool) -> float:
    """Bore radius (m) of a body's mesh: of a solid or nearly solid one that is free, a small one."""
    bore = float(body.bore_radius)
    return bore if held else max(bore, _LEAST_BORE * float(tooth.root_radius)) if bore >= 0.0 else bore


class LeadHarmonics(NamedTuple):
    """Response of a gear, held, to line loads cos kz along its teeth, for unit Young's modulus; amplitudes.

    K wave numbers, M positions of the load as in `GearCompliance`, P positions along the root.
    """

    wave_number: Float[Array, " wave"]  # (K,), k, rad/m, increasing from 0
    inside: Float[Array, "wave 2 radius"]  # (K, 2, M)
    #: (K, 2 NEIGHBOURS + 1, M, M), as in `GearCompliance`, per unit line load
    between: Float[Array, "wave sector radius radius"]
    #: (2, P), x and y in the tooth's frame, m, of the points on the loaded flank's side, y > 0, from the
    #: middle of the gap to the flank; those of the other side are their mirror images
    root_position: Float[Array, "2 point"]
    #: (K, 2 NEIGHBOURS + 1, 2, P, M); stress along the profile, tension positive, per unit line load, 1/m: on
    #: the tooth k − NEIGHBOURS pitches towards +y of the loaded one, on its own side y > 0 (0) and y < 0 (1)
    root_stress: Float[Array, "wave sector 2 point radius"]


class FreeEnds(NamedTuple):
    """What free end faces add to the deflection of a gear of one width, for unit Young's modulus.

    Amplitude of a deflection or stress cos k'z per line load cos kz, z from one end, over c'/b with c' = 2,
    or 1 for k' = 0: at the K wave numbers solved, between which a spline interpolates. k and k' are even
    (0) or odd (1) numbers of half waves over the width b, both the same. M positions of the load, P along the
    root as in `LeadHarmonics`.
    """

    wave_number: Float[Array, " wave"]  # (K,), k, rad/m
    radius: Float[Array, " radius"]  # (M,), as in `GearCompliance`; fewer
    own: Float[Array, "2 wave wave radius"]  # (2, K', K, M), of a loaded position's surface, m
    #: (2, K', K, 2 NEIGHBOURS + 1, M, M), as in `GearCompliance`, m
    between: Float[Array, "2 wave wave sector radius radius"]
    #: (2, K', K, 2 NEIGHBOURS + 1, 2, P, M), as in `LeadHarmonics`
    root_stress: Float[Array, "2 wave wave sector 2 point radius"]


class GearCompliance(NamedTuple):
    """Compliances of a gear's flanks in plane strain, for unit Young's modulus and width.

    Multiply by 1/(E b) for m/N. M positions along the flank, from the fillet to the tip.
    """

    radius: Float[Array, " radius"]  # (M,), distance of the positions from the axis, m, increasing
    #: (2, M), displacement, along the load, of the points at the depth and at twice the depth below a loaded
    #: position
    inside: Float[Array, "2 radius"]
    #: (2 NEIGHBOURS + 1, M, M); displacement at position i of the flank k − NEIGHBOURS pitches towards +y of
    #: the tooth's frame, the side of the loaded flank, per load at position j; infinite in truth for the
    #: tooth itself where i = j
    between: Float[Array, "sector radius radius"]
    depth: float  # depth below the surface to which `inside` refers, m
    #: loads that vary along the teeth, and root stress, where they were requested
    lead: LeadHarmonics | None = None
    #: with `lead`: that the end faces are free; without it they are planes of symmetry
    ends: FreeEnds | None = None


def at_radii(solved: Float[Array, " solved"], radius: Float[Array, "*pair"]) -> Float[Array, "*pair solved"]:
    """Weights (…, M) with which values at the radii solved count at others; beyond those at the nearest."""
    return CubicSpline(solved, np.eye(len(solved)))(np.clip(radius, solved[0], solved[-1]))


def without_neighbours(gear: GearCompliance) -> GearCompliance:
    """Return a gear whose teeth do not feel each other's loads, only their own."""
    itself = (np.arange(-NEIGHBOURS, NEIGHBOURS + 1) == 0)[:, None, None]
    lead = gear.lead and gear.lead._replace(between=itself * gear.lead.between)
    ends = gear.ends and gear.ends._replace(between=itself * gear.ends.between)
    return gear._replace(between=itself * gear.between, lead=lead, ends=ends)


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
    """Response of a gear solved with its `lead` to line loads cos kz, k ≥ 0 in rad/m.

    Beyond the largest wave number that was solved, `own` follows the half-space and the others are 0.
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
    even = k == 0.0
    value[even] += freed_of_depth(gear.inside, poisson_ratio) - freed_of_depth(lead.inside[0], poisson_ratio)
    between[even] += gear.between - lead.between[0]
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
