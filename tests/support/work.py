"""Limits on work in additions of plain Python, which no clock, no load and no slower processor changes."""

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache


@contextmanager
def at_most(additions: float) -> Iterator[None]:
    """Fail where the body takes more processor time than so many additions.

    Of this thread alone, and without collecting garbage: that takes as long as other tests left objects.
    """
    addition, collects = _one_addition(), gc.isenabled()
    gc.disable()
    try:
        begun = time.thread_time()
        yield
        spent = (time.thread_time() - begun) / addition
    finally:
        if collects:
            gc.enable()
    assert spent < additions, f"the work of {spent:.1e} additions, at most {additions:.1e} are allowed"


@cache
def _one_addition() -> float:
    """Processor time of an addition in a loop, s: some 5e-8."""
    times = []
    for _ in range(3):
        begun, total = time.thread_time(), 0
        for number in range(300_000):
            total += number
        times.append(time.thread_time() - begun)
    return min(times) / 300_000
