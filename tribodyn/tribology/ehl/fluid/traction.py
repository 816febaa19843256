"""Forces along the surfaces of a solved contact, per length; positive along x, the direction of entrainment.

Surface 1 is the upper one, z = h, surface 2 the lower, z = 0; the shear stress in the film is
τ = τ_m + (z − h/2) dp/dx, τ_m of the sign of u_1 − u_2. The film pulls surface 2 by τ(0), surface 1 by −τ(h):
∫ τ_m dx holds back the faster surface and draws on the slower one, ½ ∫ h dp/dx dx holds back both.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.tribology.ehl.fluid.rheology import Rheology, stress_scale, thinned
from tribodyn.tribology.ehl.fluid.shear import Shear
from tribodyn.tribology.ehl.steady import Solution

Array = Any

#: Parts of a step between nodes in the integral of the shear stress.
_PARTS = 8


class RollingTraction(NamedTuple):
    """What rolling alone costs, N/m.

    Attributes
    ----------
    shear : F_t = ½ ∫ h dp/dx dx, drag of the pressure flow on each surface
    pressure : F_n,x = ∫ p dh/dx dx, force along x of the pressure on the gap's slope; −2 F_t, since p h
        vanishes at both ends (Biboulet & Houpert 2010)
    """

    shear: float
    pressure: float


def shear_force(shear: Shear, pressure: Array, place: Array, rheology: Rheology) -> float:
    """∫ τ_m dx over the nodes at places, N/m.

    Between two nodes the viscosity changes by powers of ten, and the stress bends where it comes near to what
    the oil bears: there ln η γ' and the pressure are taken as linear, and the law of shear does the rest.
    """
    at = np.linspace(0.0, len(place) - 1.0, _PARTS * (len(place) - 1) + 1)
    node = np.arange(len(place))
    equal = np.exp(np.interp(at, node, np.log(np.maximum(np.abs(shear.newtonian), 1e-300))))
    stress = thinned(equal, stress_scale(np.interp(at, node, pressure), rheology), rheology)
    sign = np.sign(np.interp(at, node, np.sign(shear.newtonian)))
    return float(np.trapezoid(sign * stress, np.interp(at, node, place)))


def rolling_traction(solution: Solution) -> RollingTraction:
    """Return both tractions, each by its own integral.

    The elastic part of the slope does not count in F_n,x: the influence of a half space is symmetric, so that
    ∫ p dh/dx dx = ∫ p x/R dx.
    """
    pressure, thick, place = solution.fluid_pressure, solution.mean_gap, solution.place
    shear = 0.25 * float(np.sum((thick[1:] + thick[:-1]) * np.diff(pressure)))
    return RollingTraction(shear, float(np.trapezoid(pressure * place, place)) / solution.problem.radius)
