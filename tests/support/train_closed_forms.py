"""Natural frequencies of trains in closed form: torsional chains, two stages, an idler; Hz, ascending.

A mesh on rigid bearings is a torsional spring k r_b² between shafts of different speeds. Seen from the input,
whatever turns ratio times as fast has the inertia J ratio² and the stiffness k ratio² (energies are equal),
and the train is one chain.
"""

from collections.abc import Sequence

import numpy as np

from tribodyn.numerics.shapes import Array, Float


def fixed_free_chain(count: int, stiffness: float, inertia: float) -> Float[Array, " mode"]:
    """Of equal discs and springs, the first spring on the ground: ω_j = 2 √(k/J) sin((2j − 1) π/(4n + 2))."""
    number = np.arange(1, count + 1)
    omega = 2.0 * np.sqrt(stiffness / inertia) * np.sin((2 * number - 1) * np.pi / (4 * count + 2))
    return omega / (2.0 * np.pi)


def free_chain(inertias: Sequence[float], stiffnesses: Sequence[float]) -> Float[Array, " mode"]:
    """Of any inertias, one spring between two neighbours, no ground: 0 and the roots of one polynomial.

    In the twists of the springs the equations are tridiagonal: diagonal k_i (1/J_i + 1/J_{i+1}), beside it
    the square k_i k_{i+1}/J_{i+1}². The characteristic polynomial follows from the three-term recursion p_i =
    (d_i − λ) p_{i−1} − s_i p_{i−2}.
    """
    scale = max(stiffnesses) / min(inertias)
    before, polynomial = np.poly1d([0.0]), np.poly1d([1.0])
    for i, k in enumerate(stiffnesses):
        diagonal = k * (1.0 / inertias[i] + 1.0 / inertias[i + 1]) / scale
        square = k * stiffnesses[i - 1] / (inertias[i] * scale) ** 2 if i else 0.0
        before, polynomial = polynomial, np.poly1d([-1.0, diagonal]) * polynomial - square * before
    squares = np.sort(np.roots(polynomial.coeffs).real)
    return np.append(0.0, np.sqrt(squares * scale) / (2.0 * np.pi))


def elastic_two_stage(
    inertias: Sequence[float],
    shafts: Sequence[float],
    meshes: Sequence[float],
    base_radii: Sequence[float],
) -> Float[Array, " mode"]:
    """Of two stages, three shafts with an inertia at either end: a chain of six.

    Inertias and base radii along the flow of power: motor, pinion 1, gear 1, pinion 2, gear 2, load; pinion
    1, gear 1, pinion 2, gear 2. Meshes in N/m along their lines of action.
    """
    first, second = base_radii[0] / base_radii[1], base_radii[2] / base_radii[3]
    ratios = np.array([1.0, 1.0, first, first, first * second, first * second])
    springs = [
        shafts[0],
        meshes[0] * base_radii[0] ** 2,
        shafts[1] * first**2,
        meshes[1] * (first * base_radii[2]) ** 2,
        shafts[2] * (first * second) ** 2,
    ]
    return free_chain(list(np.asarray(inertias) * ratios**2), springs)


def torsional_idler(
    inertias: Sequence[float], base_radii: Sequence[float], stiffness: Sequence[float]
) -> Float[Array, " mode"]:
    """Of driver, idler and driven gear on rigid bearings: 0 and the roots of a quadratic.

    Base radii: driver; idler in the first mesh; idler in the second; driven gear. The inertia of a driver
    whose speed is prescribed is infinite (then 0 is no mode of its own). In the deflections of the meshes the
    equations are (d_1 − λ)(d_2 − λ) = s.
    """
    weights = np.asarray(base_radii) ** 2 / np.asarray(inertias)[[0, 1, 1, 2]]
    first, second = stiffness[0] * (weights[0] + weights[1]), stiffness[1] * (weights[2] + weights[3])
    half = 0.5 * (first + second)
    root = np.sqrt((0.5 * (first - second)) ** 2 + stiffness[0] * stiffness[1] * weights[1] * weights[2])
    return np.append(0.0, np.sqrt([half - root, half + root]) / (2.0 * np.pi))


def planar_idler_determinant(
    frequency: float,
    masses: Sequence[float],
    inertias: Sequence[float],
    bearings: Sequence[float],
    base_radii: Sequence[float],
    stiffness: Sequence[float],
    between: float,
) -> float:
    """What vanishes at the natural frequencies of an idler on bearings equally stiff all round.

    Forces along the two lines of action are the unknowns: 1/k_i of each and the receptances of the bodies,
    1/(k_b − λ m) of a displacement, −1/(λ J) of a rotation. Azimuths, pressure angles and senses appear only
    as the angle `between` the normals of both meshes. In m²/N².
    """
    square = (2.0 * np.pi * frequency) ** 2
    moved = 1.0 / (np.asarray(bearings) - square * np.asarray(masses))
    turned = -(np.asarray(base_radii) ** 2) / (square * np.asarray(inertias)[[0, 1, 1, 2]])
    first = 1.0 / stiffness[0] + moved[0] + moved[1] + turned[0] + turned[1]
    second = 1.0 / stiffness[1] + moved[1] + moved[2] + turned[2] + turned[3]
    shared = base_radii[1] * base_radii[2] / (square * inertias[1]) - moved[1] * np.cos(between)
    return float(first * second - shared**2)
