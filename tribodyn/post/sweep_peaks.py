"""Peaks of the quantities that a refined sweep watched: the resonances that it was refined to find."""

from typing import Any

import numpy as np

from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE

#: A peak stands out by this share of its curve's range.
PROMINENCE = 0.05


def peaks(record: SweepRecord) -> list[dict[str, Any]]:
    """Peaks of the watched quantities, curve after curve, the highest first; none of other sweeps.

    Each has its `quantity`, where it is (`at`), its `value`, and `within`: how far from it, in the first
    parameter, the next values are. Values at the ends of the range are no peaks.
    """
    from scipy.signal import find_peaks

    maxima = []
    for name in record.settings.get("refine", {}).get("by", []):
        curves = np.where(record["status"] == DONE, record[name], np.nan)
        x = record.parameters[0].values
        for lane in np.ndindex(curves.shape[1:]):
            curve = curves[(slice(None), *lane)]
            finite = np.flatnonzero(np.isfinite(curve))
            if finite.size < 3:
                continue
            tops, _ = find_peaks(curve[finite], prominence=PROMINENCE * max(np.ptp(curve[finite]), 1e-300))
            for top in sorted(tops, key=lambda top: -curve[finite[top]]):
                before, place, after = finite[top - 1 : top + 2]
                maxima.append(
                    {
                        "quantity": name,
                        "at": record.at((int(place), *lane)),
                        "value": float(curve[place]),
                        "within": float(max(abs(x[place] - x[before]), abs(x[after] - x[place]))),
                    }
                )
    return maxima
