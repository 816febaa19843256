"""What of the tests `make test` leaves to `make soak`: parameters of some, and those of a list."""

from collections.abc import Callable, Collection, Iterable
from functools import cache
from pathlib import Path
from typing import Any

import pytest


def all_in_soak(
    parameters: Iterable[Any], kept: Callable[[Any], bool] | Collection[Any], names: int = 1
) -> list[Any]:
    """All parameters of a test; those that are not kept are marked soak. Of several names they are tuples."""
    keeps = kept if callable(kept) else kept.__contains__
    return [
        pytest.param(*((one,) if names == 1 else one), marks=() if keeps(one) else pytest.mark.soak)
        for one in parameters
    ]


@cache
def in_soak() -> frozenset[str]:
    """Names of tests as `tests/in_soak.txt` has them, below tests/, with the case in brackets or without."""
    lines = Path(__file__).parents[1].joinpath("in_soak.txt").read_text(encoding="utf-8").splitlines()
    return frozenset(line for line in lines if line and not line.startswith("#"))


def is_in_soak(nodeid: str) -> bool:
    """Whether the list names a test, or all its cases."""
    name = nodeid.removeprefix("tests/")
    return not in_soak().isdisjoint((name, name.partition("[")[0]))
