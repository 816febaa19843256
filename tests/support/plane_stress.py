"""Rings in plane stress by integration along the radius."""

from collections.abc import Sequence

import numpy as np
from scipy.integrate import solve_ivp


def shot(order: int, nu: float, start: float, states: Sequence[Sequence[float]]) -> np.ndarray:
    """States (u, v, σ_r, τ) of one harmonic at r = 1 as columns, integrated from those at another radius.

    Equilibrium and Hooke's law; moduli are 1.
    """

    def slope(r, y):
        u, v, normal, shear = y
        hoop_strain = (u + order * v) / r
        hoop = hoop_strain + nu * normal
        return [
            (1 - nu**2) * normal - nu * hoop_strain,
            2 * (1 + nu) * shear + (order * u + v) / r,
            (hoop - normal - order * shear) / r,
            (order * hoop - 2 * shear) / r,
        ]

    exact = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}
    return np.array([solve_ivp(slope, (start, 1), state, **exact).y[:, -1] for state in states]).T
