"""Viscous damping by damping ratios: of tooth contacts and of springs."""

from math import sqrt


def equivalent_mass(inertias: tuple[float, float], radii: tuple[float, float]) -> float:
    """Mass of two gears along their line of action, kg: J_1 J_2/(J_1 r_2² + J_2 r_1²).

    `inertias` about their axes, kg m²; `radii` at which the load acts, m.
    """
    (first, second), (radius_1, radius_2) = inertias, radii
    return first * second / (first * radius_2**2 + second * radius_1**2)


def mesh_damping(ratio: float, mass: float, slices: int) -> float:
    """2 ζ √m of a mesh with the equivalent mass m (kg): times √k the damping of a contact of the stiffness k.

    Of slices together that of the pair: √K times as much of a Kth of the stiffness.
    """
    return 2.0 * ratio * sqrt(mass / slices)


def spring_damping(given: float, ratio: float, stiffness: float, *inertias: float) -> float:
    """What is given and 2 ζ √(k m) of a spring; m of the body on it, or of two against each other.

    Of two m_1 m_2/(m_1 + m_2). In translation N/m, kg and N s/m, in rotation N m/rad, kg m² and N m s/rad.
    """
    own, *other = inertias
    mass = own * other[0] / (own + other[0]) if other else own
    return given + 2.0 * ratio * sqrt(stiffness * mass)
