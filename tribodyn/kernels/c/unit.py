"""One C file in the making: its structs, functions, tables of numbers and named constants."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import FunctionType
from typing import Any

import numpy as np

from tribodyn.kernels.c.types import DOUBLE, WHOLE, CTuple, CType, Structs, number_type
from tribodyn.kernels.c.values import UnknownOperationError, literal

#: Names that are C's own, or of its headers.
RESERVED: frozenset[str] = frozenset(
    """
    auto break case char const continue default do double else enum extern float for goto if inline
    int long register restrict return short signed sizeof static struct switch typedef union
    unsigned void volatile while acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh
    erf erfc exp exp2 expm1 fabs fdim floor fma fmax fmin fmod frexp hypot ilogb ldexp lgamma llrint
    llround log log10 log1p log2 logb lrint lround modf nan nearbyint nextafter pow remainder remquo
    rint round scalbln scalbn sin sinh sqrt tan tanh tgamma trunc isnan isinf isfinite isnormal
    signbit fpclassify memcpy memset memmove memcmp strlen y0 y1 yn j0 j1 jn gamma index main asm
    typeof bool true false
    """.split()
)
#: Macros of headers, which no constant may be named as.
_MACROS = frozenset("HUGE_VAL INFINITY NAN DOMAIN SING OVERFLOW UNDERFLOW PLOSS TLOSS HUGE NULL".split())


@dataclass(eq=False)
class CFunction:
    """A function in C, for arguments of certain types."""

    name: str
    parameters: list[tuple[str, CType]]  # those that its body reads
    passed: list[int]  # which of the arguments these are
    result: CType | None  # None: nothing
    writes: bool  # whether it changes arrays
    about: str
    lines: list[str]  # of its body
    exported: bool = False


class Tables:
    """Arrays of numbers that are known, equal ones once."""

    def __init__(self, taken: Callable[[str], str]):
        self.arrays: dict[str, np.ndarray] = {}
        self._names: dict[Any, str] = {}
        self._taken = taken

    def name_of(self, numbers: np.ndarray, wanted: str) -> str:
        """The name of an array."""
        numbers = np.ascontiguousarray(numbers, dtype=float if numbers.dtype.kind == "f" else np.int64)
        key = numbers.dtype.str, numbers.shape, numbers.tobytes()
        if key not in self._names:
            name = self._taken(f"table_{wanted.strip('_')}")
            self._names[key] = name
            self.arrays[name] = numbers
        return self._names[key]


class Unit:
    """All that a C file consists of."""

    def __init__(self, translate: Callable[["Unit", FunctionType, tuple[CType, ...], str], CFunction]):
        self.structs = Structs()
        self.functions: dict[Any, CFunction] = {}
        self.constants: dict[str, Any] = {}
        self.tuples: dict[str, CTuple] = {}
        self.owners: dict[str, FunctionType] = {}  # whose functions have a name first
        self._names: set[str] = set(RESERVED)
        self.tables = Tables(self.unique)
        self._translate = translate
        self._at_work: list[Any] = []

    def unique(self, *wanted: str) -> str:
        """The first of some names that is free, or the last with a number."""
        for name in wanted:
            if name not in self._names:
                self._names.add(name)
                return name
        number = 2
        while f"{wanted[-1]}_{number}" in self._names:
            number += 1
        self._names.add(f"{wanted[-1]}_{number}")
        return f"{wanted[-1]}_{number}"

    def constant(self, name: str, value: Any, module: str) -> str:
        """The name of a number that has one in capitals; "" where its text serves.

        With the module's before it where it is private, or stands for another number elsewhere.
        """
        if not name.isupper() or len(name) < 3 or value != value or value < 0 or value >= 1e300:
            return ""
        whole = f"{module.upper()}_{name.lstrip('_')}"
        for wanted in (whole,) if name.startswith("_") or name in _MACROS else (name, whole):
            known = self.constants.setdefault(wanted, value)
            if type(known) is type(value) and known == value:
                return wanted
        return ""

    def function(self, function: FunctionType, kinds: tuple[CType, ...]) -> CFunction:
        """The C function for arguments of such types."""
        key = function, kinds
        if key not in self.functions:
            if key in self._at_work:
                raise UnknownOperationError(f"{function.__qualname__} calls itself")
            self._at_work.append(key)
            try:
                self.functions[key] = self._translate(self, function, kinds, "")
            finally:
                self._at_work.pop()
        return self.functions[key]

    def entry(self, name: str, function: FunctionType, kinds: tuple[CType, ...]) -> CFunction:
        """A function that others call by a name of its own."""
        made = self._translate(self, function, kinds, name)
        self.functions[name, function] = made
        return made


def definitions(constants: Mapping[str, Any]) -> Iterator[str]:
    """Lines that name numbers."""
    whole = {name: value for name, value in constants.items() if number_type(value) == WHOLE}
    if whole:
        yield "enum {"
        yield from (f"    {name} = {literal(value)}," for name, value in whole.items())
        yield "};\n"
    for name, value in constants.items():
        if name not in whole:
            yield f"#define {name} {literal(value, DOUBLE)}"
    yield ""
