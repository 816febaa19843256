"""Kernels: functions that are called from Python as machine code."""

import ctypes
import functools
import inspect
import struct
import threading
from collections.abc import Callable
from typing import Any

from tribodyn.kernels.native.arguments import Code, together
from tribodyn.numerics.processes.lasting import LastingWork

_ENTRY = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p)


class Kernel:
    """A function for numba that Python calls as machine code; other kernels and laws call it as it stands.

    Compiled at the first call with arguments of a given layout, once in an installation; threads may call it
    at once, and run side by side. Arrays are changed in place. The function is at module level and takes
    positional arguments.
    """

    def __init__(self, function: Callable[..., Any]):
        self.function = function
        functools.update_wrapper(self, function)
        self._name = function.__name__
        self._names = tuple(inspect.signature(function).parameters)
        self._codes: dict[Any, Callable[[bytes], Any]] = {}
        self._compiling = threading.Lock()
        self._machine_codes = LastingWork[Code]()

    @functools.cached_property
    def _numba_type_(self) -> Any:
        """Inside another kernel it is a part as any other."""
        from tribodyn.kernels.native.parts import type_of_part

        return type_of_part(self.function)

    def __call__(self, *arguments: Any) -> Any:
        """Call the kernel; the results are floats and integers, or None."""
        layout, words, _ = together(self._name, self._names, arguments)
        code = self._codes.get(layout)
        if code is None:
            with self._compiling:
                code = self._codes.get(layout)
                if code is None:
                    code = self._codes[layout] = self._executable(layout)
        return code(words)

    def _executable(self, layout: Any) -> Callable[[bytes], Any]:
        """What runs the kernel for arguments of a layout."""
        from tribodyn.kernels.native.store import machine_code

        return caller(self._machine_codes.made(layout, lambda: machine_code(self.function, layout)))


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
        numbers = read.unpack(results.raw)
        return (numbers[0] if code.single else numbers) if numbers else None

    return call
