"""Loops of Python in C: over whole numbers, over the items of a tuple, and as long as something holds."""

import ast

from tribodyn.kernels.c.body import operators
from tribodyn.kernels.c.body.statements import Statements
from tribodyn.kernels.c.lines import CLine
from tribodyn.kernels.c.types import WHOLE
from tribodyn.kernels.c.values import LESS, Counting, Expression, Known, condition, plain, text_of


class Loops(Statements):
    """Translates loops."""

    def _do_For(self, node: ast.For) -> bool:
        if node.orelse:
            raise self.source.error(node, "else of a loop")
        counted = self.evaluate(node.iter)
        if isinstance(counted, Counting):
            return self._counted(node, counted)
        if _leaves(node.body):
            raise self.source.error(node, "a loop over a tuple that is left before its end")
        for item in self.items_of(counted, node):
            with self.block(node.body) as lines:
                self.assign(node.target, item)
                self.run(node.body)
            self.add("{")
            self.lines += lines
            self.add("}")
        return False

    def _counted(self, node: ast.For, counted: Counting) -> bool:
        if not isinstance(node.target, ast.Name):
            raise self.source.error(node, "a loop over numbers has one variable")
        name, scoped = node.target.id, id(node) in self.scopes.scoped
        start, stop = counted.start, counted.stop
        if isinstance(start, Known) and isinstance(stop, Known):
            turns = range(start.value, stop.value, counted.step)
            if not turns:
                return False
            if len(turns) == 1 and scoped and not _leaves(node.body):
                self.values[name] = Known(turns[0])
                return self._inline(node.body)
        c_name = self.named(name) if scoped else self.fresh(f"{name}_now")
        self.taken.add(c_name)
        end = plain(stop)
        if not isinstance(stop, Known) and end.place != "kept" and end.text not in self.steady:
            end = self.temporary(end, f"{c_name}_end")
        sign = "<" if counted.step > 0 else ">"
        step = f"{c_name}{'++' if counted.step > 0 else '--'}"
        if abs(counted.step) != 1:
            step = f"{c_name} {'+' if counted.step > 0 else '-'}= {abs(counted.step)}"
        opening = (
            f"for (int64_t {c_name} = {plain(start).text}; {c_name} {sign} {text_of(end, LESS)}; {step}) {{"
        )
        with self.block(node.body) as lines:
            counter = Expression(c_name, WHOLE, bounds=_bounds(counted))
            if scoped:
                self.values[name] = counter
                self.steady.add(c_name)
            else:
                self.effect = ""
                self.assign_name(name, counter, node)
            self.run(node.body)
        self.add(opening)
        self.lines += lines
        self.add("}")
        return False

    def _do_While(self, node: ast.While) -> bool:
        if node.orelse:
            raise self.source.error(node, "else of a loop")
        with self.block(node.body) as lines:
            test = self.evaluate(node.test)
            is_long = bool(lines)
            if is_long and not isinstance(test, Known):
                self.add(f"if ({condition(operators.opposite(test))}) {{")
                self.lines.append(CLine("break;", depth=self.depth + 1))
                self.add("}")
            if not (isinstance(test, Known) and not test.value):
                self.run(node.body)
        if isinstance(test, Known) and not test.value:
            return False
        self.add("while (1) {" if is_long or isinstance(test, Known) else f"while ({condition(test)}) {{")
        self.lines += lines
        self.add("}")
        return isinstance(test, Known) and not _leaves(node.body, (ast.Break,))


def _bounds(counted: Counting) -> tuple[int, int] | None:
    """Least and greatest number of a range."""
    if isinstance(counted.start, Known) and isinstance(counted.stop, Known):
        turns = range(counted.start.value, counted.stop.value, counted.step)
        return min(turns[0], turns[-1]), max(turns[0], turns[-1])
    return None


def _leaves(body: list[ast.stmt], kinds: tuple[type, ...] = (ast.Break, ast.Continue)) -> bool:
    """Whether statements leave the loop that they are in, or its turn."""
    for statement in body:
        if isinstance(statement, kinds):
            return True
        if isinstance(statement, ast.If) and (
            _leaves(statement.body, kinds) or _leaves(statement.orelse, kinds)
        ):
            return True
    return False
