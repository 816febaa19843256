"""Shear across the film: mean stress, velocity, heat, and what they make of the flow in Reynolds' equation.

At a place x the film is cut into `LAYERS` of equal thickness, s from its middle. There the stress is
τ = τ_m + s dp/dx, the rate γ'(τ) by the law of shear, and

    u_1 − u_2 = ∫ γ' dz                       gives τ_m
    flow/ρ = u h − ∫ s γ' dz = u h + drift − dp/dx (flow by pressure)

The drift is what unequal layers make of sliding alone, dp/dx = 0; what a gradient adds to it is the flow by
pressure, h³/(12 η) dp/dx of a Newtonian isothermal fluid (Yang & Wen 1990, with the law's tangent).

A fluid at its limiting stress would yield to every gradient along the sliding, and no pressure could stand.
With that law the flow by pressure goes as if it went across the sliding, with the secant viscosity τ_m/γ',
and takes nothing from τ_m, which so never exceeds the limit. Nor does that law say where in the film it
slips: all layers have their mean viscosity.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.fluid import Rheology, newtonian_stress, stress_scale, thinned

LAYERS = 12
#: Middle of each layer over the thickness, from −½ at surface 2 to ½ at surface 1.
MIDDLE = (np.arange(LAYERS) + 0.5) / LAYERS - 0.5
_STEPS, _ACCURACY = 60, 1e-9
#: Of the Newtonian stress over the limiting one, beyond which the limit is reached to rounding.
_MOST_RATIO = 700.0
#: Mean stress, over that of the pressure gradient, that is rounding.
_NOTHING = 1e-6
#: Stress of the pressure gradient, over that of the law, up to which its flow is linear in it.
_LEVEL = 1e-3


class Shear(NamedTuple):
    """Shear at the nodes (x) or in the layers (x, layer), from surface 2 to surface 1; SI."""

    stress: Array  # τ_m, Pa (x)
    heat: Array  # ∫ τ γ' dz of each layer, W/m² (x, layer)
    velocity: Array  # mean of each layer, m/s (x, layer)
    fluidity: Array  # flow by pressure over −h³/12 dp/dx, 1/(Pa s) (x)
    drift: Array  # over u h (x)
    response: Array  # d ln τ_m/d ln η (x)
    newtonian: Array  # stress of a Newtonian fluid that flows as this one does at τ_m, Pa (x)


def sheared(
    film: Array,
    pressure: Array,
    gradient: Array,
    log_viscosity: Array,
    speeds: tuple[float, float],
    rheology: Rheology,
) -> Shear:
    """Solve for the shear.

    At nodes (x,) film h (m), pressure p (Pa), gradient dp/dx (Pa/m); ln of η in Pa s (x, layer); u_1, u_2.
    """
    sliding, entrained = speeds[0] - speeds[1], 0.5 * (speeds[0] + speeds[1])
    thickness = film[:, None] / LAYERS
    place = film[:, None] * MIDDLE
    slope = MIDDLE * (film * gradient)[:, None]
    if rheology.law == "limiting":
        return _limited(film, pressure, gradient, np.mean(log_viscosity, axis=1), speeds, rheology)
    fluid = np.exp(-log_viscosity)
    scale = stress_scale(pressure, rheology)[:, None]
    mean, rate, tangent, response = _mean_stress(sliding, thickness, slope, fluid, scale, rheology)
    level = rate, tangent
    if rheology.law != "newtonian":
        at_level = _mean_stress(sliding, thickness, np.zeros_like(slope), fluid, scale, rheology)
        level = at_level[1:3]
    t0, t1 = (np.sum(level[1] * weight * thickness, axis=1) for weight in (1.0, place))
    # exact for a fluidity that is constant in a layer
    inner = place**2 + thickness**2 / 12.0
    through = np.sum(level[1] * inner * thickness, axis=1) - t1 * t1 / t0
    if rheology.law == "newtonian":
        drift = -sliding * t1 / t0
    else:
        drift = -np.sum(level[0] * place * thickness, axis=1)
        steep = np.abs(gradient) * film > _LEVEL * scale[:, 0]
        flow = -np.sum((rate * place + tangent * gradient[:, None] * thickness**2 / 12.0) * thickness, axis=1)
        through = np.where(steep, (drift - flow) / np.where(steep, gradient, 1.0), through)
    passed = np.cumsum(rate * thickness, axis=1)
    return Shear(
        mean,
        rate * (mean[:, None] + slope) * thickness,
        speeds[1] + passed - 0.5 * rate * thickness,
        12.0 * through / film**3,
        drift / (film * entrained),
        response,
        newtonian_stress(mean, scale[:, 0], rheology)[0],
    )


def _limited(
    film: Array,
    pressure: Array,
    gradient: Array,
    log_viscosity: Array,
    speeds: tuple[float, float],
    rheology: Rheology,
) -> Shear:
    """Shear of a fluid with a limiting stress, in closed form; `log_viscosity` (x,) is the layers' mean."""
    sliding = speeds[0] - speeds[1]
    fluid, scale = np.exp(-log_viscosity), stress_scale(pressure, rheology)
    newtonian = sliding / (film * fluid)
    mean = thinned(newtonian, scale, rheology)
    size = np.minimum(np.abs(newtonian) / scale, _MOST_RATIO)
    resting = size < 1e-12
    size = np.where(resting, 1.0, size)
    # τ_L (1 − exp(−η γ'/τ_L)) over γ', and its logarithm by ln η
    fluidity = np.where(resting, fluid, sliding / film / np.where(resting, 1.0, mean))
    response = np.where(resting, 1.0, size / np.expm1(size))
    thickness = film[:, None] / LAYERS
    place = film[:, None] * MIDDLE
    yields = (fluidity * gradient)[:, None]
    rate = sliding / film[:, None] + yields * place
    worked = (mean * sliding / LAYERS)[:, None]
    heat = worked + yields * gradient[:, None] * (place**2 + thickness**2 / 12.0) * thickness
    velocity = speeds[1] + np.cumsum(rate * thickness, axis=1) - 0.5 * rate * thickness
    return Shear(mean, heat, velocity, fluidity, np.zeros_like(film), response, newtonian)


def _mean_stress(
    sliding: float, thickness: Array, slope: Array, fluid: Array, scale: Array, rheology: Rheology
) -> tuple[Array, Array, Array, Array]:
    """τ_m (x,), γ' and dγ'/dτ (x, layer), d ln τ_m/d ln η (x,): Newton's method on asinh of the speed."""
    whole = np.sum(fluid * thickness, axis=1)
    newtonian = (sliding - np.sum(fluid * slope * thickness, axis=1)) / whole
    mean = thinned(newtonian, scale[:, 0], rheology)
    unit = np.where(np.isfinite(scale[:, 0]), scale[:, 0], 1.0) * whole
    low = -np.abs(newtonian) - 2.0 * np.max(np.abs(slope), axis=1)
    high = -low
    target = np.arcsinh(sliding / unit)
    rate, tangent, speed, grown = _sheared_at(mean, thickness, slope, fluid, scale, rheology)
    for _ in range(0 if rheology.law == "newtonian" else _STEPS):
        missing = target - np.arcsinh(speed / unit)
        if np.all(np.abs(missing) <= _ACCURACY * np.maximum(np.abs(target), 1.0)):
            break
        low = np.where(missing > 0.0, mean, low)
        high = np.where(missing < 0.0, mean, high)
        moved = mean + missing * np.hypot(unit, speed) / grown
        mean = np.where((moved > low) & (moved < high), moved, 0.5 * (low + high))
        rate, tangent, speed, grown = _sheared_at(mean, thickness, slope, fluid, scale, rheology)
    # where nothing slides the mean stress is zero but for rounding
    rolling = np.abs(mean) <= _NOTHING * np.max(np.abs(slope), axis=1)
    response = np.where(rolling, 1.0, speed / np.where(rolling, 1.0, mean * grown))
    return mean, rate, tangent, np.clip(response, 0.0, 1.0)


def _sheared_at(
    mean: Array, thickness: Array, slope: Array, fluid: Array, scale: Array, rheology: Rheology
) -> tuple[Array, Array, Array, Array]:
    """γ', dγ'/dτ, and both over the film: sliding speed and its derivative, at a mean stress."""
    equal, tangent = newtonian_stress(mean[:, None] + slope, scale, rheology)
    rate, tangent = equal * fluid, tangent * fluid
    return rate, tangent, np.sum(rate * thickness, axis=1), np.sum(tangent * thickness, axis=1)
