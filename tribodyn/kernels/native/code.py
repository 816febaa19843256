"""What is compiled and what comes of it: a function, its machine code as kept on disk, the code in memory."""

from collections.abc import Callable
from typing import Any, NamedTuple


class KernelFunction:
    """A function for numba; compiled into every kernel that calls it.

    Parameters
    ----------
    function : at module level; of positional arguments
    """

    def __init__(self, function: Callable[..., Any]):
        self.function = function


class Compiled(NamedTuple):
    """A kernel's machine code as it is kept."""

    symbol: str  # name of the entry, see `Code`
    #: returns, single: as for `Code`
    returns: str
    single: bool
    needs: list[str]  # names that the code does not define
    body: bytes  # the object file


class Code(NamedTuple):
    """Machine code in memory."""

    address: int  # of a C function `int32 entry(arguments, results)` on blocks of words, see `arguments`
    returns: str  # a letter of the struct module for every number that it returns; empty: it returns None
    single: bool  # whether it returns a number and not a tuple
