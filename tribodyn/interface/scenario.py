"""What Python programs give and get: scenarios from a name, a path, a dictionary or a case; and messages.

Messages name options of the command line, ``--force``, in place of which a Python program reads the names of
its arguments; so some sixty messages in thirty files need not know who shows them.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.errors import InputError, OutputError
from tribodyn.input.resolve import OVERRIDES, Resolved, resolve, resolve_table
from tribodyn.input.sources import find_scenario
from tribodyn.input.vary import VARY
from tribodyn.interface.arguments import checked
from tribodyn.studies.protocol.load import loaded_from, table_of
from tribodyn.studies.protocol.study import CaseHead

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
    """Put the errors raised inside into Python's words; also a decorator."""
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


Source = str | Path | Mapping[str, Any] | CaseHead
"""What names or describes a scenario."""

#: Stands for the file in messages on a scenario that is in none; names in it are looked for from here.
_FILE = Path("scenario")


@in_python()
@checked
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
    changes = {str(key): in_toml(value) for key, value in (overrides or {}).items()}
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
