"""What Python programs give and get: scenarios from a name, a path, a dictionary or a case; and messages.

Messages name options of the command line, ``--force``, in place of which a Python program reads the names of
its arguments; so some sixty messages in thirty files need not know who shows them. What arguments may be is
stated once per name, whichever function takes it.
"""

import math
import re
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import wraps
from inspect import signature
from numbers import Integral, Real
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from tribodyn.errors import InputError, OutputError, quoted
from tribodyn.input.resolve import OVERRIDES, Resolved, resolve, resolve_table
from tribodyn.input.sources import find_scenario
from tribodyn.input.vary import VARY
from tribodyn.studies.protocol.load import loaded_from, table_of
from tribodyn.studies.protocol.study import CaseHead

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


#: What the options are called that stand for the scenario's keys.
_NAMES = {OVERRIDES: "overrides", VARY: "vary"}
#: Options that are on or off.
_SWITCHES = ("allow_large", "force", "resume", "unstable")
_OPTION = re.compile(r"(?<![\w-])--([a-z][a-z-]*)")


def _keyword(option: re.Match[str]) -> str:
    name = _NAMES.get(option[0], option[1].replace("-", "_"))
    return f"{name}=True" if name in _SWITCHES else name


def python_words(text: str) -> str:
    """A message with arguments in place of options: ``force=True`` for ``--force``."""
    return _OPTION.sub(_keyword, text)


@contextmanager
def in_python() -> Iterator[None]:
    """Put the errors raised inside into Python's words."""
    try:
        yield
    except (InputError, OutputError) as error:
        for mistake in (error, *getattr(error, "errors", ())):
            _translate(mistake)
        raise


def _translate(error: Any) -> None:
    for name in ("rule", "remedy", "kept"):
        if isinstance(getattr(error, name, None), str):
            setattr(error, name, python_words(getattr(error, name)))
    if isinstance(error, InputError):
        if _OPTION.fullmatch(error.key):
            error.key = _NAMES.get(error.key, error.key[2:].replace("-", "_"))
        error.file = _NAMES.get(error.file, error.file)
    if notes := getattr(error, "__notes__", None):
        error.__notes__ = [python_words(note) for note in notes]


def public(function: Function) -> Function:
    """A function that checks its arguments by their names and has its errors in Python's words."""
    accepted = signature(function)
    names = [name for name in accepted.parameters if name in _ARGUMENTS]

    @in_python()
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


Source = str | Path | Mapping[str, Any] | CaseHead
"""What names or describes a scenario."""

#: Stands for the file in messages on a scenario that is in none; names in it are looked for from here.
_FILE = Path("scenario")


@public
def scenario(source: Source, overrides: Mapping[str, Any] | None = None) -> Any:
    """Make a case, which `run` and `sweep` take.

    Parameters
    ----------
    source : str, Path, mapping or case
        Name of a shipped scenario, path of a scenario file, its tables as nested dictionaries, or a case.
    overrides : mapping, optional
        Dotted key to value: ``{"operating.gear_torque": "600 N*m"}``.

    Returns
    -------
    case
        With all that the scenario says; ``case.toml`` is its text.

    Raises
    ------
    InputError
        Anything that is wrong with it; `InputErrors`, one per line, where there is more than one mistake.

    Notes
    -----
    A value with a unit is a text, ``"3 mm"``, or a quantity of pint. NumPy numbers and arrays are taken as
    Python's numbers and lists.
    """
    if isinstance(source, CaseHead) and not overrides:
        return source
    return loaded_from(*resolved(source, overrides)).case


def resolved(source: Source, overrides: Mapping[str, Any] | None) -> tuple[Resolved, Path]:
    """What a source says with everything in it, and its file; raises as `scenario`."""
    changes = changes_of(overrides)
    if isinstance(source, (str, Path)):
        path = find_scenario(str(source))
        return resolve(path, changes, table_of), path
    if isinstance(source, CaseHead):
        written = tomllib.loads(source.toml)
    elif isinstance(source, Mapping):
        written = in_toml(source)
    else:
        rule = f"expected a name, a path, a mapping or a case, got {type(source).__name__}"
        raise InputError("scenario", None, rule, 'give the name of a scenario: "crc-23-47"')
    return resolve_table(written, _FILE, changes, table_of), _FILE


def changes_of(overrides: Mapping[str, Any] | None) -> dict[str, Any]:
    """Overrides as a scenario file would hold them."""
    return {str(key): in_toml(value) for key, value in (overrides or {}).items()}


def in_toml(value: Any) -> Any:
    """A value as a scenario file would hold it."""
    if isinstance(value, Mapping):
        return {str(key): in_toml(item) for key, item in value.items() if item is not None}
    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return with_unit(value.magnitude, str(value.units))
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple)):
        return [in_toml(item) for item in value]
    return str(value) if isinstance(value, Path) else value


def with_unit(magnitude: Any, unit: str) -> Any:
    """A number, or all numbers of an array, with a unit; plain numbers where there is none."""
    if unit in ("", "dimensionless"):
        return np.asarray(magnitude).tolist()
    if np.ndim(magnitude):
        return [f"{float(number)!r} {unit}" for number in np.ravel(magnitude)]
    return f"{float(magnitude)!r} {unit}"
