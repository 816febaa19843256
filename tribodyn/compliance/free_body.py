"""A ring that nothing but its inertia holds: orders 0 and 1 of a load, which turn and shift it as a whole.

The bore keeps its shape, as on a shaft, and hands on neither torque nor force: those of the load are balanced
by the d'Alembert force of every particle, and displacements count from the ring's mean rotation and mean
shift, weighted by inertia (inertia relief). So a body's compliance has no more in it than its elasticity: it
tends to a limit as the bore vanishes, while that of a ring held at its bore grows without bound.

With x = (bore/radius)², ν Poisson's ratio, κ = (3 − ν)/(1 + ν) of plane stress, 2 G = 1, and tractions on the
circle r = 1:

Order 0. The shear τ is handed on as the torque τ (r⁴ − x²)/(1 − x²), which twists the ring by τ/r³ times that
per radius. By the work of both, the circle turns against the mean rotation by

    ∫ (r⁴ − x²)²/(1 − x²)² dr/r³ from the bore to 1 = (1 − x)(1 + 3x)/(3 (1 + x)²) · 1/2,

of a solid disc θ = T/(12π G b a²); the ring held at its bore has 1/x − 1 in place of twice this.

Order 1. Of a radial traction t_r cos θ and a tangential one t_θ sin θ the force per π is q = t_r − t_θ; the
body force p = −q/(1 − x) balances it. With the displacement (radial cos θ, tangential sin θ)

    u = P r² (1, −1) + c_1 (2κ ln r − 1, −2κ ln r − 1) + c_2 r² (κ − 2, κ + 2) − c_3 r⁻² (1, 1) + c_4 (1, −1),

P = −p (κ − 1)/(2κ) balances p, no force at the bore gives c_1, its shape, u_r + u_θ = 0, c_3, the tractions
give c_2, and the mean of the displacement over the area is 0 (J. R. Barber, Elasticity, ch. 7 to 9).

Teeth are a ring of half the density from root to tip, that moves with the root circle. Where the share s of
the inertia is the ring's, they take the rest of torque and force before the ring does, and the mean counts
them in: order 0 has the factor s², order 1 the factor 1 − (1 − s)/2 (1, −1)ᵀ(1, −1) on both sides.
"""

from typing import Any

import numpy as np

from tribodyn.numerics.elementary import absolute, log, maximum, namespace
from tribodyn.numerics.shapes import Array, Float

# Part of the space between root and tip circle that is a tooth.
_FILLED = 0.5
# Bore over radius below which x ln x counts as 0.
_SOLID = 1e-9


def free_torsion(bore: Any, tip: Any = 1.0) -> Any:
    """Tangential displacement at radius 1 per uniform shear there, 2 G = 1; of a ring around it, bore > 1.

    Bore and tip radius are those over the root radius; a tip of 1: without teeth.
    """
    x = bore**2
    turned = (1.0 - x) * (1.0 + 3.0 * x) / (3.0 * (1.0 + x) ** 2)
    return _share(x**2, tip**4) ** 2 * namespace(bore).where(bore > 1.0, -turned, turned)


def free_shift(bore: Any, poisson_ratio: Any, tip: Any = 1.0) -> Float[Array, "2 2"]:
    """Displacement (radial cos θ, tangential sin θ) at radius 1 per traction there, 2 G = 1; likewise."""
    xp = namespace(bore, poisson_ratio)
    kappa = (3.0 - poisson_ratio) / (1.0 + poisson_ratio)
    x = bore**2
    stiff = 1.0 + kappa * x**2
    # of the force in q: P, c_1 and c_2 in turn
    logarithm = 1.0 + 2.0 * x * log(maximum(bore, _SOLID)) / (1.0 - x)
    shifted = (
        (kappa - 1.0) / (4.0 * kappa)
        - kappa * x / (2.0 * (1.0 + kappa) * (1.0 - x)) * logarithm
        + (1.0 / (4.0 * kappa) - x * (1.0 - x) / (2.0 * (1.0 + kappa))) / stiff
    )
    mixed = -(1.0 - x) / (4.0 * stiff)
    spread = kappa * (1.0 - x**2) / (4.0 * stiff)
    rows = [
        [shifted + 2.0 * mixed + spread, spread - shifted],
        [spread - shifted, shifted - 2.0 * mixed + spread],
    ]
    matrix = xp.stack([xp.stack(row) for row in rows])
    part = np.eye(2) - (1.0 - _share(x, tip**2)) / 2.0 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return part @ xp.where(bore > 1.0, -matrix, matrix) @ part


def _share(bore: Any, tip: Any) -> Any:
    """Part of inertia that is the ring's, of powers of the ratios of radii."""
    ring, teeth = absolute(1.0 - bore), _FILLED * absolute(tip - 1.0)
    return ring / (ring + teeth)
