"""How far long work is that several layers below a run do: finite elements are solved once, then kept.

Whoever shows progress calls `watched`; loops that take seconds go through `steps`, and `part` divides work
among what is called for it. Nobody watching, all of it does nothing.
"""

import os
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

Step = TypeVar("Step")

_watcher: ContextVar[Callable[[float], None] | None] = ContextVar("watcher", default=None)
_listener: ContextVar[Callable[[str], None] | None] = ContextVar("listener", default=None)
_foreteller: ContextVar[Callable[[str], None] | None] = ContextVar("foreteller", default=None)


@contextmanager
def foretold(hear: Callable[[str], None]) -> Iterator[None]:
    """Call `hear` with what long work inside the block is going to take, in a few words."""
    token = _foreteller.set(hear)
    try:
        yield
    finally:
        _foreteller.reset(token)


def foretell(what: str) -> None:
    """Say what the work that now begins is going to take."""
    hear = _foreteller.get()
    if hear is not None:
        hear(what)


@contextmanager
def listened(hear: Callable[[str], None]) -> Iterator[None]:
    """Call `hear` with what the work inside the block is at, in a few words."""
    token = _listener.set(hear)
    try:
        yield
    finally:
        _listener.reset(token)


def announce(what: str) -> None:
    """Say what is done next."""
    hear = _listener.get()
    if hear is not None:
        hear(what)


@contextmanager
def announced(what: str) -> Iterator[None]:
    """Say that this is done inside the block, and nothing behind it."""
    announce(what)
    try:
        yield
    finally:
        announce("")


@contextmanager
def watched(report: Callable[[float], None]) -> Iterator[None]:
    """Call `report` with the share done, 0 … 1, of the work inside the block."""
    token = _watcher.set(report)
    try:
        yield
    finally:
        _watcher.reset(token)


@contextmanager
def part(begin: float, end: float) -> Iterator[None]:
    """Take what is done inside the block for the part between two shares of the work around it."""
    report = _watcher.get()
    if report is None:
        yield
        return
    with watched(lambda share: report(begin + (end - begin) * share)):
        report(begin)
        yield
        report(end)


def steps(of: Sequence[Step]) -> Iterator[Step]:
    """Go through steps of about equal length, and report each that is done; each may have `part` in it."""
    for done, step in enumerate(of):
        with part(done / len(of), (done + 1) / len(of)):
            yield step


def in_threads(
    call: Callable[[Step], None],
    items: Sequence[Step],
    workers: int,
    progress: Callable[[float], None] | None = None,
    cancelled: threading.Event | None = None,
) -> None:
    """Call a function with each item, side by side; raises what a call raises, and begins none any more.

    `progress` is called with the share done; `cancelled` is set where calls that still run should end.
    """
    from concurrent.futures import ThreadPoolExecutor, as_completed

    with ThreadPoolExecutor(workers) as pool:
        try:
            jobs = [pool.submit(call, item) for item in items]
            for done, job in enumerate(as_completed(jobs), 1):
                job.result()
                if progress:
                    progress(done / len(jobs))
        finally:
            if cancelled:
                cancelled.set()
            pool.shutdown(cancel_futures=True)


def usable_cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
