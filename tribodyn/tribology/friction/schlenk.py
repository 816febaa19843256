"""Mean friction coefficient of a mesh by Schlenk, from the conditions at its pitch point."""

from tribodyn.numerics.elementary import as_float
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.coulomb import Constant, constant, range_of_constant
from tribodyn.tribology.friction.niemann import MAXIMUM_SPEED, mean_of_fzg_tests
from tribodyn.tribology.law import FrictionLaw, JudgedRange, LawInput


def schlenk(conditions: NominalConditions) -> float:
    """Mean friction coefficient by Schlenk (dissertation, TU München 1995).

    μ_m = 0.048 [w/(V_ΣC ρ_C)]^0.2 η^−0.05 Ra^0.25 X_L with w in N/mm, V in m/s, ρ in mm, η in mPa·s, Ra in µm
    and his lubricant factor X_L of the oil's type, `tribology.oil.SCHLENK_FACTOR`.
    """
    return conditions.schlenk_factor * mean_of_fzg_tests(conditions)


def _mean(given: LawInput) -> Constant:
    conditions = given.nominal()
    return Constant(as_float(schlenk(conditions)), as_float(MAXIMUM_SPEED / conditions.pitch_line_speed))


LAW = FrictionLaw(
    "schlenk",
    "mean coefficient of the mesh by Schlenk, with the lubricant factor of the oil's type",
    constant,
    _mean,
    in_range=range_of_constant,
    range="pitch line speed up to about 50 m/s (FZG tests of case-hardened gears)",
    limits=("pitch line speed ≤ 50 m/s",),
    judged=JudgedRange((0.5, 2.0), (0.575, 1.69, 4.57)),
)
