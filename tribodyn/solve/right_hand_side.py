"""The model as every integrator takes it: the right-hand side as machine code, and what engagement does.

An engagement changes the state where the set of contacting pairs changes.
"""

from typing import Any

import numpy as np

from tribodyn.dynamics.approach import QUANTITIES
from tribodyn.dynamics.energy import engagement
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import law, truncate, where
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.structure import IN, PARAMETRIC, turn_of


@law
def engage(interval, applies, y, model, work, behind):
    """Take a state over the boundary at the start of an interval; of a cycle's first over the last one's end.

    `applies` says whether the state stands before the boundary; if not, it stays: at the start of a run.
    `behind` receives the states that may jump: the reference's slip, the rates of the other bodies'
    micro-rotations, work in, parametric work; it may be `y`.
    """
    layout = model.options.layout
    half, works = layout.half, layout.mechanical
    slip, work_in, parametric = engagement(interval, y, model, work)
    behind[half + layout.lag] = where(applies, y[half + layout.lag] + slip, y[half + layout.lag])
    for body in range(1, layout.bodies):
        i = half + turn_of(body, layout)
        behind[i] = where(applies, y[i] - model.bodies.ratio[body] * slip, y[i])
    behind[works + IN] = where(applies, y[works + IN] + work_in, y[works + IN])
    behind[works + PARAMETRIC] = where(applies, y[works + PARAMETRIC] + parametric, y[works + PARAMETRIC])


@law
def interval_at(cycle, model):
    """Number of the interval that begins a reference cycle, by the cycles before; whole numbers."""
    first = model.schedule.first
    return truncate(first[cycle % (first.shape[0] - 1)])


def engaged(interval: Any, applies: Any, y: Any, model: Model) -> list[Any]:
    """All states behind the boundary, one by one: `engage` for arrays that cannot be written to."""
    states = model.layout.states
    behind = {i: y[i] for i in range(states)}
    engage(interval, applies, y, model, contacts_of(model), behind)
    return [behind[i] for i in range(states)]


def engage_next(state: Float[Array, " state"], cycle: int, model: Model) -> None:
    """Take a state at the start of a reference cycle over the engagement there, in place."""
    engage(int(interval_at(cycle, model)), True, state, model, contacts_of(model), state)


def contacts_of(model: Model) -> list[dict[Any, Any]]:
    """What takes the quantities of every mesh's contacts where no compiled code does."""
    return [{} for _ in model.meshes]


def work_array(model: Model) -> Float[Array, "mesh quantity pair"]:
    """Scratch for the contacts' quantities."""
    return np.zeros((len(model.meshes), QUANTITIES + model.pairs, model.pairs))


@kernel
def rhs(phase, cycle, interval, y, model, work, dy):
    """The compiled right-hand side; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, interval, y, model, work, dy)
