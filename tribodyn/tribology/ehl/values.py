"""Numbers of a contact that mean something: finite, of the right sign, of a size that floats can hold."""

import math
import numbers
from typing import Any

from tribodyn.errors import InputError, quoted

#: Products of several numbers up to this size, and of their inverses, are still floats.
LARGEST = 1e30


def number(name: str, value: Any) -> float:
    """Return a value as a float; raise InputError if it is none, or not finite."""
    real = isinstance(value, numbers.Real) and not isinstance(value, bool)
    known = float(value) if real else math.nan
    if not math.isfinite(known):
        raise InputError(name, quoted(value), "is not a finite number", "give a number in SI units")
    if abs(known) > LARGEST:
        raise InputError(name, f"{known:g}", f"is beyond {LARGEST:g}", "give a number in SI units")
    return known


def not_negative(name: str, value: Any, unit: str = "", remedy: str = "write 0 or more") -> float:
    """Return a value as a float; raise InputError if it is none, or below zero."""
    known = number(name, value)
    if known < 0.0:
        raise InputError(name, f"{known:g} {unit}".strip(), "must not be negative", remedy)
    return known


def positive(name: str, value: Any, unit: str = "", remedy: str = "give a number above 0") -> float:
    """Return a value as a float; raise InputError if it is none, or not above zero."""
    known = number(name, value)
    if known <= 0.0:
        raise InputError(name, f"{known:g} {unit}".strip(), "must be positive", remedy)
    if known < 1.0 / LARGEST:
        raise InputError(name, f"{known:g} {unit}".strip(), f"is below {1.0 / LARGEST:g}", remedy)
    return known
