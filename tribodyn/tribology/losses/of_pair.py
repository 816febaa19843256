"""Load-independent losses of a pair of gears: which formulas a case asks for, and what they give."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from tribodyn.tribology.losses.bearing_drag import ShaftBearings, palmgren
from tribodyn.tribology.losses.churning import changenet_velex, iso_14179_1
from tribodyn.tribology.losses.wheel import Loss, Wheel
from tribodyn.tribology.losses.windage import anderson_loewenthal, dawson


class Formula(NamedTuple):
    """A published formula: what it is, its range in words, and what it takes beside the gears and the oil."""

    about: str
    range: str
    needs_oil_volume: bool = False


CHURNING = {
    "changenet-velex": Formula(
        "Changenet & Velex (2007)", "a single spur gear immersed at most to its axis", True
    ),
    "iso-14179-1": Formula("ISO/TR 14179-1:2001", "module of at least 1 mm"),
}
WINDAGE = {
    "dawson": Formula("Dawson (1984)", "root diameter 300 to 1160 mm, free air"),
    "anderson-loewenthal": Formula("Anderson & Loewenthal (1980)", "spur gears with solid bodies, air"),
}
BEARINGS = {"palmgren": Formula("Palmgren, as Harris gives it", "rolling bearings in an oil bath")}


@dataclass(frozen=True)
class BearingDragData:
    """Bearings of a shaft: mean diameter (m), factor f_0, number."""

    mean_diameter: float
    drag_factor: float
    count: int


@dataclass(frozen=True)
class LossData:
    """Which load-independent losses a case asks for; None: not asked for.

    Parameters
    ----------
    churning, windage, bearings : names of formulas: `CHURNING`, `WINDAGE`, `BEARINGS`
    pinion_immersion, gear_immersion : depth of each tip circle's lowest point below the oil's level, m
    oil_volume : in the sump, m³
    drag : (BearingDragData or None, the same), of the pinion's and the gear's shaft
    """

    churning: str | None = None
    windage: str | None = None
    bearings: str | None = None
    pinion_immersion: float = 0.0
    gear_immersion: float = 0.0
    oil_volume: float | None = None
    drag: tuple[BearingDragData | None, BearingDragData | None] = (None, None)


def losses_of_pair(
    asked: LossData, wheels: tuple[Wheel, Wheel], viscosity: float, density: float
) -> dict[str, Loss]:
    """Return the losses asked for by name: `churning`, `windage`, `bearings`.

    Parameters
    ----------
    wheels : pinion and gear, with their immersion
    viscosity, density : dynamic, of the oil that surrounds the gears, Pa·s; kg/m³
    """
    found: dict[str, Loss] = {}
    if asked.churning is not None:
        volume = asked.oil_volume or 0.0
        churn: dict[str, Callable[[Wheel], Loss]] = {
            "changenet-velex": lambda wheel: changenet_velex(wheel, viscosity, density, volume),
            "iso-14179-1": lambda wheel: iso_14179_1(wheel, viscosity, density),
        }
        found["churning"] = _sum([churn[asked.churning](one) for one in wheels if one.immersion > 0.0])
    if asked.windage is not None:
        blow = {"dawson": dawson, "anderson-loewenthal": anderson_loewenthal}[asked.windage]
        found["windage"] = _sum([blow(one) for one in wheels])
    if asked.bearings is not None:
        shafts = [
            ShaftBearings(wheel.speed, one.mean_diameter, one.drag_factor, one.count)
            for wheel, one in zip(wheels, asked.drag, strict=True)
            if one is not None
        ]
        found["bearings"] = _sum([palmgren(one, viscosity, density) for one in shafts])
    return found


def _sum(parts: list[Loss]) -> Loss:
    exceeded = dict.fromkeys(limit for one in parts for limit in one.exceeded)
    return Loss(sum(one.power for one in parts), tuple(exceeded))
