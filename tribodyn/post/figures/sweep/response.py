"""The response to a parameter: quantities of the cases over the first of them."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import SweepDrawing
from tribodyn.post.figures.sweep.branch import (
    MOST_COLORS,
    axis_label,
    branch_legend,
    branches,
    draw_branch,
    draw_unstable,
    mark_ends,
    regime_handles,
    shade_contact_loss,
    sweep_title,
)
from tribodyn.post.style import PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure
from tribodyn.post.sweep_report import described
from tribodyn.quantities.quantity import Quantity, shown_unit
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE


class Panel(NamedTuple):
    """A quantity of the cases, and whether its axis starts at 0."""

    quantity: Quantity
    from_zero: bool = False


#: Panels of a picture, at most.
MOST_PANELS = 6
#: Curves that vary by less than this share are constant.
FLAT = 1e-5


def panels_of(records: Sequence[SweepRecord], quantities: Sequence[Quantity]) -> list[Panel]:
    """Panels of the first quantities that vary; of the first that there are where none does.

    Parameters
    ----------
    quantities : those that may be drawn; none: all, as the first record describes them
    """
    quantities = quantities or [described(records[0], name) for name in records[0].quantities]
    known = [one for one in quantities if all(one.name in record for record in records)]
    varying = [one for one in known if _varies(records, one.name)]
    return [Panel(one) for one in (varying or known)[:MOST_PANELS]]


def _varies(records: Sequence[SweepRecord], name: str) -> bool:
    values = np.concatenate([record[name].ravel() for record in records])
    values = values[np.isfinite(values)]
    return bool(values.size) and np.ptp(values) > FLAT * np.max(np.abs(values))


def response_figure(records: Sequence[SweepRecord], panels: Sequence[Panel]) -> Figure:
    """Draw figures of every case over the first parameter; up and down apart where both were followed.

    Shaded where contact is lost at times; marked where the motion does not repeat with the mesh.

    Parameters
    ----------
    panels : at most `MOST_PANELS`
    """
    if maps_of(records):
        return _maps(records[0], panels)
    columns = min(2, len(panels))
    count = -(-len(panels) // columns)
    figure = new_figure(WIDTH, count * (PANEL_HEIGHT - 0.2) + 0.6 + 0.6 * (count == 1))
    rows = figure.subplots(count, columns, sharex=True, squeeze=False)
    for axes in rows.flat[len(panels) :]:
        axes.set_visible(False)
    drawn = branches(records)
    for letter, axes, (quantity, from_zero) in zip("abcdef", rows.flat, panels, strict=False):
        for branch in drawn:
            draw_branch(axes, branch, quantity.in_unit(branch.values(quantity.name)))
        draw_unstable(axes, drawn, f"unstable_{quantity.name}", quantity.factor)
        axes.margins(x=0.02)
        axes.set_ylabel(literal(quantity.unit))
        if from_zero:
            axes.set_ylim(bottom=0)
        elif np.ptp(axes.dataLim.intervaly) < FLAT * abs(axes.dataLim.y1):
            # a constant: no scale of rounding errors
            axes.set_ylim(0.98 * axes.dataLim.y1, 1.004 * axes.dataLim.y1)
        shade_contact_loss(axes, drawn)
        mark_ends(axes, drawn)
        mark_panel(axes, letter, literal(quantity.title))
    for axes in rows.flat[max(0, len(panels) - columns) : len(panels)]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel(axis_label(records[0].parameters[0]))
    figure.align_ylabels()
    branch_legend(figure, drawn, marks=regime_handles(drawn))
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure


def maps_of(records: Sequence[SweepRecord]) -> bool:
    """Whether figures are maps: one record over two numbers, one direction, more curves than colours."""
    record = records[0]
    return (
        len(records) == 1
        and not record.directions
        and len(record.parameters) == 2
        and all(one.values.dtype.kind in "fi" for one in record.parameters)
        and len(record.parameters[0].values) > 2
        and len(record.parameters[1].values) > MOST_COLORS
    )


def _maps(record: SweepRecord, panels: Sequence[Panel]) -> Figure:
    """Draw figures of the cases as maps over both parameters; a dot on every case that loses contact."""
    columns = min(2, len(panels))
    count = -(-len(panels) // columns)
    figure = new_figure(WIDTH, count * (PANEL_HEIGHT - 0.1) + 0.6)
    rows = figure.subplots(count, columns, sharex=True, sharey=True, squeeze=False)
    for axes in rows.flat[len(panels) :]:
        axes.set_visible(False)
    x, y = (one.values * shown_unit(one.units)[1] for one in record.parameters)
    done = record["status"] == DONE
    for letter, axes, (quantity, _) in zip("abcdef", rows.flat, panels, strict=False):
        values = quantity.in_unit(np.where(done, record[quantity.name], np.nan))
        image = axes.pcolormesh(x, y, values.T, cmap="viridis", shading="nearest", rasterized=True)
        bar = figure.colorbar(image, ax=axes, label=literal(quantity.unit), pad=0.02)
        bar.outline.set_visible(False)
        axes.grid(False)
        mark_panel(axes, letter, literal(quantity.title))
        if "contact_loss_fraction" in record:
            lost = np.argwhere(done & (record["contact_loss_fraction"] > 0.0))
            axes.plot(x[lost[:, 0]], y[lost[:, 1]], ".", color="white", markersize=2.5)
    for axes in rows[:, 0]:
        axes.set_ylabel(axis_label(record.parameters[1]))
    for axes in rows.flat[max(0, len(panels) - columns) : len(panels)]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel(axis_label(record.parameters[0]))
    dots = "contact_loss_fraction" in record and np.any(done & (record["contact_loss_fraction"] > 0.0))
    said = "; white dots: cases that lose contact" if dots else ""
    figure.suptitle(sweep_title([record]) + said, x=0.01, ha="left", fontsize=9)
    return figure


def response_drawings(quantities: Sequence[Quantity]) -> dict[str, SweepDrawing]:
    """The drawing of a study that has none of its own: its quantities over the first key."""

    def draw(records: Sequence[SweepRecord], _: Mapping[str, float | str]) -> Figure:
        return response_figure(records, panels_of(records, quantities))

    return {"response": SweepDrawing("quantities of the cases over the first varied key", draw)}
