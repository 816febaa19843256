"""Slices of helical teeth in contact: directions, lines of contact, curvature across them."""

from typing import NamedTuple

import numpy as np

from tribodyn.compliance.sharing.section import by_normal_section
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry, pair_geometry
from tribodyn.geometry.helix import curvature_share, line_stretch, normal_slope, pitch_slope
from tribodyn.numerics.shapes import Array, Float


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
