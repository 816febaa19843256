"""One thread for the linear algebra of many small systems.

NumPy and SciPy each bring a BLAS that by default takes all cores for matrices from about 64 × 64 on. For
systems of 100 … 500 unknowns, one after the other, its threads wait for each other far longer than they work,
by a factor of ten and more where the cores are busy. Only the number of threads inside a call is changed, and
what the program around had set is there again when the last call has ended.
"""

import ctypes
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path
from typing import NamedTuple

#: Modules that are linked with the BLAS of their package, and the folder in which wheels for Windows keep it.
_LINKED = (("numpy.linalg._umath_linalg", "numpy.libs"), ("scipy.linalg._fblas", "scipy.libs"))
#: Names of the functions that tell and set the number of threads; the first that a library has are taken.
_NAMES = (
    *(
        (f"{prefix}openblas_get_num_threads{suffix}", f"{prefix}openblas_set_num_threads{suffix}")
        for prefix, suffix in product(("scipy_", ""), ("64_", "", "_64"))
    ),
    ("MKL_Get_Max_Threads", "MKL_Set_Num_Threads"),
    ("bli_thread_get_num_threads", "bli_thread_set_num_threads"),
)


class _Library(NamedTuple):
    """How many threads a BLAS takes, and what changes that."""

    threads: Callable[[], int]
    set_threads: Callable[[int], None]


_lock = threading.Lock()
_known: dict[str, _Library | None] = {}
_inside = 0
_before: dict[str, int] = {}
if hasattr(os, "register_at_fork"):  # a child must not wait for a thread that it does not have
    os.register_at_fork(before=_lock.acquire, after_in_parent=_lock.release, after_in_child=_lock.release)


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let BLAS take one thread inside the block; also a decorator. Blocks may nest, in several threads, too.

    While any thread is inside, all of the process have one. A BLAS that cannot be told, such as Apple's
    Accelerate, stays as it is.
    """
    global _inside
    with _lock:
        _inside += 1
        for module, folder in _LINKED:
            library = _library(module, folder)
            if library and module not in _before and (threads := library.threads()) > 1:
                _before[module] = threads
                library.set_threads(1)
    try:
        yield
    finally:
        with _lock:
            _inside -= 1
            if not _inside:
                for module, threads in _before.items():
                    if library := _known[module]:
                        library.set_threads(threads)
                _before.clear()


def _library(module: str, folder: str) -> _Library | None:
    """The BLAS of a module's package; None where the module is not imported, or its BLAS not known."""
    if module in _known:
        return _known[module]
    file = getattr(sys.modules.get(module), "__file__", None)
    if file is None:
        return None
    # on Linux and macOS a module finds what it is linked with; on Windows the library must be named
    wheel = Path(file).parents[2] / folder
    _known[module] = next(
        (library for place in (file, *wheel.glob("*.dll")) if (library := _opened(str(place)))), None
    )
    return _known[module]


def _opened(file: str) -> _Library | None:
    try:
        library = ctypes.CDLL(file)
    except OSError:
        return None
    for getter, setter in _NAMES:
        if hasattr(library, getter) and hasattr(library, setter):
            threads, set_threads = getattr(library, getter), getattr(library, setter)
            threads.argtypes, threads.restype = (), ctypes.c_int
            set_threads.argtypes, set_threads.restype = (ctypes.c_int,), None
            return _Library(threads, set_threads)
    return None
