"""The rim of an internal gear on pins: a plane elastic ring, loaded inside and held at places of its outside.

For a load at the angle 0 with the amplitudes t_n of the order n, pins at ψ_k = ψ_0 + 2πk/N, whose reaction is
spread over an arc with the amplitudes f_n, couple orders that differ by N. Without pins the outside moves by
R_oi t_n, and the condition that no pin moves, in the mean over its arc, gives for the mean over all ψ_0

    R_n = R_ii − f_n² R_io A_m⁻¹ R_oi,   A_m = Σ f_n² R_oo over all n = m, m ± N, m ± 2N …,

R_ii to R_oo the receptances of the free ring from traction inside or outside to displacement inside or
outside. Orders 0 and 1 move it as a whole: they have a soft bed, which the pins make vanish. In the mean over
all places a ring's mesh has one stiffness; that it is stiffer at a pin than between two is left out.
"""

import numpy as np

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
