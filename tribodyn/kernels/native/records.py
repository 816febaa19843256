"""A kernel's arguments to numba: a block of words that stays where it is, its fields read where used."""

import hashlib
import operator
from typing import Any, cast

import numba
import numpy as np
from llvmlite import ir
from numba import extending
from numba.core import cgutils, types
from numba.core.typing.templates import (
    AbstractTemplate,
    AttributeTemplate,
    infer_getattr,
    infer_global,
    signature,
)
from numba.extending import lower_builtin, lower_getattr_generic, models, register_model
from numba.np.arrayobj import populate_array

from tribodyn.kernels.native.arguments import (
    Array,
    FixedLayout,
    FunctionLayout,
    IndicesLayout,
    Numeric,
    RecordLayout,
    SeveralLayout,
)

intrinsic = cast(Any, extending.intrinsic)

WORD = 8
_INT64 = ir.IntType(64)
#: Type of a block of results.
WORDS = types.CPointer(types.int64)


class RecordType(types.Type):
    """Type of a block of words whose fields are read in place; `fields` gives their types and first words."""

    def __init__(self, record: RecordLayout):
        self.fields: dict[str, tuple[Any, int]] = {}
        words = 0
        for name, layout in record.fields:
            self.fields[name] = type_of(layout), words
            words += words_of(layout)
        self.words = words
        digest = hashlib.sha256(repr(record).encode()).hexdigest()[:12]
        super().__init__(name=f"{record.name}.{digest}")  # short: it is part of every function's name


class SeveralType(types.Type):
    """Type of a block of records of one type, one after the other."""

    def __init__(self, several: SeveralLayout):
        self.item = type_of(several.item)
        self.size = words_of(several.item)
        super().__init__(name=f"several {self.item.name}")


class IndicesType(types.Type):
    """Type of whole numbers by place, which are constants of the machine code."""

    def __init__(self, values: tuple[int, ...]):
        self.values = values
        super().__init__(name=f"Indices{values}")


class RuntimeIndicesType(types.Type):
    """Type of whole numbers by place, at an address; they do not change while a kernel runs."""

    def __init__(self):
        super().__init__(name="RuntimeIndices")


@register_model(IndicesType)
@register_model(RuntimeIndicesType)
@register_model(RecordType)
@register_model(SeveralType)
class _RecordModel(models.OpaqueModel):
    pass


def words_of(layout: Any) -> int:
    """Words that a value of a layout takes."""
    if isinstance(layout, RecordLayout):
        return sum(words_of(field) for _, field in layout.fields)
    return 1 if isinstance(layout, Numeric) else layout.words


_NUMBERS = {
    "float": types.float64,
    "int": types.int64,
    "bool": types.boolean,
    "indices": RuntimeIndicesType(),
}


def type_of(layout: Any) -> Any:
    """Type of a layout to numba."""
    if isinstance(layout, RecordLayout):
        return RecordType(layout)
    if isinstance(layout, SeveralLayout):
        return SeveralType(layout)
    if isinstance(layout, FixedLayout):
        return types.literal(layout.value)
    if isinstance(layout, IndicesLayout):
        return IndicesType(layout.values)
    if isinstance(layout, Array):
        return types.Array(numba.from_dtype(np.dtype(layout.dtype)), layout.ndim, layout.order)
    if isinstance(layout, FunctionLayout):
        from tribodyn.kernels.native.functions import function_type

        return function_type(layout.function)
    return _NUMBERS[layout.name] if isinstance(layout, Numeric) else layout.type


def _read(context, builder, kind, block, word):
    """A field's value, from its first word on; blocks do not change while a kernel runs."""
    if isinstance(kind, (types.Function, IndicesType)):
        return context.get_dummy_value()  # its type says it all
    if isinstance(kind, types.IntegerLiteral):
        return _INT64(kind.literal_value)
    place = builder.gep(block, [_INT64(WORD * word)])
    if isinstance(kind, (RuntimeIndicesType, SeveralType)):
        return builder.inttoptr(_load(builder, place, _INT64), place.type)
    if isinstance(kind, RecordType):
        return place
    if isinstance(kind, types.Array):
        items = [
            _load(builder, place, _INT64, i) for i in range(1 + kind.ndim * (1 if kind.layout == "C" else 2))
        ]
        size = context.get_abi_sizeof(context.get_data_type(kind.dtype))
        shape, strides = items[1 : 1 + kind.ndim], items[1 + kind.ndim :]
        if kind.layout == "C":
            strides = [_INT64(size)]
            for length in reversed(shape[1:]):
                strides.insert(0, builder.mul(strides[0], length))
            strides = strides[: kind.ndim]
        array = context.make_array(kind)(context, builder)
        data = builder.inttoptr(items[0], context.get_data_type(kind.dtype).as_pointer())
        populate_array(array, data, shape, strides, size, None)
        return array._getvalue()
    if kind is types.boolean:
        return builder.trunc(_load(builder, place, _INT64), ir.IntType(1))
    return _load(builder, place, context.get_value_type(kind))


def _load(builder, place, kind, index=0):
    index = _INT64(index) if isinstance(index, int) else index
    value = builder.load(builder.gep(builder.bitcast(place, kind.as_pointer()), [index]), align=WORD)
    value.set_metadata("invariant.load", builder.module.add_metadata([]))
    return value


@infer_getattr
class _Fields(AttributeTemplate):
    key = RecordType

    def generic_resolve(self, record, name):
        return record.fields[name][0] if name in record.fields else None


@lower_getattr_generic(RecordType)
def _field(context, builder, record, block, name):
    return _read(context, builder, *_place(record, name, block))


@cast(Any, infer_global)(operator.getitem)
class _Items(AbstractTemplate):
    def generic(self, args, kws):
        several, index = args
        if isinstance(several, SeveralType) and isinstance(index, types.Integer):
            return signature(several.item, several, types.int64)
        if isinstance(several, (IndicesType, RuntimeIndicesType)) and isinstance(index, types.Integer):
            return signature(types.int64, several, types.int64)
        return None


@lower_builtin(operator.getitem, SeveralType, types.int64)
def _item(context, builder, signature, values):
    step = builder.mul(values[1], _INT64(WORD * signature.args[0].size))
    return builder.gep(values[0], [step])


@lower_builtin(operator.getitem, IndicesType, types.int64)
def _index(context, builder, signature, values):
    table = ir.Constant(ir.ArrayType(_INT64, len(signature.args[0].values)), list(signature.args[0].values))
    whole = cgutils.global_constant(builder, "indices", table)
    return builder.load(builder.gep(whole, [_INT64(0), values[1]]))


@lower_builtin(operator.getitem, RuntimeIndicesType, types.int64)
def _number_at(context, builder, signature, values):
    return _load(builder, values[0], _INT64, values[1])


def _place(record, name, block):
    kind, word = record.fields[name]
    return kind, block, word


@intrinsic
def fields_of(typingctx, record):
    """All fields of a record as a tuple."""
    whole = types.Tuple([kind for kind, _ in record.fields.values()])

    def emit(context, builder, signature, values):
        fields = [_read(context, builder, *_place(record, name, values[0])) for name in record.fields]
        return context.make_tuple(builder, whole, fields)

    return whole(record), emit


@intrinsic
def put(typingctx, results, value: Any):
    """Write numbers, a word each."""

    def emit(context, builder, signature, values):
        numbers = []
        if isinstance(value, types.BaseTuple):
            numbers = list(zip(cast(Any, value), cgutils.unpack_tuple(builder, values[1]), strict=True))
        elif value is not types.none:
            numbers = [(value, values[1])]
        for i, (kind, number) in enumerate(numbers):
            word = types.float64 if letter_of(kind) == "d" else types.int64
            converted = context.cast(builder, number, kind, word)
            pointer = builder.bitcast(builder.gep(values[0], [_INT64(i)]), converted.type.as_pointer())
            builder.store(converted, pointer, align=WORD)
        return context.get_dummy_value()

    return types.none(results, value), emit


def letter_of(kind: Any) -> str:
    """The struct module's letter for a number that a kernel returns."""
    if isinstance(kind, types.Float):
        return "d"
    if isinstance(kind, (types.Integer, types.Boolean)):
        return "q"
    raise TypeError(f"a kernel returns numbers or a tuple of them, not {kind}")
