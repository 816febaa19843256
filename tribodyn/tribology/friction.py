"""Friction coefficient of the lubricated contact: the laws, and the one place that chooses among them.

Every law takes the same state of one contact and returns the same quantities, so that film, asperity load
and temperature are known whatever law makes the friction.
"""

import math

from tribodyn.elementary import absolute, expm1, law, log, maximum, minimum
from tribodyn.tribology.contact import hertz_half_width, hertz_pressure
from tribodyn.tribology.empirical import benedict_kelley, xu
from tribodyn.tribology.film import asperity_load_ratio, central_film_thickness, in_fitted_range
from tribodyn.tribology.flash import flash_temperature_rise
from tribodyn.tribology.rheology import limiting_shear_stress, roelands_viscosity

NONE = 0
COULOMB = 1
MASJEDI_KHONSARI = 2
XU = 3
BENEDICT_KELLEY = 4

#: Least line load (N/m) and entrainment (m/s) at which the closures are evaluated: they diverge at zero.
LEAST_LINE_LOAD = 1.0
LEAST_ENTRAINMENT = 1e-6


@law
def mixed_film(line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact):
    """Film, asperity load, temperature and friction of a mixed-EHL line contact, Masjedi & Khonsari.

    Masjedi & Khonsari, J. Tribol. 134 (2012) 011503 and Tribol. Int. 92 (2015) 184; Liu & Ni (18)-(24).

    Parameters
    ----------
    line_load : w' = F_n/b, N/m
    curvature : 1/ρ, 1/m; positive
    entrainment, sliding : u = (u_p + u_g)/2 and v_s = u_p − u_g, m/s, any sign
    pinion_speed, gear_speed : speeds of the contact along the flanks, m/s
    contact : Contact

    Returns
    -------
    friction_coefficient, asperity_load_ratio, central_film_thickness, flash_temperature_rise,
    hertz_pressure, in_range
        μ = λ f_c + (τ_lim/p) [1 − exp(−η |v_s|/(τ_lim h_c))], λ, h_c (m), ΔT (K), p_H (Pa), and 1.0 where the
        regressions are inside their fitted range.
    """
    line_load = maximum(line_load, LEAST_LINE_LOAD)
    entrainment = maximum(absolute(entrainment), LEAST_ENTRAINMENT)
    sliding = absolute(sliding)
    modulus = contact.effective_modulus
    W = line_load * curvature / modulus
    U = contact.inlet_viscosity * entrainment * curvature / modulus
    G = contact.pressure_viscosity * modulus
    S = contact.roughness * curvature
    V = contact.hardness / modulus
    log_W, log_U, log_G, log_S, log_V = log(W), log(U), log(G), log(S), log(V)
    share = asperity_load_ratio(log_W, log_U, log_G, log_S, log_V, contact.asperity_log_factor)
    film = central_film_thickness(log_W, log_U, log_G, log_S, log_V, curvature)

    half_width = hertz_half_width(line_load, curvature, modulus)
    pressure = line_load / (2.0 * half_width)
    shear_limit = limiting_shear_stress(
        pressure, share, contact.limiting_shear_coefficient, contact.limiting_share
    )
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
    viscosity = roelands_viscosity(
        contact.viscosity_pressure_factor * pressure * (1.0 - share),
        temperature_rise,
        contact.inlet_viscosity,
        contact.viscosity_pressure_index,
        contact.temperature_viscosity,
    )
    # where asperities carry everything the fluid has no shear limit left, and no weight either
    newtonian = minimum(viscosity * sliding / (maximum(shear_limit, 1.0) * film), 600.0)
    coefficient = contact.asperity_friction * share - shear_limit / pressure * expm1(-newtonian)
    return (
        coefficient,
        share,
        film,
        temperature_rise,
        hertz_pressure(line_load, curvature, modulus),
        in_fitted_range(W, U, G, S, V),
    )


@law
def _peclet_speed(speed, sliding, share):
    """Speed in a Péclet number: the surface's own, or with `share` 1 the sliding speed (Veciana)."""
    return (1.0 - share) * absolute(speed) + share * sliding


@law
def friction(law_code, line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact):
    """Evaluate the law in use; arguments and values as for `mixed_film`.

    The film is Masjedi & Khonsari's under every law, and the range that is told is the film's. Laws that
    give the whole mesh one mean coefficient (`mean_friction`) come as Coulomb's. `law_code` is static for
    JAX, an integer for numba.
    """
    coefficient, share, film, temperature, pressure, valid = mixed_film(
        line_load, curvature, entrainment, sliding, pinion_speed, gear_speed, contact
    )
    if law_code == NONE:
        coefficient = 0.0 * coefficient
        temperature = 0.0 * temperature
    elif law_code != MASJEDI_KHONSARI:
        load = maximum(line_load, LEAST_LINE_LOAD)
        speed = maximum(absolute(entrainment), LEAST_ENTRAINMENT)
        if law_code == XU:
            coefficient = xu(
                pressure, 1.0 / curvature, speed, sliding, contact.inlet_viscosity, contact.roughness
            )
        elif law_code == BENEDICT_KELLEY:
            coefficient = benedict_kelley(
                load, 2.0 * speed, sliding, contact.inlet_viscosity, contact.mean_roughness
            )
        else:
            coefficient = 0.0 * coefficient + contact.coulomb_coefficient
        half_width = hertz_half_width(load, curvature, contact.effective_modulus)
        heat_flux = coefficient * absolute(sliding) * pressure * math.pi / 4.0
        temperature = flash_temperature_rise(
            heat_flux,
            half_width,
            pinion_speed,
            gear_speed,
            contact.pinion_conductivity,
            contact.gear_conductivity,
            contact.pinion_heat_capacity,
            contact.gear_heat_capacity,
        )
    return coefficient, share, film, temperature, pressure, valid
