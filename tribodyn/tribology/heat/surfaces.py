"""Heat transfer at surfaces: a housing in air, gears and bearings in oil, joints. SI, temperatures in K."""

import math
from typing import Any

import numpy as np

#: Stefan-Boltzmann constant, W/(m² K⁴) (CODATA), and standard gravity, m/s².
STEFAN_BOLTZMANN, GRAVITY = 5.670374e-8, 9.80665
#: Air at atmospheric pressure by temperature, K: viscosity (m²/s), conductivity (W/(m K)), Prandtl number.
#: Incropera & DeWitt, Fundamentals of Heat and Mass Transfer, table A.4.
_AIR = np.array(
    [
        [250.0, 11.44e-6, 22.3e-3, 0.720],
        [300.0, 15.89e-6, 26.3e-3, 0.707],
        [350.0, 20.92e-6, 30.0e-3, 0.700],
        [400.0, 26.41e-6, 33.8e-3, 0.690],
        [450.0, 32.39e-6, 37.3e-3, 0.686],
        [500.0, 38.79e-6, 40.7e-3, 0.684],
    ]
).T


def natural_convection(wall: Any, air: Any, height: float) -> Any:
    """Mean coefficient of a vertical wall in still air, W/(m² K).

    Nu = {0.825 + 0.387 Ra^(1/6)/[1 + (0.492/Pr)^(9/16)]^(8/27)}², Ra = g |ΔT| h³/(T_f ν a), air at the
    mean temperature T_f. S. W. Churchill & H. H. S. Chu, Int. J. Heat Mass Transfer 18 (1975) 1323; any Ra
    up to 10¹².
    """
    film = 0.5 * (np.asarray(wall) + air)
    viscosity, conductivity, prandtl = _air(film)
    rayleigh = GRAVITY * np.abs(wall - air) / film * height**3 * prandtl / viscosity**2
    nusselt = 0.825 + 0.387 * rayleigh ** (1.0 / 6.0) / (1.0 + (0.492 / prandtl) ** (9.0 / 16.0)) ** (
        8.0 / 27.0
    )
    return nusselt**2 * conductivity / height


def forced_convection(wall: Any, air: Any, speed: float, length: float) -> Any:
    """Mean coefficient of a wall along which air flows, W/(m² K).

    Nu = √(Nu_l² + Nu_t²), Nu_l = 0.664 Re^½ Pr^⅓, Nu_t = 0.037 Re^0.8 Pr/(1 + 2.443 Re^−0.1 (Pr^⅔ − 1)),
    air at the mean temperature. Gnielinski, VDI Heat Atlas, section G4; Re up to 10⁷.
    """
    viscosity, conductivity, prandtl = _air(0.5 * (np.asarray(wall) + air))
    if speed <= 0.0:
        return 0.0 * conductivity
    reynolds = speed * length / viscosity
    laminar = 0.664 * np.sqrt(reynolds) * np.cbrt(prandtl)
    turbulent = 0.037 * reynolds**0.8 * prandtl
    turbulent /= 1.0 + 2.443 * reynolds**-0.1 * (prandtl ** (2.0 / 3.0) - 1.0)
    return np.hypot(laminar, turbulent) * conductivity / length


def radiation(wall: Any, surroundings: Any, emissivity: float) -> Any:
    """Coefficient ε σ (T_w² + T_s²)(T_w + T_s) of a small grey body in large surroundings, W/(m² K)."""
    return emissivity * STEFAN_BOLTZMANN * (wall**2 + surroundings**2) * (wall + surroundings)


def housing_coefficient(wall: Any, air: Any, height: float, air_speed: float, emissivity: float) -> Any:
    """Coefficient of a housing in air, W/(m² K): convection, natural and forced, and radiation.

    Nu³ = Nu_n³ + Nu_f³ where air flows across or with the natural flow (Churchill 1977, as Incropera &
    DeWitt and the VDI Heat Atlas have it); both lengths are the height.
    """
    natural = natural_convection(wall, air, height)
    forced = forced_convection(wall, air, air_speed, height)
    return np.cbrt(natural**3 + forced**3) + radiation(wall, air, emissivity)


#: Thermal conductivity of mineral and synthetic oils, W/(m K), hardly dependent on temperature: 0.13 to 0.15
#: (Winter, Friction and lubrication of rolling bearings; data sheets).
OIL_CONDUCTIVITY = 0.13


def rotating_disc(speed: Any, viscosity: Any, prandtl: Any) -> Any:
    """Coefficient of a disc that turns in oil, W/(m² K), the same at all radii.

    h = 0.62 λ Pr^⅓ √(ω/ν): laminar, Pr ≫ 1. V. G. Levich, Physicochemical Hydrodynamics (1962). `speed` in
    rad/s, kinematic viscosity in m²/s.
    """
    return 0.62 * OIL_CONDUCTIVITY * np.cbrt(prandtl) * np.sqrt(speed / viscosity)


def plate_in_oil(speed: Any, length: float, viscosity: Any, prandtl: Any) -> Any:
    """Local coefficient at the length of a plate in laminar flow of oil, W/(m² K).

    h = 0.332 λ/l Re^½ Pr^⅓ (Pohlhausen). T. A. Harris, Rolling Bearing Analysis, takes it for a bearing in
    oil with a third of the ring's surface speed and the pitch diameter.
    """
    return 0.332 * OIL_CONDUCTIVITY * np.cbrt(prandtl) * np.sqrt(speed / (viscosity * length))


def ring(conductivity: float, width: float, inner: float, outer: float) -> float:
    """Conductance of a ring from its bore to its outside, W/K; radii in m."""
    return 2.0 * math.pi * conductivity * width / math.log(outer / inner)


def in_series(*conductances: Any) -> Any:
    """Conductance of several one after the other, W/K."""
    return 1.0 / sum(1.0 / conductance for conductance in conductances)


def _air(temperature: Any) -> tuple[Any, Any, Any]:
    at, *columns = _AIR
    viscosity, conductivity, prandtl = (np.interp(temperature, at, column) for column in columns)
    return viscosity, conductivity, prandtl
