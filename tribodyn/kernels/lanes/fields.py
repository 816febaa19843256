"""Where the fields of a record over the lanes stand: numbers, addresses of tables, and their lengths."""

from typing import NamedTuple


class Field(NamedTuple):
    """A field of a record; places are counted from where the record's own begin."""

    name: str
    ndim: int  # axes of the table; 0: a number
    row: int  # among the block's numbers or addresses
    first_length: int  # where the table's shape begins among all lengths
    shared: bool = False  # whether the table is the same in every lane
    inline: bool = False  # whether the table stands among the numbers, every entry a row


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
