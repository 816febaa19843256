"""Load contact model: which pairs touch, and how they share the load, from finite elements and Hertz.

The pairs j that can touch have

    ξ cos α_j − g_j = Σ_k λ_jk F_k + u_1(F_j) + u_2(F_j),   F_j ≥ 0,
    Σ F_j [H_gj ± μ_j L_gj] = T_g   (− before the pitch point),

with ξ = r_p θ_p − r_g θ_g, the gap g of the tips' corners outside the path of contact, the compliances λ of
both gears in plane strain (own: below the surface; of neighbours: through the body) and Weber-Banaschek's
deflection u between there and the surface (A. Diez-Ibarbia et al.; A. Fernández del Rincón et al., Mech.
Mach. Theory 61 (2013) 30). Face width, material and load are the same along the teeth.
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

from tribodyn.compliance.fem_cache import cached_gear_compliance
from tribodyn.compliance.gear_compliance import NEIGHBOURS, GearCompliance
from tribodyn.compliance.local import (
    Elastic,
    freed_of_depth,
    hertz_half_width,
    weber_banaschek,
    weber_banaschek_slope,
)
from tribodyn.errors import SimulationError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry, pair_geometry
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.geometry.pitch_point import pitch_point
from tribodyn.tribology.contact import averaged_radius

Array = Any

#: Depth of the local region, in modules, and refinement of the mesh: together within 0.1 % of their limits
#: (test_load_contact).
DEPTH = 0.25
LEVEL = 2

_STEPS = 60
_SETTLED = 1e-11
# Load, as a share of the mean, at which a pair that just touches is linearised: the contact's deflection
# goes like F ln(1/F) and has no slope at 0.
_LEAST_LOAD = 1e-7


class PairFlexibility(NamedTuple):
    """Elasticity of both gears of a drive; see `flexibility`.

    Attributes
    ----------
    assembly : Assembly
    materials : (Elastic, Elastic)
    width : float
        Common face width, m.
    gears : (GearCompliance, GearCompliance)
    """

    assembly: Assembly
    materials: tuple[Elastic, Elastic]
    width: float
    gears: tuple[GearCompliance, GearCompliance]


class SharedLoad(NamedTuple):
    """State of the mesh; arrays over (position, pair) unless said otherwise.

    Attributes
    ----------
    normal_load : N, ≥ 0
    deflection : (position,)
        ξ = r_p θ_p − r_g θ_g, m.
    overlap : m
        ξ cos α − g less what the other pairs' loads deflect: what a pair's own load takes up where it is
        positive; the distance still open where negative.
    contact_deflection : m
        u_1 + u_2.
    """

    normal_load: Array
    deflection: Array
    overlap: Array
    contact_deflection: Array


def flexibility(
    assembly: Assembly,
    materials: tuple[Elastic, Elastic],
    depth: float = DEPTH,
    level: int = LEVEL,
    lead: bool = False,
) -> PairFlexibility:
    """Finite elements of both gears, from the cache where they have been solved before.

    Parameters
    ----------
    assembly : Assembly
        The drive put together; checked (`geometry.checks`), bores > 0.
    materials : (Elastic, Elastic)
        Of pinion and gear.
    depth : float
        Of the local region, modules.
    level : int
        Refinement of the mesh.
    lead : bool
        Also for loads that vary along the teeth, and with root stress.
    """
    drive = assembly.drive
    gears = [
        cached_gear_compliance(
            assembly.tooth(side),
            round(float(body_of(drive, side).teeth)),
            float(body_of(drive, side).bore_radius),
            material.poisson_ratio,
            depth * float(drive.module),
            level,
            lead,
        )
        for side, material in zip(SIDES, materials, strict=True)
    ]
    width = min(float(drive.pinion.face_width), float(drive.gear.face_width))
    return PairFlexibility(assembly, materials, width, (gears[0], gears[1]))


def own_compliance(flexible: PairFlexibility, geometry: PairGeometry) -> Array:
    """λ_jj, m/N: both gears, from the bores to the local regions' depth; shaped like the geometry."""
    total = np.zeros_like(geometry.gap)
    reaches = geometry.pinion_radius, geometry.gear_radius
    for gear, material, reach in zip(flexible.gears, flexible.materials, reaches, strict=True):
        curve = CubicSpline(gear.radius, freed_of_depth(gear.inside, material.poisson_ratio))
        at = np.clip(reach, gear.radius[0], gear.radius[-1])
        total += curve(at) / (material.youngs_modulus * flexible.width)
    return total


def neighbour_compliance(flexible: PairFlexibility, geometry: PairGeometry) -> Array:
    """λ_jk (position, pair, pair) of different pairs, m/N, zero on the diagonal.

    The pairs stand one pitch apart in the last axis of the geometry, the one that entered first in front.
    """
    count = geometry.gap.shape[-1]
    matrix = np.zeros((*geometry.gap.shape, count))
    reaches = geometry.pinion_radius, geometry.gear_radius
    # On the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other.
    for gear, material, reach, sign in zip(flexible.gears, flexible.materials, reaches, (1, -1), strict=True):
        at = np.clip(reach, gear.radius[0], gear.radius[-1])
        for pitches in range(1, min(count - 1, NEIGHBOURS) + 1):
            surface = RectBivariateSpline(gear.radius, gear.radius, gear.between[NEIGHBOURS + sign * pitches])
            for later in range(pitches, count):
                earlier = later - pitches
                value = surface.ev(at[..., earlier], at[..., later])
                value = value / (material.youngs_modulus * flexible.width)
                matrix[..., earlier, later] += value
                matrix[..., later, earlier] += value
    return matrix


def contact_deflection(flexible: PairFlexibility, geometry: PairGeometry, load: Array) -> tuple[Array, Array]:
    """Local deflection u_1 + u_2 (m) under the normal loads (N ≥ 0), and its derivative, m/N."""
    line_load = load / flexible.width
    # Where the flanks' radii vanish, at the pitch point of a cycloid, the contact's own width sees more of
    # them. The slope is not quite Newton's there; the steps still settle.
    modulus = 2.0 / sum((1.0 - m.poisson_ratio**2) / m.youngs_modulus for m in flexible.materials)
    vanishing = pitch_point(flexible.assembly.path).length
    radius = averaged_radius(1.0 / geometry.motion.relative_curvature, line_load, modulus, vanishing)
    half = hertz_half_width(line_load, 1.0 / radius, *flexible.materials)
    total, slope = np.zeros_like(load), np.zeros_like(load)
    for gear, material in zip(flexible.gears, flexible.materials, strict=True):
        total += weber_banaschek(line_load, half, gear.depth, material)
        slope += weber_banaschek_slope(line_load, half, gear.depth, material) / flexible.width
    return total, slope


def share_load(
    flexible: PairFlexibility,
    roll: Array,
    gear_torque: float,
    friction_coefficient: Array | float = 0.0,
    gap: Array | float = 0.0,
) -> SharedLoad:
    """Share the gear's torque among the pairs that can touch.

    Parameters
    ----------
    flexible : PairFlexibility
    roll : (position, pair)
        Pinion angles of the pairs from the pitch point, rad, one pitch apart, the pair that entered first
        in front; enough of them on either side of the path for all that the load can make touch.
    gear_torque : float
        T_g > 0, N m.
    friction_coefficient : float or (position, pair)
        μ of the pairs.
    gap : float or (position, pair)
        What is missing between the flanks beside the corners' gap, m: errors and modifications.

    Raises
    ------
    SimulationError
        If no state of contact is found.
    """
    geometry = pair_geometry(flexible.assembly, roll)
    matrix = neighbour_compliance(flexible, geometry)
    matrix += np.eye(roll.shape[1]) * own_compliance(flexible, geometry)[..., None]
    arm = np.cos(geometry.motion.pressure_angle)
    side = np.sign(geometry.motion.signed_distance)
    lever = geometry.motion.gear_normal_arm + (
        side * friction_coefficient * geometry.motion.gear_friction_arm
    )
    return _solve(flexible, geometry, matrix, arm, lever, geometry.gap + gap, gear_torque)


def _solve(
    flexible: PairFlexibility,
    geometry: PairGeometry,
    matrix: Array,
    arm: Array,
    lever: Array,
    gap: Array,
    torque: float,
) -> SharedLoad:
    """Newton's method with an active set: one linear system of the pairs' loads and ξ a position and step."""
    positions, pairs = gap.shape
    mean = torque / float(np.max(lever))
    active = gap <= np.min(gap, axis=-1, keepdims=True) + 1e-12
    load = active * mean / np.sum(active, axis=-1, keepdims=True)
    system = np.zeros((positions, pairs + 1, pairs + 1))
    right = np.zeros((positions, pairs + 1))
    # ξ in units of the deflection that the mean load makes, to keep the systems well conditioned
    unit = mean * float(np.mean(np.einsum("...ii->...i", matrix)))
    change = np.inf
    for _ in range(_STEPS):
        at = np.maximum(load, _LEAST_LOAD * mean)
        value, slope = contact_deflection(flexible, geometry, at)
        own = matrix + np.eye(pairs) * slope[..., None]
        both = active[..., :, None] & active[..., None, :]
        apart = np.eye(pairs) * ~active[..., None]
        system[:, :pairs, :pairs] = np.where(both, own * mean / unit, 0.0) + apart
        system[:, :pairs, pairs] = np.where(active, -arm, 0.0)
        system[:, pairs, :pairs] = active * lever * mean / torque
        right[:, :pairs] = np.where(active, slope * at - gap - value, 0.0) / unit
        right[:, pairs] = 1.0
        solution = np.linalg.solve(system, right[..., None])[..., 0]
        found = active * solution[:, :pairs] * mean
        deflection = solution[:, pairs] * unit
        overlap = deflection[:, None] * arm - gap - np.einsum("...ij,...j->...i", matrix, found)
        overlap += np.einsum("...ii->...i", matrix) * found
        touching = np.where(active, found > 0.0, overlap > 0.0)
        # a torque must be carried by something: where all let go, the closest pair holds on
        none = ~np.any(touching, axis=-1)
        touching[none] = gap[none] <= np.min(gap[none], axis=-1, keepdims=True)
        change = np.max(np.abs(found - load)) / mean
        settled = change < _SETTLED and bool(np.all(touching == active))
        load, active = np.maximum(found, 0.0), touching
        if settled:
            value, _ = contact_deflection(flexible, geometry, load)
            return SharedLoad(load, deflection, overlap, value)
    raise SimulationError(
        f"the load contact model does not settle: loads still move by {change:.1e} of the mean"
    )


def extended_rolls(assembly: Assembly, limits: tuple[float, float], positions: int) -> Array:
    """Roll angles (position, pair) over one pitch of all pairs between the limits, for `share_load`."""
    pitch = 2.0 * np.pi / float(assembly.drive.pinion.teeth)
    count = int(np.ceil((limits[1] - limits[0]) / pitch))
    phase = (np.arange(positions) + 0.5) / positions
    return limits[0] + pitch * (phase[:, None] + np.arange(count - 1, -1, -1))


def effective_contact_ratio(roll: Array, shared: SharedLoad, pitch: float) -> float:
    """Pinion angle over which one pair carries load, over the pitch.

    `roll` (position, pair) covers one pair's whole history once, as made by `extended_rolls`. Both ends are
    where the overlap passes zero, interpolated.
    """
    order: Any = np.argsort(roll, axis=None)
    angle, overlap = roll.ravel()[order], shared.overlap.ravel()[order]
    inside = np.flatnonzero(overlap > 0.0)
    ends = []
    for here, there in ((inside[0], inside[0] - 1), (inside[-1], inside[-1] + 1)):
        share = overlap[here] / (overlap[here] - overlap[there])
        ends.append(angle[here] + share * (angle[there] - angle[here]))
    return float((ends[1] - ends[0]) / pitch)
