"""Mean friction coefficient of a mesh by ISO/TR 14179-1, from the conditions at its pitch point."""

from tribodyn.numerics.elementary import exp, log, minimum
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.coulomb import mean_law

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


LAW = mean_law(
    "iso-14179-1",
    "mean coefficient of the mesh by ISO/TR 14179-1",
    iso_14179_1,
    _within,
    "2 < V ≤ 25 m/s, 1.4 < K ≤ 14 N/mm² (the standard)",
    "2 m/s ≤ V ≤ 25 m/s and 1.4 N/mm² ≤ K ≤ 14 N/mm²",
    (0.276, 0.79, 3.35),
    (0.365, 2.84, 14.2),
)
