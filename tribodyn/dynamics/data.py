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
    """How the drive is driven and loaded.

    Parameters
    ----------
    source : {"speed", "torque"}
        Prescribed pinion speed, or a torque source with inertia.
    pinion_speed : float
        Nominal speed ω_p, rad/s; with a torque source also the speed at the start.
    gear_torque : float
        T_g, the constant part of the load, N m.
    pinion_torque : float or None
        Torque of the source at nominal speed, N m; None: balances `gear_torque` without losses.
    drive_inertia : float
        Inertia of the source, kg m².
    shaft_stiffness : float or None
        Torsional stiffness of the shaft between source and pinion, N m/rad; None: rigid.
    shaft_damping : float
        Its damping, N m s/rad.
    speed_regulation : float
        The source's torque falls by this per rad/s above `pinion_speed`, N m s/rad.
    torque_table : Table or None
        Torque over time (s, N m) added to `gear_torque`; held constant before its first and after its last
        point.
    torque_harmonics : tuple of (float, float, float)
        (amplitude N m, angular frequency rad/s, phase rad) of cosines added to the load.
    load_inertia : float
        Inertia of the load, kg m², on the gear's shaft.
    load_damping : float
        Load torque that grows with speed above nominal gear speed, N m s/rad.
    """

    source: Literal["speed", "torque"]
    pinion_speed: float
    gear_torque: float
    pinion_torque: float | None = None
    drive_inertia: float = 0.0
    shaft_stiffness: float | None = None
    shaft_damping: float = 0.0
    speed_regulation: float = 0.0
    torque_table: Table | None = None
    torque_harmonics: tuple[tuple[float, float, float], ...] = ()
    load_inertia: float = 0.0
    load_damping: float = 0.0
