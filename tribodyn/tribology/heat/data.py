"""What a scenario says of the heat of a whole gearbox; SI, temperatures in K."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class HousingHeat:
    """A housing as heat sees it."""

    area: float  # of its outside, m²
    height: float  # m
    air_speed: float  # along it, m/s; 0: still air
    emissivity: float
    wall: float  # thickness, m
    conductivity: float  # of its material, W/(m K)
    capacity: float  # J/K
    coefficient: float | None = None  # of its outside, W/(m² K), in place of convection and radiation


@dataclass(frozen=True)
class CoolerData:
    """A cooler of the oil: conductance from oil to coolant, W/K, and temperature of the coolant, K."""

    conductance: float
    coolant_temperature: float


@dataclass(frozen=True)
class SettledTemperatures:
    """Temperatures of a gearbox in its thermal steady state, K, and its heat, W."""

    oil: float
    housing: float
    gears: tuple[tuple[float, float], ...]  # driving and driven gear of every mesh
    losses: tuple[float, ...]  # of the meshes to tooth friction, W
    heat: float  # of all losses, W
    given_off: float  # W
    parts: Mapping[str, float]  # of all nodes


@dataclass(frozen=True)
class GearboxHeatData:
    """Heat of a whole gearbox."""

    housing: HousingHeat
    ambient_temperature: float  # K
    oil_volume: float  # m³
    #: of the oil that enters with the flow; without a flow that at which the oil is held, K; None: a result
    oil_temperature: float | None = None
    oil_flow: float = 0.0  # volume flow that enters and leaves, m³/s
    cooler: CoolerData | None = None
    #: conductance from teeth to oil of gears by name, W/K, where it is given
    tooth_oil: Mapping[str, float] = field(default_factory=dict)
    sump_limit: float = 368.15  # for the thermal rating, K
    settled: SettledTemperatures | None = None  # None: not looked for yet
