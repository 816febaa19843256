"""Settings of libraries that are not taken: files in the current folder, and variables.

numba, matplotlib and ezdxf read a file of the folder in which they are imported, numba again at every
compilation. Such a file may come with somebody's scenarios: code for another processor, results of other
bits, a text that is none. A process of the program imports the library from another folder if such a file is
there; it also drops the variables by which results, pictures or files would differ. In a user's own process,
as a notebook, numba alone is kept from its file, since results come from it; all else is the user's.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

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
