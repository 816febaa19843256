"""What the formulas read of a gear that turns in oil or air, and what they give."""

from typing import NamedTuple


class Wheel(NamedTuple):
    """A gear; SI.

    Attributes
    ----------
    speed : rad/s, > 0
    pitch_radius, tip_radius, root_radius : m
    face_width : m
    module : m
    immersion : depth of the tip circle's lowest point below the oil's level at rest, m; 0: not immersed
    """

    speed: float
    pitch_radius: float
    tip_radius: float
    root_radius: float
    face_width: float
    module: float
    teeth: float
    immersion: float = 0.0


class Loss(NamedTuple):
    """Power of a loss, W, and in words which limits of the formula's range are exceeded."""

    power: float
    exceeded: tuple[str, ...] = ()
