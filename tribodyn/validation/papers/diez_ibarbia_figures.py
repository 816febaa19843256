"""Figures 5 to 20 of Diez-Ibarbia et al.: load sharing, losses and efficiency of shifted pairs."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.style import INK, PALETTE, QUIET, mark_panel, new_figure
from tribodyn.validation.papers.diez_ibarbia_study import (
    CONDITIONS,
    SHIFTS,
    Course,
    Scenario,
    at_load,
    course_at_load,
    course_by_equal_loads,
    equal_load_efficiencies,
    mean_friction,
    theoretical_contact_ratio,
)

#: Shifts x1 of the curves over shift; those over the roll angle are at `SHIFTS`.
OVER_SHIFT: dict[Scenario, tuple[float, ...]] = {
    "S1": (0.0, 0.05, 0.1, 0.15, 0.2),
    "S2": (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7),
    "S3": (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7),
}
TITLES: dict[Scenario, str] = {
    "S1": "tip circles fixed",
    "S2": "contact ratio fixed",
    "S3": "tip circles follow the shift",
}
#: The mildest and the most severe condition, which the paper shows.
EXTREMES = ("OC2", "OC4")
ROLL = "Pinion angle from the pitch point (°)"
LOAD_SHARING = "Load sharing $F_N/F_{N\\,max}$ (–)"
LOSS = "$H_{v\\,inst}$ (10$^{-3}$)"
BY_CONDITION = dict(zip(CONDITIONS, PALETTE, strict=False))
DASHED, DOTTED = (0, (4, 1.6)), (0, (1, 1.2))


def comparison(_: Path) -> Figure:
    """Figure 5: both approaches without shift at OC4: load sharing, sliding, friction, loss."""
    figure = new_figure(height=4.6)
    panels = figure.subplots(2, 2, sharex=True)
    courses = {
        "load contact": (course_at_load("S1", 0.0, "OC4"), "-", PALETTE[0]),
        "equal loads (Höhn)": (course_by_equal_loads("S1", 0.0, "OC4"), DASHED, PALETTE[1]),
    }
    labels = (LOAD_SHARING, "Sliding $V_s/V$ (–)", "Friction coefficient µ (–)", LOSS)
    for label, (course, line, colour) in courses.items():
        friction = mean_friction("OC4") + 0.0 * course.roll
        for axes, values in zip(
            panels.flat, (course.share, course.sliding, friction, 1e3 * course.loss), strict=True
        ):
            axes.plot(np.degrees(course.roll), values, linestyle=line, color=colour, label=label)
    for letter, axes, label in zip("abcd", panels.flat, labels, strict=True):
        axes.set(ylabel=label, ylim=(0.0, None))
        mark_panel(axes, letter)
    panels[1, 0].set_ylim(0.0, 1.5 * mean_friction("OC4"))
    for axes in panels[1]:
        axes.set_xlabel(ROLL)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    figure.suptitle("Without shift, OC4")
    return figure


def efficiency(scenario: Scenario, _: Path) -> Figure:
    """Figures 6, 11, 16: efficiency over shift at every operating condition."""
    figure = new_figure(4.6, 3.6)
    axes = figure.subplots()
    shifts = OVER_SHIFT[scenario]
    for condition, colour in BY_CONDITION.items():
        by_model = [100.0 * at_load(scenario, shift, condition).efficiency for shift in shifts]
        equal = np.array([equal_load_efficiencies(scenario, shift, condition) for shift in shifts]).T
        axes.plot(shifts, by_model, color=colour, marker="o", markersize=3, label=condition)
        axes.plot(shifts, 100.0 * equal[0], color=colour, linestyle=DASHED)
        axes.plot(shifts, 100.0 * equal[1], color=colour, linestyle=DOTTED)
    axes.set_xlabel("Shift coefficient $x_1 = -x_2$ (–)")
    axes.set_ylabel("Efficiency (%)")
    axes.set_title(f"{scenario}: {TITLES[scenario]}")
    _legend(
        figure, axes, {"load contact": "-", "Höhn's formula": DASHED, "the integral behind it": DOTTED}, 4
    )
    return figure


def contact_ratio(scenario: Scenario, _: Path) -> Figure:
    """Figures 7, 19: theoretical and effective contact ratio over shift."""
    figure = new_figure(4.2, 2.9)
    axes = figure.subplots()
    shifts = OVER_SHIFT[scenario]
    theory = [theoretical_contact_ratio(scenario, shift) for shift in shifts]
    axes.plot(shifts, theory, color=INK, linestyle=DASHED, label="theoretical")
    for condition in EXTREMES:
        effective = [at_load(scenario, shift, condition).contact_ratio for shift in shifts]
        colour = BY_CONDITION[condition]
        axes.plot(shifts, effective, color=colour, marker="o", markersize=3, label=f"effective, {condition}")
    axes.set_xlabel("Shift coefficient $x_1 = -x_2$ (–)")
    axes.set_ylabel("Contact ratio (–)")
    axes.set_title(f"{scenario}: {TITLES[scenario]}")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def over_roll(scenario: Scenario, quantity: str, _: Path) -> Figure:
    """Figures 8, 12, 17 (load sharing) and 9, 13, 18 (losses) for several shifts, mildest and severest."""
    shifts = SHIFTS[scenario]
    colours = colormaps["viridis"](np.linspace(0.0, 0.88, len(shifts)))

    def curves(axes: Axes, condition: str) -> None:
        for shift, colour in zip(shifts, colours, strict=True):
            course = course_at_load(scenario, shift, condition)
            _draw(axes, course, quantity, color=colour, label=f"$x_1$ = {shift:g}")

    figure, axes = _two_panels(curves, {f"{scenario}, {name}": name for name in EXTREMES}, quantity)
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=len(shifts))
    return figure


def both_approaches(scenario: Scenario, shift: float, _: Path) -> Figure:
    """Figure 14: losses by both approaches with and without shift, at OC2 and OC4."""

    def curves(axes: Axes, condition: str) -> None:
        for x, colour in zip((0.0, shift), PALETTE, strict=False):
            _draw(axes, course_at_load(scenario, x, condition), "loss", color=colour, label=f"$x_1$ = {x:g}")
            _draw(axes, course_by_equal_loads(scenario, x, condition), "loss", color=colour, linestyle=DASHED)

    figure, axes = _two_panels(curves, {f"{scenario}, {name}": name for name in EXTREMES}, "loss")
    _legend(figure, axes, {"load contact": "-", "equal loads (Höhn)": DASHED}, 4)
    return figure


def by_condition(scenario: Scenario, shift: float, _: Path) -> Figure:
    """Figures 10, 15, 20: losses at every operating condition, without and with the largest shift."""

    def curves(axes: Axes, x: float) -> None:
        for condition, colour in BY_CONDITION.items():
            _draw(axes, course_at_load(scenario, x, condition), "loss", color=colour, label=condition)

    figure, axes = _two_panels(curves, {f"{scenario}, $x_1$ = {x:g}": x for x in (0.0, shift)}, "loss")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=5)
    return figure


def _two_panels(
    curves: Callable[[Axes, Any], None], panels_of: dict[str, Any], quantity: str
) -> tuple[Figure, Axes]:
    """Two panels over the roll angle, the curves drawn of what stands behind their titles; and the first."""
    figure = new_figure(height=3.1)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for letter, axes, (title, panel_data) in zip("ab", panels, panels_of.items(), strict=True):
        curves(axes, panel_data)
        axes.axvline(0.0, color=QUIET, linewidth=0.6)
        axes.set(title=title, xlabel=ROLL)
        mark_panel(axes, letter)
    # the limits once both have been drawn: they share them
    panels[0].set(ylabel=LOAD_SHARING if quantity == "share" else LOSS, ylim=(0.0, None))
    return figure, panels[0]


def _draw(axes: Axes, course: Course, quantity: str, **style: Any) -> None:
    values = course.share if quantity == "share" else 1e3 * course.loss
    axes.plot(np.degrees(course.roll), values, **style)


def _legend(figure: Figure, axes: Axes, lines: dict[str, Any], columns: int) -> None:
    """Colours as labelled, and what the line styles mean."""
    handles, labels = axes.get_legend_handles_labels()
    for label, line in lines.items():
        handles += axes.plot([], [], color=QUIET, linestyle=line)
        labels.append(label)
    figure.legend(handles, labels, loc="outside lower center", ncols=columns)


FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-5": comparison,
    "figure-6": partial(efficiency, "S1"),
    "figure-7": partial(contact_ratio, "S1"),
    "figure-8": partial(over_roll, "S1", "share"),
    "figure-9": partial(over_roll, "S1", "loss"),
    "figure-10": partial(by_condition, "S1", 0.2),
    "figure-11": partial(efficiency, "S2"),
    "figure-12": partial(over_roll, "S2", "share"),
    "figure-13": partial(over_roll, "S2", "loss"),
    "figure-14": partial(both_approaches, "S2", 0.5),
    "figure-15": partial(by_condition, "S2", 0.5),
    "figure-16": partial(efficiency, "S3"),
    "figure-17": partial(over_roll, "S3", "share"),
    "figure-18": partial(over_roll, "S3", "loss"),
    "figure-19": partial(contact_ratio, "S3"),
    "figure-20": partial(by_condition, "S3", 0.7),
}
