"""The layout of a sweep's record: its axes are the varied parameters, its datasets hold a value per case."""

from collections.abc import Mapping
from enum import IntEnum
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.trust import NOT_JUDGED, TRUST

SWEEP = "sweep"


class CaseStatus(IntEnum):
    """`status` of a case, as the file has it."""

    WAITING = 0
    DONE = 1
    FAILED = 2


WAITING, DONE, FAILED = CaseStatus
DIRECTIONS = ("up", "down")

#: Behind the name of a quantity: that of every mesh.
OF_MESH = "_of_mesh"

#: Bytes kept of a message and of a word.
MESSAGE, WORD = 240, 24

#: Stands for the units of the first varied parameter.
FIRST_PARAMETER = "first parameter"

#: What every sweep records of a case. `status` is written last: what it calls done is there.
OF_EVERY_SWEEP: dict[str, Variable] = {
    TRUST: flag(
        (),
        "whether the result lies within its model: 1 inside, 0 outside, 2 laws extrapolated, -1 not judged",
        "not_judged outside_the_model inside_the_model laws_extrapolated",
        NOT_JUDGED,
    ),
    "message": Variable((), "1", "why a case failed, or a remark on its result", f"S{MESSAGE}", b""),
    "status": flag((), "state of the case: 0 waiting, 1 done, 2 failed", "waiting done failed", WAITING),
}

DIRECTION = Variable(
    ("direction",),
    "1",
    "sense in which the first parameter went from case to case, each from the previous one's state",
)


class VariedKey(NamedTuple):
    """A varied parameter."""

    name: str  # of its dimension
    key: str  # in the scenario
    units: str  # SI
    values: Any  # numbers or texts; an array where a record is read


#: Dimension of cases that stand in a list and not over a grid.
CASE = "case"
CASE_SCALE = Variable((CASE,), "1", "number of the case")


class Listed(NamedTuple):
    """What is told of every case in a list: numbers or texts over the cases."""

    variable: Variable
    values: Any
    key: str = ""  # in the scenario; empty: it is none that was varied


class SweepLayout(NamedTuple):
    """What a sweep records of every case of a study."""

    quantities: Mapping[str, Variable]  # datasets by name; their dimensions are those after the cases'
    #: name of such a dimension -> its scale and the values along it
    scales: Mapping[str, tuple[Variable, Any]] = MappingProxyType({})
    attributes: Mapping[str, Any] = MappingProxyType({})  # what else the root says

    @property
    def variables(self) -> dict[str, Variable]:
        """All datasets of the cases, `status` last."""
        return {**self.quantities, **OF_EVERY_SWEEP}

    def empty_rows(self, count: int) -> dict[str, Any]:
        """Rows of `count` cases without results."""
        rows = {}
        for name, variable in self.variables.items():
            shape = (count, *(len(self.scales[dim][1]) for dim in variable.dims))
            text = variable.dtype.startswith("S")
            rows[name] = np.full(shape, "" if text else variable.fill, object if text else variable.dtype)
        return rows
