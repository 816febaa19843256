"""How fast a sheared fluid flows: Newton, Eyring, limiting shear stress, Carreau; arrays in, arrays out."""

from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError, unknown_name
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.values import positive

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


def check(rheology: Rheology) -> None:
    """Raise InputError at an unknown law or a constant that is not positive."""
    if not isinstance(rheology.law, str) or rheology.law not in LAWS:
        raise unknown_name("rheology", str(rheology.law), LAWS, "law of shear")
    for name in LAWS[rheology.law]:
        positive(name, getattr(rheology, name), remedy=f'law "{rheology.law}" reads it')
    if rheology.law == "carreau" and rheology.carreau_index > 1.0:
        raise InputError("carreau_index", rheology.carreau_index, "thickens with shear", "give n ≤ 1")


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
