"""Results of pure functions kept for arguments that come again within one preparation of a case."""

import functools
from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np

F = TypeVar("F", bound=Callable[..., Any])


class _Call:
    """Arguments of a call, equal to others of the same content; TypeError where they have none to compare."""

    def __init__(self, arguments: tuple[Any, ...]) -> None:
        self.arguments = arguments
        self._content = _content(arguments)
        self._hash = hash(self._content)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Call) and self._content == other._content


def _content(value: Any) -> Any:
    """The bytes of an array in place of it, in tuples too."""
    if isinstance(value, np.ndarray):
        if value.dtype.hasobject:
            raise TypeError("an array of objects has no content to compare")
        return np.ndarray, value.shape, value.dtype.str, value.tobytes()
    return (type(value), *map(_content, value)) if isinstance(value, tuple) else value


def remembered(most: int) -> Callable[[F], F]:
    """Keep the last `most` results of a pure function of names, numbers, arrays of them, and tuples of these.

    JAX tracers have no content to compare: with one of them inside the arguments the function is called
    every time. Nobody may change a result.
    """

    def keeping(function: F) -> F:
        cached = functools.lru_cache(maxsize=most)(lambda call: function(*call.arguments))

        @functools.wraps(function)
        def call(*arguments: Any) -> Any:
            try:
                wanted = _Call(arguments)
            except TypeError:
                return function(*arguments)
            return cached(wanted)

        return cast(F, call)

    return keeping
