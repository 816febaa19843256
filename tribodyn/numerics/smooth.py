"""Smoothed versions of the model's non-smooth functions, each C1 with its width stated."""

from tribodyn.numerics.elementary import (
    absolute,
    exp,
    last_at_or_below,
    law,
    log,
    maximum,
    minimum,
    skippable,
    where,
)

#: Share of a width below which none falls, so that nothing is divided by zero.
SMALLEST_SHARE = 1e-30
#: Half a width, over that of the reversal, below which a mean is the value in the middle: within 1e-6.
SMALLEST_HALF = 1e-3


@law
def positive_part(x, width):
    """max(x, 0) made C1 without offset: x²(2w − x)/w² for 0 < x < w, exact outside."""
    if skippable(x >= width):
        return x
    share = maximum(x, 0.0) / width
    return where(x >= width, x, width * share * share * (2.0 - share))


@law
def positive_part_integral(x, width):
    """The integral of `positive_part` from −∞ to x."""
    whole = 0.5 * x * x - width * width * (1.0 / 12.0)
    if skippable(x >= width):
        return whole
    inner = maximum(x, 0.0)
    ramp = inner * inner * inner * (2.0 * width / 3.0 - inner / 4.0) / (width * width)
    return where(x >= width, whole, ramp)


@law
def load_with_damping(elastic, damping, width):
    """Sum of an elastic load and a damping force, never below zero; all in N.

    C1, by `positive_part` over the width E W/(E + W) of the elastic load E and the given width W: without
    damping exactly E, and never above the sum, so that damping takes energy under any load.
    """
    elastic_share = elastic * width / (elastic + width)
    smallest = SMALLEST_SHARE * width  # `maximum` of two variables is six operations with JAX, `where` two
    return positive_part(elastic + damping, where(elastic_share > smallest, elastic_share, smallest))


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
def sign_slope(x):
    """Slope of `sign`."""
    inner = minimum(maximum(x, -1.0), 1.0)
    return 1.5 * (1.0 - inner * inner)


@law
def cubic_rise(u, rise, out, back):
    """Cubic over u from 0 to 1 that rises from 0 by `rise`, with the slopes `out` and `back` at its ends."""
    return u * (out + u * (3.0 * rise - 2.0 * out - back + u * (out + back - 2.0 * rise)))


@law
def cubic_rise_slope(u, rise, out, back):
    """Its slope."""
    return out + u * (2.0 * (3.0 * rise - 2.0 * out - back) + 3.0 * u * (out + back - 2.0 * rise))


@law
def place_between(points, x):
    """Which of the intervals between increasing points x is in, its width, and the share of it, 0 to 1."""
    i = last_at_or_below(points, x)
    width = points[i + 1] - points[i]
    return i, width, minimum(maximum((x - points[i]) / width, 0.0), 1.0)


@law
def sign_integral(x):
    """The integral of `sign` from 0 to x."""
    size = absolute(x)
    inner = minimum(size, 1.0)
    square = inner * inner
    return square * (0.75 - 0.125 * square) + (size - inner)


@law
def mean_sign(x, half):
    """Mean of `sign` from x − half to x + half, half ≥ 0; of a width below `SMALLEST_HALF` that at x."""
    wide = maximum(half, SMALLEST_HALF)
    mean = (sign_integral(x + wide) - sign_integral(x - wide)) / (2.0 * wide)
    return where(half > SMALLEST_HALF, mean, sign(x))


@law
def onset(x, width, load, stiffness):
    """Load of an approach x ≤ w, the cubic from zero with zero slope to a load and stiffness at w; C1."""
    share = maximum(x, 0.0) / width
    rise = stiffness * width
    return share * share * (3.0 * load - rise + share * (rise - 2.0 * load))


@law
def onset_integral(x, width, load, stiffness):
    """The integral of `onset` from −∞ to x, or to w; linear in load and stiffness, as `onset` is."""
    share = minimum(maximum(x / width, 0.0), 1.0)
    rise = stiffness * width
    return width * share * share * share * (load - rise / 3.0 + 0.25 * share * (rise - 2.0 * load))


@law
def power_law_force(deflection, compliance, coefficient):
    """Load F ≥ 0 of deflection = compliance F + coefficient F^0.9, by six Newton steps."""
    force = deflection / (compliance + 0.4 * coefficient)  # F^-0.1 is 0.4 near 10 kN
    for _ in range(6):
        force = maximum(force, 1e-9)
        tangent = coefficient * exp(-0.1 * log(force))
        force = (deflection - 0.1 * tangent * force) / (compliance + 0.9 * tangent)
    return maximum(force, 0.0)


@law
def power_law_stiffness(force, compliance, coefficient):
    """dF/dδ of the same law at a load F > 0."""
    return 1.0 / (compliance + 0.9 * coefficient * exp(-0.1 * log(maximum(force, 1e-9))))


@law
def power_law_work(force, compliance, coefficient):
    """The integral of the same law's load over its deflection, from zero to a load F ≥ 0."""
    return 0.5 * compliance * force * force + coefficient * (0.9 / 1.9) * maximum(force, 1e-9) ** 1.9
