"""What a followed sweep records of the ends of the branches that it left."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.variable import Variable, flag
from tribodyn.record.sweep_schema import FIRST_PARAMETER
from tribodyn.solve.branch.family import KINDS, BranchEnd

#: Ends that are kept of each case: those between its neighbour and it.
ENDS = 4

END = Variable(("end",), "1", "number of the end, in the order in which they were met")


def kind_variable(dims: tuple[str, ...], long_name: str) -> Variable:
    """A dataset of the kinds of ends, by number."""
    numbers = ", ".join(f"{number} {name}" for number, name in enumerate(KINDS, 1))
    meanings = " ".join(["none", *(name.replace(" ", "_") for name in KINDS)])
    return flag(dims, f"{long_name}: 0 none, {numbers}", meanings, 0)


VARIABLES: dict[str, Variable] = {
    "end_kind": kind_variable(("end",), "how a branch ends between the neighbouring case and this one"),
    "end_value": Variable(("end",), FIRST_PARAMETER, "first parameter at the end of the branch"),
    "end_within": Variable(("end",), FIRST_PARAMETER, "distance between the places that locate the end"),
    "end_period": Variable(
        ("end",), "1", "periods of the excitation in one of the motion that ends", "<i4", 0
    ),
    "end_multiplier_modulus": Variable(
        ("end",), "1", "maximum modulus of the multipliers at the last place found on the branch"
    ),
    "end_multiplier_angle": Variable(("end",), "rad", "angle of that multiplier"),
}


def fill_ends(rows: dict[str, Any], i: int, ends: Sequence[BranchEnd]) -> None:
    """Put the ends that were met on the way to a case into its row."""
    for place, end in enumerate(ends[:ENDS]):
        rows["end_kind"][i, place] = 1 + KINDS.index(end.kind)
        rows["end_value"][i, place], rows["end_within"][i, place] = end.value, end.within
        rows["end_period"][i, place] = end.period
        rows["end_multiplier_modulus"][i, place] = abs(end.multiplier)
        rows["end_multiplier_angle"][i, place] = np.angle(end.multiplier)
