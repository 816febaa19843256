"""Deflection of two flanks next to their contact: Weber and Banaschek's depth-limited Hertz deflection.

The finite-element model knows the contact's load only as a point. Its displacement is therefore read below
the surface, where that makes no difference, and what lies between there and the surface is put back by the
half-plane under Hertz's pressure.
"""

import numpy as np

from tribodyn.geometry.drive import MaterialData
from tribodyn.numerics.shapes import Array, Float


def hertz_half_width(
    line_load: Float[Array, "..."], curvature: Float[Array, "..."], first: MaterialData, second: MaterialData
) -> Float[Array, "..."]:
    """Half width of the contact, m: L = √(4/π Σ(1 − ν²)/E q/κ), κ = 1/χ1 + 1/χ2 (Diez-Ibarbia et al. (13)).

    The line load q is in N/m, the relative curvature κ in 1/m.
    """
    softness = sum((1.0 - m.poisson_ratio**2) / m.youngs_modulus for m in (first, second))
    return np.sqrt(4.0 / np.pi * softness * line_load / curvature)


def weber_banaschek(
    line_load: Float[Array, "..."], half_width: Float[Array, "..."], depth: float, material: MaterialData
) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
    """Approach of the surface to the point `depth` below it in a half-plane under Hertz's pressure, m.

    u = 2 (1 − ν²) q/(π E) {ln[t + √(1 + t²)] − ν/(1 − ν) t² [√(1 + 1/t²) − 1]}, t = depth/half width, in
    plane strain, q ≥ 0 in N/m; the half width of the contact (m) is 0 only where q is. Diez-Ibarbia et al.
    (12) print √(1 + t²) in the last root too, which grows without bound. Beside it the derivative by the line
    load, with whose root the half width grows, m per N/m.
    """
    nu = material.poisson_ratio
    t = depth / np.maximum(half_width, 1e-12 * depth)
    rise = np.sqrt(1.0 + t**2)
    # t² (√(1 + 1/t²) − 1) without cancellation for t → ∞, where it is 1/2
    shape = np.arcsinh(t) - nu / (1.0 - nu) * (t / (rise + t))
    # d/dt of both terms; t goes like q^(−1/2)
    steeper = 1.0 / rise - nu / (1.0 - nu) * (1.0 / rise) / (rise + t) ** 2
    softness = 2.0 * (1.0 - nu**2) / (np.pi * material.youngs_modulus)
    return softness * line_load * shape, softness * (shape - 0.5 * t * steeper)


def freed_of_depth(inside: Float[Array, " 2 *load"], poisson_ratio: float) -> Float[Array, "*load"]:
    """Displacement at the depth h corrected by what the tooth, other than a half-plane, does above it.

    A half-plane under a point load has u(h) − u(2h) = 2 (1 − ν²)/(π E) q ln 2. What the tooth has more than
    that between 2h and h it has again, to first order, between h and the surface. With this the sum of FE and
    local deflection no longer depends on h (error of second order). `inside` (2, …) are displacements at the
    depths h and 2h per unit line load, for unit Young's modulus.
    """
    return 2.0 * inside[0] - inside[1] - 2.0 * (1.0 - poisson_ratio**2) / np.pi * np.log(2.0)
