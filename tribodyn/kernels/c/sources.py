"""Python functions as trees, and what their names mean: variables, and what stands around the function."""

import ast
import builtins
import inspect
import textwrap
from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any

from tribodyn.kernels.c.scopes import Scopes
from tribodyn.numerics.elementary import COMPILED


class OutsideSubsetError(Exception):
    """Python that has no counterpart in C; the message names function, file and line."""


class PythonSource:
    """A function's tree and the values of names from outside it."""

    def __init__(self, function: FunctionType):
        self.function = function
        self.name = function.__name__
        try:
            lines, self._first = inspect.getsourcelines(function)
        except (OSError, TypeError):
            self._first = function.__code__.co_firstlineno
            raise self.error(None, "its source is not to be found") from None
        tree = ast.parse(textwrap.dedent("".join(lines))).body[0]
        if not isinstance(tree, ast.FunctionDef):
            raise self.error(None, "it is no function with `def`")
        self.node = tree
        body = tree.body
        says = ast.get_docstring(tree)
        self.body = body[1:] if says is not None else body
        self.about = (says or "").partition("\n")[0]
        self.parameters = inspect.signature(function)
        self.scopes = Scopes(self.body, list(self.parameters.parameters))
        cells = zip(function.__code__.co_freevars, function.__closure__ or (), strict=True)
        self._around = {name: cell.cell_contents for name, cell in cells}

    def error(self, node: ast.AST | None, what: str) -> OutsideSubsetError:
        """Say that something has no counterpart in C."""
        line = self._first + getattr(node, "lineno", 1) - 1
        file = self.function.__code__.co_filename
        return OutsideSubsetError(f"no C code for {self.function.__qualname__} ({file}, line {line}): {what}")

    def outside(self, name: str) -> Any:
        """What a name means that is no variable of the function; KeyError if nothing."""
        for names in (self._around, self.function.__globals__, vars(builtins)):
            if name in names:
                return names[name]
        raise KeyError(name)

    @property
    def module(self) -> str:
        """Last part of the name of its module."""
        return (self.function.__module__ or "").rpartition(".")[2]


@cache
def source_of(function: FunctionType) -> PythonSource:
    """The source of a function."""
    return PythonSource(function)


def implementation(function: Callable[..., Any]) -> Any:
    """What is compiled in place of a function: that of a kernel, or another of the same result."""
    function = getattr(function, "__wrapped__", function)
    return COMPILED.get(function, function)
