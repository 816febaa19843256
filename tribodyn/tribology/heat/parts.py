"""Conductances of the parts of a gearbox, and typical sizes where none are given. SI, temperatures in K."""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.tribology.heat.data import HousingHeat
from tribodyn.tribology.heat.network import ConductanceLaw
from tribodyn.tribology.heat.surfaces import (
    OIL_CONDUCTIVITY,
    housing_coefficient,
    plate_in_oil,
    ring,
    rotating_disc,
)
from tribodyn.tribology.oil import TEMPERATURE_RANGE, OilSheet, density_at, kinematic_viscosity, specific_heat

#: Oil in which nothing turns, W/(m² K): the least that Incropera & DeWitt, table 1.1, give for natural
#: convection in liquids.
STILL_OIL = 50.0
#: From splashed oil to the inner walls, W/(m² K): ISO/TR 14179-2 (from memory).
SPLASHED_WALL = 200.0
#: From bearings to their seats, W/(m² K): reference heat flow density 16 kW/m² of radial bearings, 50 K
#: above their surroundings, ISO 15312.
SEAT = 320.0
#: Bore, outside diameter and width over the mean diameter of a bearing of which no more is known: dimension
#: series 02 of ISO 15 (6210: 50 × 90 × 20 mm), and how much of their ring is solid (6210: 0.46 kg).
BEARING_SHAPE, BEARING_SOLID = (0.72, 1.28, 0.29), 0.67
#: Steel of shafts and bearings: density, kg/m³, specific heat, J/(kg K), conductivity, W/(m K). Incropera &
#: DeWitt, table A.1, plain carbon and low-alloy steel.
STEEL = (7850.0, 460.0, 45.0)
#: Diameter of a shaft over that of the root circle of its gear, where neither shaft nor bore is drawn: an
#: assumption.
SHAFT_DIAMETER = 0.5
#: Oil in the sump, where no volume is given, over the volume of a cube with the housing's area: an
#: assumption.
FILLING = 0.25


class HousingMaterial(NamedTuple):
    """Material of a housing: density, kg/m³, specific heat, J/(kg K), conductivity, W/(m K)."""

    density: float
    specific_heat: float
    conductivity: float


#: VDI Heat Atlas, section D6; aluminium: of casting alloys with 10 % silicon.
HOUSING_MATERIALS = {
    "cast-iron": HousingMaterial(7200.0, 540.0, 50.0),
    "aluminium": HousingMaterial(2680.0, 900.0, 150.0),
    "steel": HousingMaterial(*STEEL),
}


def side_of_cube(area: float) -> float:
    """Edge of a cube with this area, m: the height of a housing of which no more is known."""
    return math.sqrt(area / 6.0)


class OilHeat(NamedTuple):
    """An oil as heat transfer sees it; beyond the range of its sheet as at its end."""

    sheet: OilSheet

    def volumetric_heat(self, temperature: Any) -> Any:
        """ρ c, J/(m³ K)."""
        known, density = _known(temperature), self.sheet.density_15
        return density_at(density, known) * specific_heat(density, known)

    def film(self, temperature: Any) -> tuple[Any, Any]:
        """Kinematic viscosity ν, m²/s, and Prandtl number ν ρ c/λ."""
        known = _known(temperature)
        viscosity = kinematic_viscosity(self.sheet.viscosity_40, self.sheet.viscosity_100, known)
        return viscosity, viscosity * self.volumetric_heat(known) / OIL_CONDUCTIVITY


def _known(temperature: Any) -> Any:
    return np.clip(temperature, *TEMPERATURE_RANGE)


class GearDisc(NamedTuple):
    """A gear as heat sees it; lengths in m."""

    tip_radius: float
    root_radius: float
    bore_radius: float  # 0: it is one with its shaft
    width: float
    module: float  # transverse
    teeth: int  # > 0
    conductivity: float  # W/(m K)
    capacity: float  # J/K

    @property
    def surface(self) -> float:
        """Both sides and all flanks, m²; flanks as straight lines from root to tip, 20° inclined."""
        flanks = 2.0 * self.teeth * abs(self.tip_radius - self.root_radius) / math.cos(math.radians(20.0))
        sides = 2.0 * math.pi * abs(self.tip_radius**2 - self.bore_radius**2)
        return sides + flanks * self.width

    def to_shaft(self, shaft_radius: float) -> float:
        """Conductance from the root circle to the shaft, W/K: a ring as wide as the teeth."""
        inner = min(max(shaft_radius, self.bore_radius), 0.95 * self.root_radius)
        return ring(self.conductivity, self.width, inner, self.root_radius)


def gear_to_oil(surface: float, ratio: float, oil: OilHeat) -> ConductanceLaw:
    """From a gear that turns `ratio` times as fast as the input to the oil that wets all of it (Levich)."""

    def law(one: Any, two: Any, speed: float) -> Any:
        turning = rotating_disc(abs(speed * ratio), *oil.film(0.5 * (one + two)))
        return surface * np.hypot(turning, STILL_OIL)

    return law


class BearingRing(NamedTuple):
    """A bearing as heat sees it, m."""

    bore: float
    outside: float
    width: float

    @classmethod
    def typical(cls, mean_diameter: float) -> "BearingRing":
        """A bearing of which the mean diameter alone is known, m."""
        return cls(*(share * mean_diameter for share in BEARING_SHAPE))

    @property
    def capacity(self) -> float:
        """Of its steel, J/K."""
        section = math.pi / 4.0 * (self.outside**2 - self.bore**2)
        return BEARING_SOLID * section * self.width * STEEL[0] * STEEL[1]

    @property
    def mean_diameter(self) -> float:
        """Of bore and outside, m."""
        return 0.5 * (self.bore + self.outside)

    def to_seat(self, diameter: float) -> float:
        """Conductance to a seat of this diameter, m, W/K."""
        return SEAT * math.pi * diameter * self.width

    def to_oil(self, ratio: float, oil: OilHeat) -> ConductanceLaw:
        """From the bearing, whose shaft turns `ratio` times as fast as the input, to the oil (Harris)."""
        surface = 2.0 * math.pi * self.mean_diameter * self.width

        def law(one: Any, two: Any, speed: float) -> Any:
            along = abs(speed * ratio) * self.bore / 2.0 / 3.0
            flowing = plate_in_oil(along, self.mean_diameter, *oil.film(0.5 * (one + two)))
            return surface * np.hypot(flowing, STILL_OIL)

        return law


def wall_from_oil(housing: HousingHeat) -> float:
    """Conductance from the oil to the middle of the wall, W/K."""
    return housing.area / (1.0 / SPLASHED_WALL + 0.5 * housing.wall / housing.conductivity)


def housing_to_air(housing: HousingHeat) -> ConductanceLaw:
    """From the middle of the wall to air and surroundings."""
    half_wall = 0.5 * housing.wall / housing.conductivity

    def law(one: Any, two: Any, _speed: float) -> Any:
        outside = housing.coefficient
        if outside is None:
            outside = housing_coefficient(one, two, housing.height, housing.air_speed, housing.emissivity)
        return housing.area / (1.0 / np.asarray(outside) + half_wall)

    return law
