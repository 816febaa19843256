"""Smoothed versions of the model's non-smooth functions, each C1 with its width stated."""

from tribodyn.numerics.elementary import exp, law, log, maximum, minimum, skippable, where


@law
def positive_part(x, width):
    """max(x, 0) made C1 without offset: x²(2w − x)/w² for 0 < x < w, exact outside."""
    if skippable(x >= width):
        return x
    inner = minimum(maximum(x, 0.0), width)
    return where(x >= width, x, inner * inner * (2.0 * width - inner) / (width * width))


@law
def positive_part_integral(x, width):
    """The integral of `positive_part` from −∞ to x."""
    whole = 0.5 * x * x - width * width * (1.0 / 12.0)
    if skippable(x >= width):
        return whole
    inner = minimum(maximum(x, 0.0), width)
    ramp = inner * inner * inner * (2.0 * width / 3.0 - inner / 4.0) / (width * width)
    return where(x >= width, whole, ramp)


@law
def ramp(x, width):
    """0 for x ≤ 0, 1 for x ≥ w, and the cubic 3s² − 2s³ of s = x/w between."""
    if skippable(x >= width):
        return 1.0
    inner = minimum(maximum(x / width, 0.0), 1.0)
    return inner * inner * (3.0 - 2.0 * inner)


@law
def sign(x):
    """Sign of x made C1: (3x − x³)/2 for |x| < 1, exact outside."""
    inner = minimum(maximum(x, -1.0), 1.0)
    return 0.5 * inner * (3.0 - inner * inner)


@law
def power_law_force(deflection, compliance, coefficient):
    """Load F ≥ 0 of deflection = compliance F + coefficient F^0.9, by six Newton steps."""
    force = deflection / (compliance + 0.4 * coefficient)  # F^-0.1 is 0.4 near 10 kN
    for _ in range(6):
        force = maximum(force, 1e-9)
        tangent = coefficient * exp(-0.1 * log(force))
        force = (deflection - 0.1 * tangent * force) / (compliance + 0.9 * tangent)
    return maximum(force, 0.0)
