"""`tribodyn judge` and `td.judge`: every film and friction law beside the solved contact."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from tribodyn.errors import InputError
from tribodyn.studies.protocol.verb import Option, Verb

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from tribodyn.studies.ehl.judged import Judgement
    from tribodyn.studies.protocol.results import TextTable

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn judge crc-23-47\n"
    "  tribodyn judge my-drive.toml --map -o judged.png\n"
    '  tribodyn judge involute-23-47 --set operating.gear_torque="100 N*m"'
)
#: Positions of the pair, at least and at most.
FEWEST, MOST = 4, 2000


@dataclass(frozen=True)
class LawsJudged:
    """What `judge` found.

    Attributes
    ----------
    laws : dict
        (what, law) to its ratios to the solved contact along the way of a pair: ("film", "moes"), with
        `minimum`, `median`, `maximum`, `in_range` (share of the way inside the range that the law states;
        NaN: it states none), `in_judged_range` (share inside the limits that follow from the solved
        contact of many oils and surfaces; NaN: there are none), `range` (in words), `right` (share where it
        is within 10 % of the film, 25 % of the friction), `against` (which solved quantity) and `map`
        (medians, loads by speeds).
    load_factors, speed_factors : tuple of float
        On torque and speed, of the map.
    said : str
        Which laws are right over the whole way.
    """

    found: "Judgement"

    @property
    def laws(self) -> dict[tuple[str, str], Any]:  # noqa: D102
        return {(law.what, law.law): law for law in self.found.laws}

    @property
    def load_factors(self) -> tuple[float, ...]:  # noqa: D102
        return self.found.load_factors

    @property
    def speed_factors(self) -> tuple[float, ...]:  # noqa: D102
        return self.found.speed_factors

    @property
    def said(self) -> str:  # noqa: D102
        return self.found.said

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the command line says below the tables."""
        return (self.said,)

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as ``tribodyn judge --json`` prints it."""
        return self.found.as_dict()

    def tables(self) -> "list[TextTable]":
        """Tables as the command line prints them."""
        from tribodyn.studies.protocol.results import TextTable

        laws, factors = self.found.laws, self.speed_factors
        ratios = [
            [
                *(law.what, law.law, law.against),
                *(f"{value:.3f}" for value in law[2:5]),
                *(_share(law.in_range), _share(law.in_judged_range, "none")),
            ]
            for law in laws
        ]
        columns = (
            "",
            "law",
            "compared with",
            "minimum",
            "median",
            "maximum",
            "inside its range",
            "judged range",
        )
        ranges = [[law.what, law.law, law.range or "none stated"] for law in laws]
        tables = [
            TextTable("Law over solved contact, along the way of a pair", columns, ratios),
            TextTable("Ranges of the laws", ("", "law", "range"), ranges),
        ]
        if factors:
            lines = [
                [law.what, law.law, f"× {factor:g}", *(f"{value:.3f}" for value in row)]
                for law in laws
                for factor, row in zip(self.load_factors, law.map, strict=True)
            ]
            head = ("", "law", "load", *(f"speed × {factor:g}" for factor in factors))
            tables.append(TextTable("Median over load and speed", head, lines))
        return tables

    def plot(self) -> "Figure":
        """Draw the ratios of every law."""
        from tribodyn.studies.ehl.judged_picture import picture

        return picture(self.found)

    def __repr__(self) -> str:
        return f"<tribodyn laws judged for {self.found.title}: {self.said}>"


def judge(
    case: Any,
    *,
    positions: Annotated[int, Option("Positions of the pair along its way.", min=FEWEST, max=MOST)] = 24,
    map: Annotated[bool, Option("Also over 1/4 to 2 times the load and the speed.")] = False,
    progress: Callable[[float], None] | None = None,
) -> LawsJudged:
    """Compare every film and friction law with the solved contact.

    Parameters
    ----------
    source : str, Path, mapping or case
        A scenario with a drive, a lubricant and a duty, as `scenario` takes it.
    overrides : mapping, optional
        Dotted key to value.
    positions : int
        Positions of the pair along its way, 4 … 2000.
    map : bool
        Also over a quarter to twice the load and the speed.
    progress : callable, optional
        Called with the share done, 0 … 1.

    Raises
    ------
    InputError
        For what is wrong with the scenario, or one without drive, lubricant or duty.
    """
    from tribodyn.studies.ehl.judged import FACTORS, judgement

    if isinstance(positions, bool) or not isinstance(positions, int) or not FEWEST <= positions <= MOST:
        raise InputError("positions", positions, f"is no whole number from {FEWEST} to {MOST}", "give one")
    return LawsJudged(judgement(case, positions, FACTORS if map else (), progress))


def _share(value: float, without: str = "not stated") -> str:
    return without if math.isnan(value) else f"{100 * value:.0f} %"


VERBS = {"judge": Verb(judge, EXAMPLES, answers=True)}
