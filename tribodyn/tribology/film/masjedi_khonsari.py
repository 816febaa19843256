"""Film thickness and asperity load of a rough line contact in mixed elastohydrodynamic lubrication.

Masjedi & Khonsari, "Film thickness and asperity load formulas for line-contact elastohydrodynamic
lubrication with provision for surface roughness", J. Tribol. 134 (2012) 011503; Liu & Ni (19), (24).
"""

import math
from dataclasses import replace
from functools import partial

from tribodyn.numerics.elementary import exp, law, log, log1p, maximum, minimum, where
from tribodyn.tribology.contact import inlet_heating, moes_numbers
from tribodyn.tribology.film.numbers import MASJEDI_KHONSARI, film_numbers
from tribodyn.tribology.law import FilmLaw, JudgedRange

#: Ranges over which the regressions were fitted: load W, speed U, material G, roughness σ/ρ, hardness V.
#: The bounds are given from memory of the literature and have not been checked against the paper; the flags
#: `closure_in_range` and `friction_in_range` rest on them, no other result does.
FITTED_RANGE = {
    "W": (2e-5, 5e-4),
    "U": (1e-12, 1e-10),
    "G": (2500.0, 7500.0),
    "roughness": (0.0, 5e-5),
    "V": (0.005, 0.03),
}
(_W_LOW, _W_HIGH), (_U_LOW, _U_HIGH), (_G_LOW, _G_HIGH), (_, _S_HIGH), (_V_LOW, _V_HIGH) = (
    FITTED_RANGE.values()
)
#: Where the film is within 25 % of the solved contact, heat included: Moes' M and L, the factor by which the
#: formula raises the film of smooth surfaces for their roughness, η0 u² (W/m).
JUDGED_RANGE = {"M": (2.0, 1000.0), "L": (2.0, 20.0), "factor": (1.0, 2.0), "heating": (0.0, 3.0)}
(_M_LOW, _M_HIGH), (_L_LOW, _L_HIGH), (_, _FACTOR_HIGH), (_, _HEAT_HIGH) = JUDGED_RANGE.values()

#: Half width of the C1 blend by which the asperity load ratio is held at 1.
CAP_WIDTH = 0.01
_LOG_FILM_FACTOR = math.log(2.691)
_CAP_BEND = 1.0 / (4.0 * CAP_WIDTH)
LIMITS = (
    *("W ≥ 2e-5", "U ≥ 1e-12", "G ≥ 2500", "V ≥ 0.005"),
    *("W ≤ 5e-4", "U ≤ 1e-10", "G ≤ 7500", "V ≤ 0.03", "σ/ρ ≤ 5e-5"),
)
RANGE = "2e-5 ≤ W ≤ 5e-4, 1e-12 ≤ U ≤ 1e-10, 2500 ≤ G ≤ 7500, σ/ρ ≤ 5e-5, 0.005 ≤ V ≤ 0.03"


@law
def asperity_load_ratio(log_W, log_U, log_G, log_S, log_V, log_factor):
    """Share λ = L_a/100 of the load that asperities carry, 0 … 1.

    L_a[%] = 0.005 W^−0.408 U^−0.088 G^0.103 ln(1 + 4470 σ̄^6.015 V^1.168 W^0.485 U^−3.741 G^−2.898), from the
    logarithms of the dimensionless groups and of the factor. Liu & Ni (19) print 447 for 4470; it is a
    parameter so that both can be run. The cap at 100 % is blended over 1 ± `CAP_WIDTH`.
    """
    inner = log_factor + 1.168 * log_V - 2.898 * log_G + 6.015 * log_S - 3.741 * log_U + 0.485 * log_W
    logarithm = where(inner > 30.0, inner, log1p(exp(minimum(inner, 30.0))))
    ratio = 0.00005 * exp(0.103 * log_G - 0.088 * log_U - 0.408 * log_W) * logarithm
    excess = minimum(maximum(ratio - 1.0 + CAP_WIDTH, 0.0), 2.0 * CAP_WIDTH)
    return minimum(ratio, 1.0 + CAP_WIDTH) - excess * excess * _CAP_BEND


@law
def central_film_thickness(log_W, log_U, log_G, log_S, log_V, log_curvature):
    """Central film thickness h_c of smooth surfaces, ln of m, and the factor by which roughness raises it.

    From the logarithms of the dimensionless groups and of the curvature 1/ρ in 1/m:
    h_c = 2.691 W^−0.135 U^0.705 G^0.556 ρ (1 + 0.2 σ̄^1.222 V^0.223 W^−0.229 U^−0.748 G^−0.842)
    """
    smooth = _LOG_FILM_FACTOR + 0.556 * log_G + 0.705 * log_U - log_curvature - 0.135 * log_W
    rough = 0.2 * exp(0.223 * log_V - 0.842 * log_G + 1.222 * log_S - 0.748 * log_U - 0.229 * log_W)
    return smooth, 1.0 + rough


@law
def _groups(contact, parameters):
    """Logarithms of the dimensionless groups W, U, G, σ̄ and V, and of the curvature in 1/m."""
    log_curvature = log(contact.curvature)
    log_W = log(contact.line_load) + log_curvature - parameters.log_modulus
    log_U = log(contact.entrainment) + log_curvature + parameters.log_inlet_viscosity - parameters.log_modulus
    log_S = log_curvature + parameters.log_roughness
    return log_W, log_U, parameters.log_material, log_S, parameters.log_hardness, log_curvature


@law
def rough_film(contact, surfaces, parameters):
    """Ln of the smooth central film (m), roughness factor, asperity load share; see `FilmLaw`."""
    log_W, log_U, log_G, log_S, log_V, log_curvature = _groups(contact, parameters)
    share = asperity_load_ratio(log_W, log_U, log_G, log_S, log_V, parameters.log_asperity_factor)
    log_smooth, rough = central_film_thickness(log_W, log_U, log_G, log_S, log_V, log_curvature)
    return log_smooth, rough, share


@law
def in_fitted_range(contact, surfaces, parameters):
    """Shares of the dimensionless groups allowed by `FITTED_RANGE`, in the order of `LIMITS`."""
    modulus = surfaces.effective_modulus
    W = contact.line_load * contact.curvature / modulus
    U = surfaces.inlet_viscosity * contact.entrainment * contact.curvature / modulus
    G = surfaces.pressure_viscosity * modulus
    S = surfaces.roughness * contact.curvature
    V = surfaces.hardness / modulus
    low = W / _W_LOW, U / _U_LOW, G / _G_LOW, V / _V_LOW
    return (*low, _W_HIGH / W, _U_HIGH / U, _G_HIGH / G, _V_HIGH / V, _S_HIGH / S)


@law
def in_ranges(contact, surfaces, parameters):
    """Shares allowed by `FITTED_RANGE`, then by `JUDGED_RANGE`, in the order of the law's limits."""
    load, material = moes_numbers(contact, surfaces)
    fitted = in_fitted_range(contact, surfaces, parameters)
    _, roughened = central_film_thickness(*_groups(contact, parameters))
    low = load / _M_LOW, material / _L_LOW
    high = _M_HIGH / load, _L_HIGH / material, _FACTOR_HIGH / roughened
    return (*fitted, *low, *high, _HEAT_HIGH / inlet_heating(contact, surfaces))


JUDGED_LIMITS = "M ≥ 2", "L ≥ 2", "M ≤ 1000", "L ≤ 20", "roughness factor of the film ≤ 2", "η0 u² ≤ 3 W/m"

LAW = FilmLaw(
    "masjedi-khonsari",
    "central film and asperity load of rough line contacts, Masjedi & Khonsari (2012)",
    rough_film,
    partial(film_numbers, number=MASJEDI_KHONSARI),
    in_range=in_ranges,
    range=RANGE,
    limits=(*LIMITS, *JUDGED_LIMITS),
    # of the film, which is the same with the misprint
    judged=JudgedRange((0.75, 1.25), (0.942, 1.0, 1.15), len(JUDGED_LIMITS), (1.03, 1.41, 3.48)),
)
AS_PRINTED = replace(
    LAW,
    name="masjedi-khonsari-as-printed",
    about="the same with Liu & Ni's misprint in the asperity load, 447 for 4470",
    parameters=partial(film_numbers, number=MASJEDI_KHONSARI, asperity_log_factor=447.0),
)
