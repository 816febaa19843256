"""What a followed sweep records of the branches that it left: their ends, and the unstable motions beyond."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.sweep_schema import FIRST_PARAMETER
from tribodyn.solve.branch.arclength import KINDS, BranchEnd

if TYPE_CHECKING:  # the layout of a sweep needs no solver
    from tribodyn.solve.branch.unstable import UnstableBranch

#: Ends that are kept of each case: those between its neighbour and it; motions that are kept of each branch
#: beyond, evenly along its arclength where there are more.
ENDS, MOTIONS = 4, 80
#: What the names of the datasets of unstable motions begin with.
PREFIX = "unstable_"

END = Variable(("end",), "1", "number of the end, in the order in which they were met")
MOTION = Variable(("motion",), "1", "number of the unstable motion along its branch, from the end on")

_END, _MOTION = ("end",), ("end", "motion")


def kind_variable(long_name: str) -> Variable:
    """A dataset of the kinds of ends, by number, one for each end."""
    numbers = ", ".join(f"{number} {name}" for number, name in enumerate(KINDS, 1))
    meanings = " ".join(["none", *(name.replace(" ", "_") for name in KINDS)])
    return flag(_END, f"{long_name}: 0 none, {numbers}", meanings, 0)


#: What an end has whatever its parameter.
COMMON: dict[str, Variable] = {
    "end_period": Variable(_END, "1", "periods of the excitation in one of the motion that ends", "<i4", 0),
    "end_multiplier_modulus": Variable(
        _END, "1", "maximum modulus of the multipliers at the last place found on the branch"
    ),
    "end_multiplier_angle": Variable(_END, "rad", "angle of that multiplier"),
}
END_VARIABLES: dict[str, Variable] = {
    "end_kind": kind_variable("how a branch ends between the neighbouring case and this one"),
    "end_value": Variable(_END, FIRST_PARAMETER, "first parameter at the end of the branch"),
    "end_within": Variable(_END, FIRST_PARAMETER, "distance between the places that locate the end"),
    **COMMON,
}
UNSTABLE_VARIABLES: dict[str, Variable] = {
    "unstable_period": Variable(
        _END, "1", "periods of the excitation in one of the unstable motions beyond the end", "<i4", 0
    ),
    "unstable_finish": kind_variable(
        "how the branch stops being unstable; none: it leaves the range, or is lost"
    ),
    "unstable_finish_value": Variable(_END, FIRST_PARAMETER, "first parameter where it stops being unstable"),
    "unstable_value": Variable(_MOTION, FIRST_PARAMETER, "first parameter of an unstable motion"),
    "unstable_multiplier_modulus": Variable(
        _MOTION, "1", "maximum modulus of its Floquet multipliers, above 1"
    ),
    "unstable_multiplier_angle": Variable(_MOTION, "rad", "angle of that multiplier"),
    "unstable_residual": Variable(_MOTION, "1", "scaled change of its state over one period"),
}


def end_values(end: BranchEnd, place: str) -> dict[str, Any]:
    """What the record holds of an end; `place` names the dataset of its parameter."""
    return {
        "end_kind": 1 + KINDS.index(end.kind),
        place: end.value,
        "end_within": end.within,
        "end_period": end.period,
        "end_multiplier_modulus": abs(end.multiplier),
        "end_multiplier_angle": np.angle(end.multiplier),
    }


def fill_ends(rows: dict[str, Any], i: int, ends: Sequence[BranchEnd]) -> None:
    """Put the ends that were met on the way to a case into its row."""
    for number, end in enumerate(ends[:ENDS]):
        for name, value in end_values(end, "end_value").items():
            rows[name][i, number] = value


def fill_branch(rows: dict[str, Any], i: int, end: int, branch: "UnstableBranch") -> None:
    """Put a branch, of at most `MOTIONS` motions, into the row of the case behind whose end it goes on."""
    rows["unstable_period"][i, end] = branch.period
    if branch.finish is not None:
        rows["unstable_finish"][i, end] = 1 + KINDS.index(branch.finish.kind)
        rows["unstable_finish_value"][i, end] = branch.finish.value
    values = branch_values(branch) | {"unstable_value": branch.values}
    for name, along in values.items():
        rows[name][i, end, : len(branch.values)] = along


def branch_values(branch: "UnstableBranch") -> dict[str, np.ndarray]:
    """What the record holds of every motion of a branch, whatever its parameter."""
    largest = branch.multipliers[:, 0]
    return {
        "unstable_multiplier_modulus": np.abs(largest),
        "unstable_multiplier_angle": np.angle(largest),
        "unstable_residual": np.array([orbit.residual for orbit in branch.orbits]),
    }
