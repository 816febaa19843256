"""Friction coefficient by Xu's regression over thermal elastohydrodynamic solutions."""

from tribodyn.numerics.elementary import absolute, exp, law, log, maximum, minimum
from tribodyn.tribology.contact import hertz_pressure
from tribodyn.tribology.law import FrictionLaw, JudgedRange

LN10 = 2.302585092994046

#: Conditions of the solutions behind the regression: Hertz pressure (Pa), slide-to-roll ratio, roughness (m).
#: The bounds are given from memory of the dissertation; the flag `friction_in_range` rests on them, no other
#: result does.
FITTED_RANGE = {"pressure": (0.5e9, 2.5e9), "slide_to_roll": (0.0, 1.0), "roughness": (0.0, 1e-6)}
(_P_LOW, _P_HIGH), (_, _SR_HIGH), (_, _S_HIGH) = FITTED_RANGE.values()


@law
def xu(pressure, radius, entrainment, sliding, viscosity, roughness):
    """Friction coefficient of a gear contact by Xu's regression over thermal EHL solutions.

    μ = e^f p_H^b2 |SR|^b3 V_e^b6 ν0^b7 R^b8,
    f = b1 + b4 |SR| p_H log10 ν0 + b5 exp(−|SR| p_H log10 ν0) + b9 exp(S), SR = v_s/V_e.

    H. Xu, dissertation, Ohio State University (2005); Xu, Kahraman, Anderson & Maddock, J. Mech. Des. 129
    (2007) 58; Veciana (1), (2), who lose the coefficients' signs. For gear oil 75W90 at 100 °C; the
    coefficients belong to p_H in GPa, V_e in m/s, ν0 in cP, R in m, S in µm. Meant for films that separate
    the teeth of case-hardened gears: p_H about 0.5 … 2.5 GPa, |SR| ≤ 1, S some tenths of a µm (exp(S) runs
    away beyond 1 µm). No friction in pure rolling.

    Parameters
    ----------
    pressure : maximum Hertz pressure p_H, Pa
    radius : equivalent radius of curvature R, m
    entrainment : V_e = (u_p + u_g)/2, m/s, > 0
    sliding : v_s, m/s, any sign
    viscosity : dynamic viscosity ν0 at inlet temperature, Pa·s
    roughness : composite rms roughness S, m
    """
    ratio = maximum(absolute(sliding) / entrainment, 1e-12)
    gigapascal = 1e-9 * pressure
    log_viscosity = log(1e3 * viscosity)
    group = ratio * gigapascal * log_viscosity / LN10
    exponent = (
        -8.916465
        - 0.354068 * group
        + 2.812084 * exp(-group)
        + 0.620305 * exp(minimum(1e6 * roughness, 100.0))
        + 1.03303 * log(gigapascal)
        + 1.036077 * log(ratio)
        - 0.100601 * log(entrainment)
        + 0.752755 * log_viscosity
        - 0.390958 * log(radius)
    )
    return exp(maximum(minimum(exponent, 300.0), -300.0))


@law
def xu_at(contact, film, surfaces, parameters):
    """Coefficient of a local contact."""
    return xu(
        hertz_pressure(contact.line_load, contact.curvature, surfaces.effective_modulus),
        1.0 / contact.curvature,
        contact.entrainment,
        contact.sliding,
        surfaces.inlet_viscosity,
        surfaces.roughness,
    )


@law
def in_fitted_range(contact, film, surfaces, parameters):
    """Shares of pressure, slide-to-roll ratio and roughness allowed by `FITTED_RANGE`."""
    pressure = hertz_pressure(contact.line_load, contact.curvature, surfaces.effective_modulus)
    ratio = maximum(absolute(contact.sliding) / contact.entrainment, 1e-12)
    rough = _S_HIGH / surfaces.roughness + 0.0 * pressure
    return pressure / _P_LOW, _P_HIGH / pressure, _SR_HIGH / ratio, rough


LAW = FrictionLaw(
    "xu",
    "regression over thermal EHL solutions for oil 75W90, Xu (2005)",
    xu_at,
    in_range=in_fitted_range,
    range="Hertz pressure 0.5 … 2.5 GPa, slide-to-roll ratio ≤ 1, roughness ≤ 1 µm",
    limits=("p_H ≥ 0.5 GPa", "p_H ≤ 2.5 GPa", "slide-to-roll ratio ≤ 1", "roughness ≤ 1 µm"),
    judged=JudgedRange((0.5, 2.0), (0.656, 1.94, 14.3), outside=(0.599, 6.51, 50.7)),
    reads_film=False,
)
