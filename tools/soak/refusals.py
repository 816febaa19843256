"""Whether a refusal is true: it names key, rule and remedy, and its advice is accepted."""

import copy
import re
from pathlib import Path
from typing import Any

from tools.soak.cases import Refused, geometry_error
from tribodyn.errors import InputError, InputErrors

_ADVICE = re.compile(r"^use (at most|at least|less, such as|about)? ?\"?(-?[\d.]+(?:e-?\d+)?)( mm| deg)?\"?")
#: The advised value need not be sharper than this share of the way to it.
SHARP = 0.05
#: Remedies are rounded to this.
ROUNDED = 0.001


def untrue(refused: Refused, folder: Path) -> list[str]:
    """Say what is wrong with a refusal; nothing, where it is true as far as can be told.

    A remedy that names a number is followed: the same rule must not be broken again. One that says "at most"
    or "at least" is also tried a little beyond, where the rule must still hold the drive back.
    """
    error = refused.error.errors[0] if isinstance(refused.error, InputErrors) else refused.error
    said = [
        f"the refusal names no {name}: {error}" for name in ("key", "rule") if not str(getattr(error, name))
    ]
    advice = _ADVICE.match(error.remedy)
    if advice is None or not error.key.startswith("drive."):
        return said
    bound, number, unit = advice.groups()
    given = _get(refused.scenario, error.key)
    if given is None or isinstance(given, (dict, list)):
        return said
    value, old = float(number), float(str(given).split()[0])
    again = _with(refused, error.key, value, unit, folder)
    if again is not None and (again.key, _words(again.rule)) == (error.key, _words(error.rule)):
        said.append(f"the remedy is refused too: {error} -> {again}")
    if bound in ("at most", "at least"):
        beyond = value + max(SHARP, 1.5 * ROUNDED / abs(old - value)) * (old - value)
        if _with(refused, error.key, beyond, unit, folder) is None:
            said.append(f"{beyond:.6g} is accepted, beyond the limit of: {error}")
    return said


def _with(refused: Refused, key: str, value: float, unit: str | None, folder: Path) -> InputError | None:
    scenario = copy.deepcopy(refused.scenario)
    *above, last = key.split(".")
    place: Any = scenario
    for part in above:
        place = place[part]
    place[last] = f"{value:.9g}{unit}" if unit else value
    error = geometry_error(scenario["drive"], folder)
    return error.errors[0] if isinstance(error, InputErrors) else error


def _get(scenario: dict[str, Any], key: str) -> Any:
    place: Any = scenario
    for part in key.split("."):
        if not isinstance(place, dict) or part not in place:
            return None
        place = place[part]
    return place


def _words(rule: str) -> str:
    """A rule without its numbers."""
    return re.sub(r"-?\d[\d.e-]*", "#", rule)
