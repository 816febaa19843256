"""Mean friction coefficient of a mesh by Schlenk, from the conditions at its pitch point."""

from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.coulomb import mean_law
from tribodyn.tribology.friction.niemann import LIMIT, RANGE, mean_of_fzg_tests, within_speed


def schlenk(conditions: NominalConditions) -> float:
    """Mean friction coefficient by Schlenk (dissertation, TU München 1995).

    μ_m = 0.048 [w/(V_ΣC ρ_C)]^0.2 η^−0.05 Ra^0.25 X_L with w in N/mm, V in m/s, ρ in mm, η in mPa·s, Ra in µm
    and his lubricant factor X_L of the oil's type, `tribology.oil.SCHLENK_FACTOR`.
    """
    return conditions.schlenk_factor * mean_of_fzg_tests(conditions)


LAW = mean_law(
    "schlenk",
    "mean coefficient of the mesh by Schlenk, with the lubricant factor of the oil's type",
    schlenk,
    within_speed,
    RANGE,
    LIMIT,
    (0.575, 1.69, 4.57),
)
