"""A progress bar for what takes more than a second; silent when stderr is not a terminal."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol


class Report(Protocol):
    """Called with the fraction done, 0 … 1."""

    def __call__(self, fraction: float, /) -> None:
        """Report."""


PATIENCE = 1.0  # s


@contextmanager
def progress_bar(label: str) -> Iterator[Report]:
    """Give a function that takes the fraction done; a bar appears when a second has passed."""
    if not sys.stderr.isatty():
        yield lambda _fraction: None
        return
    start = time.monotonic()
    shown: list[Any] = []

    def report(fraction: float) -> None:
        if not shown and time.monotonic() - start > PATIENCE:
            shown.append(_start(label))
        for bar, task in shown:
            bar.update(task, completed=fraction)

    try:
        yield report
    finally:
        for bar, _ in shown:
            bar.stop()


def _start(label: str) -> tuple[Any, Any]:
    from rich.console import Console
    from rich.progress import Progress

    bar = Progress(console=Console(stderr=True), transient=True)
    bar.start()
    return bar, bar.add_task(label, total=1.0)
