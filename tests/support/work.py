"""Limits on work in additions of plain Python, which no clock, no load and no slower processor changes."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache


@contextmanager
def at_most(additions: float) -> Iterator[None]:
    """Fail where the body takes more processor time than so many additions."""
    begun = time.process_time()
    yield
    spent = (time.process_time() - begun) / _one_addition()
    assert spent < additions, f"the work of {spent:.1e} additions, at most {additions:.1e} are allowed"


@cache
def _one_addition() -> float:
    """Processor time of an addition in a loop, s: some 5e-8."""
    times = []
    for _ in range(3):
        begun, total = time.process_time(), 0
        for number in range(300_000):
            total += number
        times.append(time.process_time() - begun)
    return min(times) / 300_000
