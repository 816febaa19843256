"""Length of the lines of contact of a helical pair over the mesh cycle: all pairs, over the common face.

A section of the face at z touches where a spur pair late by z tan β_w/r_w does (`helix`). The line of one
pair is the sum over the sections that are on the path of contact, each with the line's length per width.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import line_stretch, pitch_slope
from tribodyn.numerics.shapes import Array, Float

#: Points of the path between which the length per width is taken as linear; one of an involute is constant.
_POINTS = 2001
#: Phases at which lengths are compared, beside those at which lines reach the ends of path and face.
_PHASES = 1000


class ContactLines(NamedTuple):
    """Sum of the lengths of all lines of contact over the mesh cycle, m."""

    mean: float
    minimum: float
    maximum: float


def contact_line_lengths(assembly: Assembly, phase: Float[Array, " phase"]) -> Float[Array, " phase"]:
    """Sum of the lengths of all lines of contact, m, at phases of the mesh; of helical teeth, plain numbers.

    The phase, in pitches, counts from where a pair comes into contact in the middle of the face.
    """
    pitch, half = float(assembly.pitch_angle), _roll_over_face(assembly) / 2.0
    roll, summed = _stretched_roll(assembly)
    pairs = np.arange(-np.ceil(half / pitch) - 1, np.ceil((roll[-1] - roll[0] + half) / pitch) + 1)
    middle = roll[0] + (np.asarray(phase)[..., None] % 1.0 + pairs) * pitch
    late, early = (np.interp(middle + offset, roll, summed) for offset in (half, -half))
    return (late - early).sum(axis=-1) * float(assembly.common_width) / (2.0 * half)


def contact_lines(assembly: Assembly) -> ContactLines:
    """Mean, minimum and maximum of the lines' length over the mesh cycle, of helical teeth.

    Of an involute, with s = p_bt/sin β_b and e the fractions of both ratios: s ε_α ε_β = b ε_α/cos β_b,
    s [ε_α ε_β − e_α e_β + max(0, e_α + e_β − 1)], s [ε_α ε_β − e_α e_β + min(e_α, e_β)].
    """
    half = _roll_over_face(assembly) / 2.0 / float(assembly.pitch_angle)
    ratio = float(assembly.contact_ratio)
    # where a line reaches or leaves an end, its length has a corner: there lie the extremes of an involute
    corners = np.array([half, -half, ratio + half, ratio - half])
    lengths = contact_line_lengths(assembly, np.concatenate([corners, np.arange(_PHASES) / _PHASES]))
    _, summed = _stretched_roll(assembly)
    mean = float(assembly.common_width * summed[-1] / assembly.pitch_angle)
    return ContactLines(mean, float(lengths.min()), float(lengths.max()))


def _stretched_roll(assembly: Assembly) -> tuple[Float[Array, " roll"], Float[Array, " roll"]]:
    """Pinion angles along the path, rad, and the integral over them of the line's length per width."""
    start, end = map(float, assembly.roll_limits)
    roll = np.linspace(start, end, _POINTS)
    stretch = line_stretch(pitch_slope(assembly), assembly.path, assembly.path.signed_distance(roll))
    steps = np.diff(roll) * (stretch[1:] + stretch[:-1]) / 2.0
    return roll, np.concatenate([[0.0], np.cumsum(steps)])


def _roll_over_face(assembly: Assembly) -> float:
    """Pinion angle, rad, by which one end of the common face is late after the other."""
    slope = abs(float(pitch_slope(assembly)))
    return float(assembly.common_width) * slope / float(assembly.path.pinion_pitch_radius)
