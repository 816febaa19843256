"""Dual numbers: a value and its derivatives in some directions, as a type that numba compiles.

A law written for floats compiles for duals as it stands and then gives its exact derivative beside its value,
whoever wrote it. Comparisons look at values alone, so that a dual march takes the branches that a march of
floats takes. Plain numbers are constants: no slopes are stored or multiplied for them.
"""

import operator
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import AbstractTemplate, signature
from numba.extending import lower_builtin, lower_cast, models, register_model

from tribodyn.kernels.lanes.vectors import COMPARISONS, FUSE, broadcast, intrinsic, of_operator

#: Directions that a number carries its derivatives in: two AVX-512 registers, four of AVX2.
DIRECTIONS = 16

DOUBLE = ir.DoubleType()
SLOPES = ir.VectorType(DOUBLE, DIRECTIONS)
_INT32 = ir.IntType(32)


class SlopeType(types.Type):
    """Type of the derivatives of a number, one per direction."""

    def __init__(self):
        super().__init__(name=f"slope in {DIRECTIONS}")


class DualType(types.Type):
    """Type of a number with its derivatives."""

    def __init__(self):
        super().__init__(name=f"dual in {DIRECTIONS}")

    def can_convert_from(self, typingctx, other):  # noqa: D102  (numba's)
        return Conversion.promote if isinstance(other, (types.Float, types.Integer)) else None

    def unify(self, typingctx, other):  # noqa: D102  (numba's)
        return self if self.can_convert_from(typingctx, other) is not None else None


SLOPE, DUAL = SlopeType(), DualType()


@register_model(SlopeType)
class _SlopeModel(models.PrimitiveModel):
    def __init__(self, manager, slope):
        super().__init__(manager, slope, SLOPES)


@register_model(DualType)
class _DualModel(models.StructModel):
    def __init__(self, manager, dual):
        super().__init__(manager, dual, [("value", types.float64), ("slope", SLOPE)])


def made(context, builder, value, slope):
    """A dual of a value and its slopes."""
    dual = cgutils.create_struct_proxy(DUAL)(context, builder)
    dual.value, dual.slope = value, slope
    return dual._getvalue()


def taken_apart(context, builder, kind, number):
    """Value and slopes of a number; None for the slopes of a plain one."""
    if kind is not DUAL:
        return number, None
    dual = cgutils.create_struct_proxy(DUAL)(context, builder, number)
    return dual.value, dual.slope


def _times(builder, factor, slope):
    return builder.fmul(broadcast(builder, factor, DIRECTIONS), slope, flags=FUSE)


@lower_cast(types.Float, DUAL)
@lower_cast(types.Integer, DUAL)
def _number_to_dual(context, builder, given, wanted, value):
    none = ir.Constant(SLOPES, [0.0] * DIRECTIONS)
    return made(context, builder, context.cast(builder, value, given, types.float64), none)


def _sum(builder, a, b):
    value = builder.fadd(a[0], b[0], flags=FUSE)
    if a[1] is None or b[1] is None:
        return value, b[1] if a[1] is None else a[1]
    return value, builder.fadd(a[1], b[1], flags=FUSE)


def _difference(builder, a, b):
    value = builder.fsub(a[0], b[0], flags=FUSE)
    if b[1] is None:
        return value, a[1]
    return value, builder.fneg(b[1]) if a[1] is None else builder.fsub(a[1], b[1], flags=FUSE)


def _product(builder, a, b):
    value = builder.fmul(a[0], b[0], flags=FUSE)
    slope = None if b[1] is None else _times(builder, a[0], b[1])
    if a[1] is not None:
        other = _times(builder, b[0], a[1])
        slope = other if slope is None else builder.fadd(other, slope, flags=FUSE)
    return value, slope


def _quotient(builder, a, b):
    value = builder.fdiv(a[0], b[0])
    inverse = builder.fdiv(DOUBLE(1.0), b[0])
    if b[1] is None:
        return value, _times(builder, inverse, a[1])
    slope = _times(builder, value, b[1])
    slope = builder.fneg(slope) if a[1] is None else builder.fsub(a[1], slope, flags=FUSE)
    return value, _times(builder, inverse, slope)


def _plain_or_dual(kind: Any) -> Any:
    """The type that an operand is taken as; None where it is neither."""
    if kind is DUAL:
        return DUAL
    return types.float64 if isinstance(kind, (types.Float, types.Integer)) else None


def _binary(operation, result, emit):
    """Give numba an operator of two numbers, at least one of them dual."""

    @of_operator(operation)
    class _Types(AbstractTemplate):
        key = operation

        def generic(self, args, kws):
            kinds = [_plain_or_dual(kind) for kind in args]
            if len(kinds) == 2 and DUAL in kinds and None not in kinds:
                return signature(result, *kinds)
            return None

    def lowered(context, builder, sig, values):
        parts = [
            taken_apart(context, builder, kind, number) for kind, number in zip(sig.args, values, strict=True)
        ]
        return emit(context, builder, *parts)

    for kinds in ((DUAL, DUAL), (DUAL, types.Float), (types.Float, DUAL)):
        lower_builtin(operation, *kinds)(lowered)


def _arithmetic(emit):
    return lambda context, builder, a, b: made(context, builder, *emit(builder, a, b))


for _operations, _emit in (
    ((operator.add, operator.iadd), _sum),
    ((operator.sub, operator.isub), _difference),
    ((operator.mul, operator.imul), _product),
    ((operator.truediv, operator.itruediv), _quotient),
):
    for _symbol in _operations:
        _binary(_symbol, DUAL, _arithmetic(_emit))

for _symbol, _sign in COMPARISONS.items():
    _binary(
        _symbol,
        types.boolean,
        lambda context, builder, a, b, sign=_sign: builder.fcmp_ordered(sign, a[0], b[0]),
    )
_binary(operator.ne, types.boolean, lambda context, builder, a, b: builder.fcmp_unordered("!=", a[0], b[0]))


@of_operator(operator.neg)
class _Negative(AbstractTemplate):
    key = operator.neg

    def generic(self, args, kws):
        return signature(DUAL, DUAL) if args == (DUAL,) else None


@lower_builtin(operator.neg, DUAL)
def _negative(context, builder, sig, values):
    value, slope = taken_apart(context, builder, DUAL, values[0])
    return made(context, builder, builder.fneg(value), builder.fneg(slope))


@intrinsic
def value_of(typingctx, x):
    """The value of a dual alone."""
    if x is not DUAL:
        return None

    def emit(context, builder, sig, values):
        return taken_apart(context, builder, DUAL, values[0])[0]

    return types.float64(DUAL), emit


@intrinsic
def chained(typingctx, x, value, derivative):
    """f(x) of a dual, from the value and the derivative of f there: the chain rule."""

    def emit(context, builder, sig, values):
        slope = taken_apart(context, builder, DUAL, values[0])[1]
        return made(context, builder, values[1], _times(builder, values[2], slope))

    return DUAL(DUAL, types.float64, types.float64), emit


@intrinsic
def select(typingctx, condition, a, b):
    """`a` where the condition holds, else `b`, with its slopes."""

    def emit(context, builder, sig, values):
        a, b = (taken_apart(context, builder, DUAL, number) for number in values[1:])
        value, slope = (builder.select(values[0], first, second) for first, second in zip(a, b, strict=True))
        return made(context, builder, value, slope)

    return DUAL(types.boolean, DUAL, DUAL), emit


@intrinsic
def largest_slope_of(typingctx, x):
    """The largest derivative of a dual by magnitude."""

    def emit(context, builder, sig, values):
        slope = taken_apart(context, builder, DUAL, values[0])[1]
        kind = ir.FunctionType(SLOPES, [SLOPES])
        name = f"llvm.fabs.v{DIRECTIONS}f64"
        rest = builder.call(cgutils.get_or_insert_function(builder.module, kind, name), (slope,))
        width = DIRECTIONS
        while width > 1:  # halves against each other
            width //= 2
            low, high = (
                builder.shuffle_vector(
                    rest, rest, ir.Constant(ir.VectorType(_INT32, width), list(range(first, first + width)))
                )
                for first in (0, width)
            )
            # what is not a number stays: no comparison puts another in its place
            larger = builder.or_(
                builder.fcmp_ordered(">", low, high), builder.fcmp_unordered("uno", low, low)
            )
            rest = builder.select(larger, low, high)
        return builder.extract_element(rest, _INT32(0))

    return types.float64(DUAL), emit
