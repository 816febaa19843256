"""What the formulas of losses take of a gear, and what they return."""

from typing import NamedTuple


class Wheel(NamedTuple):
    """A gear; SI."""

    speed: float  # rad/s, > 0
    #: pitch_radius, tip_radius, root_radius: m
    pitch_radius: float
    tip_radius: float
    root_radius: float
    face_width: float  # m
    module: float  # transverse, m
    teeth: float
    #: depth of the tip circle's lowest point below the oil's level at rest, m; 0: not immersed
    immersion: float = 0.0
    helix_angle: float = 0.0  # β on the reference circle, rad, ≥ 0


class Loss(NamedTuple):
    """Power of a loss, W, and in words which limits of the formula's range are exceeded."""

    power: float
    exceeded: tuple[str, ...] = ()
