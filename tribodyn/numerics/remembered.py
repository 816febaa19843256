"""Results of pure functions kept for arguments that come again within one preparation of a case."""

import functools
from collections.abc import Callable
from typing import Any, TypeVar, cast

F = TypeVar("F", bound=Callable[..., Any])


def remembered(function: F) -> F:
    """Keep the last results of a pure function of plain numbers, names and tuples of them.

    Arguments with arrays or JAX tracers inside have no hash: with those it is called every time. Nobody may
    change a result.
    """
    known = functools.lru_cache(maxsize=16)(function)

    @functools.wraps(function)
    def call(*arguments: Any) -> Any:
        try:
            hash(arguments)
        except TypeError:
            return function(*arguments)
        return known(*arguments)

    return cast(F, call)
