"""Specific film thickness of tooth flanks: ISO/TS 6336-22:2018, before it ISO/TR 15144-1:2014.

Method B shares the load by a formula; method A takes pressures and temperatures of a contact analysis. Both
evaluate the same film, `film_thickness`. Numbers of equations are those of ISO/TR 15144-1:2014.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tribodyn.standards.contact_path import (
    ContactPath,
    equivalent_radius,
    helical_load_factor,
    load_share,
    loss_factor,
    point_distances,
    rolling_speeds,
)

#: X_S by how the oil reaches the mesh: ISO/TR 15144-1:2014, table 4.
LUBRICATION_FACTORS = {"spray": 1.2, "dip": 1.0, "submerged": 0.2}
#: What the permissible film is above that of the test gears at their failure: ISO/TR 15144-1:2014, (A.1).
_PERMISSIBLE = 1.4


class Oil(NamedTuple):
    """An oil over temperature."""

    viscosity: Callable[[Any], Any]  # dynamic viscosity η, Pa·s, at a temperature, K
    pressure_viscosity: Callable[[Any], Any]  # α, 1/Pa, at a temperature, K
    #: X_L: 1.0 of mineral oil, 0.8 of PAO, 0.7 of PAG (0.6 where it dissolves in water), 1.3 of phosphate
    #: esters: ISO/TR 15144-1:2014, table 3
    lubricant_factor: float = 1.0


class Flanks(NamedTuple):
    """What the flanks are of."""

    mean_roughness: float  # Ra = (Ra_1 + Ra_2)/2, m
    reduced_modulus: float  # E_r = 2/Σ(1 − ν²)/E, Pa
    thermal_contact: tuple[float, float]  # B_M = √(λ ρ c) of pinion and gear, W s^½/(m² K)
    quality: float = 7.0  # grade by ISO 1328-1 of the coarser gear


class Load(NamedTuple):
    """Load and speed of a pair."""

    pinion_torque: float  # T_1, N m; negative of a ring that drives
    pinion_speed: float  # rad/s
    face_width: float  # b, m
    oil_temperature: float  # θ_oil, K
    #: application, dynamic, transverse, face: K_A, K_v, K_Hα, K_Hβ
    application: float = 1.0
    dynamic: float = 1.0
    transverse: float = 1.0
    face: float = 1.0
    lubrication: str = "dip"  # one of `LUBRICATION_FACTORS`
    tip_relief: float = 1.0  # X_Ca, see `tip_relief_factor`

    @property
    def factor(self) -> float:
        """Product K_A K_v K_Hα K_Hβ."""
        return self.application * self.dynamic * self.transverse * self.face


class Films(NamedTuple):
    """Results of either method over the points of the path, arrays where they vary."""

    friction_coefficient: float  # μ_m
    bulk_temperature: float  # θ_M, K
    pressure: Any  # (points,), p_dyn,Y, Pa
    flash_rise: Any  # (points,), θ_fl,Y, K
    film_thickness: Any  # (points,), h_Y, m
    specific_film: Any  # (points,), λ_GF,Y


def roughness_factor(mean_roughness: float, pitch_radius: float) -> float:
    """X_R = 2.2 (Ra/ρ_n,C)^0.25, Ra in µm and ρ_n,C in mm: (87)."""
    return 2.2 * (1e3 * mean_roughness / pitch_radius) ** 0.25


def mean_friction(
    line_load: float, speed_sum: float, pitch_radius: float, viscosity: float, roughness: float, oil: float
) -> float:
    """Mean friction coefficient μ_m of method B: (86).

    0.045 (w/(v_ΣC ρ_n,C))^0.2 (10³ η)^−0.05 X_R X_L in N/mm, m/s, mm, Pa·s, η at the oil's temperature, of
    w = K F_bt K_Bγ/b (N/m), v_ΣC = 2 v_t sin α_wt (m/s) and ρ_n,C (m).
    """
    load = 1e-3 * line_load / (speed_sum * 1e3 * pitch_radius)
    return 0.045 * load**0.2 * (1e3 * viscosity) ** -0.05 * roughness * oil


def bulk_rise(
    power: float, friction: float, losses: float, centre_distance: float, face_width: float, supply: float
) -> float:
    """Rise of the bulk temperature θ_M − θ_oil, K: (84).

    7400 (P μ_m H_v/(a b))^0.72 X_S/(1.2 X_Ca), P in kW, a and b in mm; `supply` is X_S/X_Ca. Of a ring, whose
    centre distance is negative and small, it is abs(a), and the estimate is a high one.
    """
    each = 1e-3 * power * friction * losses / (1e6 * abs(centre_distance) * face_width)
    return 7400.0 * each**0.72 * supply / 1.2


def tip_relief_factor(tip_contact_ratios: tuple[float, float], adequate: bool) -> float:
    """X_Ca of method B: 1 + 0.24 ε_max + 0.71 ε_max² with adequate tip relief, else 1: (100), (101)."""
    longest = max(tip_contact_ratios)
    return 1.0 + 0.24 * longest + 0.71 * longest**2 if adequate else 1.0


def hertz_pressure(line_load: Any, radius: Any, reduced_modulus: float) -> Any:
    """Hertz pressure √(w E_r/(2π ρ_n)), Pa, of a normal load per contact length, N/m: (24) to (26)."""
    return np.sqrt(line_load * reduced_modulus / (2.0 * np.pi * radius))


def flash_rise(friction: Any, pressure: Any, radius: Any, speeds: tuple[Any, Any], flanks: Flanks) -> Any:
    """Flash temperature rise θ_fl,Y, K: (80).

    (√π/2) μ p abs(v_r1 − v_r2)/(B_M1 √v_r1 + B_M2 √v_r2) √(8 ρ_n p/E_r).
    """
    first, second = speeds
    share = flanks.thermal_contact[0] * np.sqrt(first) + flanks.thermal_contact[1] * np.sqrt(second)
    width = np.sqrt(8.0 * radius * pressure / flanks.reduced_modulus)
    return np.sqrt(np.pi) / 2.0 * friction * pressure * np.abs(first - second) / share * width


def film_thickness(
    pressure: Any,
    radius: Any,
    speed_sum: Any,
    temperatures: tuple[Any, Any],
    oil: Oil,
    reduced_modulus: float,
) -> Any:
    """Film thickness h_Y, m: (4) to (33).

    1600 ρ_n G^0.6 U^0.7 W^−0.13 S^0.22 in µm and mm, with G = α(θ_M) E_r, U = η(θ_M) Σv/(2 E_r ρ_n),
    W = 2π p²/E_r² and S = α(θ_B) η(θ_B)/(α(θ_M) η(θ_M)); temperatures are (θ_M, θ_B,Y), bulk and contact, K.
    Above a contact of 783 K the standard's α(θ) is negative: there S, and with it the film, is zero.
    """
    bulk, contact = temperatures
    stiffening = oil.pressure_viscosity(bulk) * oil.viscosity(bulk)
    material = oil.pressure_viscosity(bulk) * reduced_modulus
    speed = oil.viscosity(bulk) * speed_sum / (2.0 * reduced_modulus * radius)
    load = 2.0 * np.pi * (pressure / reduced_modulus) ** 2
    sliding = np.maximum(oil.pressure_viscosity(contact), 0.0) * oil.viscosity(contact) / stiffening
    return 1.6 * radius * material**0.6 * speed**0.7 * load**-0.13 * sliding**0.22


def method_b(path: ContactPath, flanks: Flanks, load: Load, oil: Oil) -> Films:
    """Films at the points of the path (`contact_path.POINTS`) by method B, flanks without tip relief.

    The load is shared by `contact_path.load_share`. An adequate tip relief enters the bulk temperature alone.
    """
    distance = point_distances(path)
    speeds = rolling_speeds(path, distance, load.pinion_speed)
    radius = equivalent_radius(path, distance)
    in_base_plane = load.pinion_torque / path.base_radius[0]
    friction = pair_friction(path, flanks, load, oil)
    power = load.pinion_torque * load.pinion_speed * path.sense
    supply = LUBRICATION_FACTORS[load.lubrication] / load.tip_relief
    bulk = load.oil_temperature + bulk_rise(
        power, friction, loss_factor(path), path.centre_distance, load.face_width, supply
    )
    share = load_share(path, distance, flanks.quality)
    pressure = hertz_pressure(
        load.factor * in_base_plane * share / load.face_width, radius, flanks.reduced_modulus
    )
    return at_places(pressure, radius, speeds, friction, bulk, flanks, oil)


def pair_friction(path: ContactPath, flanks: Flanks, load: Load, oil: Oil) -> float:
    """Mean friction coefficient of a pair at a load, see `mean_friction`."""
    pitch_point = path.length - path.tip_contact_ratios[0] * path.base_pitch
    radius = float(equivalent_radius(path, pitch_point))
    line_load = load.factor * load.pinion_torque / path.base_radius[0] / load.face_width
    return mean_friction(
        line_load * helical_load_factor(path.total_contact_ratio),
        float(sum(rolling_speeds(path, pitch_point, load.pinion_speed))),
        radius,
        float(oil.viscosity(load.oil_temperature)),
        roughness_factor(flanks.mean_roughness, radius),
        oil.lubricant_factor,
    )


def at_places(
    pressure: Any, radius: Any, speeds: tuple[Any, Any], friction: Any, bulk: float, flanks: Flanks, oil: Oil
) -> Films:
    """Films at any places of the path from pressures, radii, speeds and friction there: method A.

    `friction` may vary along the path; Ra, moduli and the oil are as in method B.
    """
    flash = flash_rise(friction, pressure, radius, speeds, flanks)
    film = film_thickness(
        pressure, radius, speeds[0] + speeds[1], (bulk, bulk + flash), oil, flanks.reduced_modulus
    )
    return Films(friction, bulk, pressure, flash, film, film / flanks.mean_roughness)


def permissible_film(test_film: float, material_factor: float = 1.0) -> float:
    """λ_GFP = 1.4 W_W λ_GFT: (A.1), with λ_GFT of the test gears at their failure, see `fzg`.

    W_W is 1 of case-carburised steels with usual retained austenite. From memory of annex A.
    """
    return _PERMISSIBLE * material_factor * test_film
