"""Film and friction laws beside the solved contact, as an object."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from tribodyn.errors import InputError
from tribodyn.interface.scenario import Source, scenario
from tribodyn.interface.words import in_python
from tribodyn.studies.ehl.judged import FACTORS, Judgement, judgement
from tribodyn.studies.protocol.study import Progress

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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

    found: Judgement

    @property
    def laws(self) -> dict[tuple[str, str], Any]:  # noqa: D102
        return {(one.what, one.law): one for one in self.found.laws}

    @property
    def load_factors(self) -> tuple[float, ...]:  # noqa: D102
        return self.found.load_factors

    @property
    def speed_factors(self) -> tuple[float, ...]:  # noqa: D102
        return self.found.speed_factors

    @property
    def said(self) -> str:  # noqa: D102
        return self.found.said

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as ``tribodyn judge --json`` prints it."""
        return self.found.as_dict()

    def plot(self) -> "Figure":
        """Draw the ratios of every law."""
        from tribodyn.studies.ehl.judged_picture import picture

        return picture(self.found)

    def __repr__(self) -> str:
        return f"<tribodyn laws judged for {self.found.title}: {self.said}>"


@in_python()
def judge(
    source: Source,
    overrides: Mapping[str, Any] | None = None,
    *,
    positions: int = 24,
    map: bool = False,
    progress: Progress | None = None,
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
    if isinstance(positions, bool) or not isinstance(positions, int) or not FEWEST <= positions <= MOST:
        raise InputError("positions", positions, f"is no whole number from {FEWEST} to {MOST}", "give one")
    case = scenario(source, overrides)
    return LawsJudged(judgement(case, positions, FACTORS if map else (), progress))
