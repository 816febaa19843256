"""The elementary functions over lanes: straight-line code, accurate to one or two units of the last place.

Exponential, logarithm and trigonometric functions are those of fdlibm (Sun Microsystems, 1993) without its
branches: reduction to a small interval, a polynomial, and the exponent put back through the bit pattern.
"""

import operator

from numba.core import types

from tribodyn.kernels.lanes.arrays import ROW, ElementArrayType
from tribodyn.kernels.lanes.tables import LaneTableType, rows_of_four
from tribodyn.kernels.lanes.vectors import (
    LANES,
    MASK,
    Vector,
    any_of,
    bit_and,
    bits_of,
    from_bits,
    magnitude,
    select,
    shift_left,
    shift_right,
    square_root,
    to_indices,
)
from tribodyn.kernels.native.functions import larger, smaller, without_derivatives
from tribodyn.kernels.native.parts import part, part_for, part_instead
from tribodyn.numerics import elementary

LOG2_E = 1.4426950408889634
#: ln 2 in two parts; the first ends in zeros, so that its products with exponents are exact.
LN2_HIGH, LN2_LOW = float.fromhex("0x1.62e42fee00000p-1"), float.fromhex("0x1.a39ef35793c76p-33")
#: Half a turn over two in three parts and the rest, each with 20 zeros at its end but the last.
RIGHT_ANGLE = (
    float.fromhex("0x1.921fb54400000p+0"),
    float.fromhex("0x1.0b4611a600000p-34"),
    float.fromhex("0x1.3198a2e000000p-69"),
    float.fromhex("0x1.b839a252049c1p-104"),
)
ONE_BITS = 0x3FF0000000000000
ROOT_HALF_BITS = 0x3FE6A09E667F3BCD  # of √½
MANTISSA = 0x000FFFFFFFFFFFFF
#: Adding 1.5 · 2^52 rounds to an integer, which then stands in the last bits.
ROUNDER = 6755399441055744.0
ROUNDER_BITS = 0x4338000000000000
INFINITE, UNDEFINED = float("inf"), float("nan")
SMALLEST_NORMAL = 2.2250738585072014e-308


@part
def exponential_parts(x):
    """N and e^r − 1 of e^x = 2^n e^r, |r| ≤ ½ ln 2; |x| < 1e15."""
    shifted = x * LOG2_E + ROUNDER
    n = shifted - ROUNDER
    r = (x - n * LN2_HIGH) - n * LN2_LOW
    # Taylor: the first term left out is 4e-18
    r2 = r * r
    r4 = r2 * r2
    low = (1 / 2 + r * (1 / 6)) + r2 * (1 / 24 + r * (1 / 120))
    middle = (1 / 720 + r * (1 / 5040)) + r2 * (1 / 40320 + r * (1 / 362880))
    high = (1 / 3628800 + r * (1 / 39916800)) + r2 * (1 / 479001600 + r * (1 / 6227020800))
    return bits_of(shifted) - ROUNDER_BITS, r + r2 * (low + r4 * (middle + r4 * high))


@part
def power_of_two(n):
    """2^n, −1022 ≤ n ≤ 1023."""
    return from_bits(shift_left(n + 1023, 52))


@part_for(elementary.exp, LANES)
@part
def exp_lanes(x):
    """Exponential."""
    bounded = select(x < 710.0, select(x > -750.0, x, -750.0), 710.0)
    n, rise = exponential_parts(bounded)
    half = shift_right(n, 1)  # in two factors, for results below the smallest normal number
    result = (1.0 + rise) * power_of_two(half) * power_of_two(n - half)
    return select(x == x, result, x)


@part_for(elementary.expm1, LANES)
def expm1_lanes(x):
    """exp(x) − 1, accurate for small x."""
    bounded = select(x < 710.0, select(x > -50.0, x, -50.0), 710.0)
    n, rise = exponential_parts(bounded)
    half = shift_right(n, 1)
    low, high = power_of_two(half), power_of_two(n - half)
    result = rise * low * high + (low * high - 1.0)
    return select(x == x, result, x)


@part_for(elementary.log, LANES)
@part
def log_lanes(x):
    """Natural logarithm."""
    tiny = x < SMALLEST_NORMAL
    bits = bits_of(select(tiny, x * 18014398509481984.0, x))  # 2^54
    above = bits + (ONE_BITS - ROOT_HALF_BITS)
    k = shift_right(above, 52) - 1023
    f = from_bits(bit_and(above, MANTISSA) + ROOT_HALF_BITS) - 1.0  # √½ ≤ 1 + f < √2
    s = f / (2.0 + f)
    z = s * s
    w = z * z
    even = w * (0.3999999999940941908 + w * (0.2222219843214978396 + w * 0.1531383769920937332))
    odd = 0.2857142874366239149 + w * (0.1818357216161805012 + w * 0.1479819860511658591)
    odd = z * (0.6666666666666735130 + w * odd)
    half_square = 0.5 * f * f
    # the exponent as a float, through the last bits
    n = from_bits(k + ROUNDER_BITS) - ROUNDER - select(tiny, 54.0, 0.0)
    result = n * LN2_HIGH - ((half_square - (s * (half_square + even + odd) + n * LN2_LOW)) - f)
    return select(x > 0.0, select(x < INFINITE, result, x), select(x == 0.0, -INFINITE, UNDEFINED))


@part_for(elementary.log1p, LANES)
def log1p_lanes(x):
    """log(1 + x), accurate for small x."""
    sum_ = 1.0 + x
    lost = (x - (sum_ - 1.0)) / sum_
    return log_lanes(sum_) + select((sum_ > 0.0) & (x < 1e15), lost, 0.0)


@part
def quadrant(x):
    """Quadrant of an angle, what is left of it, |r| ≤ π/4, and what r lost in rounding; |x| ≤ 1.6e6."""
    shifted = x * (2.0 / 3.141592653589793) + ROUNDER
    n = shifted - ROUNDER
    first = x - n * RIGHT_ANGLE[0]  # exact, as is every product here
    second = first - n * RIGHT_ANGLE[1]
    r = second - n * RIGHT_ANGLE[2]
    lost = ((first - second) - n * RIGHT_ANGLE[1]) + ((second - r) - n * RIGHT_ANGLE[2])
    return bits_of(shifted), r, lost - n * RIGHT_ANGLE[3]


@part
def sine_of_small(r, lost):
    """Sine, |r| ≤ π/4."""
    z = r * r
    high = 2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)
    low = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * high)
    return r + (z * r * (-1.66666666666666324348e-01 + z * low) + lost * (1.0 - 0.5 * z))


@part
def cosine_of_small(r, lost):
    """Cosine, |r| ≤ π/4."""
    z = r * r
    high = -2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)
    low = -1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 + z * high)
    half = 0.5 * z
    whole = 1.0 - half
    return whole + (((1.0 - whole) - half) + (z * z * (4.16666666666666019037e-02 + z * low) - r * lost))


@part
def turned(q, r, lost):
    """Sine of the angle r in quadrant q."""
    value = select(bit_and(q, 1) == 1, cosine_of_small(r, lost), sine_of_small(r, lost))
    return select(bit_and(q, 2) == 2, -value, value)


@part_for(elementary.sin, LANES)
def sin_lanes(x):
    """Sine."""
    q, r, lost = quadrant(x)
    return turned(q, r, lost)


@part_for(elementary.cos, LANES)
def cos_lanes(x):
    """Cosine."""
    q, r, lost = quadrant(x)
    return turned(q + 1, r, lost)


part_for(elementary.sqrt, LANES)(lambda x: square_root(x))
part_for(elementary.absolute, LANES)(lambda x: magnitude(x))
part_for(elementary.truncate, LANES)(lambda x: to_indices(x))


@part_instead(operator.pow)
def _pow(x, exponent):
    if x is LANES and isinstance(exponent, (types.Float, Vector)):
        return lambda x, exponent: exp_lanes(exponent * log_lanes(x))
    return None


part_for(elementary.where, MASK)(lambda condition, a, b: select(condition, a, b))
# only where no lane needs it: what it leaves out has no weight, so that the other lanes change no bits
part_for(elementary.skippable, MASK)(lambda condition: not any_of(~condition))
part_for(elementary.anywhere, MASK)(lambda condition: any_of(condition))
part_for(elementary.opposite, MASK)(lambda condition: ~condition)
part_for(elementary.plain, LANES)(lambda x: x)
part_for(elementary.minimum, LANES)(smaller)
part_for(elementary.maximum, LANES)(larger)
without_derivatives(lambda store: isinstance(store, ElementArrayType) and store.element is ROW)


@part_instead(elementary.last_axis_of_four)
def _last_axis_of_four(table, a, b, c, d):
    if not isinstance(table, LaneTableType):
        return None
    return lambda table, a, b, c, d: rows_of_four(table, (a, b, c, d))


@part_instead(elementary.last_at_or_below)
def _last_at_or_below(grid, x):
    if not isinstance(grid, LaneTableType):
        return None

    def implementation(grid, x):
        index = to_indices(0.0 * x)
        step = 1
        while step < grid.shape[0]:
            step *= 2
        while step > 0:  # halving: the same steps in every lane
            tried = index + step
            inside = tried <= grid.shape[0] - 2
            below = grid[select(inside, tried, index)] <= x
            index = select(inside & below, tried, index)
            step //= 2
        return index

    return implementation
