"""Settings of libraries that are not taken, files and variables; one thread for small linear algebra.

numba, matplotlib and ezdxf read a file of the folder in which they are imported, numba again at every
compilation. Such a file may come with somebody's scenarios: code for another processor, results of other
bits, a text that is none. A process of the program imports the library from another folder if such a file is
there; it also drops the variables by which results, pictures or files would differ. In a user's own process,
as a notebook, numba alone is kept from its file, since results come from it; all else is the user's.

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
from contextlib import contextmanager, suppress
from importlib import import_module
from itertools import product
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

#: Library -> file of settings that it reads in the current folder.
FILES = {"numba": ".numba_config.yaml", "matplotlib": "matplotlibrc", "ezdxf": "ezdxf.ini"}
#: Beginnings of variables that the program drops, but for those that say for which machine it computes, and
#: how a cluster of Dask is reached: files of settings of one's own, addresses and certificates.
DROPPED = ("NUMBA_", "MATPLOTLIB", "MPLBACKEND", "EZDXF_", "JAX_", "SOURCE_DATE_EPOCH", "DASK_")
CLUSTER = ("DASK_CONFIG", "DASK_DISTRIBUTED__COMM__")
MACHINE = {"NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "NUMBA_NUM_THREADS", "NUMBA_DISABLE_JIT", "JAX_PLATFORMS"}
#: Flags of XLA that stay for the same reason; it ends the process where it does not know one.
XLA_FLAGS = ("--xla_cpu_max_isa=", "--xla_force_host_platform_device_count=")


def ignore_settings() -> None:
    """Keep a process of the program, at its begin, from settings of libraries."""
    for name in list(os.environ):
        if name.startswith(DROPPED) and not (name in MACHINE or name.startswith(CLUSTER)):
            del os.environ[name]
    if flags := os.environ.get("XLA_FLAGS"):
        os.environ["XLA_FLAGS"] = " ".join(flag for flag in flags.split() if flag.startswith(XLA_FLAGS))
    os.environ["MATPLOTLIBRC"] = os.devnull  # before the user's own
    ignore_files()


def ignore_files() -> None:
    """Import, at a process's begin, the libraries for which there are files in the current folder."""
    for library in FILES:
        if _has_file(library):
            without_file(library)


def without_file(library: str) -> ModuleType:
    """Import a library without its file in the current folder."""
    if library not in sys.modules and _has_file(library):
        with _elsewhere():
            module = import_module(library)
    else:
        module = import_module(library)
    if library == "numba":
        config: Any = import_module("numba.core.config")
        if config._config_fname:  # what it looks for at every compilation
            config._config_fname = ""
            config.reload_config()  # if it has been imported before
    return module


def _has_file(library: str) -> bool:
    with suppress(OSError, ValueError):
        return os.path.lexists(FILES[library])
    return False


@contextmanager
def _elsewhere() -> Iterator[None]:
    """Be in a folder that has no settings: this package's."""
    here = os.getcwd()
    os.chdir(Path(__file__).parent)
    try:
        yield
    finally:
        os.chdir(here)


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
