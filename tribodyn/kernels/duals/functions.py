"""What kernels use of dual numbers: the elementary functions, each with its derivative, and arrays of them.

An array is one of floats whose last axis holds a number's slopes, its value, and room behind it.
"""

import math
import operator

from numba.core import types

from tribodyn.kernels.duals.numbers import (
    DIRECTIONS,
    DOUBLE,
    DUAL,
    SLOPES,
    chained,
    largest_slope_of,
    made,
    select,
    taken_apart,
    value_of,
)
from tribodyn.kernels.lanes.arrays import ALIGNMENT, Element, elements_of
from tribodyn.kernels.lanes.vectors import INT64
from tribodyn.kernels.native.functions import larger, smaller
from tribodyn.kernels.native.parts import part, part_for, part_instead
from tribodyn.numerics import elementary

#: Place of the value behind the slopes, and floats that a dual number takes: whole cache lines, so that none
#: is read across two where the array begins on one.
VALUE, LENGTH = DIRECTIONS, DIRECTIONS + 8


def _load(context, builder, pointer):
    slope = builder.load(builder.bitcast(pointer, SLOPES.as_pointer()), align=ALIGNMENT)
    return made(context, builder, builder.load(builder.gep(pointer, [INT64(VALUE)])), slope)


def _store(context, builder, pointer, number):
    value, slope = taken_apart(context, builder, DUAL, number)
    builder.store(slope, builder.bitcast(pointer, SLOPES.as_pointer()), align=ALIGNMENT)
    last = builder.gep(pointer, [INT64(VALUE)])
    builder.store(value, builder.bitcast(last, DOUBLE.as_pointer()), align=ALIGNMENT)


#: An array of floats, contiguous and its last axis of `LENGTH`, as dual numbers.
duals_of = elements_of(Element(DUAL, LENGTH, _load, _store))


@part_for(elementary.sqrt, DUAL)
def sqrt_dual(x):
    """Square root."""
    root = math.sqrt(value_of(x))
    return chained(x, root, 0.5 / root)


@part_for(elementary.exp, DUAL)
def exp_dual(x):
    """Exponential."""
    value = math.exp(value_of(x))
    return chained(x, value, value)


@part_for(elementary.expm1, DUAL)
def expm1_dual(x):
    """exp(x) − 1."""
    value = elementary.expm1(value_of(x))
    return chained(x, value, 1.0 + value)


@part_for(elementary.tan, DUAL)
def tan_dual(x):
    """Tangent."""
    value = math.tan(value_of(x))
    return chained(x, value, 1.0 + value * value)


@part_for(abs, DUAL)
@part_for(elementary.absolute, DUAL)
def absolute_dual(x):
    """Absolute value; its derivative at 0 is taken as 0, the mean of both sides."""
    value = value_of(x)
    return chained(x, abs(value), 1.0 if value > 0.0 else -1.0 if value < 0.0 else 0.0)


@part
def power_dual(x, exponent):
    """Power with a plain exponent."""
    value = value_of(x)
    return chained(x, value**exponent, exponent * value ** (exponent - 1.0))


@part
def power_of_dual_exponent(x, exponent):
    """Power of a positive base."""
    return elementary.exp(exponent * elementary.log(x))


part_for(elementary.log, DUAL)(lambda x: chained(x, math.log(value_of(x)), 1.0 / value_of(x)))
part_for(elementary.log1p, DUAL)(
    lambda x: chained(x, elementary.log1p(value_of(x)), 1.0 / (1.0 + value_of(x)))
)
part_for(elementary.sin, DUAL)(lambda x: chained(x, math.sin(value_of(x)), math.cos(value_of(x))))
part_for(elementary.cos, DUAL)(lambda x: chained(x, math.cos(value_of(x)), -math.sin(value_of(x))))
part_for(elementary.truncate, DUAL)(lambda x: int(value_of(x)))
part_for(elementary.plain, DUAL)(lambda x: value_of(x))
part_for(elementary.largest_slope, DUAL)(lambda x: largest_slope_of(x))


@part_for(elementary.arctan2, DUAL)
def arctan2_dual(y, x):
    """Angle of the point (x, y)."""
    b, a = elementary.plain(y), elementary.plain(x)
    # (a dy − b dx)/(a² + b²): slopes of a sum that is zero itself
    turn = ((y - b) * a - (x - a) * b) / (a * a + b * b)
    return turn + math.atan2(b, a)


@part_instead(operator.pow)
def _pow(x, exponent):
    if x is DUAL and isinstance(exponent, types.Float):
        return power_dual
    if x is DUAL and isinstance(exponent, types.Integer):
        return lambda x, exponent: power_dual(x, float(exponent))
    if exponent is DUAL and (x is DUAL or isinstance(x, (types.Float, types.Integer))):
        return power_of_dual_exponent
    return None


@part_instead(elementary.where)
def _where(condition, a, b):
    if DUAL in (a, b) and isinstance(condition, types.Boolean):
        return lambda condition, a, b: select(condition, a, b)
    return None


part_for(elementary.minimum, DUAL)(smaller)
part_for(elementary.maximum, DUAL)(larger)
