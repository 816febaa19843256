"""Pictures of an assessment of a train: factors and efficiency over the speed, losses and safeties."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.gears.rating.limits import SAFETIES, least
from tribodyn.post.figures.drawing import Drawing, single
from tribodyn.post.figures.panel import View
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, QUIET, WIDTH, literal, new_figure
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.pair.figures import draw_bars
from tribodyn.studies.assessment.train.report import groups_of

_RPM = 30.0 / math.pi


def overview(records: Sequence[Record], _view: View) -> Figure:
    """Factors and efficiency over the speed, losses and safeties by mesh, of the first record."""
    record = records[0]
    figure = new_figure(WIDTH, 1.64 * PANEL_HEIGHT)
    factors, efficiency, losses, safeties = figure.subplots(2, 2).flat
    _factors(factors, record)
    _over_speed(efficiency, record, {"": 100.0 * record["efficiency"]})
    efficiency.set(title="Efficiency over the speed", ylabel="%")
    _losses(losses, record)
    _safeties(safeties, record)
    return figure


def _over_speed(axes: Axes, record: Record, lines: dict[str, np.ndarray]) -> None:
    speed = record["input_speed"] * _RPM
    for number, (label, values) in enumerate(lines.items()):
        axes.plot(speed, values, "o-", markersize=3, color=PALETTE[number], label=label)
    axes.axvline(float(record.summary["input_speed"]) * _RPM, color=QUIET, linewidth=0.8, linestyle="--")
    axes.set(xlabel="Speed of the input (rpm)")


def _factors(axes: Axes, record: Record) -> None:
    lines = {"dynamic factor": record["dynamic_factor"]}
    if np.any(np.isfinite(record["mesh_load_factor"])):
        lines["mesh load factor K_γ"] = record["mesh_load_factor"]
    _over_speed(axes, record, lines)
    axes.set(title="Load factors over the speed", ylabel="largest of all meshes")
    axes.legend(loc="best")


def _losses(axes: Axes, record: Record) -> None:
    meshes = record.summary[MESHES]
    lost = {
        literal(f"{group} ({len(names)})" if len(names) > 1 else group): 1e-3
        * sum(float(meshes[name]["simulated"]["power_friction_mean"]) for name in names)
        for group, names in groups_of(meshes).items()
    }
    draw_bars(axes, dict(reversed(lost.items())))
    axes.set(title="Loss to tooth friction, of all meshes of a kind (kW)")


def _safeties(axes: Axes, record: Record) -> None:
    """Safeties by the standards (filled) and simulated (open), the worst mesh of a kind; lines: required."""
    meshes, limits = record.summary[MESHES], record.summary.get("limits", {})
    groups = list(groups_of(meshes).items())[::-1]
    for number, (limit, name) in enumerate(SAFETIES.items()):
        if limit in limits:
            required = float(limits[limit]["limit"])
            axes.axvline(required, color=PALETTE[number], linewidth=0.9, linestyle="--")
        for part, fill in (("iso", PALETTE[number]), ("simulated", "none")):
            points = [
                (min(values), place)
                for place, (_, members) in enumerate(groups)
                if (
                    values := [
                        value
                        for mesh in map(meshes.get, members)
                        if (value := least(mesh.get(part, {}).get(name))) is not None
                    ]
                )
            ]
            if points:
                label = f"{literal(name)}, {'standard' if part == 'iso' else 'simulated'}"
                values, places = zip(*points, strict=True)
                axes.scatter(values, places, s=18, facecolors=fill, edgecolors=PALETTE[number], label=label)
    axes.set_yticks(range(len(groups)), [literal(group) for group, _ in groups])
    axes.set_xscale("log")
    axes.margins(0.08, 0.0)
    axes.set_ylim(-0.5, 1.35 * len(groups))  # room for the legend
    axes.set(title="Safeties of the worst mesh; dashed: required")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper center", ncol=2, fontsize=6)


DRAWINGS = {
    "overview": Drawing("factors and efficiency over the speed, losses and safeties by mesh", overview),
    "losses": Drawing("loss to tooth friction of all meshes of a kind", single(_losses)),
    "safeties": Drawing(
        "safeties by the standards and the simulation, worst mesh of a kind", single(_safeties)
    ),
}
