"""A Stribeck curve without its rise: from boundary to fluid friction as the entrainment speed grows.

μ = μ_f + (μ_b − μ_f) exp(−u/u_0), a shape for measured coefficients; the numbers are those of a measurement,
which therefore have no defaults. With μ_b = μ_f it is Coulomb's law.
"""

from tribodyn import FrictionLaw, Parameter
from tribodyn.numerics.elementary import exp, where


def coefficient(contact, film, surfaces, parameters):
    """Friction coefficient."""
    excess = parameters.boundary_coefficient - parameters.fluid_coefficient
    return parameters.fluid_coefficient + excess * exp(-contact.entrainment / parameters.reference_speed)


def in_range(contact, film, surfaces, parameters):
    """1.0 where the entrainment speed was measured, else 0.0."""
    return where(contact.entrainment <= parameters.measured_up_to, 1.0, 0.0)


LAW = FrictionLaw(
    "stribeck",
    "from boundary to fluid friction as the entrainment speed grows",
    coefficient,
    keys=(
        Parameter("boundary_coefficient", "number", "μ_b, at rest", allowed="not negative", example="0.12"),
        Parameter("fluid_coefficient", "number", "μ_f, at speed", allowed="not negative", example="0.03"),
        Parameter("reference_speed", "velocity", "u_0, by which μ has fallen by 63 %", example='"1 m/s"'),
        Parameter(
            "measured_up_to", "velocity", "entrainment speed up to which it was measured", example='"10 m/s"'
        ),
    ),
    in_range=in_range,
    range="entrainment speed up to friction.measured_up_to",
)
