"""Figures of a drive cycle: duty, losses by term, temperatures of the parts, films over time."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.cases.loss_part import TERMS
from tribodyn.post.figures.drawing import Drawing, drawing, finished, six_panels
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, QUIET, WIDTH, new_figure
from tribodyn.record.reader import Record
from tribodyn.tribology.oil import ZERO_CELSIUS


def _time(axes: Axes, record: Record) -> tuple[np.ndarray, str]:
    """Time in seconds, minutes or hours, and what the axis says."""
    time = record["time"]
    unit, name = next(
        (pair for pair in ((3600.0, "h"), (60.0, "min")) if time[-1] >= 4 * pair[0]), (1.0, "s")
    )
    axes.set_xlabel(f"Time ({name})")
    return time / unit, name


def _duty(axes: Axes, record: Record) -> None:
    time, _ = _time(axes, record)
    axes.plot(time, record["input_speed"] * 30.0 / np.pi, color=PALETTE[0])
    axes.set_ylabel("Speed of the input (rpm)")
    other = axes.twinx()
    other.plot(time, record["load"], color=PALETTE[1], linestyle="--")
    other.set_ylabel("Load over nominal (dashed)")
    other.grid(visible=False)


def _losses(axes: Axes, record: Record) -> None:
    time, _ = _time(axes, record)
    power = np.asarray(record["term_power"])
    shown = [column for column in range(power.shape[1]) if power[:, column].any()]
    names = list(TERMS)
    if shown:
        colors = [PALETTE[number % len(PALETTE)] for number in range(len(shown))]
        axes.stackplot(
            time, power[:, shown].T, labels=[names[column] for column in shown], colors=colors, alpha=0.75
        )
        axes.legend(loc="upper right", fontsize=7, ncols=2)
    axes.set_ylabel("Loss (W)")
    axes.set_ylim(bottom=0.0)


def _temperatures(axes: Axes, record: Record) -> None:
    time, _ = _time(axes, record)
    warm = np.asarray(record["node_temperature"]) - ZERO_CELSIUS
    names = [str(name) for name in record["node"]]
    ends = np.argsort(-warm.max(axis=0))
    for rank, column in enumerate(ends):
        strong = names[column] in ("oil", "housing") or rank < 3
        color = PALETTE[rank % len(PALETTE)] if strong else QUIET
        label = names[column] if strong else None
        axes.plot(time, warm[:, column], color=color, linewidth=1.2 if strong else 0.6, label=label)
    axes.set_ylabel("Temperature (°C)")
    axes.legend(loc="lower right", fontsize=7)


def _film(axes: Axes, record: Record) -> None:
    time, _ = _time(axes, record)
    for number, name in enumerate(record["mesh"]):
        values = 1e6 * np.asarray(record["film_min"])[:, number]
        axes.plot(time, values, color=PALETTE[number % len(PALETTE)], label=str(name))
    axes.set_ylabel("Minimum film (µm)")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="upper right", fontsize=7)


def _powers(axes: Axes, record: Record) -> None:
    time, _ = _time(axes, record)
    axes.plot(time, 1e-3 * record["power_in"], color=PALETTE[0], label="in")
    axes.plot(time, 1e-3 * record["power_out"], color=PALETTE[1], linestyle="--", label="out")
    axes.set_ylabel("Power (kW)")
    axes.legend(fontsize=7)


def _energy(axes: Axes, record: Record) -> None:
    time, _ = _time(axes, record)
    for number, (name, label) in enumerate(
        (("energy_lost", "lost"), ("heat_stored", "stored as heat"), ("heat_gone", "given off"))
    ):
        axes.plot(time, 1e-3 * record[name], color=PALETTE[number], label=label)
    axes.set_ylabel("Energy (kJ)")
    axes.legend(loc="upper left", fontsize=7)


_PANELS = {
    "Duty": _duty,
    "Losses by term": _losses,
    "Temperatures of the parts": _temperatures,
    "Minimum film of each mesh": _film,
    "Power at input and output": _powers,
    "Where the loss goes": _energy,
}


def _overview(records: Sequence[Record], _view: View) -> Figure:
    record = records[0]
    panels = [(title, lambda axes, draw=draw: draw(axes, record)) for title, draw in _PANELS.items()]
    return six_panels(record_title(record), tuple(panels))


def _one(titles: Sequence[str]) -> "Drawing":
    def draw(records: Sequence[Record], _view: View) -> Figure:
        figure = new_figure(WIDTH, len(titles) * PANEL_HEIGHT)
        panels = figure.subplots(len(titles), 1, squeeze=False).ravel()
        for axes, title in zip(panels, titles, strict=True):
            _PANELS[title](axes, records[0])
        return finished(figure, panels, list(titles), records[:1], None)

    return drawing(f"{titles[0].lower()} over the cycle", draw, timeless="a drive cycle")


DRAWINGS: dict[str, Drawing] = {
    "overview": drawing("duty, losses, temperatures, films and energy", _overview, timeless="a drive cycle"),
    "losses": _one(("Losses by term", "Where the loss goes")),
    "temperatures": _one(("Temperatures of the parts", "Duty")),
    "films": _one(("Minimum film of each mesh",)),
}
