"""The load-independent losses that a pair of gears asks for."""

from collections.abc import Iterable
from dataclasses import dataclass

from tribodyn.tribology.losses.bearings import BearingDragData, palmgren
from tribodyn.tribology.losses.churning import changenet_velex, iso_14179_1
from tribodyn.tribology.losses.loss import Loss, Wheel
from tribodyn.tribology.losses.windage import anderson_loewenthal, dawson


@dataclass(frozen=True)
class LossData:
    """Which load-independent losses a case requests; None: not requested."""

    churning: str | None = None  # "changenet-velex" or "iso-14179-1"
    windage: str | None = None  # "dawson" or "anderson-loewenthal"
    bearings: str | None = None  # "palmgren"
    #: pinion_immersion, gear_immersion: depth of each tip circle's lowest point below the oil's level, m
    pinion_immersion: float = 0.0
    gear_immersion: float = 0.0
    oil_volume: float | None = None  # in the sump, m³
    #: (BearingDragData or None, the same), of the pinion's and the gear's shaft
    drag: tuple[BearingDragData | None, BearingDragData | None] = (None, None)
    #: of a mesh of several: which of both gears it counts, and bearings of shafts with their speeds, rad/s
    counted: tuple[bool, bool] = (True, True)
    further: tuple[tuple[BearingDragData, float], ...] = ()


def losses_of_pair(
    data: LossData, wheels: tuple[Wheel, Wheel], viscosity: float, density: float
) -> dict[str, Loss]:
    """Return the requested losses of pinion and gear by name: `churning`, `windage`, `bearings`.

    Viscosity (dynamic, Pa·s) and density (kg/m³) are those of the oil that surrounds the gears.
    """
    losses: dict[str, Loss] = {}
    dipping = [wheel for wheel in wheels if wheel.immersion > 0.0]
    if data.churning == "changenet-velex":
        volume = data.oil_volume or 0.0
        losses["churning"] = _sum(changenet_velex(wheel, viscosity, density, volume) for wheel in dipping)
    elif data.churning is not None:
        losses["churning"] = _sum(iso_14179_1(wheel, viscosity, density) for wheel in dipping)
    if data.windage is not None:
        windage = {"dawson": dawson, "anderson-loewenthal": anderson_loewenthal}[data.windage]
        counted = [wheel for wheel, is_counted in zip(wheels, data.counted, strict=True) if is_counted]
        losses["windage"] = _sum(map(windage, counted))
    if data.bearings is not None:
        turning = [(drag, wheel.speed) for wheel, drag in zip(wheels, data.drag, strict=True)]
        losses["bearings"] = _sum(
            palmgren(drag, speed, viscosity, density)
            for drag, speed in (*turning, *data.further)
            if drag is not None
        )
    return losses


def _sum(losses: Iterable[Loss]) -> Loss:
    parts = list(losses)
    exceeded = dict.fromkeys(limit for part in parts for limit in part.exceeded)
    return Loss(sum(part.power for part in parts), tuple(exceeded))
