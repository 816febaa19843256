"""The fluid: viscosity and density under pressure, and how fast it flows sheared; arrays in, arrays out."""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.oil import ROELANDS_POLE, ROELANDS_PRESSURE
from tribodyn.tribology.pressure_law import PressureLaw

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
    #: takes the place of Roelands' law; `pressure_viscosity` is then its α*
    law: PressureLaw | None = None

    def softened(self, share: float) -> "Fluid":
        """The fluid with a share of its pressure-viscosity coefficient."""
        law = self.law.softened(share) if self.law is not None else None
        return self._replace(pressure_viscosity=share * self.pressure_viscosity, law=law)


def log_viscosity(pressure: Array, fluid: Fluid) -> tuple[Array, Array]:
    """ln(η/η0) and its derivative by pressure, 1/Pa.

    Roelands: ln(η/η0) = α p_r/z [(1 + p/p_r)^z − 1], whose slope at p = 0 is α for every z.
    """
    z = fluid.viscosity_pressure_index
    if fluid.law is not None:
        exponent, slope, _ = fluid.law.rise(pressure, fluid.law.temperature)
    elif z == 1.0:
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
    the oil below exp(−A). Barus' law: ln(η/η0) = α p − K_T Θ. With a `PressureLaw` this holds of ambient
    pressure, A = ln η0 + 9.67, and its rise at the higher temperature is added.
    """
    if fluid.law is not None:
        hotter, _, by_heat = fluid.law.rise(pressure, fluid.law.temperature + rise)
        pole = math.log(fluid.viscosity) + ROELANDS_POLE
        thinner = np.exp(-coefficient / pole * rise)
        logarithm = np.clip(hotter, 0.0, MAXIMUM_LOG_VISCOSITY) + pole * (thinner - 1.0)
        return logarithm, by_heat - coefficient * thinner
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


#: Of Newton's method for Carreau's rate, which begins within a factor of 2.
_CARREAU_STEPS = 8
#: Of τ/τ_0: e^600 is more than any sliding speed asks for.
_MOST_EYRING = 600.0


class Rheology(NamedTuple):
    """Law of shear and its constants, of which a law reads its own."""

    law: str = "newtonian"  # "newtonian", "eyring", "limiting" or "carreau"
    eyring_stress: float = 5e6  # τ_0, Pa: γ' = τ_0/η sinh(τ/τ_0)
    #: limiting_coefficient, limiting_floor: Λ and τ_00 (Pa) of the limiting shear stress τ_L = τ_00 + Λ p: γ'
    #: = −τ_L/η ln(1 − |τ|/τ_L) (Bair & Winer 1979)
    limiting_coefficient: float = 0.05
    limiting_floor: float = 2e6
    #: carreau_modulus, carreau_index: G (Pa) and n: τ = η γ' [1 + (η γ'/G)²]^((n − 1)/2) (Bair 2007)
    carreau_modulus: float = 5e6
    carreau_index: float = 0.5


#: Law -> names of the constants that it reads; each must be positive.
LAWS: dict[str, tuple[str, ...]] = {
    "newtonian": (),
    "eyring": ("eyring_stress",),
    "limiting": ("limiting_coefficient", "limiting_floor"),
    "carreau": ("carreau_modulus", "carreau_index"),
}


def stress_scale(pressure: Array, rheology: Rheology) -> Array:
    """Stress at which a fluid departs from Newton's law, Pa; infinite if it never does."""
    if rheology.law == "eyring":
        return np.full_like(pressure, rheology.eyring_stress)
    if rheology.law == "limiting":
        return rheology.limiting_floor + rheology.limiting_coefficient * pressure
    if rheology.law == "carreau":
        return np.full_like(pressure, rheology.carreau_modulus)
    return np.full_like(pressure, np.inf)


def thinned(newtonian: Array, scale: Array, rheology: Rheology) -> Array:
    """Stress at a rate at which a Newtonian fluid of the same viscosity has the stress `newtonian`."""
    if rheology.law == "newtonian":
        return newtonian
    ratio = newtonian / scale
    if rheology.law == "eyring":
        return scale * np.arcsinh(ratio)
    if rheology.law == "limiting":
        return scale * np.sign(ratio) * -np.expm1(-np.abs(ratio))
    return newtonian * (1.0 + ratio * ratio) ** (0.5 * (rheology.carreau_index - 1.0))


def newtonian_stress(stress: Array, scale: Array, rheology: Rheology) -> tuple[Array, Array]:
    """η γ', the inverse of `thinned`, and its derivative by the stress.

    Not of a limiting stress, which no number of digits tells from the stresses just below it.
    """
    if rheology.law == "newtonian":
        return stress, np.ones_like(stress)
    ratio = stress / scale
    if rheology.law == "eyring":
        clipped = np.clip(ratio, -_MOST_EYRING, _MOST_EYRING)
        return scale * np.sinh(clipped), np.cosh(clipped)
    size = np.abs(ratio)
    index = rheology.carreau_index
    rate = np.maximum(size, np.maximum(size, 1e-300) ** (1.0 / index))
    for _ in range(_CARREAU_STEPS):
        square = rate * rate
        share = square / (1.0 + square)
        excess = np.log(np.maximum(rate, 1e-300)) - np.log(np.maximum(size, 1e-300))
        excess += 0.5 * (index - 1.0) * np.log1p(square)
        rate = rate * np.exp(-excess / (1.0 + (index - 1.0) * share))
    square = rate * rate
    slope = (1.0 + square) ** (0.5 * (1.0 - index)) / (1.0 + (index - 1.0) * square / (1.0 + square))
    return scale * np.sign(ratio) * rate, slope
