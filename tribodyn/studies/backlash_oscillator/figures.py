"""Figures of the oscillator with backlash: its response up and down in frequency, and its stability."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.post.figures.drawing import Drawing, drawing, finished
from tribodyn.post.style import INK, PALETTE, PANEL_HEIGHT, QUIET, WIDTH, new_figure
from tribodyn.record.reader import Record

ABSCISSA = "Frequency of the excitation / natural frequency"
UP, DOWN = 0, 1
LINES: dict[int, Any] = {UP: "-", DOWN: (0, (4, 1.6))}
#: Line of unstable motions beyond the ends.
UNSTABLE: dict[str, Any] = {"linestyle": (0, (1.6, 1.3)), "linewidth": 0.9}
#: Mark of an end of a branch.
END: dict[str, Any] = {"markersize": 5, "markerfacecolor": "none", "markeredgewidth": 0.8}
WORDS = {UP: "increasing", DOWN: "decreasing"}


def _response(records: Sequence[Record]) -> Figure:
    """RMS over frequency, heavier where contact is lost; below it the share of time without contact."""
    figure = new_figure(WIDTH, 2.3 * PANEL_HEIGHT)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.2, 1.0))
    for number, record in enumerate(records):
        for direction in (UP, DOWN):
            color = _color(records, number, direction)
            _branch(upper, record, direction, color)
            if "end_frequency" in record:  # marked at the lower edge
                at = record["end_frequency"][record["end_direction"] == direction]
                low = {"transform": upper.get_xaxis_transform(), **END}
                upper.plot(at, np.full(len(at), 0.02), "^", color=color, **low)
            _unstable(upper, record, direction, color, "rms_displacement")
            _unstable(lower, record, direction, color, "contact_loss_fraction", 100.0)
            free = 100.0 * record["contact_loss_fraction"][:, direction]
            lower.plot(record["frequency"], free, color=color, linestyle=LINES[direction])
            back = 100.0 * record["back_contact_fraction"][:, direction]
            if np.nanmax(back, initial=0.0) > 0.0:
                lower.plot(record["frequency"], back, color=color, linestyle=":", linewidth=0.9)
    upper.set_ylabel("RMS of x about its mean\n(half backlashes)")
    lower.set_ylabel("Time without\ncontact (%)")
    for axes in (upper, lower):
        axes.set_ylim(bottom=0)
    titles = "Amplitude of the vibration: root mean square about the mean", "Loss of contact"
    return _finished(figure, (upper, lower), records, titles, losing=True)


def _branch(axes: Axes, record: Record, direction: int, color: str) -> None:
    """One direction: a line through periodic motions broken at jumps, points where nothing repeats."""
    x, y = record["frequency"], record["rms_displacement"][:, direction]
    periodic = record["stable"][:, direction] == 1.0
    losing = periodic & (record["contact_loss_fraction"][:, direction] > 0.0)
    places = jumps(y, periodic)
    gaps = [place + 1 for place in places]

    def broken(values: np.ndarray) -> np.ndarray:
        return np.insert(values, gaps, np.nan)

    band: dict[str, Any] = {"linewidth": 4.5, "alpha": 0.25, "solid_capstyle": "butt", "zorder": 1.5}
    axes.plot(broken(x), broken(np.where(losing, y, np.nan)), color=color, **band)
    axes.plot(broken(x), broken(np.where(periodic, y, np.nan)), color=color, linestyle=LINES[direction])
    marker = "^" if direction == UP else "v"
    axes.plot(x[~periodic], y[~periodic], marker, color=color, markersize=2.5, markeredgewidth=0.0)
    for place in places:
        # on the way up the motion comes from the left, on the way down from the right
        start, end = (place, place + 1) if direction == UP else (place + 1, place)
        arrow = {"arrowstyle": "-|>", "color": color, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (x[end], y[end]), xytext=(x[start], y[start]), arrowprops=arrow)


def _unstable(axes: Axes, record: Record, direction: int, color: str, name: str, factor: float = 1.0) -> None:
    """Draw the branches beyond the ends that were met in a direction."""
    if "unstable_frequency" not in record:
        return
    x, y = record["unstable_frequency"], factor * np.abs(record[f"unstable_{name}"])
    for end in np.flatnonzero(record["end_direction"] == direction) + 1:
        chosen = record["unstable_end"] == end
        axes.plot(x[chosen], y[chosen], color=color, zorder=1.8, **UNSTABLE)


def jumps(values: np.ndarray, periodic: np.ndarray) -> list[int]:
    """Places after which a branch jumps: a step ten times its neighbours', of a tenth of the range."""
    step = np.abs(np.diff(values))
    both = periodic[:-1] & periodic[1:]
    spread = np.nanmax(values, initial=0.0) - np.nanmin(values, initial=np.inf)
    places = []
    for i in np.flatnonzero(both & (np.nan_to_num(step) > 0.1 * spread)):
        neighbours = [step[j] for j in (i - 1, i + 1) if 0 <= j < len(step) and np.isfinite(step[j])]
        if len(step) > 2 and neighbours and step[i] > 10.0 * min(neighbours):
            places.append(int(i))
    return places


def _multipliers(records: Sequence[Record]) -> Figure:
    """Largest modulus, and its angle, of the Floquet multipliers."""
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for number, record in enumerate(records):
        for direction in (UP, DOWN):
            color = _color(records, number, direction)
            modulus = record["multiplier_modulus"][:, direction, 0]
            angle = np.degrees(np.abs(record["multiplier_angle"][:, direction, 0]))
            upper.plot(record["frequency"], modulus, color=color, linestyle=LINES[direction])
            lower.plot(record["frequency"], angle, color=color, linestyle=LINES[direction])
            _unstable(upper, record, direction, color, "multiplier_modulus")
            _unstable(lower, record, direction, color, "multiplier_angle", 180.0 / np.pi)
    upper.axhline(1.0, color=INK, linewidth=0.7)
    upper.set_ylabel("Largest multiplier, modulus")
    upper.set_ylim(bottom=0)
    lower.set(ylabel="its angle (°)", yticks=range(0, 181, 45))
    titles = "Stability: the largest Floquet multiplier; stable below 1", "Its angle: 180° period doubling"
    return _finished(figure, (upper, lower), records, titles, losing=False)


def _color(records: Sequence[Record], number: int, direction: int) -> str:
    return PALETTE[(number if len(records) > 1 else direction) % len(PALETTE)]


def _finished(
    figure: Figure, panels: Sequence[Axes], records: Sequence[Record], titles: Sequence[str], losing: bool
) -> Figure:
    panels[-1].set_xlabel(ABSCISSA)
    key: dict[str, dict[str, Any]] = {}
    for direction, words in WORDS.items():
        color = QUIET if len(records) > 1 else PALETTE[direction]
        key[f"frequency {words}"] = {"color": color, "linestyle": LINES[direction]}
    if any("unstable_frequency" in record for record in records):
        key["unstable"] = UNSTABLE
    if losing:
        key["contact lost for part of the period"] = {"linewidth": 4.5, "alpha": 0.4}
        if any("end_frequency" in record for record in records):
            key["a branch ends (a)"] = {"linestyle": "", "marker": "^", **END}
        if any(np.any(record["stable"] == 0.0) for record in records):
            key["not periodic"] = {"linestyle": "", "marker": "^", "markersize": 3.5}
        if any(np.nanmax(record["back_contact_fraction"], initial=0.0) > 0.0 for record in records):
            key["contact on the back side (b)"] = {"linestyle": ":"}
    lines = [(name, Line2D([], [], **{"color": QUIET, **style})) for name, style in key.items()]
    return finished(figure, panels, titles, records, lines, columns=3, handlelength=2.6)


def _drawing(about: str, draw: Callable[[Sequence[Record]], Figure]) -> Drawing:
    return drawing(about, lambda records, _: draw(records), timeless="a frequency sweep")


DRAWINGS: dict[str, Drawing] = {
    "overview": _drawing("response of the first record", lambda records: _response(records[:1])),
    "response": _drawing("root mean square and loss of contact over frequency", _response),
    "multipliers": _drawing("Floquet multipliers over frequency", _multipliers),
}
