"""Errors in a Python program's words: messages name options of the command line, ``--force``.

So some sixty messages in thirty files need not know whether the command line or a program shows them.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from tribodyn.errors import InputError, OutputError
from tribodyn.scenario.resolve import OVERRIDES
from tribodyn.scenario.vary import VARY

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
