"""Veciana et al., Machines 12 (2024) 943: cycloidal against involute efficiency under two friction laws."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.surface_state import surface_state
from tribodyn.validation.papers.veciana_study import (
    CHOSEN,
    DRIVES,
    EFFECTIVE_MODULUS,
    LAWS,
    PINION_TEETH,
    DriveUnderLaw,
    Law,
    closure_of,
    contact_height,
)
from tribodyn.validation.published import WIDE
from tribodyn.validation.rows import Row, compare_paper

PAPER = "veciana-2024"
#: Generating circles over d_1 of the paper's figures 5 and 6, and which of them is the `CHOSEN` one.
CIRCLES = np.linspace(0.1, 0.4, 31)
_AT_CHOSEN = int(np.argmin(np.abs(CIRCLES - CHOSEN)))


class Efficiencies:
    """Efficiencies, %, of all drives of the study under one law.

    `involute` (drive,), `cycloid` (drive, circle), `crossovers` of all drives, `crossover` of the first,
    `apart`: maximum distance of cycloid and involute at the chosen circles. What is gained, percentage
    points: `by_circles`, of the smallest over the largest, by drive; by circle `by_ratio`, of i = 3 over 1 at
    module 2 mm, and `by_module`, of 6 mm over 2 mm at i = 1.
    """

    def __init__(self, law: Law) -> None:
        self.law: Law = law
        studies = [DriveUnderLaw(ratio, module, law) for ratio, module in DRIVES]
        self.involute = 100.0 * np.array([study.involute() for study in studies])
        self.cycloid = 100.0 * np.array([study.cycloid(CIRCLES) for study in studies])
        self.crossovers = [study.crossover() for study in studies]
        self.crossover = self.crossovers[0]
        self.exact_speeds = 100.0 * studies[0].cycloid(CHOSEN, exact_speeds=True)
        self.apart = float(np.max(np.abs(self.cycloid[:, _AT_CHOSEN] - self.involute)))
        self.by_circles = self.cycloid[:, 0] - self.cycloid[:, -1]
        self.by_ratio = self.cycloid[2] - self.cycloid[0]
        self.by_module = self.cycloid[4] - self.cycloid[0]


def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
    """All rows of the paper. Nothing is written to `folder`: the study needs no simulation."""
    tables: dict[Law, Efficiencies] = {}
    for count, law in enumerate(LAWS):
        tables[law] = Efficiencies(law)
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
    values = _geometry() | _claims((ehl, mixed))
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


def _claims(tables: Sequence[Efficiencies]) -> dict[str, tuple[Any, str]]:
    """Statements about both laws; a drive's i and module as in `DRIVES`."""
    ratios, modules = (0, 1, 2), (0, 3, 4)
    profiles = [profile for table in tables for profile in (table.cycloid, table.involute)]
    rises = [np.diff(profile[list(drives)], axis=0) for profile in profiles for drives in (ratios, modules)]
    chosen = [table.cycloid[:, _AT_CHOSEN] for table in tables] + [table.involute for table in tables]
    steps = [np.diff(values[list(drives)]) for values in chosen for drives in (ratios, modules)]
    apart = [max(abs(one / table.crossover - 1.0) for one in table.crossovers) for table in tables]
    paths = [_along_path(table.law) for table in tables]
    low, high = (np.array([_friction(table.law, ratio) for table in tables]) for ratio in (0.01, 0.9))
    prefix, laws = "veciana/claim-", ("EHL", "MEHL")
    return {
        f"{prefix}smaller-circles-better": (
            bool(all(np.all(np.diff(table.cycloid, axis=1) < 0.0) for table in tables)),
            f"all drives, circles of 0.1 … 0.4 d1 in steps of {CIRCLES[1] - CIRCLES[0]:.2f}",
        ),
        f"{prefix}ratio-and-module-better": (bool(all(np.all(rise > 0.0) for rise in rises)), "all circles"),
        f"{prefix}gains-shrink": (
            bool(all(late < early for early, late in steps)),
            "from i = 1 to 2 to 3 and from 2 to 4 to 6 mm, cycloid at 0.17 d1 and involute",
        ),
        f"{prefix}crossover-independent-of-ratio-and-module": (
            max(apart) < WIDE,
            "; ".join(
                f"{law} {', '.join(f'{one:.4f}' for one in table.crossovers)}"
                for law, table in zip(laws, tables, strict=True)
            ),
        ),
        f"{prefix}load-of-the-cycloid-lower": (
            min(lower for lower, *_ in paths) > 0.9,
            ", ".join(f"{law} at {path[0]:.0%} of the path" for law, path in zip(laws, paths, strict=True)),
        ),
        f"{prefix}cycloid-better-at-both-ends": (
            all(better for _, better, _ in paths),
            "cycloid better beyond, of half the path: "
            + ", ".join(f"{law} {path[2]:.2f}" for law, path in zip(laws, paths, strict=True)),
        ),
        f"{prefix}laws-similar-at-high-slide-to-roll": (
            bool(low[1] > low[0] and abs(high[1] - high[0]) < 0.1 * (low[1] - low[0])),
            f"slide-to-roll ratio 0.01: {low[0]:.4f} and {low[1]:.4f}; 0.9: {high[0]:.4f} and {high[1]:.4f}",
        ),
    }


def _along_path(law: Law) -> tuple[float, bool, float]:
    """Where the cycloid at the chosen circles has less load than the involute, i = 1, m = 2 mm.

    Share of the path; whether its torque ratio is better at both ends and worse at the pitch point only; and
    from where on, as a share of half the path.
    """
    study = DriveUnderLaw(1.0, 2e-3, law)
    half = math.pi / PINION_TEETH
    turn = np.linspace(-half, half, 600)  # an even number: not at the pitch point itself
    places = turn, np.full_like(turn, 1.0 / turn.size)
    involute = study.solve(study.involute_pair(places))
    cycloid = study.solve(study.cycloid_pair(CHOSEN, rotation=places))
    better = cycloid.torque_ratio > involute.torque_ratio
    changes = np.flatnonzero(np.diff(better.astype(int)))
    once = bool(better[0] and better[-1] and not better[turn.size // 2] and changes.size == 2)
    lower = float(np.mean(cycloid.normal_load < involute.normal_load))
    return lower, once, float(np.max(np.abs(turn[changes]))) / half if changes.size else 0.0


def _friction(law: Law, slide_to_roll: float) -> float:
    """Friction coefficient of the paper's Table 2: R 5 mm, V_e 5 m/s, p_H 2 GPa."""
    radius, speed, pressure = 5e-3, 5.0, 2e9
    slid = slide_to_roll * speed
    load = 2.0 * math.pi * radius * pressure**2 / EFFECTIVE_MODULUS
    conditions = (load, 1 / radius, speed, slid, speed + slid / 2, speed - slid / 2)
    contact = local_contact(*(np.array([value]) for value in conditions))
    return float(surface_state(contact, closure_of(law)).friction_coefficient[0])
