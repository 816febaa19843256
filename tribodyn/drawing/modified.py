"""What modifications take off a drawn tooth: points of a flank turned about the axis, so that it is thinner.

A point at the radius R whose transverse normal passes the axis at r_w cos α moves by e √(1 + tan² β_n) along
that normal where it turns by e √(1 + tan² β_n)/(r_w cos α), e the amount along the normal of the flank: to
first order, as the amounts of both flanks open their gap. Radii stay, so that tips end on their circle. From
the flank to the root circle the fillet goes back to its own place.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import ToothOutline
from tribodyn.geometry.drive import Side, body_of
from tribodyn.geometry.flank_form import along_face, at_the_end, over_profile
from tribodyn.geometry.helix import normal_slope, pitch_slope
from tribodyn.geometry.modification import FlankModification, LeadRelief
from tribodyn.geometry.path import distance_at_radius, radius
from tribodyn.numerics.shapes import Array, Float

#: Places along a face at which the bend of a relief is looked for.
_FINE = 401


class Modified(NamedTuple):
    """How points of half a tooth or of an outline turn, rad; counter-clockwise > 0."""

    over_profile: Float[Array, " point"]  # everywhere along the face
    along_face: Float[Array, " point"]  # for each m that is missing along the face
    at_the_end: Float[Array, " point"]  # twist, at the end of the face; linear to its start
    lead: LeadRelief
    width: float  # of the face, m
    way: float  # +1: its start is at the most negative z of the drawing; −1: its end

    def turned(self, z: Float[Array, " height"]) -> Float[Array, "height point"]:
        """Of every point at heights, m from the middle of the face."""
        place = self.way * z[:, None]
        missing = along_face(self.lead, self.width, place)
        return self.over_profile + self.along_face * missing + self.at_the_end * (2.0 * place / self.width)

    def steps(self, reach: float, allowed: float) -> int:
        """Number of even steps along the face whose chords leave it by so much at most, m, so far out (m)."""
        z, step = np.linspace(-0.5, 0.5, _FINE, retstep=True)
        bend = np.abs(np.diff(self.turned(z * self.width), 2, axis=0)).max(initial=0.0) * reach / step**2
        return int(np.ceil(np.sqrt(bend / (8.0 * allowed))))


def modified(
    assembly: Assembly, side: Side, flank: FlankModification, shape: ToothOutline, way: float
) -> Modified:
    """Of the points of fillet and flank of half a tooth, the last of the one the first of the other."""
    path, to_pair = assembly.path_of(side), 1.0 if side == "pinion" else -1.0
    limits = sorted((to_pair * assembly.r_start, to_pair * assembly.r_end))
    within = sorted(float(radius(path, limit)) for limit in limits)
    reach = np.sign(float(path.pinion_pitch_radius)) * np.hypot(shape.flank_x, shape.flank_y)

    def place_at(out: Float[Array, " flank"]) -> Float[Array, " flank"]:
        return np.clip(distance_at_radius(path, np.clip(out, within[0], within[1])), limits[0], limits[1])

    place = place_at(reach)
    angle = path.pressure_angle(place)
    stretched, arm = (
        np.hypot(1.0, normal_slope(pitch_slope(assembly), angle)),
        abs(path.pinion_pitch_radius) * np.cos(angle),
    )
    # along its normal the flank comes from a little further out
    raised = stretched * over_profile(assembly, side, flank, to_pair * place)
    place = to_pair * place_at(reach + raised * np.sqrt(np.maximum(1.0 - (arm / reach) ** 2, 0.0)))
    each = stretched / arm
    share = np.linspace(0.0, 1.0, len(shape.fillet_x))[:-1]

    def whole(of_flank: Float[Array, " flank"]) -> Float[Array, " point"]:
        return np.append(share * of_flank[0], of_flank)

    return Modified(
        whole(each * over_profile(assembly, side, flank, place)),
        whole(each),
        whole(each * at_the_end(assembly, side, flank, place)),
        flank.lead,
        float(body_of(assembly.drive, side).face_width),
        way,
    )
