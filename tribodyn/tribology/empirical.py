"""Friction coefficients by regression over local contact conditions: Xu's EHL formula, Benedict & Kelley."""

from tribodyn.numerics.elementary import absolute, exp, law, log, maximum, minimum

LN10 = 2.302585092994046

#: Benedict & Kelley's coefficient grows without bound towards pure rolling; their discs slid by more than
#: this share of the rolling speed, and closer to the pitch point the law is held.
LEAST_SLIDING = 0.01
#: Their roughness factor has a pole at Ra = 1.13 µm; it is held at this value, which Ra = 0.75 µm reaches.
GREATEST_ROUGHNESS_FACTOR = 3.0


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
    pressure : greatest Hertz pressure p_H, Pa
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
        + 0.620305 * exp(1e6 * roughness)
        + 1.03303 * log(gigapascal)
        + 1.036077 * log(ratio)
        - 0.100601 * log(entrainment)
        + 0.752755 * log_viscosity
        - 0.390958 * log(radius)
    )
    return exp(maximum(minimum(exponent, 300.0), -300.0))


@law
def benedict_kelley(line_load, sum_speed, sliding, viscosity, mean_roughness):
    """Friction coefficient of gear teeth by Benedict & Kelley's disc tests.

    μ = 0.0127 [1.13/(1.13 − S)] log10[29700 w/(η |v_s| V_Σ²)] with w in N/mm, η in mPa·s, speeds in m/s and
    S in µm.

    Benedict & Kelley, ASLE Trans. 4 (1961) 59; in SI units as in Anderson & Loewenthal, NASA TP 1622 (1980),
    without their roughness factor. Mixed lubrication by mineral oils; S below 0.75 µm. Towards pure rolling
    the logarithm diverges: see `LEAST_SLIDING`. Never below zero.

    Parameters
    ----------
    line_load : w = F_n/b, N/m
    sum_speed : V_Σ = u_p + u_g, m/s, > 0
    sliding : v_s, m/s, any sign
    viscosity : dynamic viscosity η at inlet temperature, Pa·s
    mean_roughness : arithmetic mean roughness S, m
    """
    slid = maximum(absolute(sliding), LEAST_SLIDING * sum_speed)
    smooth = maximum(1.13 - 1e6 * mean_roughness, 1.13 / GREATEST_ROUGHNESS_FACTOR)
    argument = 29.7 * line_load / (1e3 * viscosity * slid * sum_speed * sum_speed)
    return 0.0127 * 1.13 / smooth * maximum(log(argument) / LN10, 0.0)
