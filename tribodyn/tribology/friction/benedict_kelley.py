"""Friction coefficient of gear teeth by Benedict & Kelley's disc tests."""

from tribodyn.numerics.elementary import absolute, exp, law, log, maximum
from tribodyn.tribology.law import FrictionLaw, JudgedRange

LN10 = 2.302585092994046

#: Benedict & Kelley's coefficient grows without bound towards pure rolling; their discs slid by more than
#: this share of the rolling speed, and closer to the pitch point the law is held.
MINIMUM_SLIDING = 0.01
#: Their roughness factor has a pole at Ra = 1.13 µm; it is held at this value, which Ra = 0.75 µm reaches.
MAXIMUM_ROUGHNESS_FACTOR = 3.0
_MAXIMUM_ROUGHNESS = 1e-6 * 1.13 * (1.0 - 1.0 / MAXIMUM_ROUGHNESS_FACTOR)


@law
def log10_of_group(line_load, sum_speed, sliding, viscosity):
    """log10 of 29700 w/(η |v_s| V_Σ²), the sliding speed held at `MINIMUM_SLIDING` of the rolling speed."""
    slid = maximum(absolute(sliding), MINIMUM_SLIDING * sum_speed)
    return log(29.7 * line_load / (1e3 * viscosity * slid * sum_speed * sum_speed)) / LN10


@law
def benedict_kelley(line_load, sum_speed, sliding, viscosity, mean_roughness):
    """Friction coefficient of gear teeth by Benedict & Kelley's disc tests.

    μ = 0.0127 [1.13/(1.13 − S)] log10[29700 w/(η |v_s| V_Σ²)] with w in N/mm, η in mPa·s, speeds in m/s and
    S in µm.

    Benedict & Kelley, ASLE Trans. 4 (1961) 59; in SI units as in Anderson & Loewenthal, NASA TP 1622 (1980),
    without their roughness factor. Mixed lubrication by mineral oils; S below 0.75 µm. Towards pure rolling
    the logarithm diverges: see `MINIMUM_SLIDING`. Never below zero.

    Parameters
    ----------
    line_load : w = F_n/b, N/m
    sum_speed : V_Σ = u_p + u_g, m/s, > 0
    sliding : v_s, m/s, any sign
    viscosity : dynamic viscosity η at inlet temperature, Pa·s
    mean_roughness : arithmetic mean roughness S, m
    """
    smooth = maximum(1.13 - 1e6 * mean_roughness, 1.13 / MAXIMUM_ROUGHNESS_FACTOR)
    logarithm = log10_of_group(line_load, sum_speed, sliding, viscosity)
    return 0.0127 * 1.13 / smooth * maximum(logarithm, 0.0)


@law
def benedict_kelley_at(contact, film, surfaces, parameters):
    """Coefficient of a local contact."""
    return benedict_kelley(
        contact.line_load,
        2.0 * contact.entrainment,
        contact.sliding,
        surfaces.inlet_viscosity,
        surfaces.mean_roughness,
    )


@law
def not_held(contact, film, surfaces, parameters):
    """Shares by which the law is clear of its poles and of zero, where it is held."""
    sum_speed = 2.0 * contact.entrainment
    logarithm = log10_of_group(contact.line_load, sum_speed, contact.sliding, surfaces.inlet_viscosity)
    slides = absolute(contact.sliding) / (MINIMUM_SLIDING * sum_speed)
    smooth = _MAXIMUM_ROUGHNESS / surfaces.mean_roughness + 0.0 * logarithm
    return slides, smooth, exp(LN10 * logarithm)


LAW = FrictionLaw(
    "benedict-kelley",
    "disc tests in mixed lubrication, Benedict & Kelley (1961)",
    benedict_kelley_at,
    in_range=not_held,
    range="where it is not held: sliding ≥ 1 % of the rolling speed, Ra ≤ 0.75 µm, coefficient above zero",
    limits=(
        "sliding ≥ 1 % of the rolling speed",
        "Ra ≤ 0.75 µm",
        "29700 w/(η |v_s| V_Σ²) ≥ 1 (coefficient above zero)",
    ),
    judged=JudgedRange((0.5, 2.0), (1.02, 3.87, 25.0), outside=(2.43, 7.0, 20.8)),
    reads_film=False,
)
