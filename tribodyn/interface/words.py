"""Errors in a Python program's words: what is below knows the options of the command line only."""

import re
from collections.abc import Callable, Iterator
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
_WORDS: tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...] = (
    (re.compile(r"--set ([\w.]+)=(\S+)"), r'overrides={"\1": "\2"}'),
    (re.compile(r"--vary ([\w.]+)=(\S+)"), r'vary={"\1": "\2"}'),
    (re.compile(r"--direction up, down or both"), 'direction="up", "down" or "both"'),
    (re.compile(r"--engine (\w+)"), r'engine="\1"'),
    (re.compile(r" \(in Python allow_large=True\)"), ""),
    (re.compile(r"see the keys with: tribodyn schema"), "the page of scenario files lists the keys"),
    (re.compile(r"tribodyn show and plot read it"), "td.open reads it"),
    (re.compile(r"tribodyn plot A\.h5 B\.h5"), "a.plot(name, b)"),
    (re.compile(r"tribodyn plot\b"), "plot"),
    (re.compile(r"tribodyn (run|sweep|validate)\b"), r"td.\1"),
    (_OPTION, lambda found: _keyword(found[1])),
)


def _keyword(option: str) -> str:
    name = _NAMES.get(f"--{option}", option.replace("-", "_"))
    return f"{name}=True" if name in _SWITCHES else name


def python_words(text: str) -> str:
    """A message with Python's names where it has options and verbs of the command line."""
    for pattern, words in _WORDS:
        text = pattern.sub(words, text)
    return text


@contextmanager
def in_python() -> Iterator[None]:
    """Put the errors raised inside into Python's words; also a decorator."""
    try:
        yield
    except (InputError, OutputError) as error:
        for one in (error, *getattr(error, "errors", ())):
            _translate(one)
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
