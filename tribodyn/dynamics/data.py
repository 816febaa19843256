"""What a case says of shafts, bearings, drive and load, in SI units."""

from dataclasses import dataclass
from typing import Literal

from tribodyn.numerics.curve import Table


@dataclass(frozen=True)
class BearingData:
    """Shaft and bearing of one gear: stiffness (N/m) and damping ratio of each axis (x: pitch tangent)."""

    stiffness_x: float
    stiffness_y: float
    damping_ratio_x: float
    damping_ratio_y: float


@dataclass(frozen=True)
class OperatingData:
    """How the drive is driven and loaded."""

    source: Literal["speed", "torque"]  # prescribed pinion speed, or a torque source with inertia
    pinion_speed: float  # nominal speed ω_p, rad/s; with a torque source also the speed at the start
    gear_torque: float  # T_g, the constant part of the load, N m
    #: of the source at nominal speed, N m; None: balances `gear_torque` without losses
    pinion_torque: float | None = None
    drive_inertia: float = 0.0  # of the source, kg m²
    #: shaft_stiffness, shaft_damping: of the shaft between source and pinion, N m/rad (None: rigid), N m
    #: s/rad
    shaft_stiffness: float | None = None
    shaft_damping: float = 0.0
    speed_regulation: float = 0.0  # fall of the source's torque per speed above `pinion_speed`, N m s/rad
    #: torque over time (s, N m) added to `gear_torque`; constant before and after its points
    torque_table: Table | None = None
    #: (amplitude N m, angular frequency rad/s, phase rad) of cosines added to the load
    torque_harmonics: tuple[tuple[float, float, float], ...] = ()
    load_inertia: float = 0.0  # on the gear's shaft, kg m²
    load_damping: float = 0.0  # load torque per gear speed above nominal, N m s/rad
