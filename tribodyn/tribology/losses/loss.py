"""What the formulas of losses take of oil and gears, and what they return.

Speeds, viscosities, densities and forces may be arrays over points of operation; torques then are too.
"""

import math
from typing import NamedTuple

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.oil import LubricantData

#: rad/s of one revolution per minute.
RPM = math.pi / 30.0


class OilState(NamedTuple):
    """Oil at its temperature."""

    viscosity: Float[Array, "..."]  # dynamic, Pa s
    density: Float[Array, "..."]  # kg/m³
    synthetic: bool = False

    @property
    def kinematic(self) -> Float[Array, "..."]:
        """Kinematic viscosity, mm²/s."""
        return 1e6 * self.viscosity / self.density


def oil_state(oil: LubricantData) -> OilState:
    """A lubricant at the temperature that its numbers are of."""
    kind = oil.type if oil.sheet is None else oil.sheet.type
    return OilState(oil.inlet_viscosity, oil.density, kind not in (None, "mineral"))


class Wheel(NamedTuple):
    """A gear; SI."""

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
    pressure_angle: float = 0.0  # transverse, rad


class Sump(NamedTuple):
    """The oil's space; 0: not known, and not read."""

    volume: float = 0.0  # of oil, m³
    hydraulic_length: float = 0.0  # four times the area of the housing's section over its circumference, m


class Torque(NamedTuple):
    """Torque against the rotation of a shaft, N m, finite at speed 0; limits that some point exceeds."""

    torque: Float[Array, "..."]
    exceeded: tuple[str, ...] = ()


class Loss(NamedTuple):
    """Power of a loss, W, and in words which limits of the formula's range are exceeded."""

    power: float
    exceeded: tuple[str, ...] = ()
