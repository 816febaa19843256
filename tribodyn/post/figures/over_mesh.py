"""The figures of a gear pair over its mesh cycles, and the six panels that sum them up."""

from collections.abc import Sequence
from functools import partial

from matplotlib.figure import Figure

from tribodyn.post.figures import over_phase as panels
from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import View, draw, legend, record_title
from tribodyn.post.figures.path_of_contact import draw_path, path_figure
from tribodyn.post.figures.spectrum import spectrum_figure
from tribodyn.post.style import mark_panel, new_figure
from tribodyn.record.reader import Record


def overview_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw what the first record holds in six panels."""
    record = records[0]
    drawn = new_figure(11.0, 6.2)
    rows = drawn.subplots(2, 3)
    draw_path(rows[0, 0], record)
    quantities = (
        panels.TRANSMISSION_ERROR,
        panels.NORMAL_LOAD,
        panels.FRICTION_FORCE,
        panels.FILM_THICKNESS,
        panels.EFFICIENCY,
    )
    for axes, quantity in zip(rows.flat[1:], quantities, strict=True):
        draw(axes, [record], quantity, view)
    for letter, axes in zip("abcdef", rows.flat, strict=True):
        mark_panel(axes, letter)
    legend(drawn, rows[0, 2], [record])
    drawn.suptitle(record_title(record), x=0.01, ha="left", fontsize=11)
    return drawn


def _over_phase(name: str, about: str) -> Drawing:
    return Drawing(about, partial(panels.over_phase, name))


#: Of every record over time with loads, films and friction of pairs.
DRAWINGS: dict[str, Drawing] = {
    "overview": Drawing(
        "path of contact, transmission error, load, friction, film, efficiency", overview_figure
    ),
    "transmission-error": _over_phase("transmission-error", "transmission error of every pair"),
    "spectrum": Drawing("spectrum of the rotational transmission error", spectrum_figure),
    "normal-load": _over_phase("normal-load", "normal load of every pair"),
    "friction": _over_phase("friction", "friction force and coefficient"),
    "film": _over_phase("film", "film thickness and film parameter"),
    "entrainment": _over_phase("entrainment", "entrainment and sliding speed"),
    "pressure": _over_phase("pressure", "Hertz pressure and flash temperature"),
    "efficiency": _over_phase("efficiency", "instantaneous efficiency"),
    "mesh-stiffness": _over_phase("mesh-stiffness", "stiffness of every pair"),
    "path-of-contact": Drawing("both gears in mesh, path of contact, key points", path_figure),
}
