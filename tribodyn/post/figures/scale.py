"""Limits of a vertical axis that neither magnify rounding errors nor hide the curves behind a spike."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from tribodyn.post.style import QUIET

#: A curve that varies by less than this share of its magnitude is constant.
FLAT = 1e-6
#: Part of the points that spikes may have, on either side.
SPIKES = 0.02
#: Spikes are cut where the rest of the points needs less than this share of the axis.
HIDDEN = 0.35
#: Margin, as a share of what is shown.
MARGIN = 0.08


def scale(axes: Axes, curves: Sequence[np.ndarray], from_zero: bool = False) -> None:
    """Set the limits of the vertical axis for these curves (NaN: gaps); what is beyond is said on the axes.

    A constant is shown about its value with a tenth on either side, zero throughout is said to be that.
    Where few points are far from all others, the axis is that of the others and the extreme is written.
    """
    values = np.concatenate([np.ravel(curve) for curve in curves]) if len(curves) else np.empty(0)
    values = values[np.isfinite(values)]
    if not values.size:
        axes.annotate("nothing to show", (0.5, 0.5), xycoords="axes fraction", ha="center", color=QUIET)
        return
    low, high = float(values.min()), float(values.max())
    size = max(abs(low), abs(high))
    if high - low <= FLAT * size:
        middle = (low + high) / 2.0
        if size == 0.0:
            axes.annotate("0 throughout", (0.5, 0.56), xycoords="axes fraction", ha="center", color=QUIET)
            axes.set_ylim(-1.0, 1.0)
            axes.set_yticks([0.0])
        elif from_zero:
            axes.set_ylim(*sorted((0.0, 1.1 * middle)))
        else:
            axes.set_ylim(middle - 0.1 * size, middle + 0.1 * size)
        return
    inner = np.quantile(values, [SPIKES, 1.0 - SPIKES])
    ends = [low, high]
    for side, sign in ((0, -1.0), (1, 1.0)):
        # what the points but for the spikes need, were this side cut
        needed = abs(float(inner[1] - inner[0])) if not from_zero else float(inner[1])
        beyond = sign * (ends[side] - float(inner[side]))
        if needed > 0.0 and beyond > needed * (1.0 / HIDDEN - 1.0) and not (from_zero and side == 0):
            extreme, ends[side] = ends[side], float(inner[side]) + sign * 0.6 * needed
            mark, place, align = (("▼ down to", 0.03, "bottom"), ("▲ up to", 0.97, "top"))[side]
            text = f"{mark} {extreme:.3g}, cut off"
            axes.annotate(
                text, (0.98, place), xycoords="axes fraction", ha="right", va=align, fontsize=7, color=QUIET
            )
    low, high = ends
    margin = MARGIN * (high - low)
    axes.set_ylim(0.0 if from_zero and low >= 0.0 else low - margin, high + margin)
