"""Film of a line contact in every regime, from rigid and isoviscous to elastic and piezoviscous: Moes.

Moes, Proc. IMechE 180 (3B) (1965) 244 drew the map; the formula that joins its four asymptotes stands in
Moes, Wear 159 (1992) 57, and, for the central film, in Venner's thesis (Twente, 1991). Here from memory:

    M = W U_Σ^−1/2, L = G U_Σ^1/4, H = (h/ρ) U_Σ^−1/2, U_Σ = η0 (u_p + u_g)/(E' ρ), W = w'/(E' ρ), G = α_PV E'
    H_RI = 3 M^−1                     rigid, isoviscous
    H_RP = 1.287 L^2/3                rigid, piezoviscous
    H_EI = 2.621 M^−1/5               elastic, isoviscous
    H_EP = 1.311 M^−1/8 L^3/4         elastic, piezoviscous
    H^s = (H_RI^7/3 + H_EI^7/3)^(3s/7) + (H_RP^−7/2 + H_EP^−7/2)^(−2s/7),  s = (7 + 8 exp(−2 H_EI/H_RI))/5

with 2/E' = (1 − ν1²)/E1 + (1 − ν2²)/E2, as everywhere here, and Barus' exponential viscosity. The film is the
one at which the pressure is highest, where all fluid goes through: in a rigid contact 1.226 times the film on
the line of centres, which makes Martin's 2.449/M of it 3/M. The formula is of smooth surfaces; `roughening`
makes the film between rough ones of it.
"""

import math
from functools import partial

from tribodyn.numerics.elementary import absolute, exp, law, log, log1p, maximum, minimum
from tribodyn.tribology.contact import hertz_pressure, inlet_heating, moes_numbers
from tribodyn.tribology.film.numbers import MOES, film_numbers, roughening
from tribodyn.tribology.law import FilmLaw, JudgedRange

_LOG_RI, _LOG_RP = math.log(3.0), math.log(1.287)
_LOG_EI, _LOG_EP = math.log(2.621), math.log(1.311)
_LOG_2 = math.log(2.0)
#: Where the formula is within 25 % of the solved contact of a compressible oil, heat included: M, L, Hertz
#: pressure (Pa), η0 u² (W/m). It knows no compressibility, and lies above the solved film by about the
#: relative density.
JUDGED_RANGE = {"M": (2.0, 1000.0), "L": (1.0, 15.0), "pressure": (0.0, 0.75e9), "heating": (0.0, 1.0)}
(_M_LOW, _M_HIGH), (_L_LOW, _L_HIGH), (_, _P_HIGH), (_, _HEAT_HIGH) = JUDGED_RANGE.values()


@law
def log_of_sum(a, b):
    """ln(e^a + e^b) without overflow."""
    return maximum(a, b) + log1p(exp(-absolute(a - b)))


@law
def log_survey(log_M, log_L):
    """Dimensionless film ln H from ln M and ln L."""
    rigid_isoviscous = _LOG_RI - log_M
    rigid_piezoviscous = _LOG_RP + log_L * (2.0 / 3.0)
    elastic_isoviscous = _LOG_EI - 0.2 * log_M
    elastic_piezoviscous = _LOG_EP - 0.125 * log_M + 0.75 * log_L
    ratio = exp(minimum(elastic_isoviscous - rigid_isoviscous, 30.0))
    s = 0.2 * (7.0 + 8.0 * exp(-2.0 * minimum(ratio, 300.0)))
    isoviscous = log_of_sum(rigid_isoviscous * (7.0 / 3.0), elastic_isoviscous * (7.0 / 3.0)) * (3.0 / 7.0)
    piezoviscous = log_of_sum(-3.5 * rigid_piezoviscous, -3.5 * elastic_piezoviscous) * (-2.0 / 7.0)
    return log_of_sum(s * isoviscous, s * piezoviscous) / s


@law
def moes(contact, surfaces, parameters):
    """Ln of the smooth central film (m), and by which factor roughness raises it; no asperity load."""
    log_curvature = log(contact.curvature)
    log_W = log(contact.line_load) + log_curvature - parameters.log_modulus
    log_U = _LOG_2 + log(contact.entrainment) + log_curvature
    log_U = log_U + parameters.log_inlet_viscosity - parameters.log_modulus
    log_H = log_survey(log_W - 0.5 * log_U, parameters.log_material + 0.25 * log_U)
    log_smooth = log_H + 0.5 * log_U - log_curvature
    return log_smooth, roughening(log_smooth, parameters.log_roughness), 0.0


@law
def in_judged_range(contact, surfaces, parameters):
    """Shares of M, L, pressure and heat allowed by `JUDGED_RANGE`, in the order of the law's limits."""
    load, material = moes_numbers(contact, surfaces)
    pressure = hertz_pressure(contact.line_load, contact.curvature, surfaces.effective_modulus)
    heating = _HEAT_HIGH / inlet_heating(contact, surfaces)
    low = load / _M_LOW, material / _L_LOW
    return (*low, _M_HIGH / load, _L_HIGH / material, _P_HIGH / pressure, heating)


LAW = FilmLaw(
    "moes",
    "central film of line contacts in all regimes, Moes' survey formula, raised by roughness",
    moes,
    partial(film_numbers, number=MOES),
    in_range=in_judged_range,
    limits=("M ≥ 2", "L ≥ 1", "M ≤ 1000", "L ≤ 15", "p_H ≤ 0.75 GPa", "η0 u² ≤ 1 W/m"),
    judged=JudgedRange((0.75, 1.25), (0.66, 1.12, 1.23), 6, (1.1, 1.22, 1.63)),
)
