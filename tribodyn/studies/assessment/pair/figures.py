"""Pictures of an assessment: those of its record, and those of the first page of its report."""

import math
from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.cases.assessment_part import ReportCurve
from tribodyn.gears.rating.standard import ZERO_CELSIUS
from tribodyn.post.figures.drawing import Drawing, single
from tribodyn.post.figures.panel import View
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, QUIET, WIDTH, house_style, literal, new_figure
from tribodyn.record.reader import Record
from tribodyn.standards.contact_path import POINTS


def pictures(record: Record, curves: Sequence[ReportCurve]) -> Figure:
    """Curves of the other studies, then the specific film along the path and the losses by friction law."""
    with house_style():
        panels = len(curves) + 2
        rows = math.ceil(panels / 2)
        figure = new_figure(WIDTH, 0.82 * PANEL_HEIGHT * rows)
        axes = list(figure.subplots(rows, 2, squeeze=False).flat)
        for place, curve in zip(axes, curves, strict=False):
            _curve(place, curve)
        draw_film(axes[len(curves)], record)
        draw_losses(axes[len(curves) + 1], record)
        for place in axes[panels:]:
            place.set_visible(False)
    return figure


def _curve(axes: Axes, curve: ReportCurve) -> None:
    for number, (label, values) in enumerate(curve.lines.items()):
        axes.plot(curve.x, values, color=PALETTE[number % len(PALETTE)], label=label)
    if curve.mark is not None:
        axes.axvline(curve.mark, color=QUIET, linewidth=0.8, linestyle="--")
    axes.set(title=curve.title, xlabel=curve.x_label, ylabel=curve.y_label)
    axes.locator_params(axis="x", nbins=5)


def draw_film(axes: Axes, record: Record) -> None:
    """Specific film along the path of contact, and that of the standard at its points."""
    roll = record["roll_angle"] * 180.0 / math.pi
    axes.plot(roll, record["specific_film"], color=PALETTE[0], label="simulated")
    iso, angle_of_point = record.summary.get("iso"), record.summary["point_angles"]
    angles = [float(angle_of_point[name]) * 180.0 / math.pi for name in POINTS]
    if iso:
        axes.plot(
            angles,
            [iso["lambda_GF"][name] for name in POINTS],
            "o",
            color=PALETTE[1],
            markersize=4,
            clip_on=False,
            label="ISO/TS 6336-22",
        )
    permissible = record.summary["margins"].get("iso", {}).get("lambda_GFP")
    if permissible is not None:
        axes.axhline(permissible, color="#b3261e", linewidth=0.9, linestyle="--", label="permissible")
    axes.set_ylim(bottom=0.0)
    axes.set(title="Specific film along the path of contact", xlabel="Roll angle (°)", ylabel="λ_GF")
    axes.legend(loc="best")


def draw_losses(axes: Axes, record: Record) -> None:
    """Loss by every friction law, and by the standard."""
    losses = {literal(name): float(value) for name, value in record.summary["loss_by_law"].items()}
    iso = record.summary.get("iso", {}).get("loss")
    if iso is not None:
        losses["ISO/TR 15144-1"] = float(iso)
    draw_bars(axes, {name: losses[name] for name in sorted(losses, key=losses.__getitem__)})
    axes.set(title="Loss to tooth friction by law (W)")


def draw_bars(axes: Axes, losses: Mapping[str, float]) -> None:
    """Losses by name, the first at the bottom."""
    names = list(losses)
    axes.barh(names, [losses[name] for name in names], color=PALETTE[5], height=0.62)
    for number, name in enumerate(names):
        axes.text(losses[name], number, f" {float(f'{losses[name]:.3g}'):,g}", va="center", fontsize=7)
    axes.grid(visible=False, axis="y")
    axes.set_xlim(0.0, 1.2 * max(max(losses.values()), 1e-12))


def along_path(records: Sequence[Record], _view: View) -> Figure:
    """Hertz pressure, contact temperature and specific film over the roll angle."""
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    panels = figure.subplots(1, 3)
    for number, record in enumerate(records):
        roll, colour = record["roll_angle"] * 180.0 / math.pi, PALETTE[number % len(PALETTE)]
        curves = {
            "Hertz pressure (GPa)": record["hertz_pressure"] * 1e-9,
            "Contact temperature (°C)": record["contact_temperature"] - ZERO_CELSIUS,
            "Specific film λ_GF": record["specific_film"],
        }
        for axes, (label, values) in zip(panels, curves.items(), strict=True):
            axes.plot(roll, values, color=colour)
            axes.set(title=label, xlabel="Roll angle (°)")
    return figure


DRAWINGS = {
    "overview": Drawing("pressure, contact temperature and specific film along the path", along_path),
    "specific-film": Drawing(
        "specific film along the path, simulated and by the standard", single(draw_film)
    ),
    "losses": Drawing("loss to tooth friction by every friction law", single(draw_losses)),
}
