"""A case of a search: everything that one run needs to know, and the names of its keys and duties."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import Field

from tribodyn.input.quantity import Table
from tribodyn.studies.protocol.study import CaseHead

_NUMBER_AND_UNIT = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*(\S.*?)?\s*$", re.ASCII)
#: What stands for the value of a quantity at the start, as the limit of a constraint.
START = "start"
#: Distribution of a tolerance whose key numbers samples.
DRAWN = "drawn"


class Free(NamedTuple):
    """A free key."""

    keys: tuple[str, ...]  # dotted keys of the base scenario that take the same value
    name: str  # of its dataset in the record
    #: low, high: bounds in its unit; of choices their numbers
    low: float
    high: float
    unit: str = ""  # as it is written; "" for a plain number
    #: si, units: factor to SI, and the SI unit
    si: float = 1.0
    units: str = "1"
    whole: bool = False  # whether its values are whole numbers
    choices: tuple[Any, ...] = ()  # the values as TOML has them, where it is a choice; else none

    @property
    def continuous(self) -> bool:
        """Whether it takes all values between its bounds."""
        return not (self.whole or self.choices)

    @property
    def number_of_values(self) -> float:
        """How many values it has."""
        return math.inf if self.continuous else self.high - self.low + 1.0


class Objective(NamedTuple):
    """A sum of quantities to be minimised; several count relative to their values at the start."""

    name: str
    terms: tuple[tuple[str, float], ...]  # (quantity, weight); weights are negative where more is better

    @property
    def relative(self) -> bool:
        """Whether its quantities are divided by their values at the start."""
        return len(self.terms) > 1


class Constraint(NamedTuple):
    """A quantity that must not be above (sign 1) or below (sign −1) its limit, SI or `START`."""

    text: str
    quantity: str
    sign: float
    limit: float | str


class WeightedDuty(NamedTuple):
    """One of the duties that the quantities are means over."""

    weight: float
    set: Mapping[str, Any]
    name: str


class Tolerance(NamedTuple):
    """What varies beyond the designer's reach."""

    key: str
    name: str
    plus_minus: float  # in its unit
    unit: str
    #: "uniform", "normal" (`plus_minus` is three standard deviations), "ends" (both ends alone), `DRAWN`
    distribution: str


class RobustTable(Table):
    """How quantities are taken over the samples of the tolerances."""

    over: Literal["mean", "worst", "quantile"] = "mean"
    quantile: Annotated[float, Field(strict=True, gt=0, lt=1)] = 0.9
    samples: Annotated[int, Field(strict=True, ge=1, le=10_000)] = 8
    seed: Annotated[int, Field(strict=True, ge=0)] = 0


class SearchOptions(NamedTuple):
    """How to search: the method, the maximum number of evaluations, local searches, points of a front."""

    method: str = "auto"
    evaluations: int = 200
    starts: int = 2
    seed: int = 0
    points: int = 7
    accuracy: float = 1e-3


@dataclass(frozen=True)
class DesignCase(CaseHead):
    """A search, complete."""

    base: Mapping[str, Any]  # the scenario that is searched through, resolved, as TOML has it
    parts: Mapping[str, Mapping[str, Any]]  # further scenarios by name, with the drive of the base
    free: tuple[Free, ...]
    objectives: tuple[Objective, ...]  # one, or two for a front
    constraints: tuple[Constraint, ...]
    duties: tuple[WeightedDuty, ...]  # at least one
    over_duties: str  # "mean" or "worst"
    tolerances: tuple[Tolerance, ...]
    robust: RobustTable
    search: SearchOptions
    #: key to value, under which start and best are evaluated once more; empty: they are not
    confirm: Mapping[str, Any]
    sensitivities: bool  # whether each key and each tolerance is moved alone about the best

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the quantities that objectives and constraints are made of."""
        of_objectives = (name for objective in self.objectives for name, _ in objective.terms)
        return (*of_objectives, *(constraint.quantity for constraint in self.constraints))

    @property
    def scenarios(self) -> dict[str, Mapping[str, Any]]:
        """All scenarios that are evaluated, by their names as sources."""
        return {"": self.base, **self.parts}


def unit_of(text: str) -> str | None:
    """The unit behind a number, "" where there is none; None where the text does not begin with a number."""
    match = _NUMBER_AND_UNIT.match(text)
    return (match[1] or "") if match else None


def naming_key(keys: str | Sequence[str]) -> str:
    """The key that names a free key: of several its parts that all of them have."""
    if isinstance(keys, str):
        return keys
    shared = set(keys[0].split(".")).intersection(*(key.split(".") for key in keys[1:]))
    return ".".join(part for part in keys[0].split(".") if part in shared) or keys[0]


def apart(keys: Sequence[str]) -> list[str]:
    """Shortest names for keys: their last parts, of such length that all differ; gears are always named."""
    for length in range(1, 12):
        ends = [key.split(".")[-length:] for key in keys]
        gears = [next((part for part in key.split(".") if part in ("pinion", "gear")), "") for key in keys]
        names = [
            "_".join(([gear] if gear and gear not in end else []) + end)
            for gear, end in zip(gears, ends, strict=True)
        ]
        if len(set(names)) == len(names):
            return names
    return [key.replace(".", "_") for key in keys]


def flat(table: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Nested tables as dotted keys."""
    keys: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{above}{name}"
        keys |= flat(value, f"{key}.") if isinstance(value, Mapping) else {key: value}
    return keys


def duty_names(design: Mapping[str, Any]) -> list[str]:
    """A name for each duty: the values of the keys in which duties differ."""
    sets = [flat(duty.get("set", {})) for duty in design.get("duty", ())]
    keys = list(dict.fromkeys(key for set in sets for key in set))
    different = [key for key in keys if len({str(set.get(key)) for set in sets}) > 1]
    return ["\n".join(str(set.get(key, "")) for key in different) for set in sets]
