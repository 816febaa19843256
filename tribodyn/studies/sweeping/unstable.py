"""What a followed sweep records of branches beyond the ends of their stable parts."""

from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.numerics.variable import Variable
from tribodyn.record.sweep_schema import FIRST_PARAMETER
from tribodyn.solve.branch.family import KINDS
from tribodyn.studies.sweeping.ends import kind_variable

if TYPE_CHECKING:  # the layout of a sweep needs no solver
    from tribodyn.solve.branch.unstable import UnstableBranch

#: Motions that are kept of each branch, evenly along its arclength where there are more.
MOTIONS = 80
#: What the names of the datasets begin with.
PREFIX = "unstable_"

MOTION = Variable(("motion",), "1", "number of the unstable motion along its branch, from the end on")

_BRANCH, _MOTION = ("end",), ("end", "motion")
VARIABLES: dict[str, Variable] = {
    "unstable_period": Variable(
        _BRANCH, "1", "periods of the excitation in one of the unstable motions beyond the end", "<i4", 0
    ),
    "unstable_finish": kind_variable(
        _BRANCH, "how the branch stops being unstable; none: it leaves the range, or is lost"
    ),
    "unstable_finish_value": Variable(
        _BRANCH, FIRST_PARAMETER, "first parameter where it stops being unstable"
    ),
    "unstable_value": Variable(_MOTION, FIRST_PARAMETER, "first parameter of an unstable motion"),
    "unstable_multiplier_modulus": Variable(
        _MOTION, "1", "maximum modulus of its Floquet multipliers, above 1"
    ),
    "unstable_multiplier_angle": Variable(_MOTION, "rad", "angle of that multiplier"),
    "unstable_residual": Variable(_MOTION, "1", "scaled change of its state over one period"),
}


def fill_branch(rows: dict[str, Any], i: int, end: int, branch: "UnstableBranch") -> None:
    """Put a branch, of at most `MOTIONS` motions, into the row of the case behind whose end it goes on."""
    count = len(branch.values)
    rows["unstable_period"][i, end] = branch.period
    if branch.finish is not None:
        rows["unstable_finish"][i, end] = 1 + KINDS.index(branch.finish.kind)
        rows["unstable_finish_value"][i, end] = branch.finish.value
    rows["unstable_value"][i, end, :count] = branch.values
    largest = branch.multipliers[:, 0]
    rows["unstable_multiplier_modulus"][i, end, :count] = np.abs(largest)
    rows["unstable_multiplier_angle"][i, end, :count] = np.angle(largest)
    rows["unstable_residual"][i, end, :count] = [orbit.residual for orbit in branch.orbits]
