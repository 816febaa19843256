"""Derivatives by few numbers first: the chain rule over a law that depends on many numbers through its own.

What a law makes of a few numbers, such as a mesh's contact forces of the motion of its bodies, is evaluated
with duals whose directions are these numbers, however many directions these have themselves. Its results are
then taken to those: a mesh's contacts cost the same, whatever train it is part of.
"""

from llvmlite import ir
from numba.core import cgutils, types

from tribodyn.kernels.duals.numbers import BLOCK, SLOPES, DualType, dual_among, each, made, taken_apart, times
from tribodyn.kernels.lanes.arrays import ElementArrayType
from tribodyn.kernels.lanes.vectors import intrinsic
from tribodyn.kernels.native.parts import part_instead
from tribodyn.numerics import elementary


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
