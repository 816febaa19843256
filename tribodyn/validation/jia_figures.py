"""Figures 14, 16, 17 and 19 to 21 of Jia et al.: loads along the face, stresses over the pinion's angle.

Where the paper draws contact stress these show the maximum line load along the face, which its figures
behave like (docs/validation.md); Hertz pressures have a figure of their own.
"""

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tribodyn.post.style import mark_panel, new_figure
from tribodyn.validation.jia import CROWNED, FaceState, Name, face_load, passage

RELIEFS = (0.0, 4.0, 8.0, 12.0)
MINUTES = (0.0, 1.0, 2.0, 3.0)
FACE = "From the middle of the face (mm)"
ROLL = "Pinion angle from the pitch point (°)"
LINE_LOAD = "Line load (N/mm)"
QUANTITIES = {
    "line_load": ("Maximum line load (N/mm)", 1e-3),
    "pressure": ("Hertz pressure (GPa)", 1e-9),
    "compression": ("Root compression (MPa)", 1e-6),
    "tension": ("Root tension (MPa)", 1e-6),
}
#: The four panels of figures 17 and 19 to 21.
PANELS: tuple[tuple[str, Name, FaceState], ...] = (
    ("involute, unmodified", "involute", FaceState()),
    ("parabolic, unmodified", "parabolic", FaceState()),
    ("involute, 8/8 µm, 8 mm", "involute", CROWNED),
    ("parabolic, 8/8 µm, 8 mm", "parabolic", CROWNED),
)


def relieved_faces(_: Path) -> Figure:
    """Figure 14: load along the face at the pitch point under relief, parabolic."""
    figure = new_figure(height=3.0)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for letter, axes, unmodified in zip("ab", panels, (0.0, 8.0), strict=True):
        for relief, colour in zip(RELIEFS, _shades(RELIEFS), strict=True):
            _draw_face(
                axes, "parabolic", FaceState(relief, unmodified), colour, f"$y_1 = y_2$ = {relief:g} µm"
            )
        axes.set_title(f"parabolic, $y_3$ = {unmodified:g} mm")
        mark_panel(axes, letter)
    _finish(figure, panels.flat, FACE, LINE_LOAD)
    return figure


def relieved_stresses(_: Path) -> Figure:
    """Figure 16: line load and root stresses over the pinion's angle under relief, parabolic."""
    figure = new_figure(height=7.2)
    panels = figure.subplots(3, 2, sharex=True, sharey="row")
    for row, quantity in zip(panels, ("line_load", "compression", "tension"), strict=True):
        for axes, unmodified in zip(row, (0.0, 8.0), strict=True):
            for relief, colour in zip(RELIEFS, _shades(RELIEFS), strict=True):
                state = FaceState(relief, unmodified)
                _draw_passage(axes, "parabolic", state, quantity, colour, f"$y_1 = y_2$ = {relief:g} µm")
            axes.set_title(f"parabolic, $y_3$ = {unmodified:g} mm")
        row[0].set_ylabel(QUANTITIES[quantity][0])
        row[0].set_ylim(bottom=0.0)
    for letter, axes in zip("abcdef", panels.flat, strict=True):
        mark_panel(axes, letter)
    for axes in panels[-1]:
        axes.set_xlabel(ROLL)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def misaligned_faces(_: Path) -> Figure:
    """Figure 17: load along the face at the pitch point under misalignment."""
    return _four(_draw_face, FACE, LINE_LOAD)


def misaligned_passages(quantity: str, _: Path) -> Figure:
    """Figures 19 (line load; Hertz pressure), 20 and 21 (root stress) under misalignment."""

    def draw(axes: Axes, name: Name, state: FaceState, colour: Any, label: str) -> None:
        _draw_passage(axes, name, state, quantity, colour, label)

    return _four(draw, ROLL, QUANTITIES[quantity][0])


def _four(draw: Callable[[Axes, Name, FaceState, Any, str], None], along: str, across: str) -> Figure:
    figure = new_figure(height=5.2)
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for letter, axes, (title, name, state) in zip("abcd", panels.flat, PANELS, strict=True):
        for minutes, colour in zip(MINUTES, _shades(MINUTES), strict=True):
            draw(axes, name, state._replace(misalignment=minutes), colour, f"{minutes:g}′")
        axes.set_title(title)
        mark_panel(axes, letter)
    for axes in panels[1]:
        axes.set_xlabel(along)
    for axes in panels[:, 0]:
        axes.set_ylabel(across)
    panels[0, 0].set_ylim(bottom=0.0)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _finish(figure: Figure, panels: Iterable[Axes], along: str, across: str) -> None:
    first, *_ = panels = list(panels)
    for axes in panels:
        axes.set_xlabel(along)
    first.set_ylabel(across)
    first.set_ylim(bottom=0.0)
    figure.legend(*first.get_legend_handles_labels(), loc="outside lower center", ncols=4)


def _draw_face(axes: Axes, name: Name, state: FaceState, colour: Any, label: str) -> None:
    place, load = face_load(name, state)
    axes.plot(1e3 * place, 1e-3 * load, color=colour, label=label)


def _draw_passage(axes: Axes, name: Name, state: FaceState, quantity: str, colour: Any, label: str) -> None:
    course = passage(name, state)
    values = getattr(course, quantity)
    axes.plot(np.degrees(course.roll), QUANTITIES[quantity][1] * values, color=colour, label=label)


def _shades(values: tuple[float, ...]) -> Any:
    return colormaps["viridis"](np.linspace(0.0, 0.88, len(values)))


FIGURES: dict[str, Callable[[Path], Figure]] = {
    "figure-14": relieved_faces,
    "figure-16": relieved_stresses,
    "figure-17": misaligned_faces,
    "figure-19": partial(misaligned_passages, "line_load"),
    "figure-19-pressure": partial(misaligned_passages, "pressure"),
    "figure-20": partial(misaligned_passages, "compression"),
    "figure-21": partial(misaligned_passages, "tension"),
}
