"""Formulas that a scenario writes as text: arithmetic and a few functions of named variables."""

import ast
import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

_OPERATORS: dict[type, Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.Mod: operator.mod,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "abs", "floor")},
    "max": np.maximum,
    "min": np.minimum,
}
#: Characters and nesting of a formula, at most.
LONGEST = 500


class FormulaError(ValueError):
    """A text is no formula of the variables."""


def evaluated(text: str, variables: Mapping[str, Any]) -> Any:
    """Value of a formula of numbers or arrays.

    Raises FormulaError for what is not arithmetic, for unknown names, and where the value is not finite.
    """
    if len(text) > LONGEST:
        raise FormulaError(f"longer than {LONGEST} characters")
    try:
        tree = ast.parse(text, mode="eval")
        with np.errstate(all="ignore"):
            value = _value(tree.body, {"pi": np.pi, **variables})
    except (SyntaxError, RecursionError, MemoryError, TypeError, ValueError, ArithmeticError) as error:
        if isinstance(error, FormulaError):
            raise
        raise FormulaError("not a formula that can be evaluated") from None
    if not np.all(np.isfinite(value)):
        raise FormulaError("not finite everywhere")
    return value


def _value(node: ast.expr, variables: Mapping[str, Any]) -> Any:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return float(node.value)
    if isinstance(node, ast.Name):
        if node.id not in variables:
            raise FormulaError(f'"{node.id}" is none of {", ".join(variables)}')
        return variables[node.id]
    if isinstance(node, ast.UnaryOp) and type(node.op) in _OPERATORS:
        return _OPERATORS[type(node.op)](_value(node.operand, variables))
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
        return _OPERATORS[type(node.op)](_value(node.left, variables), _value(node.right, variables))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
        if node.func.id not in FUNCTIONS:
            raise FormulaError(f'"{node.func.id}" is none of the functions {", ".join(FUNCTIONS)}')
        return FUNCTIONS[node.func.id](*(_value(part, variables) for part in node.args))
    raise FormulaError("only numbers, variables, + - * / ** % and functions")
