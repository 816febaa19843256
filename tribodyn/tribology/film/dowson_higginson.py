"""Minimum film of a line contact in elastohydrodynamic lubrication, Dowson & Higginson.

H_min = 2.65 U^0.7 G^0.54 W^−0.13 with H = h ρ⁻¹, U = η0 u/(E' ρ), G = α_PV E', W = w'/(E' ρ), the mean
u = (u_p + u_g)/2 and 1/E' = ½[(1 − ν1²)/E1 + (1 − ν2²)/E2]: Dowson, Proc. IMechE 182 (3A) (1968) 151; Dowson
& Higginson, Elasto-hydrodynamic Lubrication, 2nd ed. (1977). Formula and definitions from memory; they agree
with the groups of ISO/TR 15144-1, which goes back to the same authors (1600 G^0.6 U^0.7 W^−0.13 in µm/mm).
The formula is of smooth surfaces; `roughening` makes the film between rough ones of it.
"""

import math
from functools import partial

from tribodyn.numerics.elementary import law, log
from tribodyn.tribology.contact import hertz_pressure, inlet_heating, moes_numbers
from tribodyn.tribology.film.numbers import DOWSON_HIGGINSON, film_numbers, roughening
from tribodyn.tribology.law import FilmLaw, JudgedRange

_LOG_FACTOR = math.log(2.65)
_U_POWER, _G_POWER, _W_POWER = 0.7, 0.54, -0.13

#: Groups of the numerical solutions that the formula was fitted to, from memory, not checked against the
#: book; the flag `closure_in_range` rests on them, no other result does.
FITTED_RANGE = {"W": (3e-5, 3e-4), "U": (1e-13, 1e-11), "G": (2500.0, 5000.0)}
(_W_LOW, _W_HIGH), (_U_LOW, _U_HIGH), (_G_LOW, _G_HIGH) = FITTED_RANGE.values()
#: Where the formula is within 25 % of the solved contact, heat included: Moes' M and L, Hertz pressure (Pa),
#: η0 u² (W/m).
JUDGED_RANGE = {"M": (2.0, 500.0), "L": (2.0, 15.0), "pressure": (0.0, 1.4e9), "heating": (0.0, 1.0)}
(_M_LOW, _M_HIGH), (_L_LOW, _L_HIGH), (_, _P_HIGH), (_, _HEAT_HIGH) = JUDGED_RANGE.values()


@law
def dowson_higginson(contact, surfaces, parameters):
    """Ln of the smooth minimum film (m), and by which factor roughness raises it; no asperity load."""
    log_curvature = log(contact.curvature)
    log_W = log(contact.line_load) + log_curvature - parameters.log_modulus
    log_U = log(contact.entrainment) + log_curvature + parameters.log_inlet_viscosity - parameters.log_modulus
    log_H = _LOG_FACTOR + _U_POWER * log_U + _G_POWER * parameters.log_material + _W_POWER * log_W
    log_smooth = log_H - log_curvature
    return log_smooth, roughening(log_smooth, parameters.log_roughness), 0.0


@law
def in_ranges(contact, surfaces, parameters):
    """Shares allowed by `FITTED_RANGE`, then by `JUDGED_RANGE`, in the order of the law's limits."""
    modulus = surfaces.effective_modulus
    W = contact.line_load * contact.curvature / modulus
    U = surfaces.inlet_viscosity * contact.entrainment * contact.curvature / modulus
    G = surfaces.pressure_viscosity * modulus
    load, material = moes_numbers(contact, surfaces)
    pressure = hertz_pressure(contact.line_load, contact.curvature, modulus)
    fitted = W / _W_LOW, U / _U_LOW, G / _G_LOW, _W_HIGH / W, _U_HIGH / U, _G_HIGH / G
    low = load / _M_LOW, material / _L_LOW
    high = _M_HIGH / load, _L_HIGH / material, _P_HIGH / pressure
    return (*fitted, *low, *high, _HEAT_HIGH / inlet_heating(contact, surfaces))


LAW = FilmLaw(
    "dowson-higginson",
    "minimum film of line contacts, Dowson & Higginson (1968), raised by roughness",
    dowson_higginson,
    partial(film_numbers, number=DOWSON_HIGGINSON),
    in_range=in_ranges,
    range="3e-5 ≤ W ≤ 3e-4, 1e-13 ≤ U ≤ 1e-11, 2500 ≤ G ≤ 5000",
    thickness="minimum",
    limits=(
        *("W ≥ 3e-5", "U ≥ 1e-13", "G ≥ 2500", "W ≤ 3e-4", "U ≤ 1e-11", "G ≤ 5000"),
        *("M ≥ 2", "L ≥ 2", "M ≤ 500", "L ≤ 15", "p_H ≤ 1.4 GPa", "η0 u² ≤ 1 W/m"),
    ),
    judged=JudgedRange((0.75, 1.25), (0.816, 0.959, 1.04), 6, (0.894, 1.02, 1.46)),
)
