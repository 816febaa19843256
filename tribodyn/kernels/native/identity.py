"""What distinguishes one function among a kernel's arguments from another, in this process and in the next.

A function that is handed to a kernel is compiled into it, with all that it calls and with the numbers that
it takes from its module and from around it. Of functions it is the bytecode that counts, wherever they are
defined: in a file, in a cell of a notebook or inside another function. The machine code may be kept only if
all that it depends on is functions, modules in files, numbers and texts.
"""

import hashlib
from collections.abc import Callable, Iterator
from functools import cache
from itertools import count
from pathlib import Path
from types import CellType, CodeType, FunctionType, ModuleType
from typing import Any, NamedTuple

from tribodyn.numerics import elementary
from tribodyn.numerics.sources import code_of

_serial = count()


class FunctionLayout(NamedTuple):
    """Layout of a function among a kernel's arguments: no words, but the code depends on it."""

    function: Callable[..., Any]
    #: name, and a digest of the function and of all that it refers to; of a function whose code may not be
    #: kept, a number that is this process's own
    identity: str
    kept: bool  # whether machine code that contains the function may be kept on disk
    words: int = 0

    def __repr__(self) -> str:
        return self.identity


@cache
def function_layout(function: Callable[..., Any]) -> FunctionLayout:
    """Return the layout of a function."""
    name = f"{function.__module__}.{function.__qualname__}"
    digest = hashlib.sha256()
    try:
        for part in _parts(function):
            digest.update(len(part).to_bytes(8, "little") + part)
    except _UnknownError:
        return FunctionLayout(function, f"{name}@{next(_serial)}", False)
    return FunctionLayout(function, f"{name}#{digest.hexdigest()[:16]}", True)


class _UnknownError(Exception):
    """A function depends on something that is not told apart by its content."""


def _parts(function: Callable[..., Any]) -> Iterator[bytes]:
    """Go through all that the machine code of a function depends on, as bytes."""
    seen: list[Any] = []
    waiting: list[Any] = [function]
    while waiting:
        one = waiting.pop()
        if one is None or isinstance(one, (bool, int, float, complex, str, bytes)):
            yield repr(one).encode()
            continue
        if isinstance(one, tuple):
            yield f"tuple of {len(one)}".encode()
            waiting += one
            continue
        if any(one is other for other in seen):
            yield f"again {[one is other for other in seen].index(True)}".encode()
            continue
        seen.append(one)
        if getattr(one, "__module__", "") == elementary.__name__:
            yield str(getattr(one, "__name__", "")).encode()  # compiled code has versions of its own
        elif isinstance(one, FunctionType):
            yield f"{one.__module__}.{one.__qualname__}".encode()
            yield from _content(one.__code__, one.__doc__)
            waiting += [one.__defaults__, *(one.__kwdefaults__ or {}).items()]
            waiting += [_inside(cell) for cell in one.__closure__ or ()]
            names = sorted(_names(one.__code__))
            known = [(name, one.__globals__[name]) for name in names if name in one.__globals__]
            modules = [other for _, other in known if isinstance(other, ModuleType)]
            waiting += known
            waiting += [(name, getattr(of, name)) for of in modules for name in names if hasattr(of, name)]
        elif isinstance(one, ModuleType):
            if getattr(one, "__file__", None):  # `math` and others of the interpreter have none
                yield _source(str(one.__file__))
        elif isinstance(one, type):
            yield repr((one.__module__, one.__qualname__, getattr(one, "_fields", ()))).encode()
        elif hasattr(one, "py_func"):  # compiled by numba's own decorator
            waiting.append(one.py_func)
        elif callable(one):
            yield repr((type(one).__qualname__, getattr(one, "__name__", ""))).encode()
        else:
            raise _UnknownError


def _inside(cell: CellType) -> Any:
    """What a variable around a function holds."""
    try:
        return cell.cell_contents
    except ValueError:  # not yet anything
        raise _UnknownError from None


def _content(code: CodeType, docstring: str | None = None) -> Iterator[bytes]:
    """What code does, without the place where it is written and what it says of itself."""
    inner = [one for one in code.co_consts if isinstance(one, CodeType)]
    constants = [one for one in code.co_consts if not isinstance(one, CodeType) and one is not docstring]
    yield repr((code.co_argcount, code.co_kwonlyargcount, code.co_flags, constants)).encode()
    yield repr((code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars)).encode()
    yield code.co_code + code.co_exceptiontable
    for one in inner:
        yield from _content(one)


def _names(code: CodeType) -> set[str]:
    """Names that code refers to, inner functions included."""
    inner = (_names(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    return set(code.co_names).union(*inner)


@cache
def _source(file: str) -> bytes:
    """Digest of a source file."""
    try:
        return hashlib.sha256(code_of(Path(file).read_bytes())).digest()
    except OSError:
        raise _UnknownError from None
