"""A progress bar for what takes more than a second; silent when stderr is not a terminal."""

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from tribodyn.numerics.work import listened, watched

PATIENCE = 1.0  # s


@contextmanager
def progress_bar(label: str) -> Iterator[Callable[[float], None]]:
    """Give a function that takes the fraction done; a bar appears when a second has passed."""
    if not sys.stderr.isatty():
        yield lambda _fraction: None
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn

    columns = SpinnerColumn(), *Progress.get_default_columns()
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    task = bar.add_task(label, total=1.0)
    reached, doing = 0.0, label

    def hear(what: str) -> None:
        nonlocal doing
        doing = f"{label}: {what}"
        bar.update(task, description=doing)

    def report(fraction: float) -> None:
        nonlocal reached
        reached = fraction
        bar.update(task, description=doing, completed=fraction)

    def prepare(fraction: float) -> None:
        if fraction < 1.0:
            bar.update(task, description=f"{label}: finite elements", completed=fraction)
        else:
            report(reached)

    # a timer, so that the bar also comes up while code is compiled and no progress is reported
    patience = threading.Timer(PATIENCE, bar.start)
    patience.daemon = True
    patience.start()
    try:
        with watched(prepare), listened(hear):
            yield report
    finally:
        patience.cancel()
        patience.join()
        bar.stop()
