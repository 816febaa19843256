"""The section in which a tooth is elastic: of helical involutes the normal one, of others the transverse one.

The helix lies in the flank, so that the normal load of a helical tooth lies in the section across the helix:
on a length b/cos β the tooth is a straight one of that section, with the normal module and as high as in the
transverse section. The transverse section in its stead would be too stiff, in bending by up to 1/cos⁴ β: the
tooth is thicker there by 1/cos β, and cannot give way along the axis. The body is the ring with the virtual
number of teeth z/(cos² β_b cos β), rounded, and with the same ratio of root to bore radius.

Of other families, whose rack has no normal section, the transverse section stands for the tooth, and the
load's transverse part for the load.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.corner_contact import PairGeometry, pair_geometry
from tribodyn.geometry.drive import SIDES, Drive, Side, body_of, reference_radius
from tribodyn.geometry.helix import (
    base_helix_angle,
    curvature_share,
    line_stretch,
    normal_section,
    normal_slope,
    pitch_slope,
)
from tribodyn.numerics.shapes import Array, Float


def is_helical(assembly: Assembly) -> bool:
    """Whether teeth are helical; plain numbers."""
    return float(assembly.drive.helix_angle) != 0.0


def by_normal_section(assembly: Assembly) -> bool:
    """Whether the teeth are elastic in their normal section."""
    return is_helical(assembly) and assembly.family.involute


def length_per_width(assembly: Assembly) -> float:
    """Length of a tooth of the elastic section per width of the face: 1/cos β of the normal section."""
    return 1.0 / math.cos(float(assembly.drive.helix_angle)) if by_normal_section(assembly) else 1.0


def elastic_section(assembly: Assembly) -> Assembly:
    """Spur gears whose teeth are those of the section; lengths in m."""
    if not by_normal_section(assembly):
        return assembly
    drive = assembly.drive
    straight = normal_section(drive)
    base = float(base_helix_angle(drive))
    virtual = 1.0 / (math.cos(base) ** 2 * math.cos(float(drive.helix_angle)))
    bodies: dict[str, Any] = {}
    for side in SIDES:
        body = body_of(straight, side)
        teeth = round(float(body.teeth) * virtual)
        moved = float(straight.module) * teeth / 2.0 - float(reference_radius(drive, side))
        root = float(assembly.tooth(side).root_radius)
        tip = None if body.tip_radius is None else body.tip_radius + moved
        bore = body.bore_radius * (root + moved) / root
        bodies[side] = body._replace(teeth=teeth, tip_radius=tip, bore_radius=bore)
    section: Drive = straight._replace(helix_angle=0.0, centre_distance=None, **bodies)
    return assemble(assembly.family, section)


def raised(assembly: Assembly, section: Assembly, side: Side) -> float:
    """By how much radii (m) in the section are greater than the gear's at the same height of a tooth."""
    return float(reference_radius(section.drive, side)) - float(reference_radius(assembly.drive, side))


class ObliqueFaces(NamedTuple):
    """Slices at their own angles; arrays (position, pair, slice)."""

    geometry: PairGeometry  # in the transverse plane
    arm: Float[Array, "position pair slice"]  # cos α cos β_n: approach along the normal per ξ
    lever: Float[Array, "position pair slice"]  # torque on the gear per load, friction included, m
    curvature: Float[Array, "position pair slice"]  # relative, across the line of contact, 1/m
    length: Float[Array, "position pair slice"]  # of the line of contact per width of the face
    corner_gap: Float[Array, "position pair slice"]  # along the normal, m
    #: part of the load in the elastic section, and of that section's deflection along the normal
    within: Float[Array, "position pair slice"]

    def at(self, rows: slice) -> tuple[Float[Array, "position pair slice"], ...]:
        """Radii (m) of pinion and gear and `within`, at some positions."""
        return self.geometry.pinion_radius[rows], self.geometry.gear_radius[rows], self.within[rows]


def oblique_faces(
    assembly: Assembly,
    roll: Float[Array, "position pair slice"],
    friction_coefficient: Float[Array, "..."] | float = 0.0,
) -> ObliqueFaces:
    """Find the slices' contacts at the pinion's angles `roll`, rad; beyond the path as at its ends.

    Friction acts in the transverse plane; its coefficient is that of pairs (position, pair) or one for all.
    """
    geometry = pair_geometry(assembly, roll)
    motion, path, slope = geometry.motion, assembly.path, pitch_slope(assembly)
    friction = np.asarray(friction_coefficient, dtype=float)
    friction = friction[..., None] if friction.ndim == 2 else friction
    r = np.clip(motion.signed_distance, assembly.r_start, assembly.r_end)
    cosine = 1.0 / np.hypot(1.0, normal_slope(slope, motion.pressure_angle))
    side = np.sign(motion.signed_distance)
    return ObliqueFaces(
        geometry=geometry,
        arm=np.cos(motion.pressure_angle) * cosine,
        lever=motion.gear_normal_arm * cosine + side * friction * motion.gear_friction_arm,
        curvature=motion.relative_curvature * curvature_share(slope, path, r),
        length=line_stretch(slope, path, r),
        corner_gap=geometry.gap * cosine,
        within=np.ones_like(cosine) if by_normal_section(assembly) else cosine,
    )
