"""Arrays of floats whose last axis makes up a number of lanes or a dual one, read and written at once."""

import operator
from collections.abc import Callable
from typing import Any, NamedTuple, cast

from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, signature
from numba.extending import lower_builtin, lower_getattr, models, register_model

from tribodyn.kernels.lanes.vectors import FLOATS, INT64, LANES, WIDTH, intrinsic, of_operator

#: What loads may count on: a multiple of 8 bytes. Rows that stand on one of 64 are faster, not needed.
ALIGNMENT = 8


class Element(NamedTuple):
    """What an array holds: its type to numba, the floats that it takes, and how it is read and written."""

    type: Any
    length: int
    load: Callable[..., Any]  # (context, builder, pointer) -> value
    store: Callable[..., Any]  # (context, builder, pointer, value)


class ElementArrayType(types.Type):
    """Type of an array of `ndim` axes of such elements."""

    def __init__(self, ndim: int, element: Element):
        self.ndim, self.element = ndim, element
        super().__init__(name=f"ArrayOf({ndim}, {element.type.name})")


@register_model(ElementArrayType)
class _ElementArrayModel(models.StructModel):
    def __init__(self, manager, array):
        members = [
            ("data", types.CPointer(types.float64)),
            ("shape", types.UniTuple(types.int64, array.ndim)),
        ]
        super().__init__(manager, array, members)


@infer_getattr
class _Shape(AttributeTemplate):
    key = ElementArrayType

    def resolve_shape(self, array):
        return types.UniTuple(types.int64, array.ndim)


@lower_getattr(ElementArrayType, "shape")
def _shape(context, builder, array, value):
    return cgutils.create_struct_proxy(array)(context, builder, value).shape


def as_elements(array: Any, element: Element) -> Any:
    """Type of a contiguous array of floats, its last axis an element, as one of elements; what emits it."""
    elements = ElementArrayType(array.ndim - 1, element)

    def emit(context, builder, signature, values):
        source = context.make_array(array)(context, builder, values[0])
        value = cgutils.create_struct_proxy(elements)(context, builder)
        value.data = source.data
        value.shape = cgutils.pack_array(builder, cgutils.unpack_tuple(builder, source.shape)[:-1])
        return value._getvalue()

    return elements, emit


def row_at(builder, pointer, offset):
    """Address of the row of lanes at a float's place."""
    return builder.bitcast(builder.gep(pointer, [offset]), FLOATS.as_pointer())


def _load_row(context, builder, pointer):
    return builder.load(row_at(builder, pointer, INT64(0)), align=ALIGNMENT)


def _store_row(context, builder, pointer, value):
    builder.store(value, row_at(builder, pointer, INT64(0)), align=ALIGNMENT)


#: A row of lanes as an element.
ROW = Element(LANES, WIDTH, _load_row, _store_row)


@intrinsic
def rows_of(typingctx, array):
    """An array of floats, its last axis the lanes, as rows of lanes."""
    rows, emit = as_elements(array, ROW)
    return rows(array), emit


def subscripts(index: Any) -> list[Any]:
    """Types of a subscript's parts."""
    return list(cast(Any, index)) if isinstance(index, types.BaseTuple) else [index]


def indices_of(context, builder, kind, value, wanted):
    """Index values of a subscript, each cast to one of the `wanted` types."""
    values = cgutils.unpack_tuple(builder, value) if isinstance(kind, types.BaseTuple) else [value]
    return [
        context.cast(builder, value, kind, wanted(kind))
        for value, kind in zip(values, subscripts(kind), strict=True)
    ]


def _pointer(context, builder, array, value, kind, index):
    """Where an element or a part stands, and the lengths of all axes; the index may stop before the last."""
    value = cgutils.create_struct_proxy(array)(context, builder, value)
    shape = cgutils.unpack_tuple(builder, value.shape)
    indices = indices_of(context, builder, kind, index, lambda _: types.int64)
    place = None
    for axis, length in enumerate(shape):
        place = place if place is None else builder.mul(place, length)
        if axis < len(indices):
            place = indices[axis] if place is None else builder.add(place, indices[axis])
    return builder.gep(value.data, [builder.mul(place, INT64(array.element.length))]), shape


@of_operator(operator.getitem)
class _GetLanes(AbstractTemplate):
    def generic(self, args, kws):
        array, index = args
        if not isinstance(array, ElementArrayType):
            return None
        if isinstance(index, types.SliceType):
            return signature(array, array, index)
        left = array.ndim - len(subscripts(index))
        return signature(ElementArrayType(left, array.element) if left else array.element.type, array, index)


@of_operator(operator.setitem)
class _SetItem(AbstractTemplate):
    def generic(self, args, kws):
        array, index, _ = args
        if isinstance(array, ElementArrayType) and len(subscripts(index)) == array.ndim:
            return signature(types.none, array, index, array.element.type)
        return None


@lower_builtin(operator.getitem, ElementArrayType, types.Integer)
@lower_builtin(operator.getitem, ElementArrayType, types.BaseTuple)
def _load(context, builder, signature, values):
    array, kind = signature.args
    pointer, shape = _pointer(context, builder, array, values[0], kind, values[1])
    if signature.return_type is array.element.type:
        return array.element.load(context, builder, pointer)
    part = cgutils.create_struct_proxy(signature.return_type)(context, builder)
    part.data = pointer
    part.shape = cgutils.pack_array(builder, shape[len(subscripts(kind)) :])
    return part._getvalue()


@lower_builtin(operator.getitem, ElementArrayType, types.SliceType)
def _slice(context, builder, signature, values):
    """Rows from one on, up to another or the end."""
    array, kind = signature.args
    value = cgutils.create_struct_proxy(array)(context, builder, values[0])
    wanted = cast(Any, context).make_helper(builder, kind, values[1])
    first, *others = cgutils.unpack_tuple(builder, value.shape)
    place = wanted.start
    for length in others:
        place = builder.mul(place, length)
    inside = builder.icmp_signed("<", wanted.stop, first)
    end = builder.select(inside, wanted.stop, first)
    part = cgutils.create_struct_proxy(array)(context, builder)
    part.data = builder.gep(value.data, [builder.mul(place, INT64(array.element.length))])
    part.shape = cgutils.pack_array(builder, [builder.sub(end, wanted.start), *others])
    return part._getvalue()


@lower_builtin(operator.setitem, ElementArrayType, types.Integer, types.Any)
@lower_builtin(operator.setitem, ElementArrayType, types.BaseTuple, types.Any)
def _store(context, builder, signature, values):
    array, kind, _ = signature.args
    pointer, _ = _pointer(context, builder, array, values[0], kind, values[1])
    array.element.store(context, builder, pointer, values[2])
    return context.get_dummy_value()
