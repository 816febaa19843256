"""A panel: one dataset of one or several records over the phase of the mesh, key points marked."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from tribodyn.post.cycles import Window, by_time, in_parts, key_points, last_cycles, pair_curve, stretches
from tribodyn.post.style import INK, PAIR_STYLES, PALETTE, QUIET, ROW, literal, name_above, write_beside
from tribodyn.quantities.quantity import SHOWN
from tribodyn.record import trust
from tribodyn.record.reader import Record

#: A curve that varies by less than this share of its magnitude is constant.
FLAT = 1e-6
#: Part of the points that spikes may have, on either side.
SPIKES = 0.02
#: Spikes are cut where the rest of the points needs less than this share of the axis.
HIDDEN = 0.35
#: Margin, as a share of what is shown.
MARGIN = 0.08


def scale(axes: Axes, curves: Sequence[np.ndarray], from_zero: bool = False) -> None:
    """Set the limits of the vertical axis for these curves (NaN: gaps); what is beyond is said on the axes.

    A constant is shown about its value with a tenth on either side, zero throughout is said to be that.
    Where few points are far from all others, the axis is that of the others and the extreme is written.
    """
    values = np.concatenate([np.ravel(curve) for curve in curves]) if len(curves) else np.empty(0)
    values = values[np.isfinite(values)]
    if not values.size:
        axes.annotate("nothing to show", (0.5, 0.5), xycoords="axes fraction", ha="center", color=QUIET)
        return
    low, high = float(values.min()), float(values.max())
    size = max(abs(low), abs(high))
    if high - low <= FLAT * size:
        middle = (low + high) / 2.0
        if size == 0.0:
            axes.annotate("0 throughout", (0.5, 0.56), xycoords="axes fraction", ha="center", color=QUIET)
            axes.set(ylim=(-1.0, 1.0), yticks=[0.0])
        elif from_zero:
            axes.set_ylim(*sorted((0.0, 1.1 * middle)))
        else:
            axes.set_ylim(middle - 0.1 * size, middle + 0.1 * size)
        return
    inner = np.quantile(values, [SPIKES, 1.0 - SPIKES])
    ends = [low, high]
    for side, sign in ((0, -1.0), (1, 1.0)):
        # what the points but for the spikes need, were this side cut
        needed = abs(float(inner[1] - inner[0])) if not from_zero else float(inner[1])
        beyond = sign * (ends[side] - float(inner[side]))
        if needed > 0.0 and beyond > needed * (1.0 / HIDDEN - 1.0) and not (from_zero and side == 0):
            extreme, ends[side] = ends[side], float(inner[side]) + sign * 0.6 * needed
            mark, place, align = (("▼ down to", 0.03, "bottom"), ("▲ up to", 0.97, "top"))[side]
            how = {"ha": "right", "va": align, "fontsize": 7, "color": QUIET}
            axes.annotate(f"{mark} {extreme:.3g}, cut off", (0.98, place), xycoords="axes fraction", **how)
    margin = MARGIN * (ends[1] - ends[0])
    axes.set_ylim(0.0 if from_zero and ends[0] >= 0.0 else ends[0] - margin, ends[1] + margin)


#: Over more cycles than these, key points would hide the curves.
MOST_CYCLES_MARKED = 4
#: Over more cycles than these, curves would fill the panel: the range within each cycle is drawn.
MOST_CYCLES_DRAWN = 24
#: Shade where a law is extrapolated, by the flag that says so: colour and what the legend says.
EXTRAPOLATED = {
    "closure_in_range": ("#faf0dc", "film law extrapolated"),
    "friction_in_range": ("#faf0dc", "friction law extrapolated"),
}
#: What the numbers of pairs mean, in a legend.
ORDER = {"pair 1": " (entered last)", "pair 0": " (before it)"}
#: What the names of the key points mean.
ENTERS, PASSES, LEAVES = "$B_g$: a pair enters", ",  $P$: it passes the pitch point", ",  $B_p$: it leaves"
KEY_POINTS = ENTERS + PASSES + LEAVES
ALONE = ",  $C_p$ to $C_g$: it carries alone"


class View(NamedTuple):
    """Which part of the records is drawn, and over what."""

    cycles: int | None = 2  # how many of the last whole mesh cycles; None for all
    against: str = "phase"  # `phase` (mesh cycles) or `time` (ms)
    chosen: bool = False  # whether somebody chose that abscissa


class Trace(NamedTuple):
    """A dataset and how engineers read it."""

    dataset: str
    title: str
    #: symbol, unit: for the axis
    symbol: str
    unit: str
    from_zero: bool = False  # whether the axis starts at 0
    flag: str = ""  # dataset that says where the law behind it is inside its range, if any

    @property
    def factor(self) -> float:
        """From SI to the unit."""
        return SHOWN.get(self.unit, ("", 1.0))[1]

    @property
    def label(self) -> str:
        """Label of the axis."""
        return f"{self.symbol} ({self.unit})"


def record_label(record: Record) -> str:
    """Name a record in a legend."""
    return literal(record.label)


def record_title(record: Record) -> str:
    """Return what a record is about, and that it is unfinished or outside its model where it is."""
    title = literal(str(record.scenario.get("title", record.label)))
    marks = [record.status] * (record.status != "complete") + [record.trust] * (record.trust == trust.OUTSIDE)
    return " ".join((title, *(f"[{mark}]" for mark in marks)))


def abscissa(window: Window, view: View) -> np.ndarray:
    """Give the phase from 0 at the first cycle shown, or the time in ms."""
    return window.time * 1e3 if view.against == "time" else window.phase


def draw(
    axes: Axes,
    records: Sequence[Record],
    trace: Trace,
    view: View,
    first: bool = True,
    last: bool = True,
    mesh: int = 0,
) -> int:
    """Draw a dataset of every record, pairs apart where it has pairs, with axis labels and key points.

    Of a `mesh`, without key points where meshes have names. In a stack of panels the `first` alone names the
    key points and the `last` alone the horizontal axis. Over many cycles the range within each cycle and its
    mean are drawn. Returns the rows of names above the axes.
    """
    several = len(records) > 1
    shown = []
    for number, record in enumerate(records):
        window = last_cycles(record, view.cycles)
        x = abscissa(window, view)
        values = record.over_meshes(trace.dataset)[:, mesh] * trace.factor
        color = PALETTE[number % len(PALETTE)] if several else PALETTE[0]
        if window.phase[-1] > MOST_CYCLES_DRAWN:
            shown += draw_ranges(axes, record, values, window, view, color, mesh=mesh)
        elif values.ndim == 1:
            axes.plot(x, values[window.part], color=color)
            shown.append(values[window.part])
        else:
            for position, pair in enumerate(drawn_pairs(record, window, mesh)):
                curve = pair_curve(record, values, pair, window, x, mesh)
                shade = PALETTE[(number if several else position) % len(PALETTE)]
                axes.plot(*curve, color=shade, linestyle=PAIR_STYLES.get(pair, "-"), label=pair_label(pair))
                shown.append(curve[1])
        _shade_extrapolated(axes, record, trace, window, x, color if several else "", mesh)
    axes.set_ylabel(trace.label)
    scale(axes, shown, trace.from_zero)
    if last:
        axes.set_xlabel(abscissa_label(view, records[0]))
    if records[0].names_meshes:
        axes.autoscale(axis="x", tight=True)
        return 0
    return mark_key_points(axes, records, view, first)


def draw_ranges(
    axes: Axes,
    record: Record,
    values: np.ndarray,
    window: Window,
    view: View,
    color: str,
    labels: tuple[str, str] = ("range in a mesh cycle", "mean of a mesh cycle"),
    mesh: int = 0,
) -> list[np.ndarray]:
    """Draw minimum, mean and maximum in each mesh cycle, in a train of its slowest mesh; what is drawn."""
    parts = in_parts(record, window)
    low, mean, high = cycle_ranges(record, values, parts, mesh)
    middle = abscissa(parts, view)[:-1].reshape(-1, parts.samples_per_cycle).mean(axis=1)
    axes.fill_between(middle, low, high, color=color, alpha=0.3, linewidth=0, label=labels[0])
    axes.plot(middle, mean, color=color, linewidth=0.9, label=labels[1])
    return [low, high]


def cycle_ranges(
    record: Record, values: np.ndarray, window: Window, mesh: int = 0
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Minimum, mean and maximum (cycles,) in every `samples_per_cycle`; of pairs those under load; or NaN."""
    values = values[window.part][:-1]
    if values.ndim > 1:
        load = record.over_meshes("normal_load")[window.part, mesh][:-1]
        values = np.where(load > 0.0, values, np.nan)
    parts = len(values) // window.samples_per_cycle
    rows = np.where(np.isfinite(values), values, np.nan).reshape(parts, -1)
    count = np.isfinite(rows).sum(axis=1)
    mean = np.where(count > 0, np.nansum(rows, axis=1) / np.maximum(count, 1), np.nan)
    return np.fmin.reduce(rows, axis=1), mean, np.fmax.reduce(rows, axis=1)


def _shade_extrapolated(
    axes: Axes, record: Record, trace: Trace, window: Window, x: np.ndarray, hue: str, mesh: int
) -> None:
    """Shade where a law is outside its range for any pair under load; in a record's `hue` if given."""
    if trace.flag not in record:
        return
    flag, load = (record.over_meshes(name)[window.part, mesh] for name in (trace.flag, "normal_load"))
    outside = np.any((flag == 0) & (load > 0.0), axis=1)
    color, label = EXTRAPOLATED[trace.flag]
    if hue:
        color, label = f"{hue}18", f"{label}: {record_label(record)}"
    for start, stop in stretches(outside):
        left, right = float(x[start]), float(x[min(stop, len(x) - 1)])
        axes.axvspan(left, right, color=color, linewidth=0, zorder=0.5, label=label)


def drawn_pairs(record: Record, window: Window, mesh: int = 0) -> list[int]:
    """List the pairs to draw: driving flanks from the newest on, then back flanks that carry load."""
    load = record.over_meshes("normal_load")[window.part, mesh]
    carries = np.any(np.isfinite(load), axis=0)  # a mesh of a train may have fewer than another
    front = [pair for pair, loaded in zip(record.pairs, carries, strict=True) if pair <= 1 and loaded]
    touching = [pair for slot, pair in enumerate(record.pairs) if pair > 1 and np.any(load[:, slot] > 0)]
    return front[::-1] + touching


def pair_label(pair: int) -> str:
    """Name a pair."""
    return f"pair {pair}" if pair <= 1 else f"back flanks {pair - 1}"


def abscissa_label(view: View, record: Record) -> str:
    """Label the horizontal axis, with the name of the first mesh where meshes have names."""
    if view.against == "time":
        return "Time (ms)"
    if record.names_meshes:
        return f"Cycles of the mesh {literal(record.meshes[0])}"
    return "Phase (mesh cycles)"


def mark_key_points(axes: Axes, records: Sequence[Record], view: View, named: bool = True) -> int:
    """Draw thin lines at the key points of every cycle, named above the axes unless `named` is off.

    One record: a row for each of its pairs, naming where it is. Several: a row for each record in its colour,
    naming where pair 1 is. Over many cycles lines and names would hide the curves and are left out. Returns
    the rows of names above the axes.
    """
    several = len(records) > 1
    rows, left, right = 0, np.inf, -np.inf
    for number, record in enumerate(records):
        window = last_cycles(record, view.cycles)
        x = abscissa(window, view)
        left, right = min(left, float(x[0])), max(right, float(x[-1]))
        cycles = round(window.phase[-1])
        if by_time(record) or not 0 < cycles <= MOST_CYCLES_MARKED:
            continue
        marks = key_points(record)
        points = [
            (cycle + point.phase, point.names)
            for cycle in range(cycles + 1)
            for point in marks
            if cycle + point.phase <= cycles + 1e-9
        ]
        pairs = [1] if several else sorted({pair for point in marks for pair in point.names}, reverse=True)
        heads = {1: record_label(record)} if several else {pair: f"pair {pair}" for pair in pairs}
        color = PALETTE[number % len(PALETTE)] if several else QUIET
        places = np.interp([phase for phase, _ in points], window.phase, x)
        # one line for all: to make and to draw one for each takes a twentieth of the overview's time
        axes.plot(
            np.repeat(places, 3),
            np.tile([0.0, 1.0, np.nan], len(points)),
            transform=axes.get_xaxis_transform(),
            color=color,
            linewidth=0.6,
            linestyle=":",
            zorder=0.9,
        )
        if not named:
            continue
        rows = len(records) if several else len(pairs)
        for position, pair in enumerate(pairs):
            row = rows - 1 - (number if several else position)
            shade = color if several or position else INK
            above = (9, 3 + ROW * row)
            write_beside(axes, heads[pair], (1, 1), above, 6.5, shade, xycoords="axes fraction")
            for place, (_, names) in zip(places, points, strict=True):
                if pair in names:
                    name_above(axes, place, f"${names[pair]}$", row, shade, 7.5)
    axes.set_xlim(left, right)
    return rows


def legend(figure: Figure, panels: Sequence[Axes], records: Sequence[Record], view: View) -> None:
    """Put one legend below the figure: records by colour, pairs by line, shades, names of key points.

    Where meshes have names each panel is of one record, and has no key points.
    """
    named = any(record.names_meshes for record in records)
    entries: dict[str, Artist] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            entries.setdefault(label, handle)
    if len(records) > 1 and not named:
        of_pairs = {pair_label(pair): pair for record in records for pair in record.pairs}
        lines: dict[str, Artist] = {
            record_label(record): Line2D([], [], color=PALETTE[number % len(PALETTE)])
            for number, record in enumerate(records)
        }
        for label, handle in entries.items():
            style = PAIR_STYLES.get(of_pairs.get(label, 1), "-")
            shade = isinstance(handle, Patch) or label not in of_pairs
            lines[label] = handle if shade else Line2D([], [], color=QUIET, linestyle=style)
        entries = lines
    title = None
    cycles = [round(last_cycles(record, view.cycles).phase[-1]) for record in records if not named]
    if any(0 < count <= MOST_CYCLES_MARKED for count in cycles):
        names = {name for record in records for point in key_points(record) for name in point.names.values()}
        title = ENTERS + PASSES * ("P" in names) + LEAVES + ALONE * ("C_p" in names)
    if len(entries) > 1 or title:
        figure.legend(
            list(entries.values()),
            [f"{label}{ORDER.get(label, '')}" for label in entries],
            loc="outside lower center",
            ncols=max(1, min(3 if len(records) > 1 else 4, len(entries))),
            handlelength=2.6,
            title=title,
            title_fontsize=7.5,
        )
