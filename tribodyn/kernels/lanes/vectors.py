"""Vectors of numbers, one per case, as types that numba compiles to SIMD registers.

`LANES` holds floats, `INDICES` integers, `MASK` truths. They mix with plain numbers, which stand for the same
number in every lane, so that a law written for one case compiles for `WIDTH` of them as it stands.
"""

import operator
from typing import Any, cast

from llvmlite import binding, ir
from numba import config, extending
from numba.core import cgutils, types
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import lower_builtin, lower_cast, models, register_model

#: Decorator of functions that emit LLVM code; untyped because numba's own type names the compiler's argument.
intrinsic = cast(Any, extending.intrinsic)
#: Decorator of the types of an operator.
of_operator = cast(Any, infer_global)

#: Cases side by side: one AVX-512 register of floats, two of AVX2, four of NEON.
WIDTH = 8

DOUBLE, INT64, BIT = ir.DoubleType(), ir.IntType(64), ir.IntType(1)
FLOATS, INTEGERS, BITS = (ir.VectorType(scalar, WIDTH) for scalar in (DOUBLE, INT64, BIT))

#: The bits of x and of 1/x add up to about this.
RECIPROCAL_BITS = 0x7FDE623822FC16E6
#: What the processor that is compiled for can do, where NUMBA_CPU_FEATURES says so.
_GIVEN: str | None = cast(Any, config).CPU_FEATURES
#: Whether it multiplies and adds in one, without which a division is better left to the divider.
FUSED = "+fma" in (binding.get_host_cpu_features().flatten() if _GIVEN is None else _GIVEN).split(",")

#: Comparisons that hold of numbers only; `!=` holds of what is not a number too.
COMPARISONS = {operator.lt: "<", operator.le: "<=", operator.gt: ">", operator.ge: ">=", operator.eq: "=="}
#: Products and sums may fuse: fewer roundings. The order of operations stays as written.
FUSE = ("contract",)


class Vector(types.Type):
    """Type of `WIDTH` values of one kind: "float", "index" or "mask"."""

    def __init__(self, kind: str):
        self.kind = kind
        super().__init__(name=f"lanes of {kind} x {WIDTH}")

    def can_convert_from(self, typingctx, other):  # noqa: D102  (numba's)
        if self.kind == "mask":
            return Conversion.promote if isinstance(other, types.Boolean) else None
        if isinstance(other, types.Integer):
            return Conversion.promote if self.kind == "index" else Conversion.safe
        if self.kind == "float":
            if isinstance(other, types.Float):
                return Conversion.promote
            if isinstance(other, Vector) and other.kind == "index":
                return Conversion.safe
        return None

    def unify(self, typingctx, other):  # noqa: D102  (numba's)
        return self if self.can_convert_from(typingctx, other) is not None else None


LANES, INDICES, MASK = Vector("float"), Vector("index"), Vector("mask")
_LLVM = {"float": FLOATS, "index": INTEGERS, "mask": BITS}


@register_model(Vector)
class _VectorModel(models.PrimitiveModel):
    def __init__(self, manager, vector):
        super().__init__(manager, vector, _LLVM[vector.kind])


def broadcast(builder, value, width=WIDTH):
    """The same scalar in every lane."""
    vector = ir.VectorType(value.type, width)
    first = builder.insert_element(ir.Constant(vector, ir.Undefined), value, INT64(0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), width), [0] * width)
    return builder.shuffle_vector(first, ir.Constant(vector, ir.Undefined), zeros)


@lower_cast(types.Float, LANES)
@lower_cast(types.Integer, LANES)
def _number_to_lanes(context, builder, source_type, wanted, value):
    return broadcast(builder, context.cast(builder, value, source_type, types.float64))


@lower_cast(types.Integer, INDICES)
def _integer_to_indices(context, builder, source_type, wanted, value):
    return broadcast(builder, context.cast(builder, value, source_type, types.int64))


@lower_cast(INDICES, LANES)
def _indices_to_lanes(context, builder, source_type, wanted, value):
    return builder.sitofp(value, FLOATS)


@lower_cast(types.Boolean, MASK)
def _truth_to_mask(context, builder, source_type, wanted, value):
    return broadcast(builder, builder.trunc(value, BIT))


def _register(operation, *cases):
    """Give numba an operator: pairs of a signature and a function (builder, *values) -> value."""
    template = type(
        "Template", (ConcreteTemplate,), {"key": operation, "cases": [typed for typed, _ in cases]}
    )
    of_operator(operation)(template)
    for typed, emit in cases:
        lower_builtin(operation, *typed.args)(_lowering(emit))


def _lowering(emit):
    return lambda context, builder, signature, values: emit(builder, *values)


def _instruction(name, **flags):
    return lambda builder, a, b: getattr(builder, name)(a, b, **flags)


for _operator, _inplace, _float, _int in (
    (operator.add, operator.iadd, "fadd", "add"),
    (operator.sub, operator.isub, "fsub", "sub"),
    (operator.mul, operator.imul, "fmul", "mul"),
):
    for _symbol in (_operator, _inplace):
        _register(
            _symbol,
            (signature(INDICES, INDICES, INDICES), _instruction(_int)),
            (signature(LANES, LANES, LANES), _instruction(_float, flags=FUSE)),
        )


def _fma(builder, a, b, c):
    function = ir.FunctionType(FLOATS, [FLOATS] * 3)
    return builder.call(
        cgutils.get_or_insert_function(builder.module, function, f"llvm.fma.v{WIDTH}f64"), (a, b, c)
    )


def _constant(value):
    return ir.Constant(FLOATS, [value] * WIDTH)


def quotient(builder, a, b):
    """a/b without the divider, by which vectors gain little: a guess from the bits, refined to the end.

    Two steps of third order bring the reciprocal's error from 0.06 by 2e-4 to 1e-11, the remainder then gives
    the quotient to half a unit or a little more. A divisor that is zero, infinite or not within
    1e-307 … 1e307 gives NaN.
    """
    guess = builder.sub(ir.Constant(INTEGERS, [RECIPROCAL_BITS] * WIDTH), builder.bitcast(b, INTEGERS))
    r = builder.bitcast(guess, FLOATS)
    opposite = builder.fneg(b)
    for _ in range(2):
        error = _fma(builder, opposite, r, _constant(1.0))
        r = _fma(builder, r, _fma(builder, error, error, error), r)
    q = builder.fmul(a, r)
    return _fma(builder, _fma(builder, opposite, q, a), r, q)


for _symbol in (operator.truediv, operator.itruediv):
    _register(
        _symbol, (signature(LANES, LANES, LANES), quotient if FUSED else _instruction("fdiv", flags=FUSE))
    )
_register(operator.neg, (signature(LANES, LANES), lambda builder, a: builder.fneg(a)))

for _operator, _sign in COMPARISONS.items():
    _register(
        _operator,
        (
            signature(MASK, INDICES, INDICES),
            lambda builder, a, b, sign=_sign: builder.icmp_signed(sign, a, b),
        ),
        (signature(MASK, LANES, LANES), lambda builder, a, b, sign=_sign: builder.fcmp_ordered(sign, a, b)),
    )
_register(
    operator.ne,
    (signature(MASK, INDICES, INDICES), lambda builder, a, b: builder.icmp_signed("!=", a, b)),
    (signature(MASK, LANES, LANES), lambda builder, a, b: builder.fcmp_unordered("!=", a, b)),
)
_register(operator.and_, (signature(MASK, MASK, MASK), _instruction("and_")))
_register(operator.or_, (signature(MASK, MASK, MASK), _instruction("or_")))
_register(operator.invert, (signature(MASK, MASK), lambda builder, a: builder.not_(a)))


@intrinsic
def select(typingctx, condition, a, b):
    """Per lane `a` where the mask holds, else `b`."""
    kinds = {types.unliteral(a), types.unliteral(b)}
    kind = INDICES if INDICES in kinds and kinds <= {INDICES, types.int64} else LANES

    def emit(context, builder, signature, values):
        return builder.select(*values)

    return kind(MASK, kind, kind), emit


@intrinsic
def any_of(typingctx, mask):
    """Whether the mask holds in any lane."""

    def emit(context, builder, signature, values):
        bits = builder.bitcast(values[0], ir.IntType(WIDTH))
        return builder.icmp_unsigned("!=", bits, ir.Constant(bits.type, 0))

    return types.boolean(MASK), emit


@intrinsic
def bits_of(typingctx, x):
    """The floats' bit patterns as integers."""
    return INDICES(LANES), lambda context, builder, signature, values: builder.bitcast(values[0], INTEGERS)


@intrinsic
def from_bits(typingctx, bits):
    """The floats that have these bit patterns."""
    return LANES(INDICES), lambda context, builder, signature, values: builder.bitcast(values[0], FLOATS)


def _integer_operation(name, doc):
    @intrinsic
    def operation(typingctx, a, b):
        def emit(context, builder, signature, values):
            return getattr(builder, name)(*values)

        return INDICES(INDICES, INDICES), emit

    operation.__doc__ = doc
    return operation


shift_left = _integer_operation("shl", "Integers times 2^b.")
shift_right = _integer_operation("ashr", "Integers over 2^b, rounded down.")
bit_and = _integer_operation("and_", "Bits that both have.")


@intrinsic
def to_indices(typingctx, x):
    """Integer parts; 0 where x is not a number, so that every address is valid."""

    def emit(context, builder, signature, values):
        (x,) = values
        ordered = builder.fcmp_ordered("ord", x, x)
        zero = ir.Constant(FLOATS, [0.0] * WIDTH)
        return builder.fptosi(builder.select(ordered, x, zero), INTEGERS)

    return INDICES(LANES), emit


def _unary(name, doc):
    """An LLVM function of one vector of floats."""

    @intrinsic
    def function(typingctx, x):
        def emit(context, builder, signature, values):
            prototype = ir.FunctionType(FLOATS, [FLOATS])
            called = cgutils.get_or_insert_function(builder.module, prototype, f"llvm.{name}.v{WIDTH}f64")
            return builder.call(called, values)

        return LANES(LANES), emit

    function.__doc__ = doc
    return function


square_root = _unary("sqrt", "Correctly rounded square root; NaN below zero.")
magnitude = _unary("fabs", "Absolute value.")


@intrinsic
def count(typingctx, counter, number):
    """Add to an array's first integer and give what it was, whichever thread comes first."""

    def emit(context, builder, signature, values):
        array = context.make_array(signature.args[0])(context, builder, values[0])
        return builder.atomic_rmw("add", array.data, values[1], "monotonic")

    return types.int64(counter, types.int64), emit
