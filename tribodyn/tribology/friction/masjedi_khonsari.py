"""Friction of a mixed elastohydrodynamic line contact, Masjedi & Khonsari, and its printed variants.

Masjedi & Khonsari, J. Tribol. 134 (2012) 011503 and Tribol. Int. 92 (2015) 184; Liu & Ni (18)-(24).
"""

import math
from functools import partial
from typing import Any, NamedTuple

from tribodyn.numerics.elementary import absolute, exp, expm1, law, log, maximum, minimum, skippable
from tribodyn.tribology.contact import flash_temperature_rise, hertz_half_width, moes_numbers
from tribodyn.tribology.film.masjedi_khonsari import LIMITS, RANGE, in_fitted_range
from tribodyn.tribology.law import FrictionLaw, JudgedRange, LawInput, film_at

#: Where friction is within a factor of 2 of the solved contact: Moes' L, and the stress η |v_s|/h_c of a
#: Newtonian film by the law over Λ_lim p. Below that the solved film shears more easily than the law's.
JUDGED_RANGE = {"L": (2.0, 20.0), "stress": 0.1}
(_L_LOW, _L_HIGH), _STRESS_LOW = JUDGED_RANGE.values()
JUDGED_LIMITS = "L ≥ 2", "L ≤ 20", "Newtonian stress ≥ 0.1 Λ_lim p"
#: Above this the exponential overflows; 1 − exp(−η …) has long reached 1.
MAXIMUM_EXPONENT = 600.0


class MixedFriction(NamedTuple):
    """Numbers of the mixed law; SI."""

    asperity_friction: Any  # friction coefficient f_c of touching asperities
    limiting_shear_coefficient: Any  # Λ_lim, limiting shear stress over pressure
    #: 1: the limiting shear stress follows the pressure on the fluid, p(1 − λ); 0: the whole p
    limiting_share: Any
    log_inlet_viscosity: Any  # ln of η0 in Pa·s
    viscosity_pressure_index: Any  # Roelands' z
    temperature_viscosity: Any  # K_T, 1/K
    #: pressure in Roelands' law over the mean pressure: 1, or 4/π for the maximum
    viscosity_pressure_factor: Any
    peclet_sliding: Any  # 1: both Péclet numbers contain the sliding speed; 0: each surface's own speed
    #: pinion_conductivity, gear_conductivity: W/(m K)
    pinion_conductivity: Any
    gear_conductivity: Any
    #: pinion_heat_capacity, gear_heat_capacity: per volume, as they stand in the Péclet numbers, J/(m³ K)
    pinion_heat_capacity: Any
    gear_heat_capacity: Any


@law
def log_roelands_viscosity(pressure, temperature_rise, log_inlet_viscosity, index, temperature_coefficient):
    """Average viscosity in the contact, ln of Pa·s, from the logarithm of the one at the inlet, η0 in Pa·s.

    η = η0 exp{(ln η0 + 9.67) [−1 + (1 + 5.1e-9 p)^z] − K_T ΔT}, Roelands (1966); Liu & Ni (21). The exponent
    is clipped (near a cycloid's pitch point the Hertz pressure diverges).
    """
    rise = exp(index * log(1.0 + 5.1e-9 * pressure)) - 1.0
    exponent = (log_inlet_viscosity + 9.67) * rise - temperature_coefficient * temperature_rise
    exponent = maximum(minimum(exponent, MAXIMUM_EXPONENT), -MAXIMUM_EXPONENT)
    return log_inlet_viscosity + exponent


@law
def sheared(contact, film, surfaces, parameters):
    """Share λ of the asperities, τ_lim/p, and the stress over its limit, η |v_s|/(τ_lim h_c).

    The fluid cannot exceed τ_lim/p = Λ_lim (1 − λ); Liu & Ni (20). With `limiting_share` 0 it is Λ_lim: the
    variant that brings Liu & Ni's friction levels closest.
    """
    log_smooth, rough, share = film_at(film, contact, surfaces)
    sliding = absolute(contact.sliding)
    half_width = hertz_half_width(contact.line_load, contact.curvature, surfaces.effective_modulus)
    pressure = contact.line_load / (2.0 * half_width)
    shear_share = parameters.limiting_shear_coefficient * (1.0 - parameters.limiting_share * share)
    log_viscosity = log_roelands_viscosity(
        parameters.viscosity_pressure_factor * pressure * (1.0 - share),
        _temperature_rise(contact, share, half_width, pressure, parameters),
        parameters.log_inlet_viscosity,
        parameters.viscosity_pressure_index,
        parameters.temperature_viscosity,
    )
    # where asperities carry everything the fluid has no shear limit left, and no weight either
    per_viscosity = sliding / (maximum(shear_share * pressure, 1.0) * rough)
    return share, shear_share, minimum(exp(log_viscosity - log_smooth) * per_viscosity, 600.0)


@law
def mixed_friction(contact, film, surfaces, parameters):
    """Friction coefficient μ = λ f_c + (τ_lim/p) [1 − exp(−η |v_s|/(τ_lim h_c))] of a local contact."""
    share, shear_share, newtonian = sheared(contact, film, surfaces, parameters)
    return parameters.asperity_friction * share + shear_share * saturated(newtonian)


@law
def _temperature_rise(contact, share, half_width, pressure, parameters):
    """Flash temperature rise of the heat |v_s| p [f_c λ + Λ_lim (1 − λ)], K."""
    sliding = absolute(contact.sliding)
    highest = parameters.asperity_friction * share + parameters.limiting_shear_coefficient * (1.0 - share)
    return flash_temperature_rise(
        sliding * pressure * highest,
        half_width,
        _peclet_speed(contact.pinion_speed, sliding, parameters.peclet_sliding),
        _peclet_speed(contact.gear_speed, sliding, parameters.peclet_sliding),
        parameters,
    )


@law
def heat_of_mixed_friction(contact, film, surfaces, parameters, coefficient):
    """Flash temperature rise as the law itself has it, K; see `FrictionLaw`."""
    _, _, share = film_at(film, contact, surfaces)
    half_width = hertz_half_width(contact.line_load, contact.curvature, surfaces.effective_modulus)
    return _temperature_rise(contact, share, half_width, contact.line_load / (2.0 * half_width), parameters)


@law
def saturated(x):
    """1 − exp(−x) for x ≥ 0. From 38 on it is 1 to the last bit, and what x is need not be waited for."""
    if skippable(x >= 38.0):
        return 1.0
    return -expm1(-x)


@law
def _peclet_speed(speed, sliding, share):
    """Speed in a Péclet number: the surface's own, or with `share` 1 the sliding speed (Veciana)."""
    return (1.0 - share) * absolute(speed) + share * sliding


@law
def in_range_of_film(contact, film, surfaces, parameters):
    """Shares allowed by the fitted range of the law's own regressions, which are those of its film."""
    return in_fitted_range(contact, surfaces, parameters)


@law
def in_ranges(contact, film, surfaces, parameters):
    """Shares allowed by the fitted range of the film, then by `JUDGED_RANGE`."""
    fitted = in_fitted_range(contact, surfaces, parameters)
    _, material = moes_numbers(contact, surfaces)
    _, shear_share, over_limit = sheared(contact, film, surfaces, parameters)
    stress = over_limit * shear_share / parameters.limiting_shear_coefficient
    return (*fitted, material / _L_LOW, _L_HIGH / material, stress / _STRESS_LOW)


def _mixed(
    inputs: LawInput,
    limiting_share: float = 1.0,
    heat_capacity: bool = True,
    lubricant_heat: bool = False,
    peclet_sliding: float = 0.0,
    viscosity_pressure_factor: float = 1.0,
) -> MixedFriction:
    """Return the parameters.

    `heat_capacity`: whether the Péclet numbers contain ρ_s c_p of the solids, as they must to be numbers;
    `lubricant_heat`: whether the density in them is the lubricant's; the others as in `MixedFriction`.
    """
    surfaces, lubricant = inputs.surfaces, inputs.lubricant
    heat = [surfaces.pinion_heat_capacity, surfaces.gear_heat_capacity]
    if lubricant_heat:
        heat = [lubricant.density * material.specific_heat for material in inputs.materials]
    if not heat_capacity:  # the printed Péclet number has none in it; 1 J/(m³ K) is what that amounts to
        heat = [1.0, 1.0]
    return MixedFriction(
        asperity_friction=lubricant.asperity_friction,
        limiting_shear_coefficient=lubricant.limiting_shear_coefficient,
        limiting_share=limiting_share,
        log_inlet_viscosity=log(surfaces.inlet_viscosity),
        viscosity_pressure_index=lubricant.viscosity_pressure_index,
        temperature_viscosity=lubricant.temperature_viscosity,
        viscosity_pressure_factor=viscosity_pressure_factor,
        peclet_sliding=peclet_sliding,
        pinion_conductivity=surfaces.pinion_conductivity,
        gear_conductivity=surfaces.gear_conductivity,
        pinion_heat_capacity=heat[0],
        gear_heat_capacity=heat[1],
    )


def _law(
    name: str,
    about: str,
    ratio: tuple[float, float, float],
    outside: tuple[float, float, float],
    film: str = "masjedi-khonsari",
    ranged: bool = True,
    **settings: Any,
) -> FrictionLaw:
    """Return a variant with its ratios to the solved contact; `ranged`: it is right in `JUDGED_RANGE`."""
    judged = JUDGED_LIMITS if ranged else ()
    return FrictionLaw(
        name,
        about,
        mixed_friction,
        partial(_mixed, **settings),
        in_range=in_ranges if ranged else in_range_of_film,
        range=f"that of its film: {RANGE}",
        limits=(*LIMITS, *judged),
        judged=JudgedRange((0.5, 2.0), ratio, len(judged), outside),
        flash_temperature=heat_of_mixed_friction,
        film=film,
    )


LAW = _law(
    "masjedi-khonsari",
    "mixed elastohydrodynamic line contact, Masjedi & Khonsari (2012, 2015)",
    (0.755, 1.02, 1.46),
    (0.871, 2.08, 9.07),
)
MEAN_PRESSURE = _law(
    "masjedi-khonsari-mean-pressure",
    "the same, limiting shear stress from the whole mean pressure instead of the fluid's share",
    (0.755, 1.03, 1.52),
    (0.872, 2.08, 9.07),
    limiting_share=0.0,
)
AS_PRINTED = _law(
    "masjedi-khonsari-as-printed",
    "the same with Liu & Ni's misprints: 447 for 4470, Péclet numbers without ρ c_p",
    (0.125, 1.01, 3.01),
    (0.0287, 1.28, 4.94),
    ranged=False,
    film="masjedi-khonsari-as-printed",
    heat_capacity=False,
)
VECIANA = _law(
    "masjedi-khonsari-veciana",
    "the same as Veciana et al. print it: Péclet numbers of sliding speed and lubricant density",
    (0.445, 1.02, 3.79),
    (0.157, 1.5, 8.1),
    ranged=False,
    lubricant_heat=True,
    peclet_sliding=1.0,
)
VECIANA_PEAK = _law(
    "masjedi-khonsari-veciana-peak",
    "the reading that meets Veciana's crossover: Roelands' law at the maximum pressure, "
    "each surface's own speed and the lubricant's density in the Péclet numbers",
    (0.906, 1.15, 4.0),
    (0.85, 1.9, 9.16),
    ranged=False,
    lubricant_heat=True,
    viscosity_pressure_factor=4.0 / math.pi,
)
