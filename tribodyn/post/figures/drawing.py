"""A figure that a study offers."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.errors import InputError
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.style import PALETTE, mark_panel, new_figure
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


def drawing(
    about: str,
    draw: Callable[[Sequence[Record], View], Figure],
    fits: Callable[[Record], bool] = always,
    missing: tuple[str, str, str] = ("", "", ""),
    *,
    samples: int = 1,
    timeless: str = "",
) -> Drawing:
    """A figure that refuses what it cannot show: records of fewer samples, or that do not fit.

    `missing` is its name, what is wrong with a record that does not fit ("{path}" stands for its path), and
    the remedy; `timeless` is what knows no time, where its records have none.
    """

    def checked(records: Sequence[Record], view: View) -> Figure:
        if timeless and view.against == "time":
            raise InputError("against", "time", f"{timeless} knows no time", "phase")
        for record in records:
            if record.samples < samples:
                raise record.refused("holds no samples to draw", "run the scenario again")
            if not fits(record):
                name, rule, remedy = missing
                raise InputError("plot", name, rule.replace("{path}", str(record.path)), remedy)
        return draw(records, view)

    return Drawing(about, checked, fits)


def single(draw: Callable[[Axes, Record], None]) -> Callable[[Sequence[Record], View], Figure]:
    """A figure of one panel, of the first record."""

    def figure(records: Sequence[Record], _view: View) -> Figure:
        canvas = new_figure()
        draw(canvas.subplots(), records[0])
        return canvas

    return figure


def finished(
    figure: Figure,
    panels: Sequence[Axes] | np.ndarray,
    titles: Sequence[str],
    records: Sequence[Record],
    key: Sequence[tuple[str, Artist]] | None = (),
    *,
    title: str = "",
    columns: int = 4,
    **legend: Any,
) -> Figure:
    """Letter and title the panels, name the only record above them or several below, and the key's lines.

    Without a key (None) the panels themselves name several records. `title` stands in place of the record's,
    `legend` is for the legend of so many columns.
    """
    for letter, axes, text in zip("abcdef", panels, titles, strict=False):
        mark_panel(axes, letter if len(panels) > 1 else "", text)
    figure.align_ylabels()
    if len(records) == 1:
        figure.suptitle(title or record_title(records[0]), x=0.01, ha="left", fontsize=9)
    elif key is not None:
        colours = (PALETTE[number % len(PALETTE)] for number in range(len(records)))
        lines = [Line2D([], [], color=colour) for colour in colours]
        key = [*zip(map(record_label, records), lines, strict=True), *key]
    if key:
        labels, handles = zip(*key, strict=True)
        count = min(columns, len(key))
        figure.legend(handles, labels, loc="outside lower center", ncols=count, **legend)
    return figure


def six_panels(title: str, panels: Sequence[tuple[str, Callable[[Axes], object]]]) -> Figure:
    """An overview of up to six panels, by what each shows and what draws it."""
    figure = new_figure(11.0, 6.2)
    grid = figure.subplots(2, 3).ravel()
    for letter, axes, (about, draw) in zip("abcdef", grid, panels, strict=False):
        draw(axes)
        mark_panel(axes, letter, about)
    for axes in grid[len(panels) :]:
        axes.remove()
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    return figure


def with_whole_markers(figure: Figure) -> Figure:
    """Show markers whole that stand on an edge of their axes; lines that leave their axes stay cut there."""
    for axes in figure.axes:
        low, high = axes.viewLim.min, axes.viewLim.max
        for line in axes.lines:
            if line.get_marker() in ("None", "", " ", None) or line.get_transform() != axes.transData:
                continue
            places = np.asarray(line.get_xydata(), float)
            places = places[np.isfinite(places).all(axis=1)]
            if len(places) and np.all((places >= low) & (places <= high)):
                line.set_clip_on(False)
                line.set_in_layout(False)  # it is inside the axes, which have their room
    return figure


class SweepDrawing(NamedTuple):
    """The same for a figure of sweeps."""

    about: str  # in a line
    #: (records, at) -> Figure; `at` is a parameter's name to its value in SI, for a single case
    draw: Callable[[Sequence[SweepRecord], Mapping[str, float | str]], Figure]
    #: whether it shows quantities of the cases over the first key, as a page does itself
    curves: bool = False
