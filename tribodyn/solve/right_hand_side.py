"""The model as every integrator takes it: the right-hand side as machine code, and what engagement does.

An engagement changes the state where the set of contacting pairs changes.
"""

from typing import Any

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import SLIP, STATES, WORK_IN, WORK_PARAMETRIC, XI_RATE, Model
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import law, where
from tribodyn.numerics.shapes import Array, Float


@law
def engage(segment, applies, y, model, work, behind):
    """Take a state over the boundary at the start of a segment; at segment 0 over the end of a mesh cycle.

    `applies` says whether the state stands before the boundary; if not, it stays: at the start of a run.
    `behind` receives the states that may jump, slip, ξ', work in, parametric work; it may be `y`.
    """
    boundary = model.table.boundary
    segments = model.table.in_contact.shape[0]
    before = (segment + segments - 1) % segments
    slip, xi_rate, work_in, parametric = engagement(
        before, boundary[before + 1], segment, boundary[segment], y, model, work
    )
    behind[SLIP] = where(applies, y[SLIP] + slip, y[SLIP])
    behind[XI_RATE] = where(applies, y[XI_RATE] + xi_rate, y[XI_RATE])
    behind[WORK_IN] = where(applies, y[WORK_IN] + work_in, y[WORK_IN])
    behind[WORK_PARAMETRIC] = where(applies, y[WORK_PARAMETRIC] + parametric, y[WORK_PARAMETRIC])


def engaged(segment: Any, applies: Any, y: Any, model: Model) -> list[Any]:
    """All states behind the boundary, one by one: `engage` for arrays that cannot be written to."""
    behind = {i: y[i] for i in range(STATES)}
    engage(segment, applies, y, model, {}, behind)
    return [behind[i] for i in range(STATES)]


def engage_next(state: Float[Array, " state"], model: Model) -> None:
    """Take a state at the end of a mesh cycle over the engagement that begins the next, in place."""
    engage(0, True, state, model, {}, state)


def work_array(model: Model) -> Float[Array, "quantity pair"]:
    """Scratch for the contacts' quantities."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs))


@kernel
def rhs(phase, cycle, segment, y, model, work, dy):
    """The compiled right-hand side; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, segment, y, model, work, dy)
