"""Thermal rating of a gearbox by ISO/TR 14179-1: one temperature, that of the sump, and one coefficient.

SI units; temperatures in K. The table of coefficients is from memory of the report.
"""

from collections.abc import Callable

from scipy.optimize import root_scalar

#: Air speed along the housing, m/s -> k, W/(m² K): large indoor space without a fan, then with one.
COEFFICIENTS = ((1.4, 15.0), (2.5, 15.0), (5.0, 24.0), (10.0, 42.0), (15.0, 58.0))


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


def thermal_rating(dissipated: float, without_load: float, with_load: float, power: float) -> float:
    """Return the power P_T, W, at which losses equal the heat dissipated at the limit of the sump.

    P_T = P (P_Q − P_N)/P_L: `without_load` P_N does not depend on the load, `with_load` P_L, the loss at the
    input power P, goes with it. 0 where the losses without load alone exceed what is dissipated.
    """
    return max(power * (dissipated - without_load) / with_load, 0.0)


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
