"""Friction of radial shaft seals: a torque that does not depend on the speed."""

from collections.abc import Callable
from dataclasses import dataclass

from tribodyn.tribology.losses.loss import RPM, OilState, Torque


@dataclass(frozen=True)
class SealData:
    """Radial lip seals of a shaft, alike."""

    diameter: float  # of the shaft under the lip, m
    count: int = 1
    material: str = "nbr"  # "nbr" or "fkm"


def iso_14179_2(seals: SealData, oil: OilState) -> Torque:
    """P_VD = 7.69e-6 d² n W with d in mm, n in rpm: ISO/TR 14179-2:2001; mineral oil."""
    diameter = 1e3 * seals.diameter
    outside = ("mineral oil",) if oil.synthetic else ()
    return Torque(seals.count * 7.69e-6 / RPM * diameter**2, outside)


#: Torque over shaft diameter, N m/mm: ISO/TR 14179-1:2001, Buna N and Viton (from memory).
LIP_FRICTION = {"nbr": 2.429e-3, "fkm": 3.737e-3}


def iso_14179_1(seals: SealData, oil: OilState) -> Torque:
    """T = c d, c by the material of the lip (`LIP_FRICTION`): ISO/TR 14179-1:2001."""
    return Torque(seals.count * LIP_FRICTION[seals.material] * 1e3 * seals.diameter)


#: Methods by the names that a scenario has.
SEALS: dict[str, Callable[[SealData, OilState], Torque]] = {
    "iso-14179-2": iso_14179_2,
    "iso-14179-1": iso_14179_1,
}
