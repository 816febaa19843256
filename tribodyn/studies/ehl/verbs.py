"""`tribodyn compare-laws` and `td.compare_laws`: every film and friction law beside the solved contact."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

from tribodyn.errors import InputError
from tribodyn.studies.protocol.verb import Option, Verb

if TYPE_CHECKING:
    from tribodyn.studies.ehl.judgement import LawsJudged

EXAMPLES = (
    "\b\nExamples:\n"
    "  tribodyn compare-laws crc-23-47\n"
    "  tribodyn compare-laws my-drive.toml --map -o laws.png\n"
    '  tribodyn compare-laws involute-23-47 --set operating.gear_torque="100 N*m"'
)
#: Positions of the pair, at least and at most.
FEWEST, MOST = 4, 2000


def compare_laws(
    case: Any,
    *,
    positions: Annotated[int, Option("Positions of the pair along its way.", min=FEWEST, max=MOST)] = 24,
    map: Annotated[bool, Option("Also over 1/4 to 2 times the load and the speed.")] = False,
    progress: Callable[[float], None] | None = None,
) -> "LawsJudged":
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
    progress : callable or bool, optional
        As of `run`.

    Returns
    -------
    LawsJudged
        Ratios to the solved contact, without unit, by law and position.

    Raises
    ------
    InputError
        For what is wrong with the scenario, or one without drive, lubricant or duty.
    """
    from tribodyn.studies.ehl.judgement import FACTORS, judgement

    if isinstance(positions, bool) or not isinstance(positions, int) or not FEWEST <= positions <= MOST:
        raise InputError("positions", positions, f"is no whole number from {FEWEST} to {MOST}", "give one")
    return judgement(case, positions, FACTORS if map else (), progress)


VERBS = {"compare-laws": Verb(compare_laws, EXAMPLES, answers=True, alias="judge")}
