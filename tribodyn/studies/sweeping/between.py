"""Cases between two cases of a study, for sweeps that follow a motion from one to the other."""

import dataclasses
from typing import Any

import numpy as np

#: Fields that name a case or hold its text, and say nothing of it beyond the others.
_TEXTS = ("title", "name", "toml", "sha256")


class NothingBetween(Exception):
    """The cases differ in something that is no number."""


def case_between(first: Any, last: Any, share: float) -> Any:
    """The case at a share of the way from one case to another, every number in proportion.

    Numbers of a case are in SI units and proportional to what a scenario says, up to a constant; so for a
    varied quantity this is the case of the value in between. A share above 1 goes on beyond the last case.

    Raises
    ------
    NothingBetween
        Where the cases differ in a name, a switch, a whole number, or the number of numbers.
    """
    if share == 0.0:
        return first
    return last if share == 1.0 else _between(first, last, share)


def _between(first: Any, last: Any, share: float) -> Any:
    if dataclasses.is_dataclass(first) and type(first) is type(last):
        changed = {
            field.name: _between(getattr(first, field.name), getattr(last, field.name), share)
            for field in dataclasses.fields(first)
            if field.init and field.name not in _TEXTS
        }
        return dataclasses.replace(first, **changed)  # pyright: ignore[reportArgumentType]
    if isinstance(first, tuple) and isinstance(last, tuple) and len(first) == len(last):
        parts = [_between(*ends, share) for ends in zip(first, last, strict=True)]
        return type(first)(*parts) if hasattr(first, "_fields") else tuple(parts)
    if isinstance(first, np.ndarray) and isinstance(last, np.ndarray):
        if first.shape != last.shape:
            raise NothingBetween
        return first if np.array_equal(first, last) else first + share * (last - first)
    if isinstance(first, dict) and isinstance(last, dict) and first.keys() == last.keys():
        return {key: _between(first[key], last[key], share) for key in first}
    if isinstance(first, float) and isinstance(last, float):
        return first if first == last else first + share * (last - first)
    if type(first) is type(last) and first == last:
        return first
    raise NothingBetween
