"""What the formulas of the friction of rolling bearings take and return, and the methods by name."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.loss import OilState

BALLS = ("deep-groove-ball", "angular-contact-ball", "four-point-contact-ball", "self-aligning-ball")
#: Those that are built with two rows; their factors are of both.
DOUBLE = ("four-point-contact-ball", "self-aligning-ball", "spherical-roller")


@dataclass(frozen=True)
class BearingInOil:
    """Rolling bearings of a shaft, alike, as formulas of their friction need them; SI, None: not known."""

    type: str
    mean_diameter: float  # d_m = (bore + outside)/2
    count: int = 1
    rows: int = 1  # single rows that a pair is made of
    both_ways: bool = False  # whether a pair takes thrust both ways: O and X
    contact_angle: float = 0.0  # nominal, rad
    static_rating: float | None = None  # C_0 of the whole bearing or pair, N
    #: X_0, Y_0 of P_0 = max(X_0 F_r + Y_0 F_a, F_r), ISO 76
    static_factors: tuple[float, float] = (1.0, 0.0)
    drag_factor: float | None = None  # f_0; None: that of the type
    series: str = ""  # of dimensions, as catalogues name it; "": the method's usual one
    #: sizes of the bearing, m
    bore: float | None = None
    outside_diameter: float | None = None
    width: float | None = None
    #: of an oil bath: height of the oil above the outer raceway's lowest point, m, and the factor V_M that
    #: the maker's diagram has for it; 0: none
    oil_level: float = 0.0
    bath_factor: float = 0.0
    seal: str = ""  # contact seals on both sides, by the maker's name
    seal_diameter: float = 0.0  # of their counterface, m


class BearingTorque(NamedTuple):
    """Torques of all bearings alike against the rotation, N m, finite at speed 0; limits exceeded."""

    idle: Float[Array, "..."]  # without load
    loaded: Float[Array, "..."]  # what the load adds
    exceeded: tuple[str, ...] = ()


#: Of bearings, speed (rad/s, at least 0), oil, radial and axial force of each (N, at least 0).
BearingFormula = Callable[
    [BearingInOil, Float[Array, "..."], OilState, Float[Array, "..."], Float[Array, "..."]], BearingTorque
]
