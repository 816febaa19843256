"""Veciana et al., Machines 12 (2024) 943: cycloidal against involute efficiency under two friction laws."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.validation.rows import Row, compare, published
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
#: Generating circles over d_1 between which the paper gives its gains.
SMALL, LARGE = 0.1, 0.4


class Efficiencies:
    """Efficiencies, %, of all drives of the study under one law.

    `involute` (drive,), `cycloid` (drive, circle) at `SMALL`, `CHOSEN` and `LARGE` circles, `crossover` of
    the first drive, `apart`: maximum distance of cycloid and involute at the chosen circles. What is gained,
    percentage points: `by_circles`, of the smallest over the largest, by drive; by the smallest and largest
    circles `by_ratio`, of i = 3 over 1 at module 2 mm, and `by_module`, of 6 mm over 2 mm at i = 1.
    """

    def __init__(self, law: Law) -> None:
        studies = [DriveUnderLaw(ratio, module, law) for ratio, module in DRIVES]
        circles = np.array([SMALL, CHOSEN, LARGE])
        self.involute = 100.0 * np.array([study.involute() for study in studies])
        self.cycloid = 100.0 * np.array([study.cycloid(circles) for study in studies])
        self.crossover = studies[0].crossover()
        self.exact_speeds = 100.0 * studies[0].cycloid(circles, exact_speeds=True)
        self.apart = float(np.max(np.abs(self.cycloid[:, 1] - self.involute)))
        self.by_circles = self.cycloid[:, 0] - self.cycloid[:, 2]
        self.by_ratio = (self.cycloid[2] - self.cycloid[0])[[0, 2]]
        self.by_module = (self.cycloid[4] - self.cycloid[0])[[0, 2]]


def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
    """All rows of the paper. Nothing is written to `folder`: the study needs no simulation."""
    tables = {}
    for count, law in enumerate(LAWS):
        tables[law] = Efficiencies(law)
        if progress:
            progress((count + 1) / len(LAWS))
    values: dict[str, tuple[Any, ...]] = {**_geometry(), **_efficiencies(tables)}
    table = published(PAPER)
    return [compare(table[key], *values[key]) for key in table]


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


def _efficiencies(tables: dict[Law, Efficiencies]) -> dict[str, tuple[Any, ...]]:
    ehl, literal, other = (tables[law] for law in LAWS)

    def both(value: Callable[[Efficiencies], Any]) -> tuple[float, str, tuple[str, float]]:
        a, b = float(value(literal)), float(value(other))
        readings = f"reading A (as printed) {a:.4g}, reading B (maximum pressure, own speeds) {b:.4g}"
        return a, readings, ("reading B", b)

    exact = "; ".join(
        f"{name} {100 - table.cycloid[0, 1]:.3f} -> {100 - table.exact_speeds[1]:.3f}, "
        f"involute {100 - table.involute[0]:.3f}"
        for name, table in tables.items()
    )
    return {
        "veciana/04": (ehl.crossover, ""),
        "veciana/05": both(lambda table: table.crossover),
        "veciana/06": (float(ehl.by_circles.min()), ""),
        "veciana/07": (float(ehl.by_circles.max()), ""),
        "veciana/08": both(lambda table: table.by_circles.min()),
        "veciana/09": both(lambda table: table.by_circles.max()),
        "veciana/10": (float(ehl.by_ratio.min()), ""),
        "veciana/11": (float(ehl.by_ratio.max()), ""),
        "veciana/12": both(lambda table: table.by_ratio.min()),
        "veciana/13": both(lambda table: table.by_ratio.max()),
        "veciana/14": (float(ehl.by_module.max()), ""),
        "veciana/15": both(lambda table: table.by_module.max()),
        "veciana/17": (float(ehl.by_module.min()), ""),
        "veciana/18": both(lambda table: table.by_module.min()),
        "veciana/16": (
            ehl.apart,
            f"EHL; {both(lambda table: table.apart)[1]}; loss of the cycloid, %, i = 1, m 2 mm, with the "
            f"paper's rolling speeds -> with the motion of the contact along the path in them: {exact}",
        ),
    }
