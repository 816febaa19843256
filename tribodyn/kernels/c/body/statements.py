"""Python statements to C: assignments, choices, loops, returns."""

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from tribodyn.kernels.c.body import operators
from tribodyn.kernels.c.body.calls import Calls
from tribodyn.kernels.c.body.expressions import NOT_TRANSLATED, constant
from tribodyn.kernels.c.lines import CLine, names_in
from tribodyn.kernels.c.sources import PythonSource
from tribodyn.kernels.c.types import (
    DOUBLE,
    CArray,
    CNumber,
    CPointer,
    CRecord,
    CTuple,
    CType,
    common,
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
    Value,
    bounds_of,
    condition,
    number_of,
    plain,
    text_of,
)


class AgainError(Exception):
    """A variable is of a more general type than its first value: the function is translated again."""


@dataclass(eq=False)
class OpenBlock:
    """A block of C that is being written."""

    numbers: set[int]  # of the blocks of Python in it
    lines: list[CLine]
    depth: int
    variables: list[str]
    names: set[str]  # of its variables in C


class Statements(Calls):
    """Translates the statements of one function."""

    def __init__(self, source: PythonSource, unit: Unit, general: dict[str, CType], renamed: set[str]):
        super().__init__(source, unit)
        self.general, self.renamed = general, renamed
        self.scopes = source.scopes
        self.blocks: list[OpenBlock] = []
        self.variables: dict[str, Expression] = {}  # that are declared in C
        self.steady: set[str] = set()  # names in C of those that are assigned once
        self.returned: list[Value] = []

    def named(self, name: str) -> str:
        """The name of a variable in C."""
        name = name.partition("@")[0]
        return f"{name}_" if name in self.renamed else name

    @contextmanager
    def block(self, body: list[ast.stmt]) -> Iterator[list[CLine]]:
        """A block of its own; its variables end with it."""
        outer = self.lines
        self.depth += 1
        self.lines = []
        self.blocks.append(OpenBlock({id(body)}, self.lines, self.depth, [], set()))
        yield self.lines
        for name in self.blocks.pop().variables:
            del self.variables[name]
        self.lines = outer
        self.depth -= 1

    def run(self, body: list[ast.stmt]) -> bool:
        """Translate statements; whether what follows them is never reached."""
        for statement in body:
            visit = getattr(self, f"_do_{type(statement).__name__}", None)
            if visit is None:
                raise self.source.error(statement, f"{type(statement).__name__} is not translated")
            try:
                ends = visit(statement)
            except NOT_TRANSLATED as error:
                raise self.source.error(statement, str(error) or "it is not translated") from error
            if ends:
                return True
        return False

    def _inline(self, body: list[ast.stmt]) -> bool:
        self.blocks[-1].numbers.add(id(body))
        return self.run(body)

    def _rooted(self, node: ast.expr) -> Value:
        """The value of all that is assigned or returned, or stands alone."""
        self.whole, self.effect = node, ""
        value = self.evaluate(node)
        self.whole = None
        return value

    def _do_Pass(self, node: ast.Pass) -> None:
        pass

    def _do_Break(self, node: ast.Break) -> bool:
        self.add("break;")
        return True

    def _do_Continue(self, node: ast.Continue) -> bool:
        self.add("continue;")
        return True

    def _do_Expr(self, node: ast.Expr) -> None:
        self._rooted(node.value)
        if self.effect:
            self.add(self.effect)

    def _do_Return(self, node: ast.Return) -> bool:
        value: Value = Known(None) if node.value is None else self._rooted(node.value)
        if isinstance(value, Expression) and isinstance(value.type, CTuple) and self.returned:
            value = Several(tuple(self.items_of(value, node)))
        self.returned.append(value)
        self.add("return", returned=value)
        return True

    def _do_Assign(self, node: ast.Assign) -> None:
        value = self._rooted(node.value)
        if len(node.targets) > 1:
            raise self.source.error(node, "several variables are assigned at once")
        self.assign(node.targets[0], value)

    def _do_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.assign(node.target, self._rooted(node.value))

    def _do_AugAssign(self, node: ast.AugAssign) -> None:
        target = ast.Name(node.target.id, ast.Load()) if isinstance(node.target, ast.Name) else node.target
        before = self.evaluate(target)
        value = self._rooted(node.value)
        changed = operators.binary(node.op, before, value)
        is_known = isinstance(before, Known)
        symbols = operators.SYMBOLS | {ast.Div: ("/", ATOM)}
        if is_known or type(node.op) not in symbols or number_of(changed) != number_of(before):
            self.assign(node.target, changed)
            return
        assert isinstance(before, Expression)
        if not isinstance(node.target, ast.Name):
            self._written(node.target)
        text = f"{before.text} {symbols[type(node.op)][0]}= {text_of(value, wanted=number_of(before))};"
        self.add(text, before.text if isinstance(node.target, ast.Name) else "", self.effect)

    def assign(self, target: ast.expr, value: Value) -> None:
        """Assign a value to a variable, an element or several of them."""
        if isinstance(target, ast.Name):
            self.assign_name(target.id, value, target)
        elif isinstance(target, ast.Subscript):
            element = self.evaluate(target)
            if not isinstance(element, Expression) or not isinstance(element.type, CNumber):
                raise self.source.error(target, "only elements of arrays are assigned")
            self._written(target)
            self.add(f"{element.text} = {text_of(value, wanted=element.type)};")
        elif isinstance(target, (ast.Tuple, ast.List)):
            self._assign_several(target.elts, value, target)
        else:
            raise self.source.error(target, "it cannot be assigned")

    def _written(self, target: ast.expr) -> None:
        assert isinstance(target, ast.Subscript)
        array = self.evaluate(target.value)
        if not (isinstance(array, Expression) and isinstance(array.type, CArray) and array.type.written):
            raise self.source.error(target, "an array inside a record is changed")
        self.writes = True

    def _assign_several(self, targets: list[ast.expr], value: Value, node: ast.expr) -> None:
        if isinstance(value, Expression) and isinstance(value.type, CTuple) and not value.text.isidentifier():
            value = self.temporary(value, f"of_{value.text.partition('(')[0]}", self.effect)
            self.effect = ""
        items = self.items_of(value, node)
        if len(items) != len(targets):
            raise self.source.error(node, f"{len(items)} values for {len(targets)} variables")
        changed: set[str] = set()
        for target, item in zip(targets, items, strict=True):
            if isinstance(item, Expression) and changed & names_in(item.text):
                items = [
                    self.temporary(one, "moved") if isinstance(one, Expression) and number_of(one) else one
                    for one in items
                ]
                break
            base = target
            while isinstance(base, ast.Subscript):
                base = base.value
            if isinstance(base, ast.Name):
                changed.add(self.named(base.id))
        for target, item in zip(targets, items, strict=True):
            if not (isinstance(target, ast.Name) and target.id == "_"):
                self.assign(target, item)

    def assign_name(self, name: str, value: Value, node: ast.AST) -> None:
        """Assign a value to a variable."""
        once = self.scopes.assignments.get(name, 1) == 1
        if isinstance(value, Several):
            items = [
                self.temporary(item, name) if isinstance(item, Expression) and number_of(item) else item
                for item in value.items
            ]
            value = Several(tuple(items))
        if isinstance(value, (Several, Counting)) or (
            isinstance(value, Known) and (once or number_type(value.value) is None)
        ):
            if not once and not isinstance(value, Known):
                raise self.source.error(node, f"{name} is assigned a tuple, and more than once")
            self.values[name] = value
            return
        text, kind = (
            (plain(value).text, plain(value).type) if isinstance(value, Known) else (value.text, value.type)
        )
        if isinstance(kind, CRecord) and isinstance(value, Expression) and value.place == "kept":
            text, kind = f"&{text}", CPointer(kind)
        if not takes_place(kind):
            self.values[name] = value
            return
        effect, self.effect = self.effect, ""
        if name in self.variables:
            self._assign_again(name, text, kind, value, effect, node)
            return
        kind = self.general.get(name, kind)
        c_name = self.named(name)
        if any(c_name in block.names for block in self.blocks):
            c_name = self.fresh(c_name)
        self.taken.add(c_name)
        place = "kept" if isinstance(kind, CPointer) else "local"
        bounds = bounds_of(value) if once else None
        variable = Expression(c_name, kind, ATOM, place, bounds)
        if isinstance(kind, CNumber):
            text = text_of(value, wanted=kind)
        home = next(block for block in reversed(self.blocks) if self.scopes.home[name] in block.numbers)
        home.variables.append(name)
        home.names.add(c_name)
        if home is self.blocks[-1] and self.lines is home.lines:
            (self.steady.add if once else self.steady.discard)(c_name)
            declaration = constant(kind, c_name) if once else declared(kind, c_name)
            self.add(f"{declaration} = {text};", c_name, effect)
        else:
            nothing = "{0}" if isinstance(kind, (CRecord, CTuple)) else "0.0" if kind == DOUBLE else "0"
            home.lines.append(CLine(f"{declared(kind, c_name)} = {nothing};", c_name, depth=home.depth))
            self.add(f"{c_name} = {text};", c_name, effect)
        self.variables[name] = self.values[name] = variable

    def _assign_again(
        self, name: str, text: str, kind: CType, value: Value, effect: str, node: ast.AST
    ) -> None:
        variable = self.variables[name]
        joined = common([variable.type, kind])
        if joined is None:
            raise self.source.error(node, f"{name} is assigned values of several types")
        if joined != variable.type:
            if name in self.source.parameters.parameters:
                raise self.source.error(node, f"{name} is handed over as another type than is assigned to it")
            self.general[name] = joined
            raise AgainError
        if isinstance(joined, CNumber):
            text = text_of(value, wanted=joined)
        elif isinstance(joined, CRecord) and isinstance(kind, CPointer):
            text = f"*{text}"
        self.values[name] = variable
        self.add(f"{variable.text} = {text};", variable.text, effect)

    def _do_If(self, node: ast.If) -> bool:
        test = self.evaluate(node.test)
        if isinstance(test, Known):
            return self._inline(node.body if test.value else node.orelse)
        opening = f"if ({condition(test)}) {{"
        with self.block(node.body) as body:
            body_ends = self.run(node.body)
        with self.block(node.orelse) as other:
            other_ends = self.run(node.orelse)
        self.add(opening)
        self.lines += body
        if other and _is_one_choice(other):
            other[0].text = f"}} else {other[0].text}"
            for line in other:
                line.depth -= 1
            self.lines += other
            return body_ends and other_ends
        if other:
            self.add("} else {")
            self.lines += other
        self.add("}")
        return body_ends and other_ends


def _is_one_choice(lines: list[CLine]) -> bool:
    """Whether lines are an `if` with what belongs to it, and nothing else."""
    outer = [line.text for line in lines if line.depth == lines[0].depth]
    return outer[0].startswith("if (") and outer.index("}") == len(outer) - 1 if "}" in outer else False
