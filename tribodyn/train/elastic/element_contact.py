"""Contact of a rolling element between both raceways, by Hertz: one law per type. For all compilers.

The static equilibrium of `rolling_bearing` and the forces in time of `train.bearing_forces` both sum these.
The energy of a contact is its load times its compression over 1 + exponent.
"""

from tribodyn.numerics.elementary import law, maximum

#: Of the load over the compression: of a ball; of a roller by ISO/TS 16281.
BALL_EXPONENT, ROLLER_EXPONENT = 1.5, 10.0 / 9.0


@law
def ball_contact(length, apart, constant):
    """Load of a ball whose groove centres stand a length apart, unloaded `apart`, N; its compression, m."""
    compressed = maximum(length - apart, 0.0)
    return constant * compressed**BALL_EXPONENT, compressed


@law
def roller_contact(pressed, constant):
    """Load of a slice of a roller whose raceways approach by so much, N; its compression, m."""
    compressed = maximum(pressed, 0.0)
    return constant * compressed**ROLLER_EXPONENT, compressed
