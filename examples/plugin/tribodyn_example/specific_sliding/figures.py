"""The study's pictures."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from tribodyn import InputError
from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, new_figure
from tribodyn.record.reader import Record


def _specific_sliding(records: Sequence[Record], view: View) -> Figure:
    if view.against == "time":
        raise InputError("against", "time", "specific sliding is drawn over the path of contact", "omit it")
    drawn = new_figure(WIDTH, PANEL_HEIGHT + 0.6)
    axes = drawn.subplots()
    for number, record in enumerate(records):
        distance = 1e3 * record["signed_distance"]
        for body, style in (("pinion", "-"), ("gear", "--")):
            label = f"{record_label(record)}, {body}" if len(records) > 1 else body
            values, colour = record[f"{body}_specific_sliding"], PALETTE[number % len(PALETTE)]
            axes.plot(distance, values, style, color=colour, label=label)
    axes.set_xlabel("Distance from the pitch point along the path of contact (mm)")
    axes.set_ylabel("Specific sliding")
    axes.legend()
    if len(records) == 1:
        drawn.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return drawn


_ABOUT = "specific sliding of both flanks along the path of contact"
DRAWINGS = {
    "overview": Drawing(_ABOUT, _specific_sliding),
    "specific-sliding": Drawing(_ABOUT, _specific_sliding),
}
