"""Kernels: functions that are called from Python as machine code."""

import ctypes
import functools
import inspect
import struct
import threading
from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.kernels.native.arguments import together

_ENTRY = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p)


class Code(NamedTuple):
    """Machine code in memory.

    Attributes
    ----------
    address : int
        Of a C function `int32 entry(arguments, results)` on blocks of words, see `arguments`.
    returns : str
        A letter of the struct module for every number that it returns; empty: it returns None.
    single : bool
        Whether it returns a number and not a tuple.
    """

    address: int
    returns: str
    single: bool


class Kernel:
    """A function for numba that Python calls as machine code; other kernels and laws call it as it stands.

    Compiled at the first call with arguments of a given layout, once in an installation; threads may call it
    at once, and run side by side. Arrays are changed in place.

    Parameters
    ----------
    function : callable
        At module level; of positional arguments.
    """

    def __init__(self, function: Callable[..., Any]):
        functools.update_wrapper(self, function)
        self.function = function
        self._name = function.__name__
        self._names = tuple(inspect.signature(function).parameters)
        self._codes: dict[Any, Callable[[bytes], Any]] = {}
        self._compiling = threading.Lock()

    def __call__(self, *arguments: Any) -> Any:
        """Call the kernel; the results are floats and integers, or None."""
        layout, words = together(self._name, self._names, arguments)
        code = self._codes.get(layout)
        if code is None:
            with self._compiling:
                code = self._codes.get(layout)
                if code is None:
                    from tribodyn.kernels.native.store import machine_code

                    code = self._codes[layout] = caller(machine_code(self.function, layout))
        return code(words)


def kernel(function: Callable[..., Any]) -> Kernel:
    """Make a kernel of a function, see `Kernel`: the decorator."""
    return Kernel(function)


def caller(code: Code) -> Callable[[bytes], Any]:
    """Return a function of a block of arguments that runs the code and returns its results."""
    entry = _ENTRY(code.address)
    read = struct.Struct(f"={code.returns}")

    def call(words: bytes) -> Any:
        results = ctypes.create_string_buffer(read.size)
        if entry(words, results):
            raise RuntimeError("a kernel raised an exception")
        found = read.unpack(results.raw)
        return (found[0] if code.single else found) if found else None

    return call
