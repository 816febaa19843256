"""Kernels as C, compiled and called from Python."""

import ctypes
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tribodyn.kernels.c import CEntry, translated

#: Strict, without a warning, and every operation rounded by itself.
STRICT = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", "-fPIC", "-shared")


def c_compiler() -> list[str]:
    """The machine's C compiler; skips the test where there is none."""
    found = shutil.which("cc")
    if found is None:
        pytest.skip("no C compiler `cc`")
    return [found]


def zig_compiler() -> list[str]:
    """The C compiler that is a Python package."""
    if find_spec("ziglang") is None:
        pytest.skip("no ziglang")
    return [sys.executable, "-m", "ziglang", "cc"]


def compiled(
    source: str, folder: Path, compiler: Sequence[str] | None = None, options: Sequence[str] = ("-O2",)
) -> ctypes.CDLL:
    """A library of C code."""
    text, library = folder / "kernels.c", folder / "kernels.so"
    text.write_text(source, encoding="utf-8")
    command = [*(compiler or c_compiler()), *STRICT, *options, "-o", str(library), str(text), "-lm"]
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr[:4000]
    assert not outcome.stderr, outcome.stderr[:4000]
    return ctypes.CDLL(str(library))


def address(library: ctypes.CDLL, name: str) -> ctypes.c_void_p:
    """Address of a constant of a library."""
    return ctypes.c_void_p(ctypes.addressof(ctypes.c_char.in_dll(library, name)))


def floats(count: int) -> type[ctypes.Structure]:
    """What a function returns that gives so many floats."""
    fields = [(f"v{i}", ctypes.c_double) for i in range(count)]
    return type("Floats", (ctypes.Structure,), {"_fields_": fields})


def called(function: Any, *arguments: Any, result: Any = None) -> tuple[float, ...]:
    """Call a function of C: floats, whole numbers, arrays, and addresses."""
    made: list[Any] = []
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            made.append(argument.ctypes.data_as(ctypes.c_void_p))
        elif isinstance(argument, float):
            made.append(ctypes.c_double(argument))
        else:
            made.append(argument if isinstance(argument, ctypes.c_void_p) else ctypes.c_int64(argument))
    function.restype = result
    answer = function(*made)
    if isinstance(answer, ctypes.Structure):
        return tuple(getattr(answer, name) for name, *_ in answer._fields_)
    return () if answer is None else (answer,)


def of_numbers(function: Callable[..., Any], *examples: Any) -> str:
    """A function alone as C, by the name `entry`."""
    return translated({"entry": CEntry(function, examples)}, {}).source
