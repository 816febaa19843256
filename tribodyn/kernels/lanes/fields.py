"""Where the fields of a record over the lanes stand: numbers, addresses of tables, and their lengths."""

from typing import NamedTuple


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
