"""Pictures of a search: history, start and best, what the best depends on, the front; and its page."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import Drawing, drawing
from tribodyn.post.figures.panel import View, record_label, record_title, scale
from tribodyn.post.page.page import PageContent
from tribodyn.post.page.page import page as write
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, QUIET, WIDTH, literal, new_figure
from tribodyn.quantities.quantity import Quantity
from tribodyn.record.reader import Record
from tribodyn.studies.design.case import apart, duty_names, naming_key
from tribodyn.studies.design.outcome import LOWER, OBJECTIVES, UPPER, searched
from tribodyn.studies.design.report import (
    PANELS,
    REPORTED,
    bounds,
    number_of,
    quantity_of,
    sentences,
    verdict,
)
from tribodyn.studies.design.teeth import has_teeth, teeth_figure
from tribodyn.studies.pages import figure, sheet
from tribodyn.studies.protocol.study import TextTable

#: Duties that are drawn as bars, at most.
MOST_BARS = 6
#: Characters of a line beside an axis.
LONGEST = 29
START, BEST = QUIET, PALETTE[1]
NO_DESIGN = ("search", "{path} holds no design to draw", "run the scenario again")


class _ShownObjective:
    """An objective of a record in engineers' units."""

    def __init__(self, record: Record, place: int = 0) -> None:
        name = OBJECTIVES[place]
        units = record.units(name)
        about = record.long_name(name).removeprefix("objective: ")
        plain = Quantity(about, about.replace("_", " "), "" if units == "1" else units)
        self.quantity = quantity_of(record.scenario, about) or plain
        more = "maximise" in record.scenario["design"]
        self.factor = -self.quantity.factor if more else self.quantity.factor
        self.values = self.factor * record[name][searched(record)]

    @property
    def label(self) -> str:
        """Label of an axis, over two lines where it is long."""
        title = literal(self.quantity.title)
        lines = fill(title, LONGEST, break_long_words=False, break_on_hyphens=False)
        return lines + (f" ({literal(self.quantity.unit)})" if self.quantity.unit else "")


def _feasible(record: Record) -> np.ndarray:
    """Which evaluations of the search are feasible."""
    return record["feasible"][searched(record)] == 1


def _found(record: Record) -> bool:
    return record.samples > 0 and "objective" in record.summary


def _overview(records: Sequence[Record], _view: View) -> Figure:
    figure = new_figure(WIDTH, 2.0 * PANEL_HEIGHT)
    ends = _draw_front if "objective_2" in records[0] else _draw_duties
    panels = _draw_history, ends, _draw_values, _draw_sensitivities
    for axes, draw in zip(figure.subplots(2, 2).ravel(), panels, strict=True):
        draw(axes, records[:1])
    figure.suptitle(record_title(records[0]), fontsize=8.5, fontweight="bold")
    return figure


def _draw_history(axes: Axes, records: Sequence[Record]) -> None:
    """Objective of every candidate in their order, the best so far, and what the search ends on."""
    shown = _ShownObjective(records[0])
    seen = []
    for number, record in enumerate(records):
        values, feasible = shown.factor * record["objective"][searched(record)], _feasible(record)
        count = np.arange(1, len(values) + 1)
        down = np.sign(shown.factor)
        best = down * np.fmin.accumulate(np.where(feasible, down * values, np.nan))
        color = PALETTE[number % len(PALETTE)]
        axes.plot(count[feasible], values[feasible], ".", color=color, markersize=3, alpha=0.6)
        other = ~feasible & np.isfinite(values)
        axes.plot(count[other], values[other], "x", color=QUIET, markersize=3, markeredgewidth=0.7)
        label = record_label(record) if len(records) > 1 else "best so far"
        axes.step(count, best, where="post", color=color, label=label)
        end = abs(shown.factor) * _first(record, "objective")
        axes.plot(count[-1:], [end], "o", color=BEST, ms=5, clip_on=False, label="" if number else "best")
        seen += [values[np.isfinite(values)], np.array([end])]
    level = abs(shown.factor) * _first(records[0], "objective_start")
    if np.isfinite(level):
        axes.axhline(level, color=START, linestyle=":", label="start")
        seen.append(np.array([level]))
    every = np.concatenate(seen)
    low, high = np.min(every), np.fmax(np.quantile(every, 0.95), level)
    if high > low:
        axes.set_ylim(low - 0.08 * (high - low), high + 0.1 * (high - low))
    else:
        scale(axes, [every])
    axes.set_xlabel("Evaluation (× not feasible)")
    axes.set_ylabel(shown.label)
    axes.set_title("History", loc="left")
    axes.legend(loc="best")


def _draw_duties(axes: Axes, records: Sequence[Record]) -> None:
    """First objective at each duty, at the start and at the best, of the first record."""
    record = records[0]
    shown, duties = _ShownObjective(record), record.summary.get("duties")
    names = duty_names(record.scenario["design"])
    if duties is None:
        heights = [[abs(shown.factor) * _first(record, name)] for name in ("objective_start", "objective")]
        names = [""]
    else:
        heights = [shown.factor * np.asarray(duties[end]) for end in ("start", "best")]
    place = np.arange(len(names))
    bars = len(names) <= MOST_BARS
    for number, (values, color, label) in enumerate(
        zip(heights, (START, BEST), ("start", "best"), strict=True)
    ):
        if bars:
            axes.bar(place + 0.4 * number - 0.2, values, 0.36, color=color, label=label)
        else:
            axes.plot(place, values, ".-", color=color, label=label)
    labels = ["\n".join(map(literal, name.replace("*", " ").split("\n"))) for name in names]
    every = 1 if bars else -(-len(names) // 4)
    axes.set_xticks(place[::every], labels[::every], fontsize=6.5)
    axes.set_ylabel(shown.label)
    axes.set_title("Before and after" + ", by duty" * (len(names) > 1), loc="left")
    axes.margins(y=0.25)
    axes.set_xlim(-0.6, len(names) - 0.4)
    axes.legend(ncols=2)


def _first(record: Record, name: str) -> float:
    """The first objective of the summary under a name; NaN where there is none."""
    value = record.summary.get(name)
    return np.nan if value is None else float(np.atleast_1d(value)[0])


def _draw_values(axes: Axes, records: Sequence[Record]) -> None:
    """Free keys over their ranges: start, best, and those candidates that come within a tenth of it."""
    record = records[0]
    entries = record.scenario["design"]["free"]
    names = [name for name in record if name.startswith("free_")]
    shown, feasible = _ShownObjective(record), _feasible(record)
    values = shown.values * np.sign(shown.factor)
    least = np.nanmin(np.where(feasible, values, np.nan))
    span = abs(np.nan_to_num(_first(record, "objective_start")) * shown.factor)
    near = feasible & (values <= least + 0.1 * abs(least or span))
    keys = [naming_key(entry["key"]) for entry in entries]
    labels = []
    for row, (name, entry) in enumerate(zip(names, entries, strict=True)):
        key = entry["key"] if isinstance(entry["key"], str) else entry["key"][0]
        low, high = bounds(entry)
        shares = (record[name][searched(record)] - low) / ((high - low) or 1.0)
        axes.plot(shares[near], np.full(near.sum(), row), "|", color=PALETTE[0], markersize=7, alpha=0.5)
        written = record.summary["best"].get(key, "")
        with suppress(ValueError):  # of a changed record: shown as it is written, without a place
            share = (number_of(written, entry) - low) / ((high - low) or 1.0)
            axes.plot(share, row, "o", color=BEST, markersize=5, zorder=3)
        labels.append(f"{literal(apart(keys)[row].replace('_', ' '))}\n{literal(_short(written))}")
    axes.set_yticks(range(len(names)), labels, fontsize=6.5)
    axes.set_ylim(len(names) - 0.4, -0.6)
    axes.set_xlim(-0.03, 1.03)
    axes.set_xlabel("Share of the range (● best, | within a tenth of it)")
    axes.set_title("Free keys", loc="left")


def _short(value: Any) -> str:
    number, _, unit = str(value).partition(" ")
    try:
        return f"{float(number):.4g} {unit}".rstrip()
    except ValueError:
        return str(value)


def _draw_sensitivities(axes: Axes, records: Sequence[Record]) -> None:
    """Change of the objective with one key or tolerance moved about the best, of the first record."""
    record = records[0]
    shown, design = _ShownObjective(record), record.scenario["design"]
    keys = [naming_key(entry["key"]) for entry in design["free"]]
    names = [f"{name.replace('_', ' ')} ± 2 %" for name in apart(keys)]
    tolerances = design.get("tolerance", ())
    of_tolerances = apart([tolerance["key"] for tolerance in tolerances])
    names += [
        f"{name.replace('_', ' ')} ± {tolerance['plus_minus']}"
        for name, tolerance in zip(of_tolerances, tolerances, strict=True)
    ]
    best = _first(record, "objective") * abs(shown.factor)
    place = np.arange(len(names))
    for moved, color, label in ((LOWER, PALETTE[5], "down"), (UPPER, PALETTE[2], "up")):
        offset = 0.2 if moved == UPPER else -0.2
        axes.barh(place + offset, shown.factor * record[moved] - best, 0.36, color=color, label=label)
    axes.axvline(0.0, color=INK, linewidth=0.7)
    axes.set_yticks(place, [literal(name) for name in names], fontsize=6.5)
    axes.set_ylim(len(names) - 0.4, -0.6)
    unit = f" ({literal(shown.quantity.unit)})" if shown.quantity.unit else ""
    axes.set_xlabel(f"Change of the objective{unit}")
    axes.set_title("What the best depends on", loc="left")
    axes.margins(x=0.1)
    axes.legend()


def _draw_front(axes: Axes, records: Sequence[Record]) -> None:
    """All feasible candidates, and those that no other is better than in both objectives."""
    for number, record in enumerate(records):
        color = PALETTE[number % len(PALETTE)]
        views, feasible = [_ShownObjective(record, place) for place in (0, 1)], _feasible(record)
        every = (view.values[feasible] for view in views)
        axes.plot(*every, ".", color=color, markersize=3, alpha=0.35)
        front = record.summary.get("front", {})
        both = zip(views, OBJECTIVES, strict=True)
        members = (view.factor * np.atleast_1d(front[name]) for view, name in both)
        label = record_label(record) if len(records) > 1 else "front"
        axes.plot(*members, "o-", color=color, markersize=3.5, label=label)
        for name, mark, shade, text in (
            ("objective_start", "s", START, "start"),
            ("objective", "D", BEST, "compromise"),
        ):
            if (values := record.summary.get(name)) is not None:
                end = (abs(view.factor) * value for view, value in zip(views, values, strict=True))
                axes.plot(*end, mark, color=shade, label=text)
    axes.set(xlabel=_ShownObjective(records[0], 0).label, ylabel=_ShownObjective(records[0], 1).label)
    axes.margins(x=0.05)
    axes.set_title("Front", loc="left")
    axes.legend()


def _panel(
    about: str,
    draw: Callable[[Axes, Sequence[Record]], None],
    height: float = 1.3,
    fits: Callable[[Record], bool] = _found,
    missing: tuple[str, str, str] = NO_DESIGN,
) -> Drawing:
    """A figure of one panel."""

    def drawn(records: Sequence[Record], _view: View) -> Figure:
        canvas = new_figure(WIDTH, height * PANEL_HEIGHT)
        draw(canvas.subplots(), records)
        return canvas

    return drawing(about, drawn, fits, missing)


DRAWINGS: Mapping[str, Drawing] = {
    "overview": drawing(
        "history, start and best, free keys, what the best depends on", _overview, _found, NO_DESIGN
    ),
    "teeth": drawing("outlines and reliefs of the start and of the best", teeth_figure, has_teeth, NO_DESIGN),
    "history": _panel("objective of every candidate, and the best so far", _draw_history, 1.4),
    "duties": _panel("first objective at each duty, at the start and at the best", _draw_duties),
    "free-keys": _panel("where in their ranges good values lie", _draw_values),
    "sensitivities": _panel("change of the objective with one key or tolerance moved", _draw_sensitivities),
    "front": _panel(
        "the front of two objectives",
        _draw_front,
        1.6,
        lambda record: _found(record) and "objective_2" in record,
        ("front", "{path} holds no front of two objectives", "name two in design.minimise"),
    ),
}

#: Pictures on the page, where the record holds enough for them.
PICTURES = ("teeth", "overview", "front")


def page(record: Record) -> str:
    """Write the page of a search's record."""
    pictures = [
        (name, DRAWINGS[name].about, figure(name, [record]))
        for name in PICTURES
        if DRAWINGS[name].fits(record)
    ]
    content = PageContent(
        REPORTED,
        sentences(record),
        PANELS,
        tables=sheet(record),
        heading="Scenario that was searched through",
        found=before_and_after(record),
        pictures=pictures,
        titles={
            name: f"Objective: {_ShownObjective(record, place).quantity.title}"
            for place, name in enumerate(OBJECTIVES)
            if name in record
        },
        verdict=verdict(record),
    )
    return write([record], [content])


def before_and_after(record: Record) -> tuple[TextTable, ...]:
    """Free keys, and all quantities that a summary has a line for, at the start and at the best."""
    summary = record.summary
    if "best" not in summary:
        return ()
    start, best = (summary.get(name, {}) for name in ("start", "best"))
    keys = [(key, str(start.get(key, "not set")), str(value)) for key, value in best.items()]
    before, after = (summary.get(f"quantities_{name}", {}) for name in ("start", "best"))
    rows = [
        row for name, value in after.items() if (row := _row(record.scenario, name, before.get(name), value))
    ]
    columns = ("quantity", "start", "best", "unit", "change")
    of_keys = TextTable("Values of the free keys", ("key", "start", "best"), keys)
    return of_keys, TextTable("Quantities before and after", columns, rows)


def _row(search: Mapping[str, Any], name: str, before: Any, after: Any) -> tuple[str, ...] | None:
    quantity = quantity_of(search, name)
    if quantity is None:
        return None
    change = "no start"
    if before is not None and np.isfinite(before) and before:
        change = f"{100.0 * (after / before - 1.0):+.1f} %"
    first = "not known" if before is None else quantity.written(before)
    return quantity.title, first, quantity.written(after), quantity.unit, change
