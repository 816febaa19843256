"""Every film and friction law beside the solved contact, over a pair's way and over load and speed."""

import math
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tribodyn.cases.results import TextTable
from tribodyn.errors import InputError
from tribodyn.input.resolve import resolve_table
from tribodyn.input.schema import fields_of
from tribodyn.input.tables.duty import OiledOperatingTable
from tribodyn.numerics.registry import Registry
from tribodyn.studies.ehl.along_path import PairWay, PreparedEhl, prepare, seen_by, way
from tribodyn.studies.ehl.run import by_laws, solve
from tribodyn.studies.ehl.scenario import EhlCase
from tribodyn.studies.protocol.load import loaded_from, table_of
from tribodyn.studies.protocol.study import CaseHead, Progress
from tribodyn.tribology.closure import untried_closure_of, with_laws
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FilmLaw, FrictionLaw
from tribodyn.tribology.surface_state import range_shares

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Deviation from the solved contact up to which a law is called right: of the film, of friction.
RIGHT = {"film": 0.10, "friction": 0.25}
#: Factors on load and speed of a map.
FACTORS = (0.25, 0.5, 1.0, 2.0)
#: Positions of the pair at each point of the map over load and speed.
AT_A_POINT = 5
#: What laws are compared with: its dataset and what it is, and the laws.
AGAINST: dict[str, tuple[str, str, Registry[Any]]] = {
    "film": ("central_film_thickness", "film on the line of centres", FILM_LAWS),
    "friction": ("friction_coefficient", "friction", FRICTION_LAWS),
}
#: Needed of a scenario.
_TABLES = ("drive", "lubricant", "operating")


class LawRatio(NamedTuple):
    """A law beside the solved contact; all numbers are shares."""

    what: str  # "film" or "friction"
    law: str  # its name
    #: minimum, median, maximum: of the ratio of the law's value to the solved one over the pair's way
    minimum: float
    median: float
    maximum: float
    in_range: float  # share of the way inside the range that the law states; NaN: it states none
    #: share of the way inside the limits by the solved contact of many oils and surfaces
    #: (`law.JudgedRange`); NaN: there are none
    in_judged_range: float
    right: float  # share of the way where the ratio is within `RIGHT` of 1
    map: tuple[tuple[float, ...], ...] = ()  # (loads, speeds), median ratio; empty without a map
    against: str = ""  # which solved quantity it is compared with: what the law stands for
    range: str = ""  # of the law, in words; "" where none is stated

    def row(self) -> list[str]:
        """Its row of the table."""
        ratios = [f"{value:.3f}" for value in (self.minimum, self.median, self.maximum)]
        shares = [_share(self.in_range, "not stated"), _share(self.in_judged_range, "none")]
        return [self.what, self.law, self.against, *ratios, *shares]


def _share(value: float, without: str) -> str:
    return without if math.isnan(value) else f"{100 * value:.0f} %"


@dataclass(frozen=True)
class LawsJudged:
    """All laws beside the solved contact of a scenario: what `judge` found."""

    title: str  # of the scenario
    positions: int  # of the pair, at which contacts were solved
    #: load_factors, speed_factors: on torque and speed, of the map; empty without a map
    load_factors: tuple[float, ...]
    speed_factors: tuple[float, ...]
    ratios: list[LawRatio]  # of every law

    @property
    def laws(self) -> dict[tuple[str, str], LawRatio]:
        """(what, law) to its ratios: ("film", "moes")."""
        return {(ratio.what, ratio.law): ratio for ratio in self.ratios}

    @property
    def said(self) -> str:
        """Which laws are right over the whole way of this duty, in a sentence."""
        parts = []
        for what, share in RIGHT.items():
            names = [ratio.law for ratio in self.ratios if ratio.what == what and ratio.right == 1.0]
            which = ", ".join(names) if names else "none"
            parts.append(f"within {100 * share:.0f} % of the solved {what} at every position: {which}")
        return f"{'; '.join(parts)}.".capitalize()

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the command line says below the tables."""
        return (self.said,)

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as ``tribodyn judge --json`` prints it."""
        return {
            "title": self.title,
            "positions": self.positions,
            "load_factors": self.load_factors,
            "speed_factors": self.speed_factors,
            "laws": [ratio._asdict() for ratio in self.ratios],
            "said": self.said,
        }

    def tables(self) -> list[TextTable]:
        """Tables as the command line prints them."""
        ends = "minimum", "median", "maximum"
        columns = ("", "law", "compared with", *ends, "inside its range", "judged range")
        rows = [ratio.row() for ratio in self.ratios]
        ranges = [[ratio.what, ratio.law, ratio.range or "none stated"] for ratio in self.ratios]
        tables = [
            TextTable("Law over solved contact, along the way of a pair", columns, rows),
            TextTable("Ranges of the laws", ("", "law", "range"), ranges),
        ]
        if self.speed_factors:
            lines = [
                [ratio.what, ratio.law, f"× {factor:g}", *(f"{value:.3f}" for value in row)]
                for ratio in self.ratios
                for factor, row in zip(self.load_factors, ratio.map, strict=True)
            ]
            head = ("", "law", "load", *(f"speed × {factor:g}" for factor in self.speed_factors))
            tables.append(TextTable("Median over load and speed", head, lines))
        return tables

    def plot(self) -> "Figure":
        """Draw the ratios of every law."""
        from tribodyn.studies.ehl.figures import laws_figure

        return laws_figure(self.title, self.ratios, RIGHT)

    def __repr__(self) -> str:
        return f"<tribodyn laws judged for {self.title}: {self.said}>"


def judgement(
    case: CaseHead, positions: int, factors: tuple[float, ...] = (), progress: Progress | None = None
) -> LawsJudged:
    """Compare every law with the solved contact of a case of any study, over factors on load and speed too.

    Without factors there is no map. Raises InputError as `case_for`.
    """
    report, ehl = progress or (lambda _share: None), case_for(case, positions)
    points = [(load, speed) for load in factors for speed in factors]
    done = positions / (positions + AT_A_POINT * len(points))
    laws = _compared(ehl, lambda share: report(done * share))
    medians: list[list[float]] = []  # of every point, in the order of the laws
    for number, (load, speed) in enumerate(points, start=1):
        torque, turning = ehl.operating.gear_torque * load, ehl.operating.pinion_speed * speed
        duty = replace(ehl.operating, gear_torque=torque, pinion_speed=turning)
        point = _compared(replace(ehl, operating=duty, positions=AT_A_POINT), lambda _share: None)
        medians.append([law.median for law in point])
        report(done + (1.0 - done) * number / len(points))
    for place, law in enumerate(laws):
        values = [point[place] for point in medians]
        rows = range(0, len(points), max(len(factors), 1))
        laws[place] = law._replace(map=tuple(tuple(values[row : row + len(factors)]) for row in rows))
    return LawsJudged(case.title, positions, factors, factors, laws)


def case_for(case: CaseHead, positions: int) -> EhlCase:
    """Return the solved contact of a case's drive, oil and duty, of whatever kind it is.

    Raises InputError for a scenario without a drive of two gears, a lubricant and a duty, or a positive load.
    """
    data = tomllib.loads(case.toml)
    if missing := [name for name in _TABLES if not isinstance(data.get(name), dict)]:
        rule = f"a scenario without {' and without '.join(missing)}: there is no contact to solve"
        raise InputError("kind", case.kind, rule, "name a scenario with drive, lubricant and operating")
    fields = fields_of(OiledOperatingTable)
    tables = {name: data[name] for name in (*_TABLES, "duty") if name in data} | {
        "title": case.title,
        "name": case.name,
        "kind": "ehl",
        "operating": {name: value for name, value in data["operating"].items() if name in fields},
        "output": {"positions": positions},
    }
    # what a case says has no reference left that would be looked for beside its file
    path = Path(case.name)
    return loaded_from(resolve_table(tables, path, {}, table_of), path).case


def _compared(case: EhlCase, progress: Progress) -> list[LawRatio]:
    study = prepare(case)
    over = way(study)
    arrays = solve(study, over, progress)
    comparisons = []
    for what, laws in by_laws(study, over).items():
        dataset, against, registry = AGAINST[what]
        for law, values in laws.items():
            stated, ratio = registry[law], values / arrays[dataset]
            ratio = ratio[np.isfinite(ratio)]
            extent, right = (math.nan, math.nan, math.nan), 0.0
            if len(ratio):
                extent = float(np.min(ratio)), float(np.median(ratio)), float(np.max(ratio))
                right = float(np.mean(np.abs(ratio - 1.0) <= RIGHT[what]))
            compared = LawRatio(what, law, *extent, *_inside(study, over, stated), right)
            comparisons.append(compared._replace(against=against, range=stated.stated))
    return comparisons


def _inside(study: PreparedEhl, over: PairWay, law: FilmLaw | FrictionLaw) -> tuple[float, float]:
    """Shares of the way inside the law's range, and inside its judged limits alone; NaN: none stated."""
    names = (law.name, "none") if law.table == "film" else (None, law.name)
    seen, closure = seen_by(study, over, *names), untried_closure_of(with_laws(study.case, *names))
    shares = range_shares(seen.contact, closure)[law.table != "film"]
    least = np.min(np.broadcast_to(shares, (*seen.radius.shape, shares.shape[-1])), axis=-1)
    whole = float("nan") if np.all(np.isnan(least)) else float(np.mean(least >= 1.0))
    if law.judged is None or not law.judged.limits:
        return whole, float("nan")
    return whole, float(np.mean(np.all(shares[..., -law.judged.limits :] >= 1.0, axis=-1)))
