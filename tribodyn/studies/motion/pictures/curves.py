"""Curves of several meshes, bodies or planets in one panel."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from tribodyn.post import style
from tribodyn.post.cycles import last_cycles
from tribodyn.post.figures.panel import (
    MOST_CYCLES_DRAWN,
    Trace,
    View,
    abscissa,
    abscissa_label,
    draw_ranges,
    scale,
)
from tribodyn.record.reader import Record


def draw_curves(
    axes: Axes, record: Record, values: np.ndarray, names: Sequence[str], trace: Trace, view: View
) -> None:
    """Draw a curve for each name, `values` (samples, names) in SI; over many cycles the range within each.

    Curves of one name have one colour.
    """
    window = last_cycles(record, view.cycles)
    x, shown, distinct = abscissa(window, view), [], list(dict.fromkeys(names))
    named: set[str] = set()
    for number, name in enumerate(names):
        curve = values[:, number] * trace.factor
        color = style.PALETTE[distinct.index(name) % len(style.PALETTE)]
        if not np.any(np.isfinite(curve)):
            continue
        label = "_again" if name in named else style.literal(name)
        named.add(name)
        if window.phase[-1] > MOST_CYCLES_DRAWN:
            labels = "_range", label
            shown += draw_ranges(axes, record, curve, window, view, color, labels)
        else:
            axes.plot(x, curve[window.part], color=color, label=label)
            shown.append(curve[window.part])
    scale(axes, shown, trace.from_zero)
    axes.set_xlim(float(x[0]), float(x[-1]))
    axes.set_ylabel(trace.label)
    axes.set_xlabel(abscissa_label(view, record))
