"""An oil pump that a shaft of the gearbox drives."""

import math
from dataclasses import dataclass

from tribodyn.tribology.losses.loss import Torque


@dataclass(frozen=True)
class PumpData:
    """A positive-displacement pump; one of displacement and flow is given."""

    pressure: float  # that it raises the oil's by, Pa
    displacement: float | None = None  # a revolution of the pump, m³
    flow: float | None = None  # at the shaft's nominal speed, m³/s
    efficiency: float = 0.8  # of volume and torque together, 0 to 1
    ratio: float = 1.0  # speed of the pump over that of its shaft


def pump_torque(pump: PumpData, nominal_speed: float) -> Torque:
    """T = p V/(2 π η) times the ratio, at the shaft that drives it; V = 2 π Q/ω of a flow Q.

    It does not depend on the speed: a relief valve, which would open, is not in it. `nominal_speed` is that
    of the shaft, rad/s; the flow is that at this speed.
    """
    if pump.displacement is not None:
        delivered = pump.displacement / (2.0 * math.pi) * pump.ratio
    else:
        delivered = (pump.flow or 0.0) / nominal_speed
    return Torque(pump.pressure * delivered / pump.efficiency)
