"""Models whose numbers and tables differ by lane.

A `LaneRecord` stands for one of a model's named tuples. Its numbers are rows of lanes; its tables stay where
each case has them, and a lane holds no more than their address: a hundred cases of one drive share one table,
and nothing is copied.
"""

import hashlib
import operator
import struct
from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, signature
from numba.extending import lower_builtin, lower_getattr, lower_getattr_generic, models, register_model

from tribodyn.kernels.lanes.arrays import ALIGNMENT, ROW, ElementArrayType, indices_of, row_at, subscripts
from tribodyn.kernels.lanes.vectors import (
    DOUBLE,
    FLOATS,
    INDICES,
    INT64,
    INTEGERS,
    LANES,
    WIDTH,
    Vector,
    broadcast,
    intrinsic,
    of_operator,
)
from tribodyn.kernels.native import PackedValue


class Field(NamedTuple):
    """A field of a record; places are counted from where the record's own begin."""

    name: str
    ndim: int  # axes of the table; 0: a number
    row: int  # among the block's numbers or addresses; -1 of a table among the numbers, see `inline`
    first_length: int  # where the table's shape begins among all lengths
    shared: bool = False  # whether the table is the same in every lane
    #: whether the table stands among the numbers, every entry a row: behind all else of its record, from a
    #: row on that follows its shape among the lengths
    inline: bool = False


class Extent(NamedTuple):
    """How many numbers, addresses and lengths."""

    numbers: int
    addresses: int
    lengths: int


class SubRecord(NamedTuple):
    """A field that is a record, or several of one kind, one after the other."""

    name: str
    fields: "tuple[Field | SubRecord, ...]"
    first: Extent  # where it begins in the record
    size: Extent  # of one record
    items: int = 0  # 0: one record and no tuple of several

    def in_types(self) -> "SubRecord":
        """What code depends on: not where the record begins, nor how many there are."""
        nothing = Extent(0, 0, 0)
        return self._replace(
            first=nothing, size=self.size if self.items else nothing, items=min(self.items, 1)
        )


_FLOATS_AT = types.CPointer(types.float64)
_INTEGERS_AT = types.CPointer(types.int64)


class LaneTableType(types.Type):
    """Type of a table of `ndim` axes that each lane has at its own address.

    A `shared` one is the same in every lane and gives plain numbers.
    """

    def __init__(self, ndim: int, shared: bool = False):
        self.ndim = ndim
        self.shared = shared
        super().__init__(name=f"LaneTable({ndim}, {'shared' if shared else WIDTH})")


class LaneRecordType(types.Type):
    """Type of a record of numbers and tables over the lanes."""

    def __init__(self, fields: tuple[Field | SubRecord, ...]):
        self.fields = {field.name: field for field in fields}
        digest = hashlib.sha256(repr(fields).encode()).hexdigest()[:12]
        super().__init__(name=f"LaneRecord({digest}; {WIDTH})")


class LaneRecordsType(types.Type):
    """Type of several such records."""

    def __init__(self, part: SubRecord):
        self.item = LaneRecordType(part.fields)
        self.size = part.size
        super().__init__(name=f"LaneRecords({self.item.name})")


class LaneRecord(NamedTuple):
    """One of a model's named tuples over the lanes, as Python hands it to a kernel."""

    part: SubRecord
    #: numbers, addresses: (F, WIDTH) float64, (T, WIDTH) int64, of the whole model
    numbers: np.ndarray
    addresses: np.ndarray
    lengths: np.ndarray  # (L,) int64, shapes of all tables, one after the other; the same in every lane

    def as_argument(self) -> PackedValue:
        """As kernels read it: the addresses of the three arrays; the caller keeps them alive."""
        blocks = (self.numbers, self.addresses, self.lengths)
        places = (
            block.ctypes.data + first * block.strides[0]
            for block, first in zip(blocks, self.part.first, strict=True)
        )
        return PackedValue(LaneLayout(self.part.in_types()), struct.pack("=3q", *places), self)


class LaneLayout(NamedTuple):
    """Layout of a `LaneRecord` among a kernel's arguments."""

    part: SubRecord
    words: int = 3

    @property
    def type(self) -> Any:
        """Its type to numba."""
        return LaneRecordsType(self.part) if self.part.items else LaneRecordType(self.part.fields)


@register_model(LaneTableType)
class _LaneTableModel(models.StructModel):
    def __init__(self, manager, table):
        members = [("addresses", INDICES), ("shape", types.UniTuple(types.int64, table.ndim))]
        super().__init__(manager, table, members)


@register_model(LaneRecordType)
@register_model(LaneRecordsType)
class _LaneRecordModel(models.StructModel):
    def __init__(self, manager, record):
        members = [("numbers", _FLOATS_AT), ("addresses", _INTEGERS_AT), ("lengths", _INTEGERS_AT)]
        super().__init__(manager, record, members)


@of_operator(operator.getitem)
class _GetItem(AbstractTemplate):
    def generic(self, args, kws):
        table, index = args
        if isinstance(table, LaneTableType) and len(subscripts(index)) == table.ndim:
            return signature(types.float64 if table.shared else LANES, table, index)
        return None


def _address(context, builder, table, value, kind, index):
    """Addresses in a lane's own table: the part that differs by lane, and the offset that does not, bytes.

    Apart, because many look-ups share the first.
    """
    value = cgutils.create_struct_proxy(table)(context, builder, value)
    indices = indices_of(
        context, builder, kind, index, lambda part: part if isinstance(part, Vector) else types.int64
    )
    shape = cgutils.unpack_tuple(builder, value.shape)
    address, offset, stride = value.addresses, INT64(0), INT64(8)
    for axis in reversed(range(table.ndim)):
        if axis < len(indices):
            if indices[axis].type == INTEGERS:
                address = builder.add(address, builder.mul(indices[axis], broadcast(builder, stride)))
            else:
                offset = builder.add(offset, builder.mul(indices[axis], stride))
        stride = builder.mul(stride, shape[axis])
    return address, offset


@lower_builtin(operator.getitem, LaneTableType, types.Integer)
@lower_builtin(operator.getitem, LaneTableType, Vector)
@lower_builtin(operator.getitem, LaneTableType, types.BaseTuple)
def _gather(context, builder, signature, values):
    """Every lane reads its own table, at its own index where that is a vector."""
    table, kind = signature.args
    address, offset = _address(context, builder, table, values[0], kind, values[1])
    if table.shared:
        place = builder.add(builder.extract_element(address, INT64(0)), offset)
        return builder.load(builder.inttoptr(place, DOUBLE.as_pointer()))
    vector = ir.Constant(FLOATS, ir.Undefined)
    for lane in range(WIDTH):
        place = builder.add(builder.extract_element(address, INT64(lane)), offset)
        value = builder.load(builder.inttoptr(place, DOUBLE.as_pointer()))
        vector = builder.insert_element(vector, value, INT64(lane))
    return vector


@intrinsic
def rows_of_four(typingctx, table, index):
    """Four neighbours on the table's last axis, a vector each; `index` has all axes but the last.

    Whole rows are read and transposed: a third of the work of four look-ups.
    """
    four = types.UniTuple(LANES, 4)

    def emit(context, builder, signature, values):
        address, offset = _address(context, builder, table, values[0], index, values[1])
        row = ir.VectorType(DOUBLE, 4)
        rows = []
        for lane in range(WIDTH):
            place = builder.add(builder.extract_element(address, INT64(lane)), offset)
            rows.append(builder.load(builder.inttoptr(place, row.as_pointer()), align=8))
        return cgutils.pack_array(builder, transposed(builder, rows))

    return four(table, index), emit


def shuffled(builder, a, b, order):
    """Elements of a and b, counted on, in the order wanted."""
    mask = ir.Constant(ir.VectorType(ir.IntType(32), len(order)), order)
    return builder.shuffle_vector(a, b, mask)


def transposed(builder, rows):
    """Eight rows of four as four vectors: rows far apart are joined first, so that pairs can be swapped."""
    half = WIDTH // 2
    joined = [shuffled(builder, rows[i], rows[i + half], list(range(8))) for i in range(half)]
    even = [shuffled(builder, joined[i], joined[i + 1], [0, 8, 2, 10, 4, 12, 6, 14]) for i in (0, 2)]
    odd = [shuffled(builder, joined[i], joined[i + 1], [1, 9, 3, 11, 5, 13, 7, 15]) for i in (0, 2)]
    low, high = [0, 1, 8, 9, 4, 5, 12, 13], [2, 3, 10, 11, 6, 7, 14, 15]
    return [
        shuffled(builder, even[0], even[1], low),
        shuffled(builder, odd[0], odd[1], low),
        shuffled(builder, even[0], even[1], high),
        shuffled(builder, odd[0], odd[1], high),
    ]


@infer_getattr
class _TableAttributes(AttributeTemplate):
    key = LaneTableType

    def resolve_shape(self, table):
        return types.UniTuple(types.int64, table.ndim)


@lower_getattr(LaneTableType, "shape")
def _table_shape(context, builder, table, value):
    return cgutils.create_struct_proxy(table)(context, builder, value).shape


@infer_getattr
class _RecordAttributes(AttributeTemplate):
    key = LaneRecordType

    def generic_resolve(self, record, name):
        field = record.fields.get(name)
        if field is None:
            return None
        if isinstance(field, SubRecord):
            return LaneRecordsType(field) if field.items else LaneRecordType(field.fields)
        if field.inline:
            return ElementArrayType(field.ndim, ROW)
        return LaneTableType(field.ndim, field.shared) if field.ndim else LANES


@lower_getattr_generic(LaneRecordType)
def _record_attribute(context, builder, record, value, name):
    value = cgutils.create_struct_proxy(record)(context, builder, value)
    field = record.fields[name]
    if isinstance(field, SubRecord):
        kind = LaneRecordsType(field) if field.items else LaneRecordType(field.fields)
        return _moved(context, builder, kind, value, [INT64(each) for each in field.first])
    at = INT64(field.row * WIDTH)
    if not field.ndim:
        return builder.load(row_at(builder, value.numbers, at), align=ALIGNMENT)
    lengths = [
        builder.load(builder.gep(value.lengths, [INT64(field.first_length + axis)]))
        for axis in range(field.ndim + field.inline)
    ]
    shape = cgutils.pack_array(builder, lengths[: field.ndim])
    if field.inline:
        rows = cgutils.create_struct_proxy(ElementArrayType(field.ndim, ROW))(context, builder)
        at = builder.mul(lengths[-1], INT64(WIDTH))
        rows.data, rows.shape = builder.gep(value.numbers, [at]), shape
        return rows._getvalue()
    table = cgutils.create_struct_proxy(LaneTableType(field.ndim, field.shared))(context, builder)
    place = builder.bitcast(builder.gep(value.addresses, [at]), INTEGERS.as_pointer())
    table.addresses = builder.load(place, align=ALIGNMENT)
    table.shape = shape
    return table._getvalue()


def _moved(context, builder, kind, value, places):
    """The same block, seen from other places on among numbers, addresses and lengths."""
    part = cgutils.create_struct_proxy(kind)(context, builder)
    numbers, addresses, lengths = places
    part.numbers = builder.gep(value.numbers, [builder.mul(numbers, INT64(WIDTH))])
    part.addresses = builder.gep(value.addresses, [builder.mul(addresses, INT64(WIDTH))])
    part.lengths = builder.gep(value.lengths, [lengths])
    return part._getvalue()


@of_operator(operator.getitem)
class _GetRecord(AbstractTemplate):
    def generic(self, args, kws):
        records, index = args
        if isinstance(records, LaneRecordsType) and isinstance(index, types.Integer):
            return signature(records.item, records, types.int64)
        return None


@lower_builtin(operator.getitem, LaneRecordsType, types.int64)
def _record_item(context, builder, signature, values):
    records = signature.args[0]
    value = cgutils.create_struct_proxy(records)(context, builder, values[0])
    places = [builder.mul(values[1], INT64(each)) for each in records.size]
    return _moved(context, builder, records.item, value, places)
