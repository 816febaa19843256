"""Compare every array that a function takes or returns with the shape in its signature.

``python -m tests.support.shape_checks MODULE`` imports a module of the tests, with the package's modules
instrumented by jaxtyping's import hook, and calls its `main`. Only array types are looked at, also inside of
tuples, unions and the NamedTuples that go in and out; the static checker sees to all others. Whoever compiles
functions with numba cannot have them wrapped: `elementary` is left out.
"""

import functools
import importlib
import inspect
import os
import runpy
import sys
import types
import typing
from collections.abc import Callable
from typing import Any

CHECKED = (
    "tribodyn.numerics.iteration",
    "tribodyn.geometry",
    "tribodyn.compliance",
    "tribodyn.mesh",
    "tribodyn.drawing",
    "tribodyn.solve.branch.continuation",
    "tribodyn.solve.branch.requests",
    "tribodyn.solve.orbit.motions",
    "tribodyn.solve.orbit.search",
    "tribodyn.solve.orbit.shooting",
)


def arrays_only(function: Callable[..., Any]) -> Callable[..., Any]:
    """A run-time type checker, as jaxtyping takes them, that knows arrays only."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def checked(*arguments: Any, **named: Any) -> Any:
        bound = signature.bind(*arguments, **named)
        for name, value in bound.arguments.items():
            _require(value, signature.parameters[name].annotation, name)
        result = function(*arguments, **named)
        _require(result, signature.return_annotation, "the result")
        return result

    return checked


def _require(value: Any, annotation: Any, what: str) -> None:
    from jaxtyping import AbstractArray, jaxtyped

    origin, parts = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is tuple and isinstance(value, tuple) and len(parts) == len(value):
        for number, (item, part) in enumerate(zip(value, parts, strict=True)):
            _require(item, part, f"{what}[{number}]")
    elif origin is list:
        for number, item in enumerate(value):
            _require(item, parts[0], f"{what}[{number}]")
    elif origin in (typing.Union, types.UnionType):
        classes = tuple(part for part in parts if isinstance(part, type))
        arrays = [part for part in classes if issubclass(part, AbstractArray)]
        if arrays and not isinstance(value, classes):
            raise TypeError(f"{what} is {_shown(value)}, not {annotation}")
    elif isinstance(annotation, type) and issubclass(annotation, AbstractArray):
        if not isinstance(value, annotation):
            raise TypeError(f"{what} is {_shown(value)}, not {annotation}")
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        with jaxtyped("context"):
            for name, part in _fields(type(value)).items():
                _require(getattr(value, name), part, f"{what}.{name}")


@functools.cache
def _fields(kind: type) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def _shown(value: Any) -> str:
    return f"{type(value).__name__} {getattr(value, 'dtype', '')} {getattr(value, 'shape', '')}"


def install() -> None:
    """Instrument the package's modules; before any of them is imported."""
    os.environ["TRIBODYN_CHECK_SHAPES"] = "1"
    from jaxtyping import install_import_hook

    install_import_hook(CHECKED, "tests.support.shape_checks.arrays_only")


if __name__ == "__main__":
    # by its own name too: the hook makes instrumented modules look the checker up there
    importlib.import_module("tests.support.shape_checks").install()
    runpy.run_module(sys.argv[1], run_name="__main__")
