"""The picture of a data set: its legend stands beside the curves, however long the labels are."""

from types import SimpleNamespace
from typing import Any

import numpy as np

from tribodyn.post.figures.sweep_response import signals_figure
from tribodyn.record.sweep_schema import DONE

LABELS = ("healthy", "pinion: pit of tooth 3, 1.0 mm", "gear: crack of tooth 12, 45 %", "pinion: corner 7")


class DataSet(SimpleNamespace):
    """What the picture reads of a record: one case of each label, 200 samples."""

    def __getitem__(self, name: str) -> np.ndarray:
        return np.full(len(LABELS), DONE) if name == "status" else np.arange(200) / 20e3


def test_the_legend_overdraws_nothing():
    rng = np.random.default_rng(1)
    record: Any = DataSet(
        attrs={"sensors": "top"},
        listed={"label": np.array(LABELS)},
        scenario={"title": "A data set"},
        status="complete",
        label="set",
        dims_of=lambda _name: ("case", "time"),
        units=lambda _name: "m/s2",
        case=lambda _name, _case: rng.normal(size=200),
    )
    figure = signals_figure([record], {})
    figure.canvas.draw()
    legend = figure.legends[0].get_window_extent()
    assert legend.y1 < min(axes.get_window_extent().y0 for axes in figure.axes)
    assert figure.bbox.x0 <= legend.x0 < legend.x1 <= figure.bbox.x1
