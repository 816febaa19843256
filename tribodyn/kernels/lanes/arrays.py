"""Arrays of floats whose last axis is the lanes, read and written a row of lanes at a time."""

import operator
from typing import Any, cast

from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, signature
from numba.extending import lower_builtin, lower_getattr, models, register_model

from tribodyn.kernels.lanes.vectors import FLOATS, INT64, LANES, WIDTH, Vector, intrinsic, of_operator

#: What loads may count on: a multiple of 8 bytes. Rows that stand on one of 64 are faster, not needed.
ALIGNMENT = 8


class LaneArrayType(types.Type):
    """Type of an array of `ndim` axes over rows of lanes."""

    def __init__(self, ndim: int):
        self.ndim = ndim
        super().__init__(name=f"LaneArray({ndim}, {WIDTH})")


@register_model(LaneArrayType)
class _LaneArrayModel(models.StructModel):
    def __init__(self, manager, array):
        members = [
            ("data", types.CPointer(types.float64)),
            ("shape", types.UniTuple(types.int64, array.ndim)),
        ]
        super().__init__(manager, array, members)


@infer_getattr
class _Shape(AttributeTemplate):
    key = LaneArrayType

    def resolve_shape(self, array):
        return types.UniTuple(types.int64, array.ndim)


@lower_getattr(LaneArrayType, "shape")
def _shape(context, builder, array, value):
    return cgutils.create_struct_proxy(array)(context, builder, value).shape


@intrinsic
def rows_of(typingctx, array):
    """An array of floats, its last axis the lanes, as rows of lanes."""
    rows = LaneArrayType(array.ndim - 1)

    def emit(context, builder, signature, values):
        source = context.make_array(array)(context, builder, values[0])
        value = cgutils.create_struct_proxy(rows)(context, builder)
        value.data = source.data
        value.shape = cgutils.pack_array(builder, cgutils.unpack_tuple(builder, source.shape)[:-1])
        return value._getvalue()

    return rows(array), emit


def _flat(builder, indices, shape):
    """Place of an element, in C order; `indices` may stop before the last axes."""
    place = None
    for axis, length in enumerate(shape):
        place = place if place is None else builder.mul(place, length)
        if axis < len(indices):
            place = indices[axis] if place is None else builder.add(place, indices[axis])
    return place


def indices_of(context, builder, kind, value, wanted):
    """Index values of a subscript, each cast to one of the `wanted` types."""
    if isinstance(kind, types.BaseTuple):
        values, kinds = cgutils.unpack_tuple(builder, value), subscripts(kind)
    else:
        values, kinds = [value], [kind]
    return [
        context.cast(builder, value, kind, wanted(kind)) for value, kind in zip(values, kinds, strict=True)
    ]


def row_at(builder, pointer, offset):
    """Address of the row of lanes at a float's place."""
    return builder.bitcast(builder.gep(pointer, [offset]), FLOATS.as_pointer())


def _row(context, builder, array, value, kind, index):
    """Where a row of lanes stands."""
    value = cgutils.create_struct_proxy(array)(context, builder, value)
    shape = cgutils.unpack_tuple(builder, value.shape)
    place = _flat(builder, indices_of(context, builder, kind, index, lambda _: types.int64), shape)
    return value, shape, builder.mul(place, INT64(WIDTH))


def subscripts(index: Any) -> list[Any]:
    """Types of a subscript's parts."""
    return list(cast(Any, index)) if isinstance(index, types.BaseTuple) else [index]


@of_operator(operator.getitem)
class _GetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index = args
        if not isinstance(array, LaneArrayType):
            return None
        left = array.ndim - len(subscripts(index))
        return signature(LaneArrayType(left) if left else LANES, array, index)


@of_operator(operator.setitem)
class _SetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index, _ = args
        if isinstance(array, LaneArrayType) and len(subscripts(index)) == array.ndim:
            return signature(types.none, array, index, LANES)
        return None


@lower_builtin(operator.getitem, LaneArrayType, types.Integer)
@lower_builtin(operator.getitem, LaneArrayType, types.BaseTuple)
def _load(context, builder, signature, values):
    array, kind = signature.args
    value, shape, place = _row(context, builder, array, values[0], kind, values[1])
    if signature.return_type is LANES:
        return builder.load(row_at(builder, value.data, place), align=ALIGNMENT)
    part = cgutils.create_struct_proxy(signature.return_type)(context, builder)
    part.data = builder.gep(value.data, [place])
    part.shape = cgutils.pack_array(builder, shape[len(subscripts(kind)) :])
    return part._getvalue()


@lower_builtin(operator.setitem, LaneArrayType, types.Integer, Vector)
@lower_builtin(operator.setitem, LaneArrayType, types.BaseTuple, Vector)
def _store(context, builder, signature, values):
    array, kind, _ = signature.args
    value, _, place = _row(context, builder, array, values[0], kind, values[1])
    builder.store(values[2], row_at(builder, value.data, place), align=ALIGNMENT)
    return context.get_dummy_value()
