"""Figures 4 to 8 of Efremenkov et al., Mathematics 12 (2024) 873, in mode `as_published`."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, mark_panel, new_figure
from tribodyn.record.reader import Record
from tribodyn.validation.papers.efremenkov import PUBLISHED
from tribodyn.validation.published import published

#: Records by the curve that they are: radius of the generating circle, and of the rolling elements, mm.
CIRCLES = {"$r_2$ = 20 mm": PUBLISHED, "$r_2$ = 30 mm": f"{PUBLISHED}-r2-30"}
RADII = {
    1.2: f"{PUBLISHED}-rb-1.2",
    1.6: f"{PUBLISHED}-rb-1.6",
    2.0: PUBLISHED,
    2.4: f"{PUBLISHED}-rb-2.4",
    2.8: f"{PUBLISHED}-rb-2.8",
}
ELEMENT = "Rolling element"


def _slip(records: Path, name: str) -> np.ndarray:
    """Slip speed of the elements at the start, mm/s."""
    with Record(records / f"{name}.h5") as record:
        return 1e3 * record["slip_speed"][0]


def _loss(records: Path, name: str) -> np.ndarray:
    """N_S of the elements at the start, W."""
    with Record(records / f"{name}.h5") as record:
        return (record["power_cam"] + record["power_crown"])[0]


def slip_by_circle(records: Path) -> Figure:
    """Slip speed over the elements, a panel for each generating circle."""
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    panels = figure.subplots(1, 2)
    for letter, axes, (label, name) in zip("ab", panels, CIRCLES.items(), strict=True):
        slip = _slip(records, name)
        axes.plot(np.arange(1, slip.size + 1), slip, marker="o", markersize=3)
        axes.axhline(0.0, linewidth=0.6, color="k")
        axes.set_xlabel(ELEMENT)
        axes.set_ylabel("$V_s$ (mm/s)")
        mark_panel(axes, letter, label)
    return figure


def over_elements(
    of: Callable[[Path, str], np.ndarray], label: str, curves: dict[str, str], records: Path
) -> Figure:
    """Draw a quantity of the elements over their numbers, a curve for each record."""
    figure = new_figure(WIDTH, PANEL_HEIGHT + 0.6)
    axes = figure.subplots()
    for color, (name, record) in zip(PALETTE, curves.items(), strict=False):
        values = of(records, record)
        axes.plot(np.arange(1, values.size + 1), values, marker="o", markersize=3, color=color, label=name)
    axes.set_xlabel(ELEMENT)
    axes.set_ylabel(label)
    axes.legend()
    return figure


def largest_loss(records: Path) -> Figure:
    """Maximum N_S over the radius of the rolling elements, with the two printed values."""
    figure = new_figure(0.7 * WIDTH, PANEL_HEIGHT + 0.3)
    axes = figure.subplots()
    axes.plot(
        list(RADII), [_loss(records, name).max() for name in RADII.values()], marker="o", label="computed"
    )
    table, ends = published("efremenkov-2024"), (1.2, 2.8)
    values = [table[f"efremenkov/ns-max-rb-{radius}"]["published"] for radius in ends]
    axes.plot(ends, values, linestyle="none", marker="x", markersize=8, color=PALETTE[1], label="printed")
    axes.set_xlabel("$r_b$ (mm)")
    axes.set_ylabel("Maximum $N_S$ (W)")
    axes.legend()
    return figure


_BY_RADIUS = {f"$r_b$ = {radius} mm": name for radius, name in RADII.items()}
_LOSS, _SLIP = "$N_S$ (W)", "$V_s$ (mm/s)"

FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-4": slip_by_circle,
    "figure-5": partial(over_elements, _loss, _LOSS, CIRCLES),
    "figure-6": partial(over_elements, _slip, _SLIP, _BY_RADIUS),
    "figure-7": partial(over_elements, _loss, _LOSS, _BY_RADIUS),
    "figure-8": largest_loss,
}
