"""What kernels use of dual numbers: the elementary functions, each with its derivative, and arrays of them.

An array is one of floats whose last axis holds a number's slopes, its value, and room behind it.
"""

import math
import operator
from functools import cache
from typing import Any, cast

from llvmlite import ir
from numba import extending
from numba.core import cgutils, types

from tribodyn.kernels.duals.numbers import (
    BLOCK,
    DOUBLE,
    SLOPES,
    DualType,
    chained,
    dual_among,
    each,
    largest_slope_of,
    made,
    select,
    taken_apart,
    times,
    value_of,
)
from tribodyn.kernels.lanes.arrays import ALIGNMENT, Element, ElementArrayType, as_elements
from tribodyn.kernels.lanes.vectors import INT64, intrinsic
from tribodyn.kernels.native.functions import larger, smaller
from tribodyn.kernels.native.parts import part, part_for, part_instead
from tribodyn.numerics import elementary

# Derivatives by few numbers first: the chain rule over a law that depends on many numbers through its own.
#
# What a law makes of a few numbers, such as a mesh's contact forces of the motion of its bodies, is
# evaluated with duals whose directions are these numbers, however many directions these have themselves. Its
# results are then taken to those: a mesh's contacts cost the same, whatever train it is part of.


@intrinsic
def independent_of(typingctx, numbers, store):
    """A named tuple of numbers as duals of the type that `store` holds: each the variable of a direction.

    Of more numbers than that has directions the rest are constants. Duals of that type stay what they are.
    """
    kind = store.element.type
    if kind in tuple(numbers):
        return numbers(numbers, store), lambda context, builder, sig, values: values[0]
    several = types.NamedUniTuple(kind, len(numbers), numbers.instance_class)

    def emit(context, builder, sig, values):
        duals = []
        items = zip(tuple(numbers), cgutils.unpack_tuple(builder, values[0]), strict=True)
        for place, (source, number) in enumerate(items):
            unit = [float(place == direction) for direction in range(kind.directions)]
            blocks = [ir.Constant(SLOPES, unit[i : i + BLOCK]) for i in range(0, len(unit), BLOCK)]
            value, _ = taken_apart(context, builder, source, number)
            duals.append(made(context, builder, kind, value, blocks))
        return context.make_tuple(builder, several, duals)

    return several(numbers, store), emit


@intrinsic
def taken_through(typingctx, results, numbers):
    """A tuple of functions of numbers, duals of these, by the chain rule as duals of what the numbers are."""
    wide, kinds = dual_among(numbers), tuple(results)
    several = types.Tuple([wide] * len(kinds))

    def emit(context, builder, sig, values):
        inner = [
            taken_apart(context, builder, wide, context.cast(builder, number, source, wide))[1]
            for source, number in zip(tuple(numbers), cgutils.unpack_tuple(builder, values[1]), strict=True)
        ]
        duals = []
        for kind, result in zip(kinds, cgutils.unpack_tuple(builder, values[0]), strict=True):
            if kind is wide or not isinstance(kind, DualType):
                duals.append(context.cast(builder, result, kind, wide))
                continue
            value, outer = taken_apart(context, builder, kind, result)
            slopes = None
            for place, slope in enumerate(inner[: kind.directions]):
                share = builder.extract_element(outer[place // BLOCK], ir.IntType(32)(place % BLOCK))
                part = times(builder, share, slope)
                slopes = part if slopes is None else each(builder.fadd, slopes, part)
            duals.append(made(context, builder, wide, value, slopes))
        return context.make_tuple(builder, several, duals)

    return several(results, numbers), emit


def _holds_duals(store):
    return isinstance(store, ElementArrayType) and isinstance(store.element.type, DualType)


@part_instead(elementary.independent)
def _independent(numbers, store):
    return (lambda numbers, store: independent_of(numbers, store)) if _holds_duals(store) else None


@part_instead(elementary.by_chain_rule)
def _by_chain_rule(results, numbers, store):
    if not _holds_duals(store):
        return None
    return lambda results, numbers, store: taken_through(results, numbers)


def length_of(directions: int) -> int:
    """Floats that a dual takes: whole cache lines, so that none is read across two from the start of one."""
    return directions + BLOCK


@cache
def _element(directions: int) -> Element:
    """A dual in an array: its slopes, and its value behind them."""
    kind, blocks = DualType(directions), range(directions // BLOCK)

    def places(builder, pointer):
        value = builder.gep(pointer, [INT64(directions)])
        first = builder.bitcast(pointer, SLOPES.as_pointer())
        return builder.bitcast(value, DOUBLE.as_pointer()), [builder.gep(first, [INT64(i)]) for i in blocks]

    def load(context, builder, pointer):
        value, slopes = places(builder, pointer)
        loaded = [builder.load(place, align=ALIGNMENT) for place in slopes]
        return made(context, builder, kind, builder.load(value, align=ALIGNMENT), loaded)

    def store(context, builder, pointer, number):
        value, slopes = taken_apart(context, builder, kind, number)
        into, blocks_into = places(builder, pointer)
        for slope, place in zip(slopes, blocks_into, strict=True):
            builder.store(slope, place, align=ALIGNMENT)
        builder.store(value, into, align=ALIGNMENT)

    return Element(kind, length_of(directions), load, store)


@cast(Any, extending.intrinsic)(prefer_literal=True)
def duals_of(typingctx, array, directions):
    """An array of floats, contiguous and its last axis of `length_of`, as duals in so many directions."""
    if not isinstance(directions, types.IntegerLiteral):
        return None
    duals, emit = as_elements(array, _element(directions.literal_value))
    return duals(array, directions), emit


@part_for(elementary.sqrt, DualType)
def sqrt_dual(x):
    """Square root."""
    root = math.sqrt(value_of(x))
    return chained(x, root, 0.5 / root)


@part_for(elementary.exp, DualType)
def exp_dual(x):
    """Exponential."""
    value = math.exp(value_of(x))
    return chained(x, value, value)


@part_for(elementary.expm1, DualType)
def expm1_dual(x):
    """exp(x) − 1."""
    value = elementary.expm1(value_of(x))
    return chained(x, value, 1.0 + value)


@part_for(elementary.tan, DualType)
def tan_dual(x):
    """Tangent."""
    value = math.tan(value_of(x))
    return chained(x, value, 1.0 + value * value)


@part_for(abs, DualType)
@part_for(elementary.absolute, DualType)
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


part_for(elementary.log, DualType)(lambda x: chained(x, math.log(value_of(x)), 1.0 / value_of(x)))
part_for(elementary.log1p, DualType)(
    lambda x: chained(x, elementary.log1p(value_of(x)), 1.0 / (1.0 + value_of(x)))
)
part_for(elementary.sin, DualType)(lambda x: chained(x, math.sin(value_of(x)), math.cos(value_of(x))))
part_for(elementary.cos, DualType)(lambda x: chained(x, math.cos(value_of(x)), -math.sin(value_of(x))))
part_for(elementary.truncate, DualType)(lambda x: int(value_of(x)))
part_for(elementary.plain, DualType)(lambda x: value_of(x))
part_for(elementary.largest_slope, DualType)(lambda x: largest_slope_of(x))


@part_for(elementary.arctan2, DualType)
def arctan2_dual(y, x):
    """Angle of the point (x, y)."""
    b, a = elementary.plain(y), elementary.plain(x)
    # (a dy − b dx)/(a² + b²): slopes of a sum that is zero itself
    turn = ((y - b) * a - (x - a) * b) / (a * a + b * b)
    return turn + math.atan2(b, a)


@part_instead(operator.pow)
def _pow(x, exponent):
    if isinstance(exponent, DualType):
        return power_of_dual_exponent if dual_among([x, exponent]) else None
    if isinstance(x, DualType) and isinstance(exponent, types.Float):
        return power_dual
    if isinstance(x, DualType) and isinstance(exponent, types.Integer):
        return lambda x, exponent: power_dual(x, float(exponent))
    return None


@part_instead(elementary.where)
def _where(condition, a, b):
    if dual_among([a, b]) and isinstance(condition, types.Boolean):
        return lambda condition, a, b: select(condition, a, b)
    return None


part_for(elementary.minimum, DualType)(smaller)
part_for(elementary.maximum, DualType)(larger)
