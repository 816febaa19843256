"""Mean friction coefficients of a mesh, from the conditions at its pitch point: one formula a law."""

from collections.abc import Callable
from functools import partial
from typing import Any

from tribodyn.numerics.elementary import as_float, exp, log, minimum
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.coulomb import Constant, constant, range_of_constant
from tribodyn.tribology.law import FrictionLaw, JudgedRange, LawInput


def mean_of_mesh(
    given: LawInput, mean: Callable[[NominalConditions], Any], share: Callable[[NominalConditions], Any]
) -> Constant:
    """Parameters from the conditions at the pitch point: mean coefficient, share that its limits allow."""
    conditions = given.nominal()
    return Constant(as_float(mean(conditions)), as_float(share(conditions)))


def mean_law(
    name: str,
    about: str,
    mean: Callable[[NominalConditions], Any],
    share: Callable[[NominalConditions], Any],
    range: str,
    limit: str,
    ratio: tuple[float, float, float],
) -> FrictionLaw:
    """Law of a mean coefficient over the mesh; `ratio` to the solved contact as in `JudgedRange`."""
    return FrictionLaw(
        name,
        about,
        constant,
        partial(mean_of_mesh, mean=mean, share=share),
        in_range=range_of_constant,
        range=range,
        limits=(limit,),
        judged=JudgedRange((0.5, 2.0), ratio),
    )


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
NIEMANN = mean_law(
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


#: Pitch line speed (m/s) and load intensity (Pa) for which the standard gives the formula.
SPEED_RANGE = (2.0, 25.0)
INTENSITY_RANGE = (1.4e6, 14e6)


def iso_14179_1(conditions: NominalConditions) -> float:
    """Mesh coefficient of friction of ISO/TR 14179-1:2001 (AGMA's method).

    f_m = ν^−0.223 K^−0.40/(3.239 V^0.70) with the kinematic viscosity ν in mm²/s, the load intensity K in
    N/mm² and the pitch line speed V in m/s; for 2 < V ≤ 25 m/s and 1.4 < K ≤ 14 N/mm². The coefficient falls
    with the load, against the other laws, and does not depend on roughness.
    """
    kinematic = 1e6 * conditions.viscosity / conditions.density
    intensity = 1e-6 * conditions.load_intensity
    return (
        exp(-0.223 * log(kinematic) - 0.40 * log(intensity) - 0.70 * log(conditions.pitch_line_speed)) / 3.239
    )


def _within(conditions: NominalConditions) -> float:
    speed, intensity = conditions.pitch_line_speed, conditions.load_intensity
    return minimum(
        minimum(speed / SPEED_RANGE[0], SPEED_RANGE[1] / speed),
        minimum(intensity / INTENSITY_RANGE[0], INTENSITY_RANGE[1] / intensity),
    )


ISO_14179_1 = mean_law(
    "iso-14179-1",
    "mean coefficient of the mesh by ISO/TR 14179-1",
    iso_14179_1,
    _within,
    "2 < V ≤ 25 m/s, 1.4 < K ≤ 14 N/mm² (the standard)",
    "2 m/s ≤ V ≤ 25 m/s and 1.4 N/mm² ≤ K ≤ 14 N/mm²",
    (0.276, 0.79, 3.35),
)
