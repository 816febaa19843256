"""Curves of a sweep: the first parameter along the abscissa, a branch for every value of the others."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from tribodyn.errors import InputError
from tribodyn.post.cycles import stretches
from tribodyn.post.style import PALETTE, QUIET, literal
from tribodyn.quantities.quantity import shown, shown_unit
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE, VariedKey

#: Branches that have a colour of the palette each; of more, colours follow their order.
MOST_COLORS = 6
#: Entries of a legend, at most; of more, the first and the last are named.
MOST_NAMED = 16
#: Mark of single cases, by direction: it says which way the parameter went.
MARKS = {"": "o", "up": "^", "down": "v"}
UP, DOWN = "-", (0, (3, 1.5))
#: Shade of the range in which contact is lost.
LOST = "#f1e8dc"
#: Motions that are marked: label and marks.
MOTIONS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("repeats after several mesh cycles", {"marker": "D", "markersize": 4, "markerfacecolor": "none"}),
    ("does not repeat", {"marker": "x", "markersize": 5}),
)
#: Line of unstable motions beyond the ends of branches.
UNSTABLE: dict[str, Any] = {"linestyle": (0, (1.6, 1.3)), "linewidth": 0.8}
#: Mark of an end of a branch.
ENDS: dict[str, Any] = {
    "linestyle": "none",
    "marker": "^",
    "markersize": 4,
    "markerfacecolor": "none",
    "markeredgewidth": 0.8,
}


class Branch(NamedTuple):
    """One curve: where its cases stand, and how it is drawn."""

    record: SweepRecord
    place: tuple[int | slice, ...]  # of its cases in a dataset; a slice stands for the first parameter
    x: np.ndarray  # (n,); the first parameter as engineers read it
    color: str
    #: line style: solid upwards and for single cases, dashed downwards
    style: str | tuple[int, tuple[float, ...]]
    label: str  # what distinguishes it, except the direction
    direction: str  # "up", "down" or ""

    def values(self, name: str) -> np.ndarray:
        """A dataset along the branch, NaN where a case is not done."""
        return self._of_done(self.record[name][self.place])

    def of_first_mesh(self, name: str) -> np.ndarray:
        """The same of the mesh whose cycles the samples of a window are counted in."""
        return self._of_done(self.record.of_cases(name)[self.place])

    def _of_done(self, values: np.ndarray) -> np.ndarray:
        done = self.record["status"][self.place] == DONE
        return np.where(done.reshape(done.shape + (1,) * (values.ndim - 1)), values, np.nan)


def branches(records: Sequence[SweepRecord]) -> list[Branch]:
    """All branches of the records; InputError where their first parameters differ or are no numbers.

    Of a single one up and down have different colours; of several each has its own, up solid, down dashed.
    """
    keys = {record.parameters[0].key for record in records}
    if len(keys) > 1:
        raise records[1].refused(f"other first parameters: {', '.join(sorted(keys))}", "draw apart")
    curves = []
    for record in records:
        first, *others = record.parameters
        if first.values.dtype.kind not in "fi":
            raise record.refused(f"{first.key} is not a number", "vary a number first")
        for place in np.ndindex(*(len(parameter.values) for parameter in others)):
            label = ", ".join(_value(parameter, i) for parameter, i in zip(others, place, strict=True))
            if len(records) > 1:
                label = f"{record.label}, {label}" if label else record.label
            curves.append((record, place, label))
    colors = colors_of(len(curves))
    all_branches = []
    for number, (record, place, label) in enumerate(curves):
        for d, direction in enumerate(record.directions or ("",)):
            index = (slice(None), *place, *((d,) if direction else ()))
            style = DOWN if direction == "down" else UP
            color = PALETTE[d] if len(curves) == 1 else colors[number]
            x = record.parameters[0].values * shown_unit(record.parameters[0].units)[1]
            all_branches.append(Branch(record, index, x, color, style, label, direction))
    return all_branches


def colors_of(count: int) -> list[str]:
    """Colours of so many branches: of the palette, or along a colour map where it has not enough."""
    if count <= MOST_COLORS:
        return list(PALETTE[:count])
    return [to_hex(color) for color in colormaps["viridis"](np.linspace(0.0, 0.92, count))]


def chosen_branch(records: Sequence[SweepRecord], at: Mapping[str, float | str]) -> tuple[list[Branch], str]:
    """The branches, up and down, of the first record nearest to the values `at`, and what to call them.

    Of parameters without a value the first is taken.
    """
    curves = branches(records[:1])
    record = records[0]
    _, *others = record.parameters
    wanted = tuple(
        index_of(parameter.values, parameter.name, at[parameter.name]) if parameter.name in at else 0
        for parameter in others
    )
    matching = [branch for branch in curves if branch.place[1 : len(record.parameters)] == wanted]
    count = len(curves) // len(record.directions or ("",))
    more = f" (one of {count}; choose with --at)" if count > 1 else ""
    return matching, f"{literal(matching[0].label)}{more}"


def index_of(values: np.ndarray, name: str, wanted: float | str) -> int:
    """Index of the nearest value of a parameter; of texts that of the same, or InputError."""
    if values.dtype.kind in "fi":
        return int(np.argmin(np.abs(values - float(wanted))))
    same = np.flatnonzero(values == wanted)
    if not same.size:
        raise InputError("--at", f"{name}={wanted}", "no such value", f"one of {', '.join(map(str, values))}")
    return int(same[0])


def axis_label(parameter: VariedKey) -> str:
    """Label an axis: "Pinion speed (rpm)"."""
    name = parameter.name.replace("_", " ").capitalize()
    unit = shown_unit(parameter.units)[0]
    return literal(f"{name} ({unit})" if unit else name)


def _value(parameter: VariedKey, index: int) -> str:
    text = shown(parameter.values[index].item(), parameter.units, 4)
    return f"{parameter.name.replace('_', ' ')} {text}" if parameter.units == "1" else text


def draw_branch(axes: Axes, branch: Branch, values: np.ndarray) -> None:
    """Draw a curve, broken where cases failed, with dots where they can be distinguished: hollow downwards.

    Where the motion does not repeat with the mesh there is a larger mark, by `MOTIONS`.
    """
    marker = MARKS[branch.direction] if len(branch.x) <= 80 else ""
    axes.plot(
        branch.x,
        values,
        color=branch.color,
        linestyle=branch.style,
        marker=marker,
        markersize=3.4 if branch.direction else 1.8,
        markerfacecolor="white" if branch.direction == "down" else branch.color,
        markeredgewidth=0.6,
        linewidth=1.0,
    )
    for _, style, chosen in motions(branch):
        axes.plot(branch.x[chosen], values[chosen], color=branch.color, linestyle="none", zorder=3, **style)


def motions(branch: Branch) -> Iterator[tuple[str, dict[str, Any], np.ndarray]]:
    """Label, marks and cases (n,) of every sort of motion that does not repeat with the mesh."""
    if "period" not in branch.record or not branch.record.settings.get("steady"):
        return
    period = branch.record["period"][branch.place]
    wandering = (branch.record["status"][branch.place] == DONE) & (period == 0)
    for (label, style), chosen in zip(MOTIONS, (period > 1, wandering), strict=True):
        if chosen.any():
            yield label, style, chosen


def mark_ends(axes: Axes, curves: Sequence[Branch]) -> None:
    """Mark, at the lower edge, where branches that were followed end."""
    for branch in curves:
        if "end_value" in branch.record:
            at = branch.values("end_value").ravel() * shown_unit(branch.record.parameters[0].units)[1]
            height = np.full(len(at), 0.03)
            axes.plot(at, height, color=branch.color, transform=axes.get_xaxis_transform(), **ENDS)


def draw_unstable(axes: Axes, curves: Sequence[Branch], name: str, factor: float) -> None:
    """Draw the branches beyond their ends, where a dataset `name` over case, end and motion was recorded."""
    for branch in curves:
        if name not in branch.record:
            continue
        x = branch.values("unstable_value") * shown_unit(branch.record.parameters[0].units)[1]
        y = branch.values(name) * factor
        for at in np.argwhere(np.isfinite(x).any(axis=-1)):
            axes.plot(x[tuple(at)], y[tuple(at)], color=branch.color, zorder=1.8, **UNSTABLE)


def shade_contact_loss(axes: Axes, curves: Sequence[Branch]) -> None:
    """Shade where contact is lost at times, on any of the branches."""
    for branch in curves:
        if len(branch.x) < 2 or "contact_loss_fraction" not in branch.record:
            continue
        order = np.argsort(branch.x)
        x, lost = branch.x[order], branch.values("contact_loss_fraction")[order] > 0.0
        middle = (x[1:] + x[:-1]) / 2.0
        edges = np.concatenate([x[:1], middle, x[-1:]])
        for first, behind in stretches(lost):
            axes.axvspan(float(edges[first]), float(edges[behind]), color=LOST, linewidth=0, zorder=0)


def regime_handles(curves: Sequence[Branch]) -> list[Artist]:
    """Entries of a legend for the motions that are marked, and for the loss of contact that is shaded."""
    marks = {label: style for branch in curves for label, style, _ in motions(branch)}
    handles: list[Artist] = [
        Line2D([], [], color=QUIET, linestyle="none", label=label, **style) for label, style in marks.items()
    ]
    ending = [branch for branch in curves if "end_value" in branch.record]
    if any(np.isfinite(branch.values("end_value")).any() for branch in ending):
        handles.append(Line2D([], [], color=QUIET, label="a branch ends", **ENDS))
    continued = [branch for branch in curves if "unstable_value" in branch.record]
    if any(np.isfinite(branch.values("unstable_value")).any() for branch in continued):
        handles.append(Line2D([], [], color=QUIET, label="unstable", **UNSTABLE))
    judged = [branch for branch in curves if "contact_loss_fraction" in branch.record]
    if any(np.nanmax(branch.values("contact_loss_fraction"), initial=0.0) > 0.0 for branch in judged):
        handles.append(Patch(color=LOST, label="a curve loses contact"))
    return handles


def branch_legend(
    figure: Figure, curves: Sequence[Branch], lines: bool = True, marks: Sequence[Artist] = ()
) -> None:
    """Put one legend below the figure: branches by colour, directions by line where there are `lines`."""
    labels = {literal(branch.label): branch.color for branch in curves if branch.label}
    if len(labels) > MOST_NAMED:
        first, *_, last = labels
        between = f"… {len(labels) - 2} more in order of colour …"
        labels = {first: labels[first], between: "none", last: labels[last]}
    plain: dict[str, Any] = {} if lines else {"linestyle": "none", "marker": "o", "markersize": 4}
    handles: list[Artist] = [
        Line2D([], [], color=color, label=label, **plain) for label, color in labels.items()
    ]
    if any(branch.direction == "down" for branch in curves):
        single = len({branch.label for branch in curves}) == 1
        ways: tuple[tuple[str, Any], ...] = ("up", UP), ("down", DOWN)
        for direction, style in ways:
            color = next((branch.color for branch in curves if branch.direction == direction), QUIET)
            handles.append(
                Line2D(
                    [],
                    [],
                    color=color if single else QUIET,
                    linestyle=style if lines else "none",
                    marker=MARKS[direction],
                    markersize=4,
                    markerfacecolor="white" if direction == "down" else None,
                    label=f"parameter {'increasing' if direction == 'up' else 'decreasing'}",
                )
            )
    handles += list(marks)
    if len(handles) > 1 or marks:
        figure.legend(
            handles=handles, loc="outside lower center", ncols=min(4, len(handles)), handlelength=2.6
        )


def sweep_title(records: Sequence[SweepRecord]) -> str:
    """What a sweep is about, and that it is unfinished where it is."""
    record = records[0]
    title = literal(str(record.scenario.get("title", record.label)))
    return title if record.status == "complete" else f"{title} [{record.status}]"
