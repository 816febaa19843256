"""Calls in Python to C: of functions, of types of named tuples, and of what C has of its own."""

import ast
import inspect
from collections.abc import Callable
from types import FunctionType
from typing import Any, cast

from tribodyn.kernels.c.body.elements import Elements
from tribodyn.kernels.c.body.expressions import record_of
from tribodyn.kernels.c.body.intrinsics import INTRINSICS, PYTHON
from tribodyn.kernels.c.sources import PythonSource, implementation
from tribodyn.kernels.c.types import (
    CArray,
    CKnown,
    CNumber,
    CPointer,
    CRecord,
    CTuple,
    CType,
    number_type,
    takes_place,
    tuple_name,
)
from tribodyn.kernels.c.unit import Unit
from tribodyn.kernels.c.values import ATOM, Counting, Expression, Known, Several, Value, plain, text_of


class Calls(Elements):
    """Translates calls."""

    #: a call that stands alone or is all that is assigned or returned
    whole: ast.expr | None = None
    effect: str = ""  # what that does beside its value, as a statement

    def __init__(self, source: PythonSource, unit: Unit):
        super().__init__(source, unit)
        self.called: set[str] = set()

    def _of_Call(self, node: ast.Call) -> Value:
        if isinstance(node.func, ast.Attribute) and node.func.attr == "_replace":
            value = self.evaluate(node.func.value)
            if isinstance(value, Expression) and isinstance(value.type, (CRecord, CPointer)):
                return self._replaced(value, node)
        callee = self.evaluate(node.func)
        arguments = self.joined(node.args)
        keywords = {str(word.arg): self.evaluate(word.value) for word in node.keywords}
        if not isinstance(callee, Known):
            raise self.source.error(node, "what is called is not known")
        return self.call(callee.value, arguments, keywords, node)

    def call(self, callee: Any, arguments: list[Value], keywords: dict[str, Value], node: ast.Call) -> Value:
        """The result of a call."""
        if callee is range:
            return self.range_of(arguments, node)
        if isinstance(callee, type) and hasattr(callee, "_fields"):
            return self._constructed(cast(Any, callee), arguments, keywords, node)
        intrinsic = INTRINSICS.get(callee) if getattr(callee, "__hash__", None) else None
        if intrinsic is not None:
            return intrinsic(self, *arguments, **keywords)
        if callee in PYTHON:
            known = [argument.value for argument in arguments if isinstance(argument, Known)]
            if len(known) == len(arguments) and not keywords:
                return Known(callee(*known))
        function = implementation(cast(Callable[..., Any], callee))
        if not isinstance(function, FunctionType):
            raise self.source.error(node, f"{getattr(callee, '__name__', callee)} is not translated")
        return self._translated(function, arguments, keywords, node)

    def _translated(
        self, function: FunctionType, arguments: list[Value], keywords: dict[str, Value], node: ast.Call
    ) -> Value:
        bound = inspect.signature(function).bind(*arguments, **keywords)
        if not all(
            isinstance(one, (Known, Expression, Several, Counting)) for one in bound.arguments.values()
        ):
            raise self.source.error(node, f"{function.__name__} takes any number of arguments")
        for name, parameter in inspect.signature(function).parameters.items():
            if name not in bound.arguments:
                bound.arguments[name] = Known(parameter.default)
        ordered = [bound.arguments[name] for name in inspect.signature(function).parameters]
        kinds, texts = zip(*(self.passed(one, node) for one in ordered), strict=True) if ordered else ((), ())
        made = self.unit.function(function, tuple(kinds))
        text = f"{made.name}({', '.join(str(texts[i]) for i in made.passed)})"
        self.writes |= made.writes
        self.called.add(made.name)
        if made.result is None or not takes_place(made.result):
            if made.writes:
                self.add(f"{text};")
            return value_of(made.result)
        result = Expression(text, made.result)
        if made.writes and node is not self.whole:
            return self.temporary(result, f"of_{made.name}", f"{text};")
        self.effect = f"{text};" if made.writes else ""
        return result

    def passed(self, value: Value, node: ast.AST) -> tuple[CType, str | None]:
        """Type and text of a value as an argument; of what takes no place no text."""
        if isinstance(value, Counting):
            raise self.source.error(node, "a range is handed to a function")
        if isinstance(value, Several):
            return self.as_tuple(value, node)
        if isinstance(value, Known):
            kind = number_type(value.value)
            return (kind, text_of(value)) if kind else (CKnown(value.value), None)
        kind = value.type
        if not isinstance(kind, CRecord):
            return kind, value.text if takes_place(kind) else None
        if not takes_place(kind):
            return CPointer(kind), None
        if not value.place:
            value = self.temporary(value, "result")
        return CPointer(kind), f"&{value.text}"

    def as_tuple(self, value: Several, node: ast.AST) -> tuple[CType, str]:
        """A tuple as a struct."""
        kinds, texts = zip(*(self.held(item, node) for item in value.items), strict=True)
        whole = CTuple(tuple(kinds))
        if not takes_place(whole):
            return whole, ""
        self.unit.tuples[tuple_name(whole)] = whole
        return whole, f"({tuple_name(whole)}){{{', '.join(text for text in texts if text is not None)}}}"

    def held(self, value: Value, node: ast.AST) -> tuple[CType, str | None]:
        """Type and text of a value inside a tuple or record, or returned: records that stay by address."""
        if isinstance(value, Expression) and isinstance(value.type, CRecord) and takes_place(value.type):
            if value.place == "kept":
                return CPointer(value.type), f"&{value.text}"
            return value.type, value.text
        if isinstance(value, Expression) and isinstance(value.type, CRecord):
            return value.type, None
        if isinstance(value, Known) and number_type(value.value):
            return CKnown(value.value), None
        return self.passed(value, node)

    def _constructed(
        self, kind: Any, arguments: list[Value], keywords: dict[str, Value], node: ast.AST
    ) -> Expression:
        """A named tuple of values."""
        names = kind._fields
        values: dict[str, Value] = {name: Known(value) for name, value in kind._field_defaults.items()}
        values |= dict(zip(names, arguments, strict=False)) | keywords
        if len(arguments) > len(names) or set(values) != set(names):
            raise self.source.error(node, f"{kind.__name__} has other fields")
        fields, texts = [], []
        for name in names:
            value = values[name]
            field, text = self.held(value, node)
            if text is None and isinstance(value, Known) and number_type(value.value):
                number = plain(value)
                field, text = number.type, number.text
            fields.append((name, field))
            if text is not None:
                texts.append(f".{name} = {text}")
        record = self.unit.structs.record(kind, tuple(fields))
        return Expression(f"({record.name}){{{', '.join(texts)}}}", record, ATOM, "local")

    def _replaced(self, value: Expression, node: ast.Call) -> Expression:
        record = record_of(value.type)
        kind = next(kind for (kind, _), one in self.unit.structs.records.items() if one is record)
        fields: dict[str, Value] = {name: self.field(value, name) for name in record.fields}
        new = {str(word.arg): self.evaluate(word.value) for word in node.keywords}
        return self._constructed(kind, [], fields | new, node)


def value_of(kind: CType | None) -> Value:
    """The value whose type says it all."""
    if kind is None:
        return Known(None)
    if isinstance(kind, CKnown):
        return Known(kind.value)
    if isinstance(kind, CTuple):
        return Several(tuple(value_of(item) for item in kind.items))
    assert not isinstance(kind, (CNumber, CArray))
    return Expression("", kind, ATOM, "kept")
