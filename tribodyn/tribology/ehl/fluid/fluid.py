"""Viscosity and density of the fluid under pressure, with their derivatives; arrays in, arrays out."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.oil import ROELANDS_PRESSURE

#: Dowson & Higginson (1966): ρ/ρ0 = 1 + 0.6e-9 p/(1 + 1.7e-9 p), p in Pa.
DENSITY_RISE, DENSITY_SATURATION = 0.6e-9, 1.7e-9
#: Bound of ln(η/η0): beyond, Reynolds' equation is ρ h = const to more digits than floats have.
MAXIMUM_LOG_VISCOSITY = 600.0


class Fluid(NamedTuple):
    """How viscosity and density follow pressure."""

    viscosity: float  # η0, Pa·s, at ambient pressure and inlet temperature
    pressure_viscosity: float  # α, d ln η/dp at ambient pressure, 1/Pa
    viscosity_pressure_index: float = 1.0  # z of Roelands' law; 1 is Barus' law, ln(η/η0) = α p
    compressible: bool = True  # whether density follows Dowson & Higginson; else it is constant


def log_viscosity(pressure: Array, fluid: Fluid) -> tuple[Array, Array]:
    """ln(η/η0) and its derivative by pressure, 1/Pa.

    Roelands: ln(η/η0) = α p_r/z [(1 + p/p_r)^z − 1], whose slope at p = 0 is α for every z.
    """
    z = fluid.viscosity_pressure_index
    if z == 1.0:
        exponent = fluid.pressure_viscosity * pressure
        slope = np.full_like(pressure, fluid.pressure_viscosity)
    else:
        factor = fluid.pressure_viscosity * ROELANDS_PRESSURE / z
        base = np.log1p(pressure / ROELANDS_PRESSURE)
        rise = np.expm1(z * base)
        exponent = factor * rise
        slope = fluid.pressure_viscosity * (1.0 + rise) / (1.0 + pressure / ROELANDS_PRESSURE)
    beyond = exponent > MAXIMUM_LOG_VISCOSITY
    return np.where(beyond, MAXIMUM_LOG_VISCOSITY, exponent), np.where(beyond, 0.0, slope)


def hot_log_viscosity(pressure: Array, rise: Array, fluid: Fluid, coefficient: float) -> tuple[Array, Array]:
    """ln(η/η0) at temperatures above the inlet's (K), and its derivative by them, −1/K.

    Roelands' law over pressure and temperature, ln(η/η0) = A [(1 + p/p_r)^z exp(−K_T Θ/A) − 1] with
    A = α p_r/z: the coefficient K_T = −d ln η/dT at ambient pressure grows with pressure, and no heat thins
    the oil below exp(−A). Barus' law: ln(η/η0) = α p − K_T Θ.
    """
    cold, _ = log_viscosity(pressure, fluid)
    if fluid.viscosity_pressure_index == 1.0 or fluid.pressure_viscosity == 0.0:
        return cold - coefficient * rise, np.full_like(cold + rise, -coefficient)
    factor = fluid.pressure_viscosity * ROELANDS_PRESSURE / fluid.viscosity_pressure_index
    thicker = (cold + factor) * np.exp(-coefficient / factor * rise)
    return thicker - factor, -coefficient / factor * thicker


def relative_density(pressure: Array, fluid: Fluid) -> tuple[Array, Array]:
    """ρ/ρ0 and its derivative by pressure, 1/Pa."""
    if not fluid.compressible:
        return np.ones_like(pressure), np.zeros_like(pressure)
    below = 1.0 / (1.0 + DENSITY_SATURATION * pressure)
    return 1.0 + DENSITY_RISE * pressure * below, DENSITY_RISE * below * below
