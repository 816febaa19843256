"""Dual numbers: a value and its derivatives in some directions, as a type that numba compiles.

A law written for floats compiles for duals as it stands and then gives its exact derivative beside its value,
whoever wrote it. Comparisons look at values alone, so that a dual march takes the branches that a march of
floats takes. Plain numbers are constants: no slopes are stored or multiplied for them.

There is a type for every number of directions.
"""

import operator
from typing import Any

from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import AbstractTemplate, signature
from numba.extending import lower_builtin, lower_cast, models, register_model

from tribodyn.kernels.lanes.vectors import COMPARISONS, FUSE, broadcast, intrinsic, of_operator

#: Derivatives of a block: one AVX-512 register, two of AVX2. Directions are a multiple of it.
BLOCK = 8

DOUBLE = ir.DoubleType()
SLOPES = ir.VectorType(DOUBLE, BLOCK)
ZEROS = ir.Constant(SLOPES, [0.0] * BLOCK)
_INT32 = ir.IntType(32)


class SlopeType(types.Type):
    """Type of the derivatives of a number, one per direction."""

    def __init__(self, directions: int):
        self.blocks = directions // BLOCK
        super().__init__(name=f"slope in {directions}")


class DualType(types.Type):
    """Type of a number with its derivatives in so many directions."""

    def __init__(self, directions: int):
        self.directions = directions
        super().__init__(name=f"dual in {directions}")

    def can_convert_from(self, typingctx, other):  # noqa: D102  (numba's)
        return Conversion.promote if isinstance(other, (types.Float, types.Integer)) else None

    def unify(self, typingctx, other):  # noqa: D102  (numba's)
        return self if self.can_convert_from(typingctx, other) is not None else None


@register_model(SlopeType)
class _SlopeModel(models.PrimitiveModel):
    def __init__(self, manager, slope):
        super().__init__(manager, slope, ir.ArrayType(SLOPES, slope.blocks))


@register_model(DualType)
class _DualModel(models.StructModel):
    def __init__(self, manager, dual):
        super().__init__(manager, dual, [("value", types.float64), ("slope", SlopeType(dual.directions))])


def made(context, builder, kind, value, slopes):
    """A dual of a type, of a value and the blocks of its slopes."""
    dual = cgutils.create_struct_proxy(kind)(context, builder)
    dual.value, dual.slope = value, cgutils.pack_array(builder, slopes)
    return dual._getvalue()


def taken_apart(context, builder, kind, number) -> tuple[Any, Any]:
    """Value and blocks of slopes of a number; None for the slopes of a plain one."""
    if not isinstance(kind, DualType):
        return number, None
    dual = cgutils.create_struct_proxy(kind)(context, builder, number)
    return dual.value, [builder.extract_value(dual.slope, i) for i in range(kind.directions // BLOCK)]


def times(builder, factor, slopes):
    """Slopes times a number."""
    wide = broadcast(builder, factor, BLOCK)
    return [builder.fmul(wide, slope, flags=FUSE) for slope in slopes]


def _negated(builder, slopes):
    return [builder.fneg(slope) for slope in slopes]


def each(operation, a, b):
    """Sums or differences of the slopes of two numbers."""
    return [operation(first, second, flags=FUSE) for first, second in zip(a, b, strict=True)]


@lower_cast(types.Float, DualType)
@lower_cast(types.Integer, DualType)
def _number_to_dual(context, builder, source_type, wanted, value):
    number = context.cast(builder, value, source_type, types.float64)
    return made(context, builder, wanted, number, [ZEROS] * (wanted.directions // BLOCK))


def _sum(builder, a, b):
    value = builder.fadd(a[0], b[0], flags=FUSE)
    if a[1] is None or b[1] is None:
        return value, b[1] if a[1] is None else a[1]
    return value, each(builder.fadd, a[1], b[1])


def _difference(builder, a, b):
    value = builder.fsub(a[0], b[0], flags=FUSE)
    if b[1] is None:
        return value, a[1]
    return value, _negated(builder, b[1]) if a[1] is None else each(builder.fsub, a[1], b[1])


def _product(builder, a, b):
    value = builder.fmul(a[0], b[0], flags=FUSE)
    slope = None if b[1] is None else times(builder, a[0], b[1])
    if a[1] is not None:
        other = times(builder, b[0], a[1])
        slope = other if slope is None else each(builder.fadd, other, slope)
    return value, slope


def _quotient(builder, a, b):
    value = builder.fdiv(a[0], b[0])
    inverse = builder.fdiv(DOUBLE(1.0), b[0])
    if b[1] is None:
        return value, times(builder, inverse, a[1])
    slope = times(builder, value, b[1])
    slope = _negated(builder, slope) if a[1] is None else each(builder.fsub, a[1], slope)
    return value, times(builder, inverse, slope)


def dual_among(kinds: Any) -> Any:
    """The type of the duals among operands, the others being plain numbers; else None."""
    duals = {kind for kind in kinds if isinstance(kind, DualType)}
    plain = all(isinstance(kind, (DualType, types.Float, types.Integer)) for kind in kinds)
    return duals.pop() if plain and len(duals) == 1 else None


def _binary(operation, emit, result=None):
    """Give numba an operator of two numbers, at least one of them dual; the result is dual by default."""

    @of_operator(operation)
    class _Types(AbstractTemplate):
        key = operation

        def generic(self, args, kws):
            dual = dual_among(args) if len(args) == 2 else None
            if dual is None:
                return None
            return signature(result or dual, *(kind if kind is dual else types.float64 for kind in args))

    def lowered(context, builder, sig, values):
        parts = [
            taken_apart(context, builder, kind, number) for kind, number in zip(sig.args, values, strict=True)
        ]
        return emit(context, builder, sig.return_type, *parts)

    for kinds in ((DualType, DualType), (DualType, types.Float), (types.Float, DualType)):
        lower_builtin(operation, *kinds)(lowered)


def _arithmetic(emit):
    return lambda context, builder, kind, a, b: made(context, builder, kind, *emit(builder, a, b))


for _operations, _emit in (
    ((operator.add, operator.iadd), _sum),
    ((operator.sub, operator.isub), _difference),
    ((operator.mul, operator.imul), _product),
    ((operator.truediv, operator.itruediv), _quotient),
):
    for _symbol in _operations:
        _binary(_symbol, _arithmetic(_emit))

for _symbol, _sign in COMPARISONS.items():
    _binary(
        _symbol,
        lambda context, builder, _, a, b, sign=_sign: builder.fcmp_ordered(sign, a[0], b[0]),
        types.boolean,
    )
_binary(
    operator.ne, lambda context, builder, _, a, b: builder.fcmp_unordered("!=", a[0], b[0]), types.boolean
)


@of_operator(operator.neg)
class _Negative(AbstractTemplate):
    key = operator.neg

    def generic(self, args, kws):
        return signature(*args, *args) if len(args) == 1 and isinstance(args[0], DualType) else None


@lower_builtin(operator.neg, DualType)
def _negative(context, builder, sig, values):
    value, slope = taken_apart(context, builder, sig.args[0], values[0])
    return made(context, builder, sig.return_type, builder.fneg(value), _negated(builder, slope))


@intrinsic
def value_of(typingctx, x):
    """The value of a dual alone."""
    if not isinstance(x, DualType):
        return None

    def emit(context, builder, sig, values):
        return taken_apart(context, builder, x, values[0])[0]

    return types.float64(x), emit


@intrinsic
def chained(typingctx, x, value, derivative):
    """f(x) of a dual, from the value and the derivative of f there: the chain rule."""

    def emit(context, builder, sig, values):
        slope = taken_apart(context, builder, x, values[0])[1]
        return made(context, builder, x, values[1], times(builder, values[2], slope))

    return x(x, types.float64, types.float64), emit


@intrinsic
def select(typingctx, condition, a, b):
    """`a` where the condition holds, else `b`, with its slopes."""
    dual = dual_among([a, b])

    def emit(context, builder, sig, values):
        a, b = (taken_apart(context, builder, dual, number) for number in values[1:])
        value, *slope = (
            builder.select(values[0], first, second)
            for first, second in zip([a[0], *a[1]], [b[0], *b[1]], strict=True)
        )
        return made(context, builder, dual, value, slope)

    return dual(types.boolean, dual, dual), emit


def _larger(builder, a, b):
    """The larger of two; what is not a number stays: no comparison puts another in its place."""
    first = builder.or_(builder.fcmp_ordered(">", a, b), builder.fcmp_unordered("uno", a, a))
    return builder.select(first, a, b)


@intrinsic
def largest_slope_of(typingctx, x):
    """The largest derivative of a dual by magnitude."""

    def emit(context, builder, sig, values):
        kind = ir.FunctionType(SLOPES, [SLOPES])
        magnitude = cgutils.get_or_insert_function(builder.module, kind, f"llvm.fabs.v{BLOCK}f64")
        slopes = taken_apart(context, builder, x, values[0])[1]
        rest, *others = (builder.call(magnitude, (slope,)) for slope in slopes)
        for other in others:
            rest = _larger(builder, other, rest)
        width = BLOCK
        while width > 1:  # halves against each other
            width //= 2
            low, high = (
                builder.shuffle_vector(
                    rest, rest, ir.Constant(ir.VectorType(_INT32, width), list(range(first, first + width)))
                )
                for first in (0, width)
            )
            rest = _larger(builder, low, high)
        return builder.extract_element(rest, _INT32(0))

    return types.float64(x), emit
