"""Functions that a scenario gives: by points, monotone and C¹ between them, or by a formula as text."""

import ast
import operator
from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import is_jax, namespace
from tribodyn.numerics.shapes import Array, Float

Table = tuple[NDArray[np.float64], NDArray[np.float64]]
"""(abscissae, strictly increasing; ordinates), both in SI units."""


def monotone_slopes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Slopes at the points of the cubic Hermite curve that is monotone where the data are.

    F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300.
    """
    from scipy.interpolate import PchipInterpolator

    return PchipInterpolator(x, y)(x, 1)


def interpolate(x: np.ndarray, y: np.ndarray, at: Float[Array, "..."]) -> Float[Array, "..."]:
    """Value of the curve through (x, y) at `at`, which must lie inside and may be traced."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    xp = namespace(at)
    cell = xp.clip(xp.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    points, values, rates = xp.asarray(x), xp.asarray(y), xp.asarray(monotone_slopes(x, y))
    step = points[cell + 1] - points[cell]
    u = (at - points[cell]) / step
    start, end = values[cell], values[cell + 1]
    rise = end - start
    begin, finish = rates[cell] * step, rates[cell + 1] * step
    return start + u * (begin + u * (3 * rise - 2 * begin - finish + u * (begin + finish - 2 * rise)))


def check_cover(x: np.ndarray, first: Any, last: Any, key: str) -> None:
    """Refuse a table over roll angle that does not reach from the first to the last contact.

    Traced limits are not checked. Half a microradian is allowed, so that limits printed to six digits serve.
    Raises InputError with the range that is needed.
    """
    if is_jax(first) or is_jax(last):
        return
    if x[0] > first + 5e-7 or x[-1] < last - 5e-7:
        raise InputError(
            key,
            f"{x[0]:.6g} … {x[-1]:.6g} rad",
            f"the table does not cover the contact, from {first:.6g} to {last:.6g} rad of pinion rotation",
            "add points up to both ends (roll angle is counted from the pitch point)",
        )


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
#: Functions of one number.
_OF_ONE: dict[str, Callable[[Any], Any]] = {
    name: getattr(np, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "abs", "floor")
}
#: Functions of two numbers that several are put into one after the other.
_OF_SEVERAL: dict[str, Callable[[Any, Any], Any]] = {"max": np.maximum, "min": np.minimum}
FUNCTIONS = (*_OF_ONE, *_OF_SEVERAL)
#: Characters and nesting of a formula, at most.
LONGEST = 500


class FormulaError(ValueError):
    """A text is no formula of the variables."""


def evaluated(text: str, variables: Mapping[str, Any]) -> Any:
    """Value of a formula of numbers or arrays.

    Raises FormulaError for what is not arithmetic, for unknown names, functions of another number of
    arguments, and where the value is not a finite real number.
    """
    if len(text) > LONGEST:
        raise FormulaError(f"longer than {LONGEST} characters")
    try:
        tree = ast.parse(text, mode="eval")
        with np.errstate(all="ignore"):
            # NumPy's numbers: the root of a negative one is then none, and not complex
            names = {name: np.asarray(value, dtype=float) for name, value in variables.items()}
            value = _value(tree.body, {"pi": np.float64(np.pi), **names})
    except (SyntaxError, RecursionError, MemoryError, TypeError, ValueError, ArithmeticError) as error:
        if isinstance(error, FormulaError):
            raise
        raise FormulaError("not a formula that can be evaluated") from None
    if not np.all(np.isfinite(value)):
        raise FormulaError("not finite everywhere")
    return value


def _value(node: ast.expr, variables: Mapping[str, Any]) -> Any:
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return np.float64(node.value)
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
        numbers = [_value(part, variables) for part in node.args]
        if node.func.id in _OF_SEVERAL:
            if len(numbers) < 2:
                raise FormulaError(f'"{node.func.id}" takes two numbers or more')
            return reduce(_OF_SEVERAL[node.func.id], numbers)
        if len(numbers) != 1:
            raise FormulaError(f'"{node.func.id}" takes one number')
        return _OF_ONE[node.func.id](numbers[0])
    raise FormulaError("only numbers, variables, + - * / ** % and functions")
