"""Friction coefficient of the lubricated contact: the laws, and the one place that chooses among them.

Every law takes the same state of one contact and returns the same quantities, so that film, asperity load
and temperature are known whatever law makes the friction.
"""

import math

from tribodyn.numerics.elementary import absolute, exp, expm1, law, log, maximum, minimum, skippable
from tribodyn.tribology.contact import hertz_half_width, hertz_pressure, logarithms
from tribodyn.tribology.empirical import benedict_kelley, xu
from tribodyn.tribology.film import asperity_load_ratio, central_film_thickness, in_fitted_range
from tribodyn.tribology.flash import flash_temperature_rise
from tribodyn.tribology.rheology import limiting_shear_share, log_roelands_viscosity

NONE = 0
COULOMB = 1
MASJEDI_KHONSARI = 2
XU = 3
BENEDICT_KELLEY = 4

#: Least line load (N/m) and entrainment (m/s) at which the closures are evaluated: they diverge at zero.
LEAST_LINE_LOAD = 1.0
LEAST_ENTRAINMENT = 1e-6
#: Of the pressure in a Hertz line contact.
GREATEST_OVER_MEAN = 4.0 / math.pi


@law
def mixed_film(line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact, logs):
    """Film, asperity load, temperature and friction of a mixed-EHL line contact, Masjedi & Khonsari.

    Masjedi & Khonsari, J. Tribol. 134 (2012) 011503 and Tribol. Int. 92 (2015) 184; Liu & Ni (18)-(24).

    Parameters
    ----------
    line_load : w' = F_n/b, N/m
    curvature : 1/ρ, 1/m; positive
    entrainment, sliding : u = (u_p + u_g)/2 and v_s = u_p − u_g, m/s, any sign
    pinion_speed, gear_speed : speeds of the contact along the flanks, m/s
    contact : Contact
    logs : Logarithms of the contact

    Returns
    -------
    friction_coefficient, asperity_load_ratio, central_film_thickness, flash_temperature_rise, hertz_pressure
        μ = λ f_c + (τ_lim/p) [1 − exp(−η |v_s|/(τ_lim h_c))], λ, h_c (m), ΔT (K), p_H (Pa).
    """
    line_load = maximum(line_load, LEAST_LINE_LOAD)
    entrainment = maximum(absolute(entrainment), LEAST_ENTRAINMENT)
    sliding = absolute(sliding)
    log_curvature = log(curvature)
    log_W = log(line_load) + log_curvature - logs.modulus
    log_U = log(entrainment) + log_curvature + logs.inlet_viscosity - logs.modulus
    log_S = log_curvature + logs.roughness
    share = asperity_load_ratio(log_W, log_U, logs.material, log_S, logs.hardness, logs.asperity_factor)
    log_smooth, rough = central_film_thickness(
        log_W, log_U, logs.material, log_S, logs.hardness, log_curvature
    )

    half_width = hertz_half_width(line_load, curvature, contact.effective_modulus)
    pressure = line_load / (2.0 * half_width)
    shear_share = limiting_shear_share(share, contact.limiting_shear_coefficient, contact.limiting_share)
    heat_flux = (
        sliding
        * pressure
        * (contact.asperity_friction * share + contact.limiting_shear_coefficient * (1.0 - share))
    )
    temperature_rise = flash_temperature_rise(
        heat_flux,
        half_width,
        _peclet_speed(pinion_speed, sliding, contact.peclet_sliding),
        _peclet_speed(gear_speed, sliding, contact.peclet_sliding),
        contact.pinion_conductivity,
        contact.gear_conductivity,
        contact.pinion_heat_capacity,
        contact.gear_heat_capacity,
    )
    log_viscosity = log_roelands_viscosity(
        contact.viscosity_pressure_factor * pressure * (1.0 - share),
        temperature_rise,
        logs.inlet_viscosity,
        contact.viscosity_pressure_index,
        contact.temperature_viscosity,
    )
    # where asperities carry everything the fluid has no shear limit left, and no weight either
    per_viscosity = sliding / (maximum(shear_share * pressure, 1.0) * rough)
    newtonian = minimum(exp(log_viscosity - log_smooth) * per_viscosity, 600.0)
    coefficient = contact.asperity_friction * share + shear_share * saturated(newtonian)
    return coefficient, share, exp(log_smooth) * rough, temperature_rise, GREATEST_OVER_MEAN * pressure


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
def friction_coefficient(
    law_code, line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact, logs
):
    """Friction coefficient by the law in use, and nothing else: what the right-hand side needs.

    Laws that give the whole mesh one mean coefficient (`mean_friction`) come as Coulomb's. `law_code` is
    static for JAX, an integer for numba; arguments otherwise as for `mixed_film`.
    """
    if law_code == MASJEDI_KHONSARI:
        found = mixed_film(
            line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact, logs
        )
        return found[0]
    load = maximum(line_load, LEAST_LINE_LOAD)
    speed = maximum(absolute(entrainment), LEAST_ENTRAINMENT)
    if law_code == XU:
        return xu(
            hertz_pressure(load, curvature, contact.effective_modulus),
            1.0 / curvature,
            speed,
            sliding,
            contact.inlet_viscosity,
            contact.roughness,
        )
    if law_code == BENEDICT_KELLEY:
        return benedict_kelley(load, 2.0 * speed, sliding, contact.inlet_viscosity, contact.mean_roughness)
    if law_code == COULOMB:
        return 0.0 * sliding + contact.coulomb_coefficient
    return 0.0 * sliding  # NONE


@law
def friction(law_code, line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact):
    """All that is known of one contact under the law in use; arguments as for `mixed_film`.

    The film is Masjedi & Khonsari's under every law, and the range that is told is the film's. The heat that
    makes the flash temperature is the law's own.

    Returns
    -------
    friction_coefficient, asperity_load_ratio, central_film_thickness, flash_temperature_rise,
    hertz_pressure, in_range
        As `mixed_film`, and 1.0 where the film's regressions are inside their fitted range, else 0.0.
    """
    logs = logarithms(contact)
    coefficient, share, film, temperature, pressure = mixed_film(
        line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact, logs
    )
    load = maximum(line_load, LEAST_LINE_LOAD)
    speed = maximum(absolute(entrainment), LEAST_ENTRAINMENT)
    if law_code != MASJEDI_KHONSARI:
        coefficient = 0.0 * coefficient + friction_coefficient(
            law_code, line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact, logs
        )
        temperature = flash_temperature_rise(
            coefficient * absolute(sliding) * pressure / GREATEST_OVER_MEAN,
            hertz_half_width(load, curvature, contact.effective_modulus),
            pinion_speed,
            gear_speed,
            contact.pinion_conductivity,
            contact.gear_conductivity,
            contact.pinion_heat_capacity,
            contact.gear_heat_capacity,
        )
    return coefficient, share, film, temperature, pressure, in_fitted_range(load, curvature, speed, contact)
