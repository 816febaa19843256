"""Veciana et al., Machines 12 (2024) 943: cycloidal against involute efficiency under two friction laws."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.validation.rows import Row, compare_paper
from tribodyn.validation.veciana_study import (
    CHOSEN,
    DRIVES,
    LAWS,
    PINION_TEETH,
    DriveUnderLaw,
    Law,
    contact_height,
)

PAPER = "veciana-2024"
#: Generating circles over d_1 of the paper's figures 5 and 6, and which of them is the `CHOSEN` one.
CIRCLES = np.linspace(0.1, 0.4, 31)
_AT_CHOSEN = int(np.argmin(np.abs(CIRCLES - CHOSEN)))


class Efficiencies:
    """Efficiencies, %, of all drives of the study under one law.

    `involute` (drive,), `cycloid` (drive, circle), `crossover` of the first drive, `apart`: maximum distance
    of cycloid and involute at the chosen circles. What is gained, percentage points: `by_circles`, of the
    smallest over the largest, by drive; by circle `by_ratio`, of i = 3 over 1 at module 2 mm, and
    `by_module`, of 6 mm over 2 mm at i = 1.
    """

    def __init__(self, law: Law) -> None:
        studies = [DriveUnderLaw(ratio, module, law) for ratio, module in DRIVES]
        self.involute = 100.0 * np.array([study.involute() for study in studies])
        self.cycloid = 100.0 * np.array([study.cycloid(CIRCLES) for study in studies])
        self.crossover = studies[0].crossover()
        self.exact_speeds = 100.0 * studies[0].cycloid(CHOSEN, exact_speeds=True)
        self.apart = float(np.max(np.abs(self.cycloid[:, _AT_CHOSEN] - self.involute)))
        self.by_circles = self.cycloid[:, 0] - self.cycloid[:, -1]
        self.by_ratio = self.cycloid[2] - self.cycloid[0]
        self.by_module = self.cycloid[4] - self.cycloid[0]


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper. Nothing is written to `folder`: the study needs no simulation."""
    tables: dict[Law, Efficiencies] = {}
    for count, law in enumerate(LAWS):
        tables[law] = Efficiencies(law)
        if progress:
            progress((count + 1) / len(LAWS))
    values, other = (_values(tables["EHL"], tables[reading]) for reading in LAWS[1:])
    return compare_paper(PAPER, values, {"reading B": {key: value for key, (value, _) in other.items()}})


def _geometry() -> dict[str, tuple[Any, str]]:
    study = DriveUnderLaw(1.0, 2e-3, "EHL")
    half = math.pi / PINION_TEETH
    ends = np.array([-half, half]), np.array([0.5, 0.5])
    angle = math.degrees(half / (2.0 * CHOSEN))
    return {
        "veciana/01": (contact_height(study.involute_pair(ends)), ""),
        "veciana/02": (contact_height(study.cycloid_pair(CHOSEN, rotation=ends)), ""),
        "veciana/03": (angle, ""),
    }


def _values(ehl: Efficiencies, mixed: Efficiencies) -> dict[str, tuple[Any, str]]:
    """Value and note of every row, with one reading of the mixed law."""
    values = _geometry()
    for table, (crossover, *circles), (*ratios, least, most) in (
        (ehl, ("04", "06", "07"), ("10", "11", "17", "14")),
        (mixed, ("05", "08", "09"), ("12", "13", "18", "15")),
    ):
        values[f"veciana/{crossover}"] = (table.crossover, "")
        gains = (table.by_circles, circles), (table.by_ratio, ratios), (table.by_module, (least, most))
        for gain, names in gains:
            for name, end in zip(names, (np.argmin, np.argmax), strict=True):
                at = int(end(gain))
                note = ""
                if gain is not table.by_circles:
                    note = f"at d_g = {CIRCLES[at]:.2f} d1; {gain[0]:.4f} at 0.1, {gain[-1]:.4f} at 0.4"
                values[f"veciana/{name}"] = (float(gain[at]), note)
    losses = "; ".join(
        f"{name} {100 - table.cycloid[0, _AT_CHOSEN]:.3f} -> {100 - table.exact_speeds:.3f}, "
        f"involute {100 - table.involute[0]:.3f}"
        for name, table in (("EHL", ehl), ("MEHL", mixed))
    )
    values["veciana/16"] = (
        mixed.apart,
        f"EHL {ehl.apart:.4f}; loss of the cycloid, %, i = 1, m 2 mm, with the paper's rolling speeds -> "
        f"with the motion of the contact along the path in them: {losses}",
    )
    return values
