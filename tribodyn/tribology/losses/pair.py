"""The load-independent losses that a pair of gears asks for."""

from collections.abc import Iterable
from dataclasses import dataclass

from tribodyn.tribology.losses.bearings import BearingInOil
from tribodyn.tribology.losses.churning import CHURNING
from tribodyn.tribology.losses.loss import Loss, OilState, Sump, Torque, Wheel
from tribodyn.tribology.losses.methods import BEARING_METHODS
from tribodyn.tribology.losses.windage import WINDAGE


@dataclass(frozen=True)
class LossData:
    """Which load-independent losses a case requests; None: not requested."""

    churning: str | None = None  # of CHURNING
    windage: str | None = None  # of WINDAGE
    bearings: str | None = None  # of BEARING_METHODS
    #: pinion_immersion, gear_immersion: depth of each tip circle's lowest point below the oil's level, m
    pinion_immersion: float = 0.0
    gear_immersion: float = 0.0
    oil_volume: float | None = None  # in the sump, m³
    #: (BearingInOil or None, the same), of the pinion's and the gear's shaft
    drag: tuple[BearingInOil | None, BearingInOil | None] = (None, None)
    #: of a mesh of several: which of both gears it counts, and bearings of shafts with their speeds, rad/s
    counted: tuple[bool, bool] = (True, True)
    further: tuple[tuple[BearingInOil, float], ...] = ()


def losses_of_pair(
    data: LossData, wheels: tuple[Wheel, Wheel], speeds: tuple[float, float], oil: OilState
) -> dict[str, Loss]:
    """Return the requested losses of pinion and gear by name: `churning`, `windage`, `bearings`.

    Speeds are those of the gears, rad/s; the oil is that which surrounds them.
    """
    losses: dict[str, Loss] = {}
    turning = list(zip(wheels, speeds, strict=True))
    if data.churning is not None:
        churning, sump = CHURNING[data.churning], Sump(data.oil_volume or 0.0)
        dipping = [(wheel, speed) for wheel, speed in turning if wheel.immersion > 0.0]
        losses["churning"] = _sum((churning(wheel, speed, oil, sump), speed) for wheel, speed in dipping)
    if data.windage is not None:
        windage = WINDAGE[data.windage]
        counted = [each for each, is_counted in zip(turning, data.counted, strict=True) if is_counted]
        losses["windage"] = _sum((windage(wheel, speed), speed) for wheel, speed in counted)
    if data.bearings is not None:
        formula = BEARING_METHODS[data.bearings].formula
        shafts = (*zip(data.drag, speeds, strict=True), *data.further)
        found = [(formula(held, speed, oil, 0.0, 0.0), speed) for held, speed in shafts if held is not None]
        losses["bearings"] = _sum((Torque(each.idle, each.exceeded), speed) for each, speed in found)
    return losses


def _sum(parts: Iterable[tuple[Torque, float]]) -> Loss:
    """Sum of the powers of torques at their speeds, rad/s."""
    every = list(parts)
    exceeded = dict.fromkeys(limit for torque, _ in every for limit in torque.exceeded)
    return Loss(float(sum(torque.torque * speed for torque, speed in every)), tuple(exceeded))
