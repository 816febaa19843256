"""Pictures of an assessment's record: pressure, temperature and film along the path of contact."""

import math
from collections.abc import Sequence

from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import View
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, new_figure
from tribodyn.record.reader import Record
from tribodyn.studies.assessment.pictures import draw_film, draw_losses
from tribodyn.studies.assessment.standard import ZERO_CELSIUS


def along_path(records: Sequence[Record], _view: View) -> Figure:
    """Hertz pressure, contact temperature and specific film over the roll angle."""
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    panels = figure.subplots(1, 3)
    for number, record in enumerate(records):
        roll, colour = record["roll_angle"] * 180.0 / math.pi, PALETTE[number % len(PALETTE)]
        for axes, values in zip(
            panels,
            (
                record["hertz_pressure"] * 1e-9,
                record["contact_temperature"] - ZERO_CELSIUS,
                record["specific_film"],
            ),
            strict=True,
        ):
            axes.plot(roll, values, color=colour)
    for axes, label in zip(
        panels, ("Hertz pressure (GPa)", "Contact temperature (°C)", "Specific film λ_GF"), strict=True
    ):
        axes.set_title(label)
        axes.set_xlabel("Roll angle (°)")
    return figure


def specific_film(records: Sequence[Record], _view: View) -> Figure:
    """Specific film of the first record beside the standard's."""
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    draw_film(figure.subplots(), records[0])
    return figure


def losses(records: Sequence[Record], _view: View) -> Figure:
    """Loss of the first record by every friction law, and by the standard."""
    figure = new_figure(WIDTH, PANEL_HEIGHT)
    draw_losses(figure.subplots(), records[0].summary)
    return figure


DRAWINGS = {
    "overview": Drawing("pressure, contact temperature and specific film along the path", along_path),
    "specific-film": Drawing("specific film along the path, simulated and by the standard", specific_film),
    "losses": Drawing("loss to tooth friction by every friction law", losses),
}
