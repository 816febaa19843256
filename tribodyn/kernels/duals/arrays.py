"""Arrays of dual numbers: floats whose last axis holds a number's slopes, its value, and room behind it."""

import operator
from typing import Any, cast

from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, signature
from numba.extending import lower_builtin, models, register_model

from tribodyn.kernels.duals.numbers import DIRECTIONS, DOUBLE, DUAL, SLOPES, made, taken_apart
from tribodyn.kernels.lanes.arrays import ALIGNMENT, indices_of, subscripts
from tribodyn.kernels.lanes.vectors import INT64, intrinsic, of_operator

#: Place of the value behind the slopes, and floats that a dual number takes: whole cache lines, so that none
#: is read across two where the array begins on one.
VALUE, LENGTH = DIRECTIONS, DIRECTIONS + 8


class DualArrayType(types.Type):
    """Type of an array of `ndim` axes of dual numbers."""

    def __init__(self, ndim: int):
        self.ndim = ndim
        super().__init__(name=f"DualArray({ndim}, {DIRECTIONS})")


@register_model(DualArrayType)
class _DualArrayModel(models.StructModel):
    def __init__(self, manager, array):
        members = [
            ("data", types.CPointer(types.float64)),
            ("shape", types.UniTuple(types.int64, array.ndim)),
        ]
        super().__init__(manager, array, members)


@intrinsic
def duals_of(typingctx, array):
    """An array of floats, contiguous and its last axis of `LENGTH`, as dual numbers."""
    duals = DualArrayType(array.ndim - 1)

    def emit(context, builder, sig, values):
        source = context.make_array(array)(context, builder, values[0])
        value = cgutils.create_struct_proxy(duals)(context, builder)
        value.data = source.data
        value.shape = cgutils.pack_array(builder, cgutils.unpack_tuple(builder, source.shape)[:-1])
        return value._getvalue()

    return duals(array), emit


@of_operator(operator.getitem)
class _GetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index = args
        if not isinstance(array, DualArrayType):
            return None
        if isinstance(index, types.SliceType):
            return signature(array, array, index)
        left = array.ndim - len(subscripts(index))
        return signature(DualArrayType(left) if left else DUAL, array, index)


@of_operator(operator.setitem)
class _SetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index, _ = args
        if isinstance(array, DualArrayType) and len(subscripts(index)) == array.ndim:
            return signature(types.none, array, index, DUAL)
        return None


def _place(context, builder, array, value, kind, index):
    """The array taken apart, its lengths, and where the element or part stands, in floats."""
    value = cgutils.create_struct_proxy(array)(context, builder, value)
    shape = cgutils.unpack_tuple(builder, value.shape)
    indices = indices_of(context, builder, kind, index, lambda _: types.int64)
    place = INT64(0)
    for axis, length in enumerate(shape):
        place = builder.mul(place, length)
        if axis < len(indices):
            place = builder.add(place, indices[axis])
    return value, shape, builder.mul(place, INT64(LENGTH))


@lower_builtin(operator.getitem, DualArrayType, types.Integer)
@lower_builtin(operator.getitem, DualArrayType, types.BaseTuple)
def _load(context, builder, sig, values):
    array, kind = sig.args
    value, shape, place = _place(context, builder, array, values[0], kind, values[1])
    first = builder.gep(value.data, [place])
    if sig.return_type is DUAL:
        slope = builder.load(builder.bitcast(first, SLOPES.as_pointer()), align=ALIGNMENT)
        return made(context, builder, builder.load(builder.gep(first, [INT64(VALUE)])), slope)
    part = cgutils.create_struct_proxy(sig.return_type)(context, builder)
    part.data = first
    part.shape = cgutils.pack_array(builder, shape[len(subscripts(kind)) :])
    return part._getvalue()


@lower_builtin(operator.getitem, DualArrayType, types.SliceType)
def _slice(context, builder, sig, values):
    """Rows from one on, up to another or the end."""
    array, kind = sig.args
    value = cgutils.create_struct_proxy(array)(context, builder, values[0])
    wanted = cast(Any, context).make_helper(builder, kind, values[1])
    first, *others = cgutils.unpack_tuple(builder, value.shape)
    place = wanted.start
    for length in others:
        place = builder.mul(place, length)
    inside = builder.icmp_signed("<", wanted.stop, first)
    end = builder.select(inside, wanted.stop, first)
    part = cgutils.create_struct_proxy(array)(context, builder)
    part.data = builder.gep(value.data, [builder.mul(place, INT64(LENGTH))])
    part.shape = cgutils.pack_array(builder, [builder.sub(end, wanted.start), *others])
    return part._getvalue()


@lower_builtin(operator.setitem, DualArrayType, types.Integer, DUAL)
@lower_builtin(operator.setitem, DualArrayType, types.BaseTuple, DUAL)
def _store(context, builder, sig, values):
    array, kind, _ = sig.args
    place = _place(context, builder, array, values[0], kind, values[1])
    first = builder.gep(place[0].data, [place[2]])
    value, slope = taken_apart(context, builder, DUAL, values[2])
    builder.store(slope, builder.bitcast(first, SLOPES.as_pointer()), align=ALIGNMENT)
    last = builder.gep(first, [INT64(VALUE)])
    builder.store(value, builder.bitcast(last, DOUBLE.as_pointer()), align=ALIGNMENT)
    return context.get_dummy_value()
