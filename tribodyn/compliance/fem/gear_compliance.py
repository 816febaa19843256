"""Compliance of the flanks of one gear: the result of its finite elements, without them."""

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from tribodyn.numerics.shapes import Array, Float

#: Teeth on either side whose compliances are kept: as many pairs as can touch beside the loaded one.
NEIGHBOURS = 2


class LeadHarmonics(NamedTuple):
    """Response of a gear to line loads cos kz along its teeth, for unit Young's modulus; amplitudes.

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
    """Return a gear whose teeth do not feel each other's loads."""
    lead = gear.lead and gear.lead._replace(between=0.0 * gear.lead.between)
    ends = gear.ends and gear.ends._replace(between=0.0 * gear.ends.between)
    return gear._replace(between=0.0 * gear.between, lead=lead, ends=ends)
