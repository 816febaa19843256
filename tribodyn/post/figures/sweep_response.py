"""The response to a parameter: quantities of the cases over the first of them."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import SweepDrawing
from tribodyn.post.figures.sweep_branch import (
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
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure
from tribodyn.post.sweep_report import described
from tribodyn.quantities.quantity import Quantity, shown_unit
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE


class ResponsePanel(NamedTuple):
    """A quantity of the cases, and whether its axis starts at 0."""

    quantity: Quantity
    from_zero: bool = False


#: Panels of a picture, at most.
MOST_PANELS = 6
#: Curves that vary by less than this share are constant.
FLAT = 1e-5


def panels_of(records: Sequence[SweepRecord], quantities: Sequence[Quantity]) -> list[ResponsePanel]:
    """Panels of the first quantities that vary; of the first that there are where none does.

    Of no quantities all are taken, as the first record describes them.
    """

    def varies(name: str) -> bool:
        values = np.concatenate([record[name].ravel() for record in records])
        values = values[np.isfinite(values)]
        return bool(values.size) and np.ptp(values) > FLAT * np.max(np.abs(values))

    quantities = quantities or [described(records[0], name) for name in records[0].quantities]
    recorded = [quantity for quantity in quantities if all(quantity.name in record for record in records)]
    varying = [quantity for quantity in recorded if varies(quantity.name)]
    return [ResponsePanel(quantity) for quantity in (varying or recorded)[:MOST_PANELS]]


def _grid(record: SweepRecord, panels: int, maps: bool = False) -> tuple[Figure, np.ndarray]:
    """A figure with axes for panels in two columns, over the first parameter, and room for a legend."""
    columns = min(2, panels)
    count = -(-panels // columns)
    height = PANEL_HEIGHT - 0.1 if maps else PANEL_HEIGHT - 0.2
    figure = new_figure(WIDTH, count * height + 0.6 + 0.6 * (count == 1 and not maps))
    rows = figure.subplots(count, columns, sharex=True, sharey=maps, squeeze=False)
    for axes in rows.flat[panels:]:
        axes.set_visible(False)
    for axes in rows.flat[max(0, panels - columns) : panels]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel(axis_label(record.parameters[0]))
    return figure, rows


def response_figure(records: Sequence[SweepRecord], panels: Sequence[ResponsePanel]) -> Figure:
    """Draw at most `MOST_PANELS` quantities of every case over the first parameter, up and down apart.

    Shaded where contact is lost at times; marked where the motion does not repeat with the mesh.
    """
    if maps_of(records):
        return _maps(records[0], panels)
    figure, rows = _grid(records[0], len(panels))
    curves = branches(records)
    for letter, axes, (quantity, from_zero) in zip("abcdef", rows.flat, panels, strict=False):
        for branch in curves:
            draw_branch(axes, branch, quantity.in_unit(branch.values(quantity.name)))
        draw_unstable(axes, curves, f"unstable_{quantity.name}", quantity.factor)
        axes.margins(x=0.02)
        axes.set_ylabel(literal(quantity.unit))
        if from_zero:
            axes.set_ylim(bottom=0)
        elif np.ptp(axes.dataLim.intervaly) < FLAT * abs(axes.dataLim.y1):
            # a constant: no scale of rounding errors
            axes.set_ylim(0.98 * axes.dataLim.y1, 1.004 * axes.dataLim.y1)
        shade_contact_loss(axes, curves)
        mark_ends(axes, curves)
        mark_panel(axes, letter, literal(quantity.title))
    figure.align_ylabels()
    branch_legend(figure, curves, marks=regime_handles(curves))
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure


def maps_of(records: Sequence[SweepRecord]) -> bool:
    """Whether figures are maps: one record over two numbers, one direction, more curves than colours."""
    record = records[0]
    return (
        len(records) == 1
        and not record.directions
        and len(record.parameters) == 2
        and all(parameter.values.dtype.kind in "fi" for parameter in record.parameters)
        and len(record.parameters[0].values) > 2
        and len(record.parameters[1].values) > MOST_COLORS
    )


def more_than_curves(record: SweepRecord) -> bool:
    """Whether a response has what plain curves lack: maps, ends of branches and what is unstable beyond."""
    return maps_of([record]) or "end_value" in record


def _maps(record: SweepRecord, panels: Sequence[ResponsePanel]) -> Figure:
    """Draw quantities of the cases as maps over both parameters; a dot on every case that loses contact."""
    figure, rows = _grid(record, len(panels), maps=True)
    x, y = (parameter.values * shown_unit(parameter.units)[1] for parameter in record.parameters)
    done = record["status"] == DONE
    lost = np.empty((0, 2), dtype=int)
    if "contact_loss_fraction" in record:
        lost = np.argwhere(done & (record["contact_loss_fraction"] > 0.0))
    for letter, axes, (quantity, _) in zip("abcdef", rows.flat, panels, strict=False):
        values = quantity.in_unit(np.where(done, record[quantity.name], np.nan))
        image = axes.pcolormesh(x, y, values.T, cmap="viridis", shading="nearest", rasterized=True)
        bar = figure.colorbar(image, ax=axes, label=literal(quantity.unit), pad=0.02)
        bar.outline.set_visible(False)
        axes.grid(False)
        mark_panel(axes, letter, literal(quantity.title))
        axes.plot(x[lost[:, 0]], y[lost[:, 1]], ".", color="white", markersize=2.5)
    for axes in rows[:, 0]:
        axes.set_ylabel(axis_label(record.parameters[1]))
    dots = "; white dots: cases that lose contact" if len(lost) else ""
    figure.suptitle(sweep_title([record]) + dots, x=0.01, ha="left", fontsize=9)
    return figure


def response_drawings(quantities: Sequence[Quantity]) -> dict[str, SweepDrawing]:
    """The drawing of a study that has none of its own: its quantities over the first key."""

    def draw(records: Sequence[SweepRecord], _: Mapping[str, float | str]) -> Figure:
        return response_figure(records, panels_of(records, quantities))

    return {"response": SweepDrawing("quantities of the cases over the first varied key", draw, True)}


#: Labels that are drawn, cases that a spectrum is the mean of, seconds of a signal that are shown.
LABELS, CASES, SHOWN = 4, 24, 0.1
#: Characters of a legend in an inch of its width.
CHARACTERS = 18.0


def signals_figure(records: Sequence[SweepRecord], _at: Mapping[str, float | str]) -> Figure:
    """Draw the first signal of a data set: one case of each label over time, and spectra."""
    if len(records) > 1:
        raise records[1].refused("a data set is drawn alone", "draw one after the other")
    record = records[0]
    name = str(record.attrs["sensors"]).split()[0]
    labels, done = record.listed["label"].astype(str), record["status"] == DONE
    time = record[record.dims_of(name)[-1]]
    unit = record.units(name).replace("m/s2", "m/s²")
    figure = new_figure(WIDTH, 2 * PANEL_HEIGHT + 1.2)
    above, below = figure.subplots(2)
    window = np.hanning(len(time))
    frequency = np.fft.rfftfreq(len(time), time[1] - time[0]) / 1e3 if len(time) > 1 else np.zeros(1)
    for number, label in enumerate(list(dict.fromkeys(labels[done]))[:LABELS]):
        color = PALETTE[number % len(PALETTE)]
        chosen = np.flatnonzero(done & (labels == label))[:CASES].tolist()
        piece = time <= SHOWN
        above.plot(time[piece] * 1e3, record.case(name, (chosen[0],))[piece], color=color, linewidth=0.7)
        power = np.zeros(len(frequency))
        for case in chosen:
            values = record.case(name, (case,)).astype(float)
            lines = np.fft.rfft((values - values.mean()) * window)[: len(frequency)]
            power += np.abs(2.0 * lines / np.sum(window)) ** 2 / len(chosen)
        below.semilogy(frequency, np.sqrt(power), color=color, linewidth=0.8, label=literal(label))
    above.set_xlabel("Time (ms)")
    below.set_xlabel("Frequency (kHz)")
    for axes, title in ((above, f"{name}: first case of each label"), (below, "Mean spectrum of each label")):
        axes.set_ylabel(literal(unit))
        axes.margins(x=0.01)
        mark_panel(axes, "", literal(title))
    handles, shown = below.get_legend_handles_labels()
    # in a row of its own: beside the curves, and no wider than the figure
    room = int(
        figure.bbox.width / figure.dpi * CHARACTERS / max([len(label) + 6 for label in shown], default=1)
    )
    how = {"ncols": max(1, min(LABELS, room)), "fontsize": 7, "frameon": False}
    figure.legend(handles, shown, loc="outside lower center", **how)
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure


DATA_SET_DRAWINGS = {
    "signals": SweepDrawing("a signal of each label over time, and the mean spectra", signals_figure)
}
