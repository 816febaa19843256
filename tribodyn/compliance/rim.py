"""The rim of an internal gear on pins: a plane elastic ring, loaded inside and held at places of its outside.

For a load at the angle 0 with the amplitudes t_n of the order n, pins at ψ_k = ψ_0 + 2πk/N, whose reaction is
spread over an arc with the amplitudes f_n, couple orders that differ by N. Without pins the outside moves by
R_oi t_n, and the condition that no pin moves, in the mean over its arc, gives for the mean over all ψ_0

    R_n = R_ii − f_n² R_io A_m⁻¹ R_oi,   A_m = Σ f_n² R_oo over all n = m, m ± N, m ± 2N …,

R_ii to R_oo the receptances of the free ring from traction inside or outside to displacement inside or
outside. Orders 0 and 1 move it as a whole: they have a soft bed, which the pins make vanish. In the mean over
all places a ring's mesh has one stiffness; that it is stiffer at a pin than between two is left out.
"""

from typing import Any

import numpy as np

from tribodyn.numerics.elementary import absolute, log, maximum, namespace
from tribodyn.numerics.shapes import Array, Float

#: Diameter of a pin over the thickness of the rim: a choice, which counts as the logarithm only.
PIN = 0.5
# Of the bed, in 2 G over the inner radius; and harmonics per arc.
_BED, _FINE = 1e-7, 15.0


def pinned_receptance(
    order: Float[Array, " order"], outside: float, poisson_ratio: float, pins: int
) -> Float[Array, "order 2 2"]:
    """Displacement amplitudes (n, 2, 2) at radius 1 per traction amplitude there, for 2 G = 1.

    In the mean over all places between `pins` pins, that hold the radius `outside` > 1 radially and
    tangentially; orders 0 … n.
    """
    half_angle = PIN * (outside - 1.0) / (2.0 * outside)
    most = int(max(order[-1], pins, _FINE / half_angle))
    every = np.arange(most + 1.0)
    receptance = free_receptance(every, outside, poisson_ratio)
    spread = np.sinc(every * half_angle / np.pi)
    arc = (spread**2)[:, None, None] * receptance[:, 2:, 2:]
    mirror = np.array([1.0, -1.0])
    held = np.zeros((pins, 2, 2))
    np.add.at(held, np.arange(most + 1) % pins, arc)
    np.add.at(held, -np.arange(1, most + 1) % pins, arc[1:] * mirror[:, None] * mirror)
    count = len(order)
    off = spread[:count, None, None] * receptance[:count, 2:, :2]
    by_pins = np.swapaxes(off, 1, 2) @ np.linalg.solve(held[np.arange(count) % pins], off)
    return receptance[:count, :2, :2] - by_pins


def free_receptance(
    order: Float[Array, " order"], outside: float, poisson_ratio: float
) -> Float[Array, "order 4 4"]:
    """Displacement amplitudes (n, 4, 4) of a free ring from 1 to `outside` per traction amplitude, 2 G = 1.

    Radial (cos nθ) and tangential (sin nθ), inside, then outside. Michell's plane solutions, as in
    `foundation`: those that fade outwards scaled at the inside, those that grow at the outside.
    """
    kappa = (3.0 - poisson_ratio) / (1.0 + poisson_ratio)
    n = np.maximum(order, 1.0)
    first = n == 1
    ones, size = np.ones_like(n), 1.0 / outside
    slow, fast = size ** (n - 1.0), size ** (n + 1.0)
    bent = np.where(first, 2.0 * kappa * np.log(outside), 0.0)
    fade, grow = 1.0 - n, n + 1.0
    # columns: displacements inside and outside, then stresses, each radial and tangential
    fading = np.array([kappa - fade, -kappa - fade])
    fading[:, first] = -1.0
    stressed = np.array([fade * (3.0 - fade), -fade * (fade - 1.0)])
    stressed[:, first] = np.array([[3.0 + kappa], [1.0 - kappa]])
    growing = np.array([kappa - grow, kappa + grow])
    stressed_growing = np.array([grow * (3.0 - grow), grow * (grow - 1.0)])
    columns = [
        (fading, fading * slow + bent * np.array([ones, -ones]), stressed, stressed * slow * size),
        (
            np.array([-ones, -ones]),
            np.array([-ones, -ones]) * fast,
            np.array([grow, grow]),
            np.array([grow, grow]) * fast * size,
        ),
        (growing * fast, growing, stressed_growing * fast, stressed_growing * size),
        (
            np.array([-ones, ones]) * slow,
            np.array([-ones, ones]),
            np.array([fade, -fade]) * slow,
            np.array([fade, -fade]) * size,
        ),
    ]
    moved = np.stack([np.concatenate(column[:2]) for column in columns], axis=-1).swapaxes(0, 1)
    traction = np.stack([np.concatenate([-column[2], column[3]]) for column in columns], axis=-1).swapaxes(
        0, 1
    )
    whole = order == 0
    # u = r and 1/r, v = r and 1/r
    stretch = (1.0 + poisson_ratio) / (1.0 - poisson_ratio)
    moved[whole] = [[1, 1, 0, 0], [0, 0, 1, 1], [outside, size, 0, 0], [0, 0, outside, size]]
    traction[whole] = [[-stretch, 1, 0, 0], [0, 0, 0, 1], [stretch, -(size**2), 0, 0], [0, 0, 0, -(size**2)]]
    bed = np.where(order < 2, _BED, 0.0)[:, None, None] * np.diag([0.0, 0.0, 1.0, 1.0])
    # tractions outside act on a circle that is `outside` times longer: amplitudes of forces per angle
    loads = traction + bed @ moved
    loads[:, 2:] *= outside
    return moved @ np.linalg.inv(loads)


# A ring that nothing but its inertia holds: orders 0 and 1 of a load, which turn and shift it as a whole.
#
# The bore keeps its shape, as on a shaft, and hands on neither torque nor force: those of the load are
# balanced by the d'Alembert force of every particle, and displacements count from the ring's mean rotation
# and mean shift, weighted by inertia (inertia relief). So a body's compliance has no more in it than its
# elasticity: it tends to a limit as the bore vanishes, while that of a ring held at its bore grows without
# bound.
#
# With x = (bore/radius)², ν Poisson's ratio, κ = (3 − ν)/(1 + ν) of plane stress, 2 G = 1, and tractions on
# the circle r = 1:
#
# Order 0. The shear τ is handed on as the torque τ (r⁴ − x²)/(1 − x²), which twists the ring by τ/r³ times
# that per radius. By the work of both, the circle turns against the mean rotation by
#
#     ∫ (r⁴ − x²)²/(1 − x²)² dr/r³ from the bore to 1 = (1 − x)(1 + 3x)/(3 (1 + x)²) · 1/2,
#
# of a solid disc θ = T/(12π G b a²); the ring held at its bore has 1/x − 1 in place of twice this.
#
# Order 1. Of a radial traction t_r cos θ and a tangential one t_θ sin θ the force per π is q = t_r − t_θ;
# the body force p = −q/(1 − x) balances it. With the displacement (radial cos θ, tangential sin θ)
#
#     u = P r² (1, −1) + c_1 (2κ ln r − 1, −2κ ln r − 1) + c_2 r² (κ − 2, κ + 2)
#         − c_3 r⁻² (1, 1) + c_4 (1, −1),
#
# P = −p (κ − 1)/(2κ) balances p, no force at the bore gives c_1, its shape, u_r + u_θ = 0, c_3, the
# tractions give c_2, and the mean of the displacement over the area is 0 (J. R. Barber, Elasticity, ch. 7 to
# 9).
#
# Teeth are a ring of half the density from root to tip, that moves with the root circle. Where the share s
# of the inertia is the ring's, they take the rest of torque and force before the ring does, and the mean
# counts them in: order 0 has the factor s², order 1 the factor 1 − (1 − s)/2 (1, −1)ᵀ(1, −1) on both sides.


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
