"""A panel: one dataset of one or several records over the phase of the mesh, key points marked."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.post.cycles import Window, key_points, last_cycles, pair_curve
from tribodyn.post.style import INK, PAIR_STYLES, PALETTE, QUIET
from tribodyn.record.reader import Record

#: Over more cycles than these, key points would hide the curves.
MOST_CYCLES_MARKED = 4
#: Height of a row of names above the axes, points.
ROW = 9.5


class View(NamedTuple):
    """Which part of the records is drawn, and over what.

    Attributes
    ----------
    cycles : int or None
        How many of the last whole mesh cycles; None for all.
    against : str
        `phase` (mesh cycles) or `time` (ms).
    """

    cycles: int | None = 2
    against: str = "phase"


class Quantity(NamedTuple):
    """A dataset and how engineers read it: factor from SI, axis label, whether the axis starts at 0."""

    dataset: str
    factor: float
    label: str
    from_zero: bool = False


def record_label(record: Record) -> str:
    """Name a record in a legend."""
    return record.label


def record_title(record: Record) -> str:
    """Return what a record is about: the scenario's title, and that it is unfinished where it is."""
    title = str(record.scenario.get("title", record_label(record)))
    return title if record.status == "complete" else f"{title} [{record.status}]"


def abscissa(window: Window, view: View) -> np.ndarray:
    """Give the phase from 0 at the first cycle shown, or the time in ms."""
    return window.time * 1e3 if view.against == "time" else window.phase


def draw(
    axes: Axes,
    records: Sequence[Record],
    quantity: Quantity,
    view: View,
    first: bool = True,
    last: bool = True,
) -> None:
    """Draw a dataset of every record, pairs apart where it has pairs, with axis labels and key points.

    In a stack of panels the `first` alone names the key points and the `last` alone the horizontal axis.
    """
    several = len(records) > 1
    for number, record in enumerate(records):
        window = last_cycles(record, view.cycles)
        x = abscissa(window, view)
        values = record[quantity.dataset] * quantity.factor
        if values.ndim == 1:
            color = PALETTE[number % len(PALETTE)] if several else PALETTE[0]
            axes.plot(x, values[window.part], color=color)
            continue
        for position, pair in enumerate(drawn_pairs(record, window)):
            curve = pair_curve(record, values, pair, window, x)
            color = PALETTE[(number if several else position) % len(PALETTE)]
            style = PAIR_STYLES.get(pair, "-")
            axes.plot(*curve, color=color, linestyle=style, label=pair_label(pair))
    axes.set_ylabel(quantity.label)
    if quantity.from_zero:
        axes.set_ylim(bottom=0)
    if last:
        axes.set_xlabel(abscissa_label(view))
    mark_key_points(axes, records, view, first)


def drawn_pairs(record: Record, window: Window) -> list[int]:
    """List the pairs to draw: driving flanks from the newest on, then back flanks that carry load."""
    load = record["normal_load"][window.part]
    front = [pair for pair in record.pairs if pair <= 1]
    touching = [pair for slot, pair in enumerate(record.pairs) if pair > 1 and np.any(load[:, slot] > 0)]
    return front[::-1] + touching


def pair_label(pair: int) -> str:
    """Name a pair in a legend."""
    return f"pair {pair}" if pair <= 1 else f"back flanks {pair - 1}"


def abscissa_label(view: View) -> str:
    """Label the horizontal axis."""
    return "Time (ms)" if view.against == "time" else "Phase (mesh cycles)"


def mark_key_points(axes: Axes, records: Sequence[Record], view: View, named: bool = True) -> None:
    """Draw thin lines at the key points of every cycle, named above the axes unless `named` is off.

    One record: the upper row names where pair 1 is, the lower one pair 0. Several: a row for each record
    in its colour, naming where pair 1 is. Over many cycles lines and names would hide the curves and are
    left out.
    """
    several = len(records) > 1
    widest = 0.0
    for number, record in enumerate(records):
        window = last_cycles(record, view.cycles)
        x = abscissa(window, view)
        widest = max(widest, float(x[-1]))
        cycles = round(window.phase[-1])
        if not 0 < cycles <= MOST_CYCLES_MARKED:
            continue
        points = [
            (cycle + point.phase, point)
            for cycle in range(cycles + 1)
            for point in key_points(record)
            if cycle + point.phase <= cycles + 1e-9
        ]
        for phase, point in points:
            place = float(np.interp(phase, window.phase, x))
            color = PALETTE[number % len(PALETTE)] if several else QUIET
            axes.axvline(place, color=color, linewidth=0.6, linestyle=":", zorder=0.9)
            if named and several:
                _name(axes, place, len(records) - 1 - number, point.newest, color)
            elif named:
                _name(axes, place, 1, point.newest, INK)
                _name(axes, place, 0, point.before, QUIET)
        if named and several:
            _head_row(axes, len(records) - 1 - number, record_label(record), PALETTE[number % len(PALETTE)])
        elif named:
            _head_row(axes, 1, "pair 1", INK)
            _head_row(axes, 0, "pair 0", QUIET)
    axes.set_xlim(right=widest)


def _head_row(axes: Axes, row: int, text: str, color: str) -> None:
    axes.annotate(
        text,
        (1, 1),
        xycoords="axes fraction",
        xytext=(9, 3 + ROW * row),
        textcoords="offset points",
        fontsize=6.5,
        color=color,
    )


def _name(axes: Axes, place: float, row: int, name: str, color: str) -> None:
    if not name:
        return
    axes.annotate(
        f"${name}$",
        (place, 1),
        xycoords=("data", "axes fraction"),
        xytext=(0, 3 + ROW * row),
        textcoords="offset points",
        ha="center",
        fontsize=7.5,
        color=color,
    )


def legend(figure: Figure, axes: Axes, records: Sequence[Record]) -> None:
    """Put one legend below the figure: records by colour, pairs by line."""
    handles, labels = axes.get_legend_handles_labels()
    if len(records) > 1:
        numbers = sorted(
            {pair for record in records for pair in record.pairs}, key=lambda pair: (pair > 1, -pair)
        )
        pairs = [pair for pair in numbers if pair_label(pair) in labels]
        handles = [Line2D([], [], color=PALETTE[i % len(PALETTE)]) for i in range(len(records))]
        handles += [Line2D([], [], color=QUIET, linestyle=PAIR_STYLES.get(pair, "-")) for pair in pairs]
        labels = [*map(record_label, records), *map(pair_label, pairs)]
    if len(labels) > 1:
        figure.legend(
            handles, labels, loc="outside lower center", ncols=min(4, len(labels)), handlelength=2.6
        )
