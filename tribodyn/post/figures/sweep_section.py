"""Poincaré sections at the start of a mesh cycle: of one case, and over a parameter."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures.sweep_branch import (
    MARKS,
    Branch,
    axis_label,
    branch_legend,
    branches,
    draw_unstable,
    index_of,
    mark_ends,
    regime_handles,
    sweep_title,
)
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure
from tribodyn.quantities.quantity import shown
from tribodyn.record.sweep_reader import SweepRecord, sweeps_of_meshes
from tribodyn.record.sweep_schema import DONE


def bifurcation_figure(records: Sequence[SweepRecord]) -> Figure:
    """Draw the points of every case's section over the first parameter, a panel for each mesh."""
    of_meshes = sweeps_of_meshes(records)
    figure = new_figure(WIDTH, PANEL_HEIGHT * len(of_meshes) + 0.9)
    rows = figure.subplots(len(of_meshes), 1, squeeze=False, sharex=True)[:, 0]
    curves: list[Branch] = []
    for axes, (mesh, some) in zip(rows, of_meshes.items(), strict=True):
        curves = branches(some)
        for branch in curves:
            points = branch.values("poincare_error") * 1e6
            x = np.repeat(branch.x, points.shape[1]).reshape(points.shape)
            down = branch.direction == "down"
            axes.plot(
                x.ravel(),
                points.ravel(),
                linestyle="none",
                marker=MARKS[branch.direction],
                markersize=3.6 if down else (2.4 if branch.direction else 1.6),
                markerfacecolor="none" if down else branch.color,
                markeredgecolor=branch.color,
                markeredgewidth=0.6,
            )
        axes.set_ylabel("Transmission error (µm)")
        repeats = "Once per mesh cycle, at its start: one point where the motion repeats with the mesh"
        title = f"{literal(mesh)}: once per common period of the meshes" if mesh else repeats
        mark_panel(axes, "", title)
        axes.margins(x=0.02)
        mark_ends(axes, curves)
        draw_unstable(axes, curves, "unstable_poincare_error", 1e6)
    rows[-1].set_xlabel(axis_label(records[0].parameters[0]))
    shown_marks = ("unstable", "a branch ends")
    marks = [handle for handle in regime_handles(curves) if handle.get_label() in shown_marks]
    branch_legend(figure, curves, lines=False, marks=marks)
    figure.suptitle(sweep_title(records), x=0.01, ha="left", fontsize=9)
    return figure


def poincare_figure(records: Sequence[SweepRecord], at: Mapping[str, float | str]) -> Figure:
    """Draw the section of one case of each record: transmission error and its rate at the start of cycles.

    A panel for each mesh. Of the parameters `at` (SI) the nearest case is taken; those not named are chosen
    so that the section has the most points, and the largest spread.
    """
    of_meshes = sweeps_of_meshes(records)
    figure = new_figure(WIDTH * 0.75, 3.2 * len(of_meshes) + 0.4)
    rows = figure.subplots(len(of_meshes), 1, squeeze=False)[:, 0]
    several = len(records) > 1
    places = {record.path: chosen_case(record, at) for record in records}
    titles = []
    for axes, (mesh, some) in zip(rows, of_meshes.items(), strict=True):
        for number, record in enumerate(some):
            place = places[record.path]
            error, rate = (record.case(name, place) for name in ("poincare_error", "poincare_rate"))
            where = described(record, place)
            titles.append(literal(where))
            axes.plot(
                error * 1e6,
                rate * 1e3,
                linestyle="none",
                marker="o",
                markersize=2.5,
                color=PALETTE[number % len(PALETTE)],
                label=literal(f"{record.label}: {where}"),
            )
        axes.set_ylabel("Its rate (mm/s)")
        title = "Poincaré section: the state at the start of each mesh cycle"
        mark_panel(axes, "", f"{literal(mesh)}: at the start of each common period" if mesh else title)
        axes.margins(0.1)
    rows[-1].set_xlabel("Transmission error (µm)")
    if several:
        figure.legend(*rows[0].get_legend_handles_labels(), loc="outside lower center")
    title = sweep_title(records) if several else f"{sweep_title(records)}\n{titles[0]}"
    figure.suptitle(title, x=0.01, ha="left", fontsize=9)
    return figure


def chosen_case(record: SweepRecord, at: Mapping[str, float | str]) -> tuple[int, ...]:
    """Return the place of the case that `at` describes; raises InputError where there is none."""
    scales = {parameter.name: parameter.values for parameter in record.parameters}
    if record.directions:
        scales["direction"] = np.array(record.directions)
    for name in at:
        if name not in scales:
            raise InputError("--at", name, "not a dimension of the sweep", f"one of {', '.join(scales)}")
    wanted = [
        index_of(values, name, at[name]) if name in at else slice(None) for name, values in scales.items()
    ]
    mask = np.zeros(record["status"].shape, dtype=bool)
    mask[tuple(wanted)] = True
    mask &= record["status"] == DONE
    if not mask.any():
        raise record.refused("no case is done there", "choose another, see --at")
    points = record["poincare_error"]
    points = points.reshape(*mask.shape, -1)  # of all meshes
    count = np.sum(np.isfinite(points), axis=-1)
    # the section with the most different points says the most
    spread = np.nanmax(np.where(np.isfinite(points), points, -np.inf), axis=-1)
    spread = spread - np.nanmin(np.where(np.isfinite(points), points, np.inf), axis=-1)
    score = np.where(mask, count + np.nan_to_num(spread / (np.nanmax(spread[mask]) + 1e-300)), -np.inf)
    return tuple(int(i) for i in np.unravel_index(int(np.argmax(score)), score.shape))


def described(record: SweepRecord, place: tuple[int, ...]) -> str:
    """Name a case by its parameters in engineers' units, and its sort of motion."""
    words = [
        f"{parameter.name.replace('_', ' ')} {shown(parameter.values[index].item(), parameter.units)}"
        for parameter, index in zip(record.parameters, place, strict=False)
    ]
    if record.directions:
        words.append(record.directions[place[-1]])
    return f"{', '.join(words)}: {record.case('solution', place)}"
