"""What kernels are and how their arguments lie in memory: a single block of words of 8 bytes.

A number is a word; an array its address and lengths; a named tuple its fields in order, and a tuple the
address of its items, which are alike; a function and a fixed number no word at all. The
layout says which of these a value is, and the machine code of a kernel depends on nothing else: functions,
fixed numbers and indices are compiled in, other numbers, lengths and how many items there are never.

A function that is handed to a kernel is compiled into it, with all that it calls and with the numbers that
it takes from its module and from around it. Of functions it is the bytecode that counts, wherever they are
defined: in a file, in a cell of a notebook or inside another function. The machine code may be kept only if
all that it depends on is functions, modules in files, numbers and texts.
"""

import ctypes
import hashlib
import struct
import sys
from collections.abc import Callable, Iterator
from functools import cache
from itertools import count
from pathlib import Path
from types import CellType, CodeType, FunctionType, ModuleType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics import elementary
from tribodyn.numerics.elementary import Indices, RuntimeIndices, StaticInt
from tribodyn.numerics.files.sources import code_of

_serial = count()


class FunctionLayout(NamedTuple):
    """Layout of a function among a kernel's arguments: no words, but the code depends on it."""

    function: Callable[..., Any]
    #: a digest of what the function does and of all that it refers to, whatever its name; of a function whose
    #: code may not be kept, a number that is this process's own
    identity: str
    kept: bool  # whether machine code that contains the function may be kept on disk
    words: int = 0

    def __repr__(self) -> str:
        return self.identity


@cache
def function_layout(function: Callable[..., Any]) -> FunctionLayout:
    """Return the layout of a function."""
    digest = hashlib.sha256()
    try:
        for part in _parts(function):
            digest.update(len(part).to_bytes(8, "little") + part)
    except _UnknownError:
        return FunctionLayout(function, f"@{next(_serial)}", False)
    return FunctionLayout(function, f"#{digest.hexdigest()}", True)


class _UnknownError(Exception):
    """A function depends on something that is not told apart by its content."""


def _parts(function: Callable[..., Any]) -> Iterator[bytes]:
    """Go through all that the machine code of a function depends on, as bytes."""
    seen: list[Any] = []
    waiting: list[Any] = [function]
    while waiting:
        value = waiting.pop()
        if value is None or isinstance(value, (bool, int, float, complex, str, bytes)):
            yield repr(value).encode()
            continue
        if isinstance(value, tuple):
            yield f"tuple of {len(value)}".encode()
            waiting += value
            continue
        if any(value is other for other in seen):
            yield f"again {[value is other for other in seen].index(True)}".encode()
            continue
        seen.append(value)
        if getattr(value, "__module__", "") == elementary.__name__:
            yield str(getattr(value, "__name__", "")).encode()  # compiled code has versions of its own
        elif isinstance(value, FunctionType):
            # indices count otherwise in functions of this package, see `compiler`
            yield repr((value.__module__ or "").partition(".")[0] == "tribodyn").encode()
            yield from _content(value.__code__, value.__doc__)
            waiting += [value.__defaults__, *(value.__kwdefaults__ or {}).items()]
            waiting += [_inside(cell) for cell in value.__closure__ or ()]
            names = sorted(_names(value.__code__))
            referenced = [(name, value.__globals__[name]) for name in names if name in value.__globals__]
            modules = [other for _, other in referenced if isinstance(other, ModuleType)]
            waiting += referenced
            waiting += [(name, getattr(of, name)) for of in modules for name in names if hasattr(of, name)]
        elif isinstance(value, ModuleType):
            if getattr(value, "__file__", None):  # `math` and others of the interpreter have none
                yield _source(str(value.__file__))
        elif isinstance(value, type):
            yield repr((value.__module__, value.__qualname__, getattr(value, "_fields", ()))).encode()
        elif hasattr(value, "py_func"):  # compiled by numba's own decorator
            waiting.append(value.py_func)
        elif callable(value) and _is_named(value):
            yield repr((type(value).__qualname__, getattr(value, "__name__", ""))).encode()
        else:
            raise _UnknownError


def _is_named(value: Any) -> bool:
    """Whether a callable object has no data of its own, or is what its module has under its name."""
    if type(value).__module__.partition(".")[0] in ("builtins", "numba", "tribodyn") or isinstance(
        value, np.ufunc
    ):
        return True
    module = sys.modules.get(str(getattr(value, "__module__", "")))
    return getattr(module, str(getattr(value, "__name__", "")), None) is value


def _inside(cell: CellType) -> Any:
    """What a variable around a function holds."""
    try:
        return cell.cell_contents
    except ValueError:  # not yet anything
        raise _UnknownError from None


def _content(code: CodeType, docstring: str | None = None) -> Iterator[bytes]:
    """What code does, without the place where it is written and what it says of itself."""
    inner = [item for item in code.co_consts if isinstance(item, CodeType)]
    constants = [item for item in code.co_consts if not isinstance(item, CodeType) and item is not docstring]
    yield repr((code.co_argcount, code.co_kwonlyargcount, code.co_flags, constants)).encode()
    yield repr((code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars)).encode()
    yield code.co_code + code.co_exceptiontable
    for constant in inner:
        yield from _content(constant)


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


#: The compiler's options that change code, with what numba takes where nothing says otherwise.
OPTIONS = {"OPT": "3", "LOOP_VECTORIZE": "1", "SLP_VECTORIZE": "0"}


class Target(NamedTuple):
    """What machine code is compiled for, and how."""

    processor: str  # as LLVM names it
    features: str  # what the processor has, as LLVM writes it: "+fma,-avx512f"
    options: str  # values of `OPTIONS`, in order

    def fits(self, other: "Target") -> bool:
        """Whether it needs nothing that another target lacks, and is compiled alike."""
        return (self.processor, self.options) == (other.processor, other.options) and (
            _present(self.features) <= _present(other.features)
        )


def _present(features: str) -> set[str]:
    return {feature for feature in features.split(",") if feature.startswith("+")}


class Compiled(NamedTuple):
    """A kernel's machine code as it is kept."""

    symbol: str  # name of the entry, see `Code`
    #: returns, single: as for `Code`
    returns: str
    single: bool
    needs: list[str]  # names that the code does not define
    target: "Target"  # what it was compiled for
    body: bytes  # the object file


class Code(NamedTuple):
    """Machine code in memory."""

    address: int  # of a C function `int32 entry(arguments, results)` on blocks of words, see `arguments`
    returns: str  # a letter of the struct module for every number that it returns; empty: it returns None
    single: bool  # whether it returns a number and not a tuple


class Numeric(NamedTuple):
    """A number: "float", "int" or "bool"; or "indices" that are read at run time, by their address."""

    name: str


class Array(NamedTuple):
    """An array: type of its elements, number of axes, and whether it is contiguous ("C") or not ("A")."""

    dtype: str
    ndim: int
    order: str

    @property
    def words(self) -> int:
        """Words that it takes: address, lengths, and strides where they do not follow from the lengths."""
        return 1 + self.ndim * (1 if self.order == "C" else 2)


class FixedLayout(NamedTuple):
    """Layout of a number that is compiled in."""

    value: int
    words: int = 0


class IndicesLayout(NamedTuple):
    """Layout of whole numbers by place that are compiled in."""

    values: tuple[int, ...]
    words: int = 0


class SeveralLayout(NamedTuple):
    """Layout of a tuple of items of one layout, any number of them, where a word points at."""

    item: Any
    words: int = 1


class RecordLayout:
    """A named tuple: its name, and the layout of every field. One object for all that are equal.

    Get one from `record`.
    """

    def __init__(self, name: str, fields: tuple[tuple[str, Any], ...]):
        self.name = name
        self.fields = fields

    def __repr__(self) -> str:
        return f"{self.name}({', '.join(f'{name}={layout!r}' for name, layout in self.fields)})"


class PackedValue(NamedTuple):
    """A value as the kernels read it; stands for it among a kernel's arguments.

    What many calls have in common is packed once. Arrays inside are pointed at: the value keeps them alive.
    """

    #: Numeric, Array, RecordLayout, FunctionLayout, or what an object makes of itself by `as_argument`
    layout: Any
    words: bytes
    value: Any = None  # what was packed


FLOAT, INT, BOOL, INDICES = map(Numeric, ("float", "int", "bool", "indices"))
_float, _int = struct.Struct("=d").pack, struct.Struct("=q").pack
_array = cache(Array)


@cache
def record(name: str, names: tuple[str, ...], layouts: tuple[Any, ...]) -> RecordLayout:
    """The layout of a named tuple."""
    return RecordLayout(name, tuple(zip(names, layouts, strict=True)))


def packed(value: Any) -> PackedValue:
    """Pack a value as kernels read it; TypeError for what they do not take, an error of the program."""
    if isinstance(value, PackedValue):
        return value
    if isinstance(value, float):
        return PackedValue(FLOAT, _float(value), value)
    if isinstance(value, np.ndarray):
        return _packed_array(value)
    if isinstance(value, StaticInt):
        return PackedValue(FixedLayout(int(value)), b"", value)
    if isinstance(value, Indices):
        return PackedValue(IndicesLayout(tuple(value)), b"", value)
    if isinstance(value, RuntimeIndices):
        table = np.array(value, dtype=np.int64)
        return PackedValue(INDICES, _int(table.ctypes.data), table)
    if isinstance(value, (bool, np.bool_)):
        return PackedValue(BOOL, _int(bool(value)), value)
    if isinstance(value, (int, np.integer)):
        return PackedValue(INT, _int(value), value)
    if isinstance(value, FunctionType):
        return PackedValue(function_layout(value), b"", value)
    if hasattr(value, "as_argument"):
        return value.as_argument()
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return together(type(value).__qualname__, value._fields, value)  # pyright: ignore[reportAttributeAccessIssue]
    if isinstance(value, tuple):
        items = [packed(item) for item in value]
        (layout,) = {item.layout for item in items}  # a kernel takes items that are alike
        words = b"".join(item.words for item in items)
        block = ctypes.create_string_buffer(words, len(words))
        return PackedValue(SeveralLayout(layout), _int(ctypes.addressof(block)), (items, block))
    raise TypeError(
        f"a kernel takes numbers, arrays, functions and tuples of them, not {type(value).__name__}"
    )


def _packed_array(array: np.ndarray) -> PackedValue:
    if array.ndim == 0:
        return packed(array.item())
    contiguous = array.flags.c_contiguous
    numbers = (array.ctypes.data, *array.shape)
    if not contiguous:
        numbers += array.strides
    layout = _array(array.dtype.str, array.ndim, "C" if contiguous else "A")
    return PackedValue(layout, struct.pack(f"={len(numbers)}q", *numbers), array)


def together(name: str, names: tuple[str, ...], values: tuple[Any, ...]) -> PackedValue:
    """Pack several values as the fields of one record."""
    items = [packed(value) for value in values]
    layouts = tuple(item.layout for item in items)
    return PackedValue(record(name, names, layouts), b"".join(item.words for item in items), items)


def functions_in(layout: Any) -> Iterator[FunctionLayout]:
    """Go through the functions that a layout holds."""
    if isinstance(layout, FunctionLayout):
        yield layout
    elif isinstance(layout, SeveralLayout):
        yield from functions_in(layout.item)
    elif isinstance(layout, RecordLayout):
        for _, field in layout.fields:
            yield from functions_in(field)


def is_kept(layout: Any) -> bool:
    """Whether machine code for a layout may be kept on disk: no function in it is this process's own."""
    return all(function.kept for function in functions_in(layout))
