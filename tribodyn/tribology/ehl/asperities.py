"""Rough surfaces: pressure of the asperities, mean gap and flow between them."""

import math
from typing import NamedTuple

import numpy as np
from scipy.special import ndtr

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.values import not_negative, positive

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(48)
#: Separations over σ below which the asperities count as pressed flat.
_FLAT = -6.0


class Roughness(NamedTuple):
    """Two rough surfaces as one, pressed on a smooth one."""

    height: float  # σ, rms of both surfaces together, m
    #: σ β n, height times radius times number per area of the asperities; 0.03 … 0.05 of ground steel
    #: (Greenwood & Tripp 1970)
    density: float = 0.05
    slope: float = 0.01  # σ/β
    friction: float = 0.12  # f_c, friction coefficient of the asperities


def check(roughness: Roughness) -> None:
    """Raise InputError at the first value that is not positive."""
    names = {"height": "roughness", "density": "asperity_density", "slope": "asperity_slope"}
    for name, key in names.items():
        positive(key, getattr(roughness, name), remedy="leave the roughness out for smooth surfaces")
    not_negative("asperity_friction", roughness.friction, remedy="0.08 … 0.15 of steel")


def asperity_pressure(gap: Array, roughness: Roughness, modulus: float) -> tuple[Array, Array]:
    """Mean pressure of the asperities at gaps h (m), Pa, and its derivative by h, Pa/m.

    p_a = 16√2/15 π (σ β n)² √(σ/β) E'/2 F_5/2(h/σ), F_m(t) = ∫_t^∞ (s − t)^m exp(−s²/2) ds/√(2π): Greenwood &
    Tripp (1970), whose modulus is half of E'.
    """
    factor = 16.0 * math.sqrt(2.0) / 15.0 * math.pi * roughness.density**2 * math.sqrt(roughness.slope)
    factor *= 0.5 * modulus
    ratio = np.maximum(gap / roughness.height, _FLAT)
    value, slope = _overlap(ratio)
    # below `_FLAT` straight on
    below = np.minimum(gap / roughness.height - ratio, 0.0)
    return factor * (value + slope * below), factor * slope / roughness.height


def _overlap(ratio: Array) -> tuple[Array, Array]:
    """F_5/2 and its derivative −5/2 F_3/2, by Gauss' quadrature in the root of s − t."""
    reach = np.sqrt(9.0 + np.maximum(-ratio, 0.0))[:, None]
    root = 0.5 * reach * (_NODES + 1.0)
    square = root * root
    weight = 0.5 * reach * _WEIGHTS * np.exp(-0.5 * (square + ratio[:, None]) ** 2) * 2.0 * root**4
    weight /= math.sqrt(2.0 * math.pi)
    return np.sum(weight * square, axis=1), -2.5 * np.sum(weight, axis=1)


def mean_gap(gap: Array, roughness: Roughness) -> tuple[Array, Array]:
    """Mean distance h_T of two rough surfaces that do not overlap, m, and its derivative by the nominal gap.

    h_T = h Φ(h/σ) + σ φ(h/σ) of Gaussian heights (Patir & Cheng 1978); h_T = h of thick films.
    """
    ratio = gap / roughness.height
    share = ndtr(ratio)
    normal = np.exp(-0.5 * np.minimum(ratio * ratio, 1400.0)) / math.sqrt(2.0 * math.pi)
    # of rough surfaces pressed together the tail itself, so that no film vanishes
    return np.maximum(gap * share + roughness.height * normal, 1e-12 * roughness.height), share


def pressure_flow_factor(mean: Array, roughness: Roughness) -> tuple[Array, Array]:
    """φ_x = 1 − 0.90 exp(−0.56 h/σ) of isotropic surfaces (Patir & Cheng 1978), and its derivative, 1/m."""
    part = 0.90 * np.exp(-0.56 * mean / roughness.height)
    return 1.0 - part, 0.56 / roughness.height * part
