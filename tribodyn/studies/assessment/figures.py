"""Pictures of an assessment: those of its record, and those of its report."""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from tribodyn.cases.assessment_part import ReportCurve
from tribodyn.gears.rating.limits import SAFETIES
from tribodyn.gears.rating.standard import ZERO_CELSIUS
from tribodyn.post.figures.drawing import Drawing, single
from tribodyn.post.figures.panel import View
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, QUIET, WIDTH, house_style, literal, new_figure
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.reader import MESHES, Record
from tribodyn.standards.contact_path import POINTS
from tribodyn.studies.assessment.report import groups_of, meshes_of, of_mesh

_RPM, _DEGREES = 30.0 / math.pi, 180.0 / math.pi

Panel = Callable[[Axes], None]


def pictures(record: Record, curves: Sequence[ReportCurve], mesh: str = "") -> Figure:
    """Curves of the other studies, then what the record says: of a named mesh, else of the whole gearbox."""
    panels: list[Panel] = [partial(_curve, curve=curve) for curve in curves]
    if mesh:
        panels.append(partial(_film_of, record=record, mesh=mesh))
    elif MESHES in record.summary:
        panels = [partial(draw, record=record) for draw in _OF_GEARBOX]
    else:
        panels += [partial(draw, record=record) for draw in (_film, _losses)]
    with house_style():
        return _arranged(panels, 0.82)


def _arranged(panels: Sequence[Panel], height: float) -> Figure:
    rows = math.ceil(len(panels) / 2)
    figure = new_figure(WIDTH, height * PANEL_HEIGHT * rows)
    axes = list(figure.subplots(rows, 2, squeeze=False).flat)
    for place, draw in zip(axes, panels, strict=False):
        draw(place)
    for place in axes[len(panels) :]:
        place.set_visible(False)
    return figure


def _curve(axes: Axes, curve: ReportCurve) -> None:
    for number, (label, values) in enumerate(curve.lines.items()):
        axes.plot(curve.x, values, color=PALETTE[number % len(PALETTE)], label=label)
    if curve.mark is not None:
        axes.axvline(curve.mark, color=QUIET, linewidth=0.8, linestyle="--")
    axes.set(title=curve.title, xlabel=curve.x_label, ylabel=curve.y_label)
    axes.locator_params(axis="x", nbins=5)


def _film(axes: Axes, record: Record) -> None:
    """Specific film of the worst mesh along its path of contact, and that of the standard at its points."""
    _film_of(
        axes,
        record,
        str(
            record.summary.get("worst_of", {}).get("specific_film_min", next(iter(meshes_of(record.summary))))
        ),
    )


def _film_of(axes: Axes, record: Record, mesh: str) -> None:
    summary = meshes_of(record.summary)[mesh]
    iso, simulated = (summary.get(part, {}).get("lambda_GF") for part in ("iso", "simulated"))
    if simulated:
        angles = [float(summary["point_angles"][name]) * _DEGREES for name in POINTS]
        roll, film = angles, [simulated[name] for name in POINTS]
        if "roll_angle" in record:
            roll, film = record["roll_angle"] * _DEGREES, record["specific_film"]
        axes.plot(roll, film, color=PALETTE[0], label="simulated")
        if iso:
            values = [iso[name] for name in POINTS]
            options: dict[str, Any] = {"markersize": 4, "clip_on": False, "label": "ISO/TS 6336-22"}
            axes.plot(angles, values, "o", color=PALETTE[1], **options)
    permissible = summary.get("margins", {}).get("iso", {}).get("lambda_GFP")
    if permissible is not None:
        axes.axhline(permissible, color="#b3261e", linewidth=0.9, linestyle="--", label="permissible")
    axes.set_ylim(bottom=0.0)
    title = "Specific film along the path of contact" + (f", {mesh}" if mesh else "")
    axes.set(title=literal(title), xlabel="Roll angle (°)", ylabel="λ_GF")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best")


def _losses(axes: Axes, record: Record) -> None:
    """Loss of every kind of mesh; of a pair of gears by every friction law, and by the standard."""
    meshes, unit = record.summary.get(MESHES, {}), "W"
    if meshes:
        losses = {
            literal(f"{group} ({len(names)})" if len(names) > 1 else group): sum(
                float(of_mesh(meshes[name], "simulated", "power_friction_mean")) for name in names
            )
            for group, names in reversed(groups_of(meshes).items())
        }
        if max(losses.values()) > 1e3:
            losses, unit = {name: 1e-3 * loss for name, loss in losses.items()}, "kW"
        what = f"of all meshes of a kind ({unit})"
    else:
        losses = {literal(name): float(value) for name, value in record.summary["loss_by_law"].items()}
        iso = record.summary.get("iso", {}).get("loss")
        losses |= {"ISO/TR 15144-1": float(iso)} if iso is not None else {}
        losses = {name: losses[name] for name in sorted(losses, key=losses.__getitem__)}
        what = f"by law ({unit})"
    axes.barh([*losses], [*losses.values()], color=PALETTE[5], height=0.62)
    for number, loss in enumerate(losses.values()):
        axes.text(loss, number, f" {float(f'{loss:.3g}'):,g}", va="center", fontsize=7)
    axes.grid(visible=False, axis="y")
    axes.set_xlim(0.0, 1.2 * max(max(losses.values()), 1e-12))
    axes.set(title=f"Loss to tooth friction {what}")


def _over_speed(axes: Axes, record: Record, lines: Mapping[str, np.ndarray]) -> None:
    speed, summary = record["input_speed"] * _RPM, record.summary
    for number, (label, values) in enumerate(lines.items()):
        axes.plot(speed, values, "o-", markersize=3, color=PALETTE[number], label=label)
    duty = float(summary["input_speed"] if MESHES in summary else summary["duty"]["pinion_speed"]) * _RPM
    axes.axvline(duty, color=QUIET, linewidth=0.8, linestyle="--")
    axes.set(xlabel="Speed of the input (rpm)")


def _legend_above(axes: Axes) -> None:
    """A legend above the lines, which stay clear of it."""
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.25 * (high - low))
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper center", ncol=2)


def _factors(axes: Axes, record: Record) -> None:
    lines = {"dynamic factor": record["dynamic_factor"]}
    if np.any(np.isfinite(record["mesh_load_factor"])):
        lines["mesh load factor K_γ"] = record["mesh_load_factor"]
    _over_speed(axes, record, lines)
    axes.set(title="Load factors over the speed", ylabel="largest of all meshes")
    _legend_above(axes)


def _efficiency(axes: Axes, record: Record) -> None:
    _over_speed(axes, record, {"": 100.0 * record["efficiency"]})
    axes.set(title="Efficiency over the speed", ylabel="%")


def _films_over_speed(axes: Axes, record: Record) -> None:
    lines = {literal(QUANTITIES[name].symbol): record[name] for name in ("S_B", "S_lambda")}
    _over_speed(axes, record, {name: values for name, values in lines.items() if np.any(np.isfinite(values))})
    axes.set(title="Simulated safeties over the speed", ylabel="smallest of all meshes", ylim=(0.0, None))
    _legend_above(axes)


def _safeties(axes: Axes, record: Record) -> None:
    """Safeties by the standards (filled) and simulated (open), the worst mesh of a kind; lines: required."""
    meshes, limits = meshes_of(record.summary), record.summary.get("limits", {})
    groups = [*groups_of(meshes).items()][::-1]
    for number, (limit, name) in enumerate(SAFETIES.items()):
        if limit in limits:
            required = float(limits[limit]["limit"])
            axes.axvline(required, color=PALETTE[number], linewidth=0.9, linestyle="--")
        for part, fill in (("iso", PALETTE[number]), ("simulated", "none")):
            margins = [
                [meshes[mesh].get("margins", {}).get(part, {}).get(name) for mesh in members]
                for _, members in groups
            ]
            known = [[value for value in values if value is not None] for values in margins]
            points = [(min(values), place) for place, values in enumerate(known) if values]
            if points:
                by = "standard" if part == "iso" else "simulated"
                label = f"{literal(QUANTITIES[name].symbol)}, {by}"
                values, places = zip(*points, strict=True)
                axes.scatter(values, places, s=18, facecolors=fill, edgecolors=PALETTE[number], label=label)
    axes.set_yticks(range(len(groups)), [literal(group or "mesh") for group, _ in groups])
    axes.set_xscale("log")
    axes.margins(0.08, 0.0)
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_ylim(-0.5, 1.35 * len(groups))  # room for the legend
    axes.set(title="Safeties of the worst mesh; dashed: required")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper center", ncol=2, fontsize=6, frameon=True, framealpha=1.0, edgecolor="none")


_OF_GEARBOX = (_factors, _efficiency, _losses, _safeties)


def _overview(records: Sequence[Record], _view: View) -> Figure:
    """Values along the path of contact; of the first gearbox its meshes, and its motion over the speed."""
    if MESHES in records[0].summary:
        return _arranged([partial(draw, record=records[0]) for draw in _OF_GEARBOX], 0.82)
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    panels = figure.subplots(1, 3)
    for number, record in enumerate(records):
        roll, colour = record["roll_angle"] * _DEGREES, PALETTE[number % len(PALETTE)]
        curves = {
            "Hertz pressure (GPa)": record["hertz_pressure"] * 1e-9,
            "Contact temperature (°C)": record["contact_temperature"] - ZERO_CELSIUS,
            "Specific film λ_GF": record["specific_film"],
        }
        for axes, (label, values) in zip(panels, curves.items(), strict=True):
            axes.plot(roll, values, color=colour)
            axes.set(title=label, xlabel="Roll angle (°)")
    return figure


def _has_curves(record: Record) -> bool:
    """Whether a record has values over the speed, safeties among them."""
    return "S_B" in record


def _has_films(record: Record) -> bool:
    return any("point_angles" in mesh for mesh in meshes_of(record.summary).values())


DRAWINGS = {
    "overview": Drawing(
        "pressure, contact temperature and film along the path; of a gearbox factors, efficiency, losses, "
        "safeties",
        _overview,
    ),
    "specific-film": Drawing(
        "specific film of the worst mesh along its path, simulated and by the standard",
        single(_film),
        _has_films,
    ),
    "losses": Drawing("loss to tooth friction by friction law, of a gearbox by mesh", single(_losses)),
    "safeties": Drawing(
        "safeties by the standards and the simulation, worst mesh of a kind", single(_safeties)
    ),
    "load-factors": Drawing(
        "dynamic factor and load of the planets over the speed", single(_factors), _has_curves
    ),
    "safeties-over-speed": Drawing(
        "safeties against scuffing and micropitting over the speed", single(_films_over_speed), _has_curves
    ),
}
