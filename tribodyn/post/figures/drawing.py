"""A figure that a study offers."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from tribodyn.post.figures.panel import View
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord


def always(_record: Record) -> bool:
    """Every record holds enough."""
    return True


class Drawing(NamedTuple):
    """What a figure shows, what draws it, and whether a record holds enough for it."""

    about: str  # in a line
    #: (records, view) -> Figure; raises InputError for records that it cannot show
    draw: Callable[[Sequence[Record], View], Figure]
    #: whether a record holds enough; what does not fit is drawn only when asked for by name
    fits: Callable[[Record], bool] = always


class SweepDrawing(NamedTuple):
    """The same for a figure of sweeps."""

    about: str  # in a line
    #: (records, at) -> Figure; `at` is a parameter's name to its value in SI, for a single case
    draw: Callable[[Sequence[SweepRecord], Mapping[str, float | str]], Figure]
