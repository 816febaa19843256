"""What distinguishes one function among a kernel's arguments from another, in this process and in the next.

A function that is handed to a kernel is compiled into it, with all that it calls and with the numbers that
its module holds. The machine code may be kept only if all that is in files.
"""

import hashlib
from collections.abc import Callable, Iterator
from functools import cache
from itertools import count
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any, NamedTuple

from tribodyn.numerics import elementary

_serial = count()


class FunctionLayout(NamedTuple):
    """Layout of a function among a kernel's arguments: no words, but the code depends on it.

    Attributes
    ----------
    function : callable
    identity : str
        Name, and a digest of the sources of the function and of all that it refers to; of a function whose
        code may not be kept, a number that is this process's own.
    kept : bool
        Whether machine code that contains the function may be kept on disk.
    """

    function: Callable[..., Any]
    identity: str
    kept: bool
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
            digest.update(part)
    except _NotInFilesError:
        return FunctionLayout(function, f"{name}@{next(_serial)}", False)
    return FunctionLayout(function, f"{name}#{digest.hexdigest()[:16]}", True)


class _NotInFilesError(Exception):
    """What a function depends on is not in files alone."""


def _parts(function: Callable[..., Any]) -> Iterator[bytes]:
    """Go through all that the machine code of a function depends on, as bytes."""
    seen: list[Any] = []
    waiting: list[Any] = [function]
    while waiting:
        one = waiting.pop()
        if any(one is other for other in seen):
            continue
        seen.append(one)
        if getattr(one, "__module__", "") == elementary.__name__:
            continue  # compiled code has versions of its own
        if isinstance(one, FunctionType):
            if one.__closure__ or one.__defaults__ or one.__kwdefaults__:
                raise _NotInFilesError
            yield f"{one.__module__}.{one.__qualname__}".encode()
            # two functions of one name in one file: lambdas, or one that was defined again
            yield repr((one.__code__.co_firstlineno, list(one.__code__.co_positions()))).encode()
            yield _source(one.__code__.co_filename)
            names = sorted(_names(one.__code__))
            known = [one.__globals__[name] for name in names if name in one.__globals__]
            modules = [other for other in known if isinstance(other, ModuleType)]
            waiting += known
            waiting += [getattr(of, name) for of in modules for name in names if hasattr(of, name)]
        elif isinstance(one, ModuleType):
            if getattr(one, "__file__", None):  # `math` and others of the interpreter have none
                yield _source(str(one.__file__))
        elif isinstance(one, (bool, int, float, str, tuple)):
            yield repr(one).encode()
        elif isinstance(one, type):
            yield repr((one.__module__, one.__qualname__, getattr(one, "_fields", ()))).encode()
        elif not callable(one):
            raise _NotInFilesError


def _names(code: CodeType) -> set[str]:
    """Names that code refers to, inner functions included."""
    inner = (_names(constant) for constant in code.co_consts if isinstance(constant, CodeType))
    return set(code.co_names).union(*inner)


@cache
def _source(file: str) -> bytes:
    """Digest of a source file."""
    try:
        return hashlib.sha256(Path(file).read_bytes()).digest()
    except OSError:
        raise _NotInFilesError from None
