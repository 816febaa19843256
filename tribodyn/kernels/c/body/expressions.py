"""Python expressions to values: names, numbers, fields, elements and parts of arrays, choices."""

import ast
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from tribodyn.kernels.c.body import operators
from tribodyn.kernels.c.lines import CLine
from tribodyn.kernels.c.sources import PythonSource
from tribodyn.kernels.c.types import (
    DOUBLE,
    TRUTH,
    WHOLE,
    CArray,
    CKnown,
    CNumber,
    CPointer,
    CRecord,
    CTuple,
    CType,
    declared,
    number_type,
    takes_place,
)
from tribodyn.kernels.c.unit import Unit
from tribodyn.kernels.c.values import (
    ATOM,
    Counting,
    Expression,
    Known,
    Several,
    UnknownOperationError,
    Value,
    condition,
    python_number,
    text_of,
)

#: What says, where an expression is evaluated, that it is none of those that are translated.
NOT_TRANSLATED = (
    UnknownOperationError,
    TypeError,
    ValueError,
    AttributeError,
    LookupError,
    ArithmeticError,
    AssertionError,
)


class Expressions:
    """Translates the expressions of one function; its statements and calls are in classes made of it."""

    def __init__(self, source: PythonSource, unit: Unit):
        self.source, self.unit = source, unit
        self.values: dict[str, Value] = {}  # of variables
        self.lines: list[CLine] = []  # what is to run before the statement at hand
        self.depth = 1
        self.taken: set[str] = set()  # names of C variables
        self.writes = False  # whether the function changes arrays

    def evaluate(self, node: ast.expr) -> Value:
        """The value of an expression."""
        visit = getattr(self, f"_of_{type(node).__name__}", None)
        if visit is None:
            raise self.source.error(node, f"{type(node).__name__} is not translated")
        try:
            return visit(node)
        except NOT_TRANSLATED as error:
            raise self.source.error(node, str(error) or "it is not translated") from error

    @contextmanager
    def captured(self) -> Iterator[list[CLine]]:
        """Collect what is to run before, in a block of its own."""
        outer, self.lines = self.lines, []
        self.depth += 1
        try:
            yield self.lines
        finally:
            self.lines = outer
            self.depth -= 1

    def add(self, text: str, defines: str = "", effect: str = "", returned: Any = None) -> None:
        """Add a statement."""
        self.lines.append(CLine(text, defines, effect, returned, self.depth))

    def fresh(self, wanted: str) -> str:
        """A name that no variable has."""
        name, number = wanted, 1
        while name in self.taken:
            number += 1
            name = f"{wanted}_{number}"
        self.taken.add(name)
        return name

    def temporary(self, value: Expression, wanted: str, effect: str = "") -> Expression:
        """Give a value a variable of its own."""
        name = self.fresh(wanted)
        self.add(f"{constant(value.type, name)} = {value.text};", name, effect)
        return Expression(name, value.type, ATOM, "kept" if isinstance(value.type, CPointer) else "local")

    def in_order(self, nodes: Sequence[ast.expr]) -> list[Value]:
        """Values of expressions, each as it is before the next ones change anything."""
        values: list[Value] = []
        for node in nodes:
            before, lines = len(self.lines), self.lines
            value = self.evaluate(node)
            if any(line.effect for line in lines[before:]):
                self.lines = []
                values = [self._kept(one) for one in values]
                lines[before:before] = self.lines
                self.lines = lines
            values.append(value)
        return values

    def _kept(self, value: Value) -> Value:
        """A number that was read from an array, in a variable."""
        if isinstance(value, Expression) and "[" in value.text and isinstance(value.type, CNumber):
            return self.temporary(value, "before")
        return value

    def atomic(self, value: Value, wanted: str) -> Value:
        """A number that may stand in several places."""
        if isinstance(value, Expression) and not value.text.isidentifier():
            return self.temporary(value, wanted)
        return value

    def _of_Constant(self, node: ast.Constant) -> Value:
        return Known(node.value)

    def _of_Name(self, node: ast.Name) -> Value:
        if node.id in self.values:
            return self.values[node.id]
        name = node.id.partition("@")[0]
        if self.source.scopes.assignments.get(node.id):
            raise self.source.error(node, f"{name} has no value there")
        try:
            value = self.source.outside(node.id)
        except KeyError:
            raise self.source.error(node, f"{name} means nothing") from None
        return self._named(node.id, value)

    def _named(self, name: str, value: Any) -> Value:
        """A value from outside the function; a number by its name."""
        if number_type(value) in (WHOLE, DOUBLE):
            number = python_number(value)
            return Known(number, self.unit.constant(name, number, self.source.module))
        return Known(value)

    def _of_Tuple(self, node: ast.Tuple) -> Value:
        return Several(tuple(self.joined(node.elts)))

    def joined(self, nodes: Sequence[ast.expr]) -> list[Value]:
        """Values of expressions, those with a star item by item."""
        items: list[Value] = []
        values = self.in_order([node.value if isinstance(node, ast.Starred) else node for node in nodes])
        for node, value in zip(nodes, values, strict=True):
            items += self.items_of(value, node) if isinstance(node, ast.Starred) else [value]
        return items

    def items_of(self, value: Value, node: ast.AST) -> list[Value]:
        """The items of a tuple or the fields of a record."""
        kind = value.type
        if isinstance(value, Several):
            return list(value.items)
        if isinstance(value, Known) and isinstance(value.value, (tuple, list, range)):
            return [Known(item) for item in value.value]
        if isinstance(value, Expression) and isinstance(kind, CTuple):
            if not value.text.isidentifier():
                value = self.temporary(value, "values")
            return [self.item(value, place) for place in range(len(kind.items))]
        if isinstance(value, Expression) and isinstance(value.type, (CRecord, CPointer)):
            return [self.field(value, name) for name in record_of(value.type).fields]
        raise self.source.error(node, "it is no tuple of a known length")

    def item(self, value: Expression, place: int) -> Value:
        """An item of a tuple that a function has returned."""
        assert isinstance(value.type, CTuple)
        kind = value.type.items[place]
        if isinstance(kind, CKnown):
            return Known(kind.value)
        stored = [i for i, item in enumerate(value.type.items) if takes_place(item)]
        return Expression(f"{value.text}.v{stored.index(place)}", kind, ATOM, value.place)

    def _of_Attribute(self, node: ast.Attribute) -> Value:
        value = self.evaluate(node.value)
        if isinstance(value, Known):
            found = getattr(value.value, node.attr)
            if isinstance(value.value, type(ast)):
                return self._named(node.attr, found)
            return Known(found)
        if isinstance(value, Expression) and isinstance(value.type, CArray) and node.attr == "shape":
            return Several(tuple(self.length(value, axis) for axis in range(len(value.type.shape))))
        if isinstance(value, Expression) and isinstance(value.type, (CRecord, CPointer)):
            return self.field(value, node.attr)
        raise self.source.error(node, f"no field {node.attr}")

    def field(self, value: Expression, name: str) -> Value:
        """A field of a record."""
        record = record_of(value.type)
        if name not in record.fields:
            raise UnknownOperationError(f"{record.name} has no field {name} in C")
        kind = record.fields[name]
        if isinstance(kind, CKnown):
            return Known(kind.value)
        arrow = "->" if isinstance(value.type, CPointer) else "."
        place = "kept" if isinstance(value.type, CPointer) else value.place
        return Expression(
            f"{value.text}{arrow}{name}", kind, ATOM, "kept" if isinstance(kind, CPointer) else place
        )

    def length(self, array: Expression, axis: int) -> Value:
        """Length of an array along an axis."""
        assert isinstance(array.type, CArray)
        known = array.type.shape[axis]
        if known is not None:
            return Known(known)
        if array.type.is_pointer:
            raise UnknownOperationError("the length of a part of an array is not known")
        return Expression(f"{array.text}.shape[{axis}]", WHOLE)

    def _of_BinOp(self, node: ast.BinOp) -> Value:
        left, right = self.in_order([node.left, node.right])
        if isinstance(node.op, ast.Add) and isinstance(left, Several):
            return Several((*left.items, *self.items_of(right, node)))
        return operators.binary(node.op, left, right)

    def _of_UnaryOp(self, node: ast.UnaryOp) -> Value:
        return operators.unary(node.op, self.evaluate(node.operand))

    def _of_Compare(self, node: ast.Compare) -> Value:
        left, *others = self.in_order([node.left, *node.comparators])
        whole: Value = Known(True)
        for kind, right in zip(node.ops, others, strict=True):
            if right is not others[-1]:
                right = self.atomic(right, "compared")
            whole = operators.both(whole, operators.compared(kind, left, right))
            left = right
        return whole

    def _of_BoolOp(self, node: ast.BoolOp) -> Value:
        is_and = isinstance(node.op, ast.And)
        whole = self.evaluate(node.values[0])
        for other in node.values[1:]:
            if isinstance(whole, Known):
                if bool(whole.value) is not is_and:
                    return whole
                whole = self.evaluate(other)
                continue
            with self.captured() as before:
                value = self.evaluate(other)
            if before:  # what the second takes must not run where the first decides
                name = self.fresh("holds")
                self.add(f"int {name} = {condition(whole)};", name)
                self.add(f"if ({name if is_and else f'!{name}'}) {{")
                self.lines += before
                self.lines.append(CLine(f"{name} = {condition(value)};", name, depth=self.depth + 1))
                self.add("}")
                whole = Expression(name, TRUTH)
            else:
                whole = (operators.both if is_and else operators.either)(whole, value)
        return whole

    def _of_IfExp(self, node: ast.IfExp) -> Value:
        test = self.evaluate(node.test)
        if isinstance(test, Known):
            return self.evaluate(node.body if test.value else node.orelse)
        with self.captured() as before_body:
            body = self.evaluate(node.body)
        with self.captured() as before_other:
            other = self.evaluate(node.orelse)
        if isinstance(body, Known) and isinstance(other, Known) and body.type == other.type:
            return body
        if not before_body and not before_other:
            return operators.chosen(test, body, other)
        kind = operators.chosen(test, body, other).type
        assert isinstance(kind, CNumber)
        name = self.fresh("either")
        self.add(f"{kind.name} {name};", name)
        for opening, before, value in (
            (f"if ({condition(test)}) {{", before_body, body),
            ("} else {", before_other, other),
        ):
            self.add(opening)
            self.lines += before
            self.lines.append(CLine(f"{name} = {text_of(value, wanted=kind)};", name, depth=self.depth + 1))
        self.add("}")
        return Expression(name, kind)

    def range_of(self, arguments: list[Value], node: ast.AST) -> Value:
        """What `range` gives."""
        start, stop = (Known(0), arguments[0]) if len(arguments) == 1 else arguments[:2]
        step = arguments[2] if len(arguments) > 2 else Known(1)
        if not isinstance(step, Known) or not step.value:
            raise self.source.error(node, "the step of a range is not known")
        return Counting(start, stop, int(step.value))


def record_of(kind: CType) -> CRecord:
    """The struct of a record or of what points at one."""
    assert isinstance(kind, (CRecord, CPointer))
    return kind.record if isinstance(kind, CPointer) else kind


def constant(kind: CType, name: str) -> str:
    """The declaration of a variable that is assigned once."""
    text = declared(kind, name)
    if isinstance(kind, CArray) and kind.is_pointer:
        return text.replace(f"*{name}", f"*const {name}")
    if isinstance(kind, CPointer):
        return text.replace(f"*{name}", f"*const {name}")
    return f"const {text}"
