"""A progress bar with rate and time left, for what takes more than a second.

It is drawn on a terminal (of stderr) or in a notebook; anywhere else, as in a script whose output is kept,
only what is going to take longer than a minute is said beforehand, in a line on stderr. A program that starts
this one gets lines of `MARK`, the share done and what is done, where it sets `LINES` in the environment.
"""

import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import Any

from tribodyn.numerics.processes.work import foretold, listened, watched

PATIENCE = 1.0  # s
#: The same between two pictures of the bar in a notebook.
NOTEBOOK_PAUSE = 0.5  # s

#: Variable of the environment that asks for lines, what they begin with, and seconds between two of them.
LINES, MARK, LINE_PAUSE = "TRIBODYN_PROGRESS", "@progress", 0.1

Report = Callable[[float], None]
"""Takes the fraction done, 0 … 1."""


@contextmanager
def progress_of(
    wanted: Report | bool | None, label: str, total: float = 100.0, unit: str = "%"
) -> Iterator[Any]:
    """Give what Python's functions report to: their `progress`, a bar where it is None, or nothing."""
    if wanted is None or wanted is True:
        with progress_bar(label, total, unit) as report:
            yield report
    else:
        yield wanted or (lambda _fraction: None)


@contextmanager
def progress_bar(label: str, total: float = 100.0, unit: str = "%") -> Iterator[Report]:
    """Give a function that takes the fraction done; a bar appears when a second has passed.

    `total` is what there is to do, in `unit`, for the rate that is shown.
    """
    if os.environ.get(LINES):
        with _in_lines(label) as in_lines:
            yield in_lines
        return
    notebook = _notebook()
    if not (notebook or sys.stderr.isatty()):
        with foretold(lambda what: print(f"{label}: {what}", file=sys.stderr, flush=True)):
            yield lambda _fraction: None
        return
    bar = _bar(unit)
    task = bar.add_task(label, total=total)
    reached, doing = 0.0, label
    redraw = _in_notebook(bar) if notebook else (lambda: None)

    def show(fraction: float, description: str) -> None:
        bar.update(task, description=description, completed=fraction * total)
        redraw()

    def hear(what: str) -> None:
        nonlocal doing
        doing = f"{label}: {what}" if what else label
        show(reached, doing)

    def report(fraction: float) -> None:
        nonlocal reached
        reached = fraction
        show(fraction, doing)

    def prepare(fraction: float) -> None:
        if fraction < 1.0:
            show(fraction, f"{label}: tables, made once")
        else:
            report(reached)

    # a timer, so that the bar also comes up while code is compiled and no progress is reported
    patience = threading.Timer(PATIENCE, (lambda: None) if notebook else bar.start)
    patience.daemon = True
    patience.start()
    try:
        with (
            watched(prepare),
            listened(hear),
            foretold(lambda what: bar.console.print(f"{label}: {what}", markup=False, highlight=False)),
        ):
            yield report
        if notebook:  # where the last picture stays
            bar.update(task, description=label, completed=total)
            redraw()
    finally:
        patience.cancel()
        patience.join()
        bar.stop()


@contextmanager
def _in_lines(label: str) -> Iterator[Report]:
    """Write the share done in lines, what is said of it behind."""
    said = 0.0

    def write(fraction: float) -> None:
        nonlocal said
        if perf_counter() - said >= LINE_PAUSE or fraction >= 1.0:
            said = perf_counter()
            print(MARK, f"{fraction:.4f}", label, file=sys.stderr, flush=True)

    with foretold(lambda what: print(f"{label}: {what}", file=sys.stderr, flush=True)):
        yield write


def _notebook() -> bool:
    """Whether this is a notebook, whose cells show what is displayed."""
    if "IPython" not in sys.modules:
        return False
    from rich.console import Console

    return Console().is_jupyter


def _bar(unit: str) -> Any:
    """Rich's bar: what is done, how much of it, how fast, and how long it will take."""
    from rich.console import Console
    from rich.progress import Progress, ProgressColumn, SpinnerColumn, Task, TimeRemainingColumn
    from rich.text import Text

    class Rate(ProgressColumn):
        def render(self, task: Task) -> Text:
            speed = task.finished_speed or task.speed
            return Text(f"{speed:.3g} {unit}/s" if speed else "", style="progress.data.speed")

    _, name, line, share, _ = (SpinnerColumn(), *Progress.get_default_columns())
    columns = SpinnerColumn(), name, line, share, Rate(), TimeRemainingColumn(elapsed_when_finished=True)
    return Progress(*columns, console=Console(stderr=True), transient=True)


def _in_notebook(bar: Any) -> Callable[[], None]:
    """Give what draws the bar below the cell, at most every `NOTEBOOK_PAUSE`; the last one stays."""
    from IPython.display import display  # pyright: ignore[reportMissingImports]

    last, handle = perf_counter() + PATIENCE - NOTEBOOK_PAUSE, None

    def redraw() -> None:
        nonlocal last, handle
        if perf_counter() - last < NOTEBOOK_PAUSE and not (handle and bar.finished):
            return
        last = perf_counter()
        bundle = bar._repr_mimebundle_((), ())
        if handle is None:
            handle = display(bundle, raw=True, display_id=True)
        else:
            handle.update(bundle, raw=True)

    return redraw
