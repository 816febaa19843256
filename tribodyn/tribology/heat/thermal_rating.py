"""Thermal rating of a gearbox by ISO/TR 14179-1: one temperature, that of the sump, and one coefficient.

SI units; temperatures in K. The table of coefficients is from memory of the report.
"""

import math
from collections.abc import Callable

from scipy.optimize import root_scalar

#: Air speed along the housing, m/s -> k, W/(m² K): large indoor space without a fan, then with one.
COEFFICIENTS = ((1.4, 15.0), (2.5, 15.0), (5.0, 24.0), (10.0, 42.0), (15.0, 58.0))

#: Loads that are tried for a rating, at most, and how near two are that are the same.
MOST_LOADS, SAME_LOAD = 30, 1e-6


def heat_transfer_coefficient(air_speed: float) -> float:
    """Return k of a housing, W/(m² K), by the speed of the air, m/s: linear between the table's values."""
    low = COEFFICIENTS[0]
    if air_speed <= low[0]:
        return low[1]
    for high in COEFFICIENTS[1:]:
        if air_speed <= high[0]:
            return low[1] + (high[1] - low[1]) * (air_speed - low[0]) / (high[0] - low[0])
        low = high
    return low[1]


def heat_dissipated(coefficient: float, area: float, sump: float, ambient: float) -> float:
    """Return P_Q = k A (θ_s − θ_a), W."""
    return coefficient * area * (sump - ambient)


def rated_load(losses: Callable[[float], tuple[float, float]], dissipated: float) -> float:
    """Return the load, over that of the duty, at which losses equal the heat dissipated at the sump's limit.

    `losses` are those that do not go with the load and those that do, W, at a load; their sum rises with it.
    0 where the former alone exceed what is dissipated; infinite where nothing goes with the load.
    """
    load = 1.0
    for _ in range(MOST_LOADS):
        without, loaded = losses(load)
        if without >= dissipated:
            return 0.0
        if loaded <= 0.0:
            return math.inf
        before, load = load, load * (dissipated - without) / loaded
        if abs(load - before) <= SAME_LOAD * load:
            break
    return load


def sump_temperature(
    loss: Callable[[float], float], conductance: float, ambient: float, bounds: tuple[float, float]
) -> float | None:
    """Return θ_s with k A (θ_s − θ_a) = P_V(θ_s), K; `loss` in W, `conductance` k A in W/K.

    None: not within the bounds, K.
    """

    def left(sump: float) -> float:
        return conductance * (sump - ambient) - loss(sump)

    low = max(ambient, bounds[0])
    if left(low) > 0.0 or left(bounds[1]) < 0.0:
        return None
    return float(root_scalar(left, bracket=(low, bounds[1]), method="brentq", xtol=1e-6).root)
