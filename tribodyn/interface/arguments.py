"""What arguments of Python's functions may be: one rule per name, whichever function takes it."""

import math
from collections.abc import Callable, Mapping
from functools import wraps
from inspect import signature
from numbers import Integral, Real
from os import PathLike
from typing import Any, NamedTuple, TypeVar

import numpy as np

from tribodyn.errors import InputError, quoted

Function = TypeVar("Function", bound=Callable[..., Any])


class _Argument(NamedTuple):
    """Whether a value other than the default is one, what it is not otherwise, and what to write."""

    holds: Callable[[Any], bool]
    rule: str
    remedy: str


def _whole(least: int) -> _Argument:
    return _Argument(
        lambda value: (
            isinstance(value, Integral) and not isinstance(value, bool) and least <= int(value) < 2**63
        ),
        f"is no whole number from {least} on",
        f"write {max(least, 1)} or more",
    )


def _real(least: float, below: float) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, Real) and least <= float(value) < below


def _are_texts(value: Any) -> bool:
    return isinstance(value, str) or (
        isinstance(value, (list, tuple, set)) and all(isinstance(item, str) for item in value)
    )


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, PathLike)) and "\0" not in str(value)


_PATH = _Argument(_is_path, "is no path", 'give a text, such as "run.h5", or a pathlib.Path')
_SWITCH = _Argument(
    lambda value: isinstance(value, (bool, np.bool_)), "is neither True nor False", "write either"
)
_TEXTS = _Argument(_are_texts, "is neither a text nor a list of texts", "give names in quotes")
_NAME = _Argument(lambda value: isinstance(value, str), "is no text", "give a name in quotes")
#: Name of an argument -> what it may be.
_ARGUMENTS = {
    "allow_large": _SWITCH,
    "engine": _Argument(
        lambda value: value in ("native", "jax", "dask"), "is no engine", 'one of "native", "jax", "dask"'
    ),
    "folder": _PATH,
    "force": _SWITCH,
    "free": _Argument(
        lambda value: isinstance(value, (Mapping, list, tuple)),
        "is neither a mapping of keys to bounds nor a list of entries",
        'write {"drive.pinion.profile_shift": (-0.2, 0.4)}',
    ),
    "licence": _NAME,
    "links": _Argument(
        lambda value: isinstance(value, Mapping), "is no mapping", 'write {"spring": law}, name to law'
    ),
    "output": _PATH,
    "overrides": _Argument(
        lambda value: isinstance(value, Mapping),
        "is no mapping of keys to values",
        'write {"operating.gear_torque": "600 N*m"}',
    ),
    "paper": _NAME,
    "path": _PATH,
    "progress": _Argument(
        lambda value: isinstance(value, bool) or callable(value),
        "is neither a function nor True or False",
        "give a function of the share done, or False",
    ),
    "refine": _whole(1),
    "refine_by": _TEXTS,
    "resume": _SWITCH,
    "run_in": _Argument(_real(0.0, math.inf), "is no number of turns", "write 0 or more, such as 3"),
    "scheduler": _NAME,
    "seed": _whole(0),
    "test": _Argument(_real(0.0, 1.0), "is no share from 0 to below 1", "write 0.25"),
    "transient": _whole(1),
    "without_mean": _SWITCH,
    "vary": _Argument(
        lambda value: isinstance(value, Mapping) or _are_texts(value),
        "is neither a mapping of keys to values nor such a text",
        'write {"operating.gear_torque": "100:300:50 N*m"}',
    ),
    "workers": _whole(1),
    "wrt": _TEXTS,
}


def checked(function: Function) -> Function:
    """Check the arguments of a function by their names before it is called; raises InputError."""
    accepted = signature(function)
    names = [name for name in accepted.parameters if name in _ARGUMENTS]

    @wraps(function)
    def call(*values: Any, **keys: Any) -> Any:
        try:
            arguments = accepted.bind(*values, **keys).arguments
        except TypeError:  # what Python says of the call itself
            return function(*values, **keys)
        for name in names:
            due, default = _ARGUMENTS[name], accepted.parameters[name].default
            value = arguments.get(name, default)
            if value is not default and not due.holds(value):
                raise InputError(name, quoted(value), due.rule, due.remedy)
        return function(*values, **keys)

    return call  # pyright: ignore[reportReturnType]
