"""Elements and parts of arrays, items of tuples and of tables that are known."""

import ast
from dataclasses import replace

import numpy as np

from tribodyn.kernels.c.body import operators
from tribodyn.kernels.c.body.expressions import Expressions
from tribodyn.kernels.c.types import DOUBLE, WHOLE, CArray, CSeveral, CTuple
from tribodyn.kernels.c.values import (
    ATOM,
    SUM,
    Counting,
    Expression,
    Known,
    Several,
    Value,
    number_of,
    python_number,
    text_of,
)


class Elements(Expressions):
    """Translates subscripts."""

    def _of_Subscript(self, node: ast.Subscript) -> Value:
        value = self.evaluate(node.value)
        if isinstance(node.slice, ast.Slice):
            return self._part(value, node.slice, node)
        parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        indices = [self.evaluate(part) for part in parts]
        if isinstance(value, Known):
            return self._of_table(value, indices, node)
        if isinstance(value, Several):
            (index,) = indices
            if not isinstance(index, Known):
                raise self.source.error(node, "the index of a tuple is not known")
            return value.items[index.value]
        if isinstance(value, Counting):
            raise self.source.error(node, "the index of a range")
        if isinstance(value.type, CSeveral):
            return Expression(f"{value.text}[{text_of(indices[0])}]", value.type.record, ATOM, value.place)
        if isinstance(value.type, CTuple) and isinstance(indices[0], Known):
            return self.items_of(value, node)[indices[0].value]
        if isinstance(value.type, CArray):
            return self.element(value, indices, node)
        raise self.source.error(node, "it has no items")

    def _of_table(self, table: Known, indices: list[Value], node: ast.Subscript) -> Value:
        """An item of numbers that are known."""
        if all(isinstance(index, Known) for index in indices):
            places = [index.value for index in indices if isinstance(index, Known)]
            return Known(python_number(table.value[places[0] if len(places) == 1 else tuple(places)]))
        numbers = np.asarray(table.value)
        if numbers.dtype.kind not in "if":
            raise self.source.error(node, "the index of a tuple is not known")
        if numbers.size and np.all(numbers == numbers.flat[0]):
            return Known(python_number(numbers.flat[0]))
        name = getattr(node.value, "attr", getattr(node.value, "id", "numbers"))
        kind = CArray(DOUBLE if numbers.dtype.kind == "f" else WHOLE, numbers.shape)
        whole = Expression(self.unit.tables.name_of(numbers, name), kind, ATOM, "kept")
        value = self.element(whole, indices, node)
        if isinstance(value, Expression) and value.type == WHOLE:
            return replace(value, bounds=(int(numbers.min()), int(numbers.max())))
        return value

    def element(self, array: Expression, indices: list[Value], node: ast.AST) -> Value:
        """An element of an array, or its part at leading indices."""
        kind = array.type
        assert isinstance(kind, CArray)
        if len(indices) > len(kind.shape) or any(number_of(index) == DOUBLE for index in indices):
            raise self.source.error(node, "an array has other indices")
        indices = [self._from_start(array, axis, index) for axis, index in enumerate(indices)]
        if any(number_of(index) is None for index in indices):
            raise self.source.error(node, "the index is no number")
        rest = kind.shape[len(indices) :]
        if kind.is_pointer:
            base = array.text if array.level == ATOM else f"({array.text})"
            text = base + "".join(f"[{text_of(index)}]" for index in indices)
            return Expression(text, CArray(kind.item, rest, kind.written) if rest else kind.item)
        if rest:
            raise self.source.error(node, "a row of an array whose lengths are not known")
        place = indices[0]
        for axis, index in enumerate(indices[1:], 1):
            rows = operators.binary(ast.Mult(), place, self.length(array, axis))
            place = operators.binary(ast.Add(), rows, index)
        return Expression(f"{array.text}.data[{text_of(place)}]", kind.item)

    def _from_start(self, array: Expression, axis: int, index: Value) -> Value:
        if isinstance(index, Known) and index.value < 0:
            return operators.binary(ast.Add(), self.length(array, axis), Known(index.value))
        return index

    def _part(self, value: Value, part: ast.Slice, node: ast.AST) -> Value:
        """Rows of an array, or items of a tuple."""
        bounds = [self.evaluate(each) if each else None for each in (part.lower, part.upper)]
        if part.step is not None:
            raise self.source.error(node, "a part of an array with a step")
        known = [bound.value if isinstance(bound, Known) else None for bound in bounds]
        if isinstance(value, (Several, Known)):
            items = Several(tuple(self.items_of(value, node)))
            if None in [k if b else 0 for k, b in zip(known, bounds, strict=True)]:
                raise self.source.error(node, "the part of a tuple is not known")
            return Several(items.items[known[0] : known[1]])
        kind = value.type if isinstance(value, Expression) else None
        if not (isinstance(value, Expression) and isinstance(kind, CArray) and kind.is_pointer):
            raise self.source.error(node, "a part of an array whose lengths are not known")
        length = kind.shape[0]
        first = bounds[0] or Known(0)
        if any(isinstance(bound, Known) and bound.value < 0 for bound in bounds):
            raise self.source.error(node, "a part of an array that counts from its end")
        rows: int | None = None
        if length is not None and isinstance(first, Known) and (bounds[1] is None or known[1] is not None):
            rows = len(range(length)[known[0] or 0 : known[1]])
        text = f"{value.text} + {text_of(first, SUM + 1)}"
        return Expression(text, CArray(kind.item, (rows, *kind.shape[1:]), kind.written), SUM)
