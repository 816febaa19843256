"""Curves of a sweep: the first parameter along the abscissa, a branch for every value of the others."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from tribodyn.errors import InputError
from tribodyn.post.style import PALETTE, QUIET
from tribodyn.record.sweep_reader import Parameter, SweepRecord
from tribodyn.record.sweep_schema import DONE

#: Branches that a figure tells apart; of more, so many are shown.
MOST_BRANCHES = 6
#: Units that engineers read, for SI units: name and factor.
SHOWN_IN = {"rad/s": ("rpm", 30 / np.pi), "N*m": ("N m", 1.0), "m": ("mm", 1e3), "rad": ("deg", 180 / np.pi)}
UP, DOWN = "-", (0, (3, 1.5))


class Branch(NamedTuple):
    """One curve: where its cases stand, and how it is drawn.

    Attributes
    ----------
    record : SweepRecord
    place : tuple
        Of its cases in a dataset; a slice stands for the first parameter.
    x : (n,)
        The first parameter as engineers read it.
    color : str
    style : str or tuple
        Line style: solid upwards and for single cases, dashed downwards.
    label : str
        What tells it apart, but for the direction.
    direction : str
        "up", "down" or "".
    """

    record: SweepRecord
    place: tuple[int | slice, ...]
    x: np.ndarray
    color: str
    style: str | tuple[int, tuple[float, ...]]
    label: str
    direction: str

    def values(self, name: str) -> np.ndarray:
        """A dataset along the branch, NaN where a case is not done."""
        values = self.record[name][self.place]
        done = self.record["status"][self.place] == DONE
        return np.where(done.reshape(done.shape + (1,) * (values.ndim - 1)), values, np.nan)


def branches(records: Sequence[SweepRecord]) -> list[Branch]:
    """All branches of the records, at most `MOST_BRANCHES` colours, evenly chosen where there are more.

    Raises
    ------
    InputError
        If a record's first parameter is no number, or the records' first parameters differ.
    """
    keys = {record.parameters[0].key for record in records}
    if len(keys) > 1:
        raise InputError(
            "record", str(records[1].path), f"other first parameters: {', '.join(sorted(keys))}", "draw apart"
        )
    found = []
    for record in records:
        first, *others = record.parameters
        if first.values.dtype.kind not in "fi":
            raise InputError(
                "record", str(record.path), f"{first.key} is not a number", "vary a number first"
            )
        shape = tuple(len(one.values) for one in others)
        for place in np.ndindex(*shape):
            label = ", ".join(_value(one, i) for one, i in zip(others, place, strict=True))
            if len(records) > 1:
                label = f"{record.label}, {label}" if label else record.label
            found.append((record, place, label))
    keep = np.unique(np.linspace(0, len(found) - 1, min(len(found), MOST_BRANCHES)).round().astype(int))
    drawn = []
    for number, chosen in enumerate(keep):
        record, place, label = found[chosen]
        for d, direction in enumerate(record.directions or ("",)):
            index = (slice(None), *place, *((d,) if direction else ()))
            style = DOWN if direction == "down" else UP
            x = record.parameters[0].values * unit(record.parameters[0])[1]
            drawn.append(Branch(record, index, x, PALETTE[number], style, label, direction))
    return drawn


def unit(parameter: Parameter) -> tuple[str, float]:
    """Unit that engineers read a parameter in, and the factor from SI."""
    return SHOWN_IN.get(parameter.units, (parameter.units, 1.0))


def axis_label(parameter: Parameter) -> str:
    """Label an axis: "Pinion speed (rpm)"."""
    name = parameter.name.replace("_", " ").capitalize()
    shown = unit(parameter)[0]
    return name if shown in ("", "1") else f"{name} ({shown})"


def _value(parameter: Parameter, index: int) -> str:
    value = parameter.values[index]
    name, factor = unit(parameter)
    if parameter.values.dtype.kind not in "fi":
        return str(value)
    number = f"{float(value) * factor:.4g}"
    return f"{parameter.name.replace('_', ' ')} {number}" if name == "1" else f"{number} {name}"


def draw_branch(axes: Axes, branch: Branch, values: np.ndarray) -> None:
    """Draw a curve, broken where cases failed, with dots where the cases stand close enough to matter."""
    marker = "." if len(branch.x) <= 80 else ""
    axes.plot(
        branch.x,
        values,
        color=branch.color,
        linestyle=branch.style,
        marker=marker,
        markersize=3,
        linewidth=1.0,
    )


def branch_legend(figure: Figure, drawn: Sequence[Branch], lines: bool = True) -> None:
    """Put one legend below the figure: branches by colour, directions by line where there are `lines`."""
    labels = {branch.label: branch.color for branch in drawn if branch.label}
    handles = [Line2D([], [], color=color, label=label) for label, color in labels.items()]
    if lines and any(branch.direction == "down" for branch in drawn):
        handles.append(Line2D([], [], color=QUIET, linestyle=UP, label="up"))
        handles.append(Line2D([], [], color=QUIET, linestyle=DOWN, label="down"))
    if len(handles) > 1:
        figure.legend(
            handles=handles, loc="outside lower center", ncols=min(4, len(handles)), handlelength=2.6
        )


def sweep_title(records: Sequence[SweepRecord]) -> str:
    """What a sweep is about, and that it is unfinished where it is."""
    record = records[0]
    title = str(record.scenario.get("title", record.label))
    return title if record.status == "complete" else f"{title} [{record.status}]"
