"""Mean friction coefficient of a mesh by Niemann, from the conditions at its pitch point."""

from tribodyn.numerics.elementary import exp, log
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.coulomb import mean_law

#: Pitch line speed up to which the FZG tests behind the formula went, m/s.
MAXIMUM_SPEED = 50.0


def niemann(conditions: NominalConditions) -> float:
    """Mean friction coefficient by Niemann, as ISO/TR 14179-2 and Höhn use it.

    μ_m = 0.048 [w/(V_ΣC ρ_C)]^0.2 η^−0.05 Ra^0.25 X_L w^−d, with w in N/mm, V in m/s, ρ in mm, η in mPa·s and
    Ra in µm: Diez-Ibarbia (6), whose print loses the face width in w. Fitted to FZG tests of case-hardened
    gears, V up to about 50 m/s. X_L is that of the oil's type, or 1 with d = 0.0651 for mineral oil 75W90.
    """
    load = log(1e-3 * conditions.line_load)
    return conditions.lubricant_factor * mean_of_fzg_tests(conditions) * exp(-conditions.load_exponent * load)


def mean_of_fzg_tests(conditions: NominalConditions) -> float:
    """The part of Niemann's coefficient that Schlenk's shares: 0.048 [w/(V_ΣC ρ_C)]^0.2 η^−0.05 Ra^0.25."""
    group = 1e-3 * conditions.line_load * 1e-3 * conditions.curvature / conditions.sum_speed
    viscosity = 1e3 * conditions.viscosity
    roughness = 1e6 * conditions.mean_roughness
    return 0.048 * exp(0.2 * log(group) - 0.05 * log(viscosity) + 0.25 * log(roughness))


def within_speed(conditions: NominalConditions) -> float:
    """`MAXIMUM_SPEED` over the pitch line speed."""
    return MAXIMUM_SPEED / conditions.pitch_line_speed


RANGE = "pitch line speed up to about 50 m/s (FZG tests of case-hardened gears)"
LIMIT = "pitch line speed ≤ 50 m/s"
LAW = mean_law(
    "niemann",
    "mean coefficient of the mesh by Niemann, as in ISO/TR 14179-2",
    niemann,
    within_speed,
    RANGE,
    LIMIT,
    (0.46, 2.01, 5.62),
)


def schlenk(conditions: NominalConditions) -> float:
    """Mean friction coefficient by Schlenk (dissertation, TU München 1995).

    μ_m = 0.048 [w/(V_ΣC ρ_C)]^0.2 η^−0.05 Ra^0.25 X_L with w in N/mm, V in m/s, ρ in mm, η in mPa·s, Ra in µm
    and his lubricant factor X_L of the oil's type, `tribology.oil.SCHLENK_FACTOR`.
    """
    return conditions.schlenk_factor * mean_of_fzg_tests(conditions)


SCHLENK = mean_law(
    "schlenk",
    "mean coefficient of the mesh by Schlenk, with the lubricant factor of the oil's type",
    schlenk,
    within_speed,
    RANGE,
    LIMIT,
    (0.575, 1.69, 4.57),
)
