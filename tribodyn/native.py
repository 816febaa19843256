"""numba's versions of the elementary functions, registration of the laws, and where compiled code is kept.

Importing this module is what makes the laws callable from `@njit` functions. Modules that hold kernels
import `kernel` from here and nothing else of numba.
"""

import hashlib
import math
import os
import sys
from importlib import import_module
from pathlib import Path

import numba
import numba.core.config
import numpy as np
from numba.core import types
from numba.extending import overload, register_jitable

import tribodyn
from tribodyn import elementary
from tribodyn.dynamics import equations  # noqa: F401  (the import of both registers every law)
from tribodyn.solve import dormand_prince, rosenbrock  # noqa: F401

#: Everything that a kernel can contain; the rules of import keep it to these.
_KERNEL_SOURCES = ("elementary.py", "native.py", "mesh_cycle.py", "tribology", "dynamics", "solve", "lanes")


def _source_digest() -> str:
    """Digest of the kernels' sources and numba's version: numba's own check sees one file only."""
    digest = hashlib.sha256(numba.__version__.encode())
    for name in _KERNEL_SOURCES:
        place = Path(tribodyn.__file__).parent / name
        for file in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def _cache_folder() -> Path:
    if given := os.environ.get("TRIBODYN_CACHE"):
        return Path(given)
    from platformdirs import user_cache_path

    return user_cache_path("tribodyn")


def _load_numba_without_blas() -> None:
    """Import what numba looks for BLAS with while SciPy's seems absent: no kernel of ours uses it.

    It would import all of `scipy.linalg`, a tenth of a short run's time. In a process of the command line
    only, which no one else's kernels share.
    """
    if tribodyn.OWN_PROCESS and "scipy.linalg" not in sys.modules:
        sys.modules["scipy.linalg"] = None  # pyright: ignore[reportArgumentType]
        try:
            import_module("numba.np.arraymath")
        finally:
            del sys.modules["scipy.linalg"]


_load_numba_without_blas()
_CACHE = _cache_folder() / f"kernels-{_source_digest()}"
numba.core.config.CACHE_DIR = str(_CACHE)  # pyright: ignore[reportAttributeAccessIssue]

#: Decorator of a compiled kernel: cached between processes, IEEE division, no reordering. Without numba's
#: reference counts, which would cost a quarter of the right-hand side: so a kernel is handed its buffers.
#: Without Python's lock, so that batches run on all cores.
kernel = numba.njit(  # pyright: ignore[reportCallIssue]
    cache=True, error_model="numpy", nogil=True, no_cfunc_wrapper=True, _nrt=False
)

#: Decorator of a part of kernels, compiled into each that calls it.
part = register_jitable


def _unary(function, implementation):
    @overload(function)
    def _(x):
        return implementation if isinstance(x, types.Number) else None


_unary(elementary.sqrt, lambda x: math.sqrt(x))
_unary(elementary.exp, lambda x: math.exp(x))
_unary(elementary.log, lambda x: math.log(x))
_unary(elementary.sin, lambda x: math.sin(x))
_unary(elementary.cos, lambda x: math.cos(x))
_unary(elementary.tan, lambda x: math.tan(x))
_unary(elementary.absolute, lambda x: abs(x))
_unary(elementary.truncate, lambda x: int(x))


@overload(elementary.log1p)
def _log1p(x):
    def implementation(x):
        """log(1 + x) with the rounding of the sum put right: half the time of the C library's."""
        shifted = 1.0 + x
        return math.log(shifted) + (x - (shifted - 1.0)) / shifted

    return implementation if isinstance(x, types.Number) else None


@overload(elementary.expm1)
def _expm1(x):
    def implementation(x):
        """exp(x) − 1: Taylor's series to x¹³ where the difference would cancel, exact to rounding."""
        if abs(x) > 0.35:
            return math.exp(x) - 1.0
        square = x * x
        low = 1.0 + x / 2.0 + square * (1.0 / 6.0 + x / 24.0)
        middle = 1.0 / 120.0 + x / 720.0 + square * (1.0 / 5040.0 + x / 40320.0)
        high = 1.0 / 362880.0 + x / 3628800.0 + square * (1.0 / 39916800.0 + x / 479001600.0)
        high = high + square * square / 6227020800.0
        fourth = square * square
        return x * (low + fourth * (middle + fourth * high))

    return implementation if isinstance(x, types.Number) else None


@overload(elementary.skippable)
def _skippable(condition):
    return (lambda condition: condition) if isinstance(condition, types.Boolean) else None


@overload(elementary.arctan2)
def _arctan2(y, x):
    return lambda y, x: math.atan2(y, x)


@overload(elementary.where)
def _where(condition, a, b):
    return (lambda condition, a, b: a if condition else b) if isinstance(condition, types.Boolean) else None


@overload(elementary.minimum)
def _minimum(a, b):
    both = isinstance(a, types.Number) and isinstance(b, types.Number)
    return (lambda a, b: b if b < a or b != b else a) if both else None


@overload(elementary.maximum)
def _maximum(a, b):
    both = isinstance(a, types.Number) and isinstance(b, types.Number)
    return (lambda a, b: b if b > a or b != b else a) if both else None


@overload(elementary.last_at_or_below)
def _last_at_or_below(grid, x):
    def implementation(grid, x):
        index = np.searchsorted(grid, x, side="right") - 1
        return min(max(index, 0), grid.shape[0] - 2)

    return implementation if isinstance(grid, types.Array) else None


@overload(elementary.last_axis_of_four)
def _last_axis_of_four(table, a, b, c, d):
    def implementation(table, a, b, c, d):
        return table[a, b, c, d, 0], table[a, b, c, d, 1], table[a, b, c, d, 2], table[a, b, c, d, 3]

    return implementation if isinstance(table, types.Array) else None


for _law in elementary.LAWS:
    register_jitable(forceinline=True, no_cfunc_wrapper=True)(_law)
