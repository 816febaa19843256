"""Which internals of numba the kernels are made with, and whether the numba installed here has them.

`numba.extending` and the functions of numba's own documentation are not listed: they are numba's interface.
What is listed may change in any version of numba, so that `pyproject.toml` bounds the version from above.
Where something is missing, kernels are compiled by `plain`, and batches run case by case.
"""

import inspect
import os
import sys
import warnings
from functools import cache
from importlib import import_module
from typing import Any, NamedTuple

import tribodyn
from tribodyn.errors import InputError

TYPE_NAMES = (
    "Array",
    "BaseTuple",
    "Boolean",
    "CPointer",
    "Dispatcher",
    "Float",
    "Integer",
    "Number",
    "SliceType",
    "Tuple",
    "Type",
    "UniTuple",
    "boolean",
    "float64",
    "int64",
    "none",
    "unliteral",
)


class Internal(NamedTuple):
    """A name of numba that is not part of its interface.

    Attributes
    ----------
    module, name : str
    parameters : tuple of str
        Of a function or class: those that it is called with.
    members : tuple of str
        Of a module, class or object: attributes and methods that are used or overridden; one that a class's
        objects get when they are made is looked for in the code of its methods.
    """

    module: str
    name: str
    parameters: tuple[str, ...] = ()
    members: tuple[str, ...] = ()


_COMPILER = ("typingctx", "targetctx", "library", "args", "return_type", "flags", "locals")
INTERNALS = (
    Internal("numba.core", "types", members=TYPE_NAMES),
    Internal(
        "numba.core",
        "cgutils",
        members=("create_struct_proxy", "get_or_insert_function", "pack_array", "unpack_tuple"),
    ),
    Internal(
        "numba.core.codegen",
        "JITCodeLibrary",
        ("codegen", "name"),
        (
            "_codegen",
            "_final_module",
            "_finalize_final_module",
            "_finalized",
            "_get_module_for_linking",
            "_linking_libraries",
            "_shared_module",
            "add_ir_module",
            "codegen",
            "finalize",
            "get_pointer_to_function",
        ),
    ),
    Internal("numba.core.codegen", "JITCPUCodegen", members=("_tm",)),
    Internal("numba.core.compiler", "Compiler", _COMPILER),
    Internal(
        "numba.core.compiler",
        "Flags",
        members=("error_model", "fastmath", "no_compile", "no_cpython_wrapper", "no_cfunc_wrapper", "nrt"),
    ),
    Internal(
        "numba.core.compiler",
        "compile_extra",
        ("typingctx", "targetctx", "func", "args", "return_type", "flags", "locals", "library"),
    ),
    Internal("numba.core.compiler_lock", "global_compiler_lock", members=("__call__",)),
    Internal("numba.core.cpu_options", "FastMathOptions", ("value",)),
    Internal("numba.core.registry", "cpu_target", members=("target_context", "typing_context")),
    Internal("numba.core.typeconv.castgraph", "Conversion", members=("promote", "safe")),
    Internal("numba.core.typing.templates", "AbstractTemplate", members=("apply",)),
    Internal("numba.core.typing.templates", "AttributeTemplate", members=("resolve",)),
    Internal("numba.core.typing.templates", "ConcreteTemplate"),
    Internal("numba.core.typing.templates", "infer_getattr"),
    Internal("numba.core.typing.templates", "infer_global", ("val",)),
    Internal("numba.core.typing.templates", "signature", ("return_type",)),
    Internal(
        "numba.np.arrayobj", "populate_array", ("array", "data", "shape", "strides", "itemsize", "meminfo")
    ),
)


@cache
def missing() -> tuple[str, ...]:
    """What this numba lacks of the internals, in words; empty where all are there. Imports numba.

    Raises
    ------
    InputError
        Where a variable of the environment keeps numba from compiling.
    """
    _refuse_settings()
    lacking: list[str] = []
    for internal in INTERNALS:
        name = f"{internal.module}.{internal.name}"
        try:
            module = import_module(internal.module)
            there = getattr(module, internal.name)
        except (ImportError, AttributeError):
            lacking.append(name)
            continue
        if internal.parameters and not set(internal.parameters) <= _parameters(there):
            lacking.append(f"{name} with the parameters {', '.join(internal.parameters)}")
        lacking += [f"{name}.{member}" for member in internal.members if not _has(there, member)]
    return tuple(lacking)


def _refuse_settings() -> None:
    """Import numba as the environment sets it, and refuse what nothing can be compiled with."""
    try:
        _load_numba_without_blas()
        numba = import_module("numba")
    except ValueError as error:
        name = "NUMBA_NUM_THREADS"
        if name not in os.environ:
            raise
        remedy = "unset it, or set it to 1 or more"
        raise InputError(name, os.environ[name], "numba cannot be imported with it", remedy) from error
    if numba.config.DISABLE_JIT:
        rule = "switches off the compiler by which kernels are made"
        raise InputError("NUMBA_DISABLE_JIT", os.environ.get("NUMBA_DISABLE_JIT"), rule, "unset it")


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


def _parameters(callable_: Any) -> set[str]:
    try:
        return set(inspect.signature(callable_).parameters)
    except (TypeError, ValueError):
        return set()


def _has(thing: Any, member: str) -> bool:
    """Whether a thing has a member, or the methods of a class set or read it."""
    if hasattr(thing, member):
        return True
    codes = (
        getattr(value, "__code__", None)
        for base in getattr(thing, "__mro__", ())
        for value in vars(base).values()
    )
    return any(member in code.co_names for code in codes if code is not None)


@cache
def report_missing() -> bool:
    """Whether an internal is missing; says once in a process that there is one and what follows from it."""
    lacking = missing()
    if lacking:
        import numba

        warnings.warn(
            f"numba {numba.__version__} lacks {', '.join(lacking)}: kernels are compiled without it, anew in "
            "every process, and batches run case by case; for the usual speed install a numba within the "
            "bounds of tribodyn's pyproject.toml",
            RuntimeWarning,
            stacklevel=2,
        )
    return bool(lacking)
