"""How an oil's viscosity rises with pressure at any temperature: laws that serve inlet and contact.

Each law gives ln(η/η0) over pressure p at a temperature T, η0 the viscosity at T and ambient pressure; η0
itself is the data sheet's. Two models of free volume, with the constants that papers on measured oils state:

    Yasutomi    ln η = const − ln 10 C1 x/(C2 + x),  x = (T − T_g) F,  T_g = T_g0 + A1 ln(1 + A2 p)
                F = (1 + b1 p)^b2 (improved: Bair, Mary, Bouscharain & Vergne 2013)
                F = 1 − b1 ln(1 + b2 p) (Yasutomi, Bair & Winer 1984)
    Doolittle   ln η = const + B R0 o/(V − R0 o),  o = 1 + ε (T − T_R),  V = [1 + a_V (T − T_R)] v
    with Tait   v = 1 − ln[1 + (1 + K') p/K_0]/(1 + K'),  K_0 = K_00 exp(−β_K T)

Beyond the glass transition, T < T_g, F stays what it is there, and Yasutomi's law goes on along its tangent.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import is_jax
from tribodyn.numerics.shapes import Array

_LN_10 = math.log(10.0)
#: Expansivity F of the law of 1984, over that at ambient pressure, at which it is held: it has no bound.
_LEAST_EXPANSION = 1e-3
#: Free volume over the volume at T_R at which it is held: ln η is beyond 500 there.
_LEAST_FREE = 5e-3
#: Pressure up to which η0/η is integrated, Pa: nothing is left of it there; panels, finer towards p = 0.
_ISOVISCOUS_END, _PANELS = 2e9, 40
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)

Rise = tuple[Array, Array, Array]


class Yasutomi(NamedTuple):
    """Constants of Yasutomi's law; K, Pa."""

    a1: float  # A1, K
    a2: float  # A2, 1/Pa
    b1: float  # of F: 1/Pa, of the law of 1984 a pure number
    b2: float  # of F: a pure number, of the law of 1984 1/Pa
    c1: float  # C1
    c2: float  # C2, K
    glass_temperature: float  # T_g0, at ambient pressure, K
    improved: bool = True  # which F

    def exponent(self, pressure: Array, temperature: Array) -> Rise:
        """Ln η less a constant, and its derivatives by pressure (1/Pa) and temperature (1/K)."""
        glass = self.glass_temperature + self.a1 * np.log1p(self.a2 * pressure)
        glass_slope = self.a1 * self.a2 / (1.0 + self.a2 * pressure)
        # beyond the transition F stays what it is there
        grown = np.exp((temperature - self.glass_temperature) / self.a1)
        transition = np.maximum(grown - 1.0, 0.0) / self.a2
        solid = pressure > transition
        share, share_slope = self._expansion(np.minimum(pressure, transition))
        above = temperature - glass
        place = above * share
        width = self.c2 + np.maximum(place, 0.0)
        slope = -_LN_10 * self.c1 * self.c2 / (width * width)
        by_pressure = np.where(solid, 0.0, above * share_slope) - glass_slope * share
        moving = np.where(solid & (transition > 0.0), grown / (self.a1 * self.a2), 0.0)
        by_heat = share + above * share_slope * moving
        return -_LN_10 * self.c1 * place / width, slope * by_pressure, slope * by_heat

    def _expansion(self, pressure: Array) -> tuple[Array, Array]:
        """F and its derivative by pressure, 1/Pa."""
        if self.improved:
            share = (1.0 + self.b1 * pressure) ** self.b2
            return share, self.b1 * self.b2 * share / (1.0 + self.b1 * pressure)
        share = 1.0 - self.b1 * np.log1p(self.b2 * pressure)
        held = share < _LEAST_EXPANSION
        slope = np.where(held, 0.0, -self.b1 * self.b2 / (1.0 + self.b2 * pressure))
        return np.maximum(share, _LEAST_EXPANSION), slope


class DoolittleTait(NamedTuple):
    """Constants of Doolittle's law with Tait's equation of state; K, Pa."""

    free_volume_factor: float  # B
    occupied_share: float  # R0, occupied volume over the volume at T_R
    occupied_expansion: float  # ε, 1/K
    reference_temperature: float  # T_R, K
    expansion: float  # a_V, 1/K
    bulk_modulus: float  # K_00, at 0 K, Pa
    bulk_modulus_decay: float  # β_K, 1/K
    bulk_modulus_slope: float  # K' = dK/dp at ambient pressure

    def exponent(self, pressure: Array, temperature: Array) -> Rise:
        """Ln η less a constant, and its derivatives by pressure (1/Pa) and temperature (1/K)."""
        warmer = temperature - self.reference_temperature
        occupied = self.occupied_share * (1.0 + self.occupied_expansion * warmer)
        modulus = self.bulk_modulus * np.exp(-self.bulk_modulus_decay * temperature)
        stiffer = 1.0 + self.bulk_modulus_slope
        share = 1.0 - np.log1p(stiffer * pressure / modulus) / stiffer
        grown = 1.0 + self.expansion * warmer
        free_volume = grown * share - occupied
        free = np.maximum(free_volume, _LEAST_FREE)
        held = free_volume < _LEAST_FREE
        by_pressure = -grown / (modulus + stiffer * pressure)
        by_heat = self.expansion * share + grown * -self.bulk_modulus_decay * pressure / (
            modulus + stiffer * pressure
        )
        occupied_slope = self.occupied_share * self.occupied_expansion
        value = self.free_volume_factor * occupied / free
        to_free = np.where(held, 0.0, -value / free)
        heat = to_free * (by_heat - occupied_slope) + self.free_volume_factor * occupied_slope / free
        return value, to_free * by_pressure, heat


MeasuredLaw = Yasutomi | DoolittleTait


class LawPart(NamedTuple):
    """A measured oil's law as a part of an oil's."""

    law: MeasuredLaw
    pressure_factor: float = 1.0  # s: the rise at p is the measured oil's at s p
    weight: float = 1.0  # share of the part in ln(η/η0)


class PressureLaw(NamedTuple):
    """ln(η/η0) of an oil, the weighted sum of its parts; at p = 0 it is zero at every temperature."""

    parts: tuple[LawPart, ...]
    temperature: float  # of the inlet, K

    def rise(self, pressure: Array, temperature: Array | float) -> Rise:
        """ln(η/η0) and its derivatives by pressure, 1/Pa, and temperature, 1/K."""
        total: list[Array] = [np.zeros(1), np.zeros(1), np.zeros(1)]
        warm = np.asarray(temperature, dtype=float)
        for law, factor, weight in self.parts:
            value, by_pressure, by_heat = law.exponent(factor * pressure, warm)
            ambient, _, ambient_heat = law.exponent(np.zeros_like(warm), warm)
            terms = value - ambient, factor * by_pressure, by_heat - ambient_heat
            total = [summed + weight * more for summed, more in zip(total, terms, strict=True)]
        return total[0], total[1], total[2]

    def softened(self, share: float) -> "PressureLaw":
        """The law with every pressure times a share."""
        parts = tuple(part._replace(pressure_factor=share * part.pressure_factor) for part in self.parts)
        return self._replace(parts=parts)


def asymptotic_coefficient(law: PressureLaw) -> float:
    """α* = 1/∫ η0/η dp over all pressures, at the law's temperature, 1/Pa.

    The reciprocal asymptotic isoviscous pressure (Blok 1963), which Bair, Liu & Wang (2006) take as the
    pressure-viscosity coefficient of film formulas. Of Barus' law it is α.
    """
    edges = _ISOVISCOUS_END * np.linspace(0.0, 1.0, _PANELS + 1) ** 3
    half = 0.5 * np.diff(edges)[:, None]
    pressure = edges[:-1, None] + half * (1.0 + _NODES)
    return float(1.0 / np.sum(half * _WEIGHTS * np.exp(-law.rise(pressure, law.temperature)[0])))


def with_coefficient(law: MeasuredLaw, temperature: float, coefficient: float) -> LawPart:
    """A measured oil's law over pressures such that its α* at a temperature is `coefficient` (1/Pa)."""
    coefficient_of_law = asymptotic_coefficient(PressureLaw((LawPart(law),), temperature))
    return LawPart(law, coefficient / coefficient_of_law)


class MeasuredViscosity(NamedTuple):
    """A measured oil's law, and the conditions up to which it was measured; K, Pa."""

    law: MeasuredLaw
    maximum_pressure: float
    minimum_temperature: float
    maximum_temperature: float

    def coefficient(self, temperature: Any) -> float:
        """α* at a temperature, 1/Pa; InputError where that is traced for a derivative."""
        if is_jax(temperature):
            rule = "has no derivative by the temperature: its α* is a quadrature"
            raise InputError("lubricant.viscosity_law", None, rule, "leave the law out, or use differences")
        return asymptotic_coefficient(PressureLaw((LawPart(self.law),), float(temperature)))
