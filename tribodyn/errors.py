"""How a run can end badly: bad input, a simulation that could not go on, results that cannot be written."""

import errno
import os
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

#: Characters of a key in a message, more than any that is known has; one that nobody knows may have more.
LONGEST_KEY = 240
#: Characters of a path, more than files of any user have.
LONGEST_PATH = 1024
#: Characters of a rule: what is wrong, which may quote what somebody wrote, or what a library says.
LONGEST_RULE = 1200


@dataclass
class InputError(Exception):
    """Input that cannot be used; the command line prints it and exits with status 2.

    Physics raises it without `file`; the scenario layer adds the file's name and the full key.
    """

    key: str  # where the value stands, dotted: ``drive.pinion.profile_shift``
    value: object = None  # what was given, or None where the key is missing
    rule: str = ""  # what is wrong with it, or which rule it breaks
    remedy: str = ""  # what to write instead
    file: str = ""  # the file that the key stands in

    def moved(self, place: Callable[[str], str]) -> "InputError":
        """The same with another name for where the key stands, as a function of the old one."""
        return InputError(self.key, self.value, self.rule, self.remedy, place(self.file))

    def __str__(self) -> str:
        place = f"{self.file}: " if self.file else ""
        key = cut(self.key, LONGEST_KEY)
        value = f" = {cut(str(self.value), LONGEST_PATH)}" if self.value is not None else ""
        remedy = f"; {self.remedy}" if self.remedy else ""
        return printable(f"{place}{key}{value}: {cut(self.rule, LONGEST_RULE)}{remedy}")


class InputErrors(InputError):
    """Several mistakes found at once, one per line; the first stands for them where only one is looked at."""

    def __init__(self, errors: Sequence[InputError]):
        first = errors[0]
        super().__init__(first.key, first.value, first.rule, first.remedy, first.file)
        self.errors = tuple(errors)

    def moved(self, place: Callable[[str], str]) -> "InputErrors":
        """See `InputError.moved`."""
        return InputErrors([error.moved(place) for error in self.errors])

    def __str__(self) -> str:
        return "\n".join(map(str, self.errors))


@dataclass
class SimulationError(Exception):
    """A simulation that could not go on; what it has is kept and the exit status is 3."""

    reason: str  # why, in a sentence that the user can act on
    time: float | None = None  # float, optional Simulated time reached, s; none where time is not simulated.

    def __str__(self) -> str:
        return self.reason if self.time is None else f"stopped at t = {self.time:.6g} s: {self.reason}"


@dataclass
class OutputError(Exception):
    """Results that the system does not take, as on a full disk; the exit status is 3."""

    file: str  # what could not be written
    reason: str  # why, in the system's words
    kept: str = ""  # what there is of the results, and where

    def __str__(self) -> str:
        return f"{self.file}: cannot be written: {self.reason}" + (f"; {self.kept}" if self.kept else "")


#: What the system says where there is no room, or no device any more.
NO_ROOM = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO})


def no_descriptors(error: BaseException) -> bool:
    """Whether a process may have no more files open: HDF5's errors have no number, but the system's words."""
    return getattr(error, "errno", None) in _NO_DESCRIPTORS or any(word in str(error) for word in _TOO_MANY)


_NO_DESCRIPTORS = (errno.EMFILE, errno.ENFILE)
_TOO_MANY = tuple(map(os.strerror, _NO_DESCRIPTORS))
#: What to say then, and to do.
TOO_MANY_FILES = "no more files may be open in this process", "raise the limit: ulimit -n 1024"


def near_name(name: str, names: Iterable[str]) -> str:
    """Return the known name that looks most like `name`, or ""."""
    from difflib import get_close_matches

    names = list(names)
    close = get_close_matches(name, names, n=1, cutoff=0.6)
    close = close or names_with(name, names)
    close = close or [other for other in names if name and other in name]
    return close[0] if close else ""


def names_with(part: str, names: Iterable[str]) -> list[str]:
    """Return the known names that contain a part, whatever its case, blanks and hyphens.

    "ISO VG 320" is part of "iso-vg-320-mineral" and "iso-vg-320-pao".
    """

    def plain(name: str) -> str:
        return "".join(filter(str.isalnum, name.lower()))

    wanted = plain(part)
    return [name for name in names if wanted and wanted in plain(name)]


def quoted(value: Any) -> str:
    """Return a value as TOML would write it, on one line and cut where it is long."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        text = f'"{printable(value)}"'
    elif isinstance(value, dict):
        text = "{" + ", ".join(f"{printable(str(key))} = {quoted(item)}" for key, item in value.items()) + "}"
    elif isinstance(value, (list, tuple)):
        text = "[" + ", ".join(map(quoted, value)) + "]"
    else:
        text = str(value)
    most = 240 if isinstance(value, str) else 80  # a file's path is quoted in full
    return cut(text, most)


def cut(text: str, most: int) -> str:
    """Return text of at most so many characters, its end left out where it is longer."""
    return text if len(text) <= most else text[: most - 3] + "..."


def printable_path(path: Any) -> str:
    """Return a path on one line, as long as systems take one; what is longer is no path."""
    return cut(printable(str(path)), LONGEST_PATH)


def printable(text: str) -> str:
    """Return text with line ends and other invisible characters escaped, so that it stays on one line."""
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode()
        for character in text
    )


def harmless(text: str) -> str:
    """Return text with everything escaped that a terminal, a picture or a page would obey.

    Control characters but line ends and tabs, halves of surrogate pairs, and marks that turn the direction of
    writing.
    """
    if not _OBEYED.search(text):
        return text
    return _OBEYED.sub(lambda match: match[0].encode("unicode_escape").decode(), text)


_OBEYED = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]"
)


def unknown_name(key: str, name: str, names: Iterable[str], what: str) -> InputError:
    """Return what to say of a name that is not among the known ones; `what` says what they are names of."""
    names = list(dict.fromkeys(names))
    near = near_name(name, names)
    mean = f'did you mean "{near}"? ' if near else ""
    return InputError(key, quoted(name), f"no such {what}", f"{mean}there is: {', '.join(names)}")


def broken_list(key: str, given: Sequence[str], known: Collection[str], what: str) -> Iterator[InputError]:
    """Go through names in a list at a key that are not `known`, or there twice."""
    for place, name in enumerate(given):
        if name not in known:
            yield unknown_name(f"{key}.{place}", name, known, what)
        elif name in given[:place]:
            yield InputError(key, quoted(list(given)), f"names {name} twice", f"name each {what} once")
