"""A run revolution by revolution: transmission error, load and film of its meshes."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import View, record_title
from tribodyn.post.figures.scale import scale
from tribodyn.post.style import PALETTE, new_figure
from tribodyn.record.reader import Record

_AXIS = "revolution"
#: Dataset, what stands beside its axis, and what its values are multiplied by.
_ROWS = (
    ("revolution_transmission_error_rms", "Transmission error,\nrms about its mean (µm)", 1e6),
    ("revolution_normal_load_max", "Maximum load\nof a pair (kN)", 1e-3),
    ("revolution_film_thickness_min", "Minimum\nfilm (µm)", 1e6),
)


def has_revolutions(record: Record) -> bool:
    """Whether a record has more than one row by revolution."""
    return _AXIS in record and len(record[_AXIS]) > 1


def revolutions_figure(records: Sequence[Record], _view: View) -> Figure:
    """Draw the rows by revolution of the first record, a curve for each mesh."""
    record = records[0]
    figure = new_figure(7.0, 5.2)
    panels = figure.subplots(len(_ROWS), 1, sharex=True)
    for axes, (name, label, factor) in zip(panels, _ROWS, strict=True):
        values = factor * record.over_meshes(name)
        for column, (mesh, curve) in enumerate(zip(record.meshes, values.T, strict=True)):
            axes.plot(record[_AXIS], curve, color=PALETTE[column % len(PALETTE)], label=mesh, lw=1.0)
        finite = values[np.isfinite(values)]
        scale(axes, [finite] if finite.size else [])
        axes.set_ylabel(label)
    if len(record.meshes) > 1:
        panels[0].legend(fontsize=7, ncols=3)
    panels[-1].set_xlabel("Revolution of the gear that drives the first mesh")
    figure.suptitle(record_title(record), x=0.01, ha="left", fontsize=9)
    return figure


DRAWINGS: dict[str, Drawing] = {
    "revolutions": Drawing(
        "transmission error, load and film by revolution, of gears whose teeth differ",
        revolutions_figure,
        has_revolutions,
    ),
}
