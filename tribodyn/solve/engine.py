"""What every integration engine takes and returns, and how a failure is told."""

from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.dynamics.parameters import (
    DISPLACEMENTS,
    LAG,
    MOTOR_SLIP,
    SLIP,
    STATES,
    TWIST,
    VELOCITIES,
    WORKS,
    Model,
)

DONE, STEP_TOO_SMALL, TOO_MANY_STEPS, NOT_FINITE, STALLED, GAVE_UP = range(6)

REASONS = {
    STEP_TOO_SMALL: "the step size fell below 1e-13 mesh cycles",
    TOO_MANY_STEPS: "the limit of steps in one mesh cycle was reached; raise solver.max_steps or choose a "
    "stiff solver.method",
    NOT_FINITE: "the solution stopped being finite",
    STALLED: "the pinion came to rest; integration in mesh phase needs it to turn forwards",
    GAVE_UP: "the solver gave up",
}


class Tolerances(NamedTuple):
    """Error control: relative tolerance and absolute ones for every state."""

    rtol: float
    atol: np.ndarray
    max_steps: int


class March(NamedTuple):
    """What all cases of a batch share; see `ensemble.march`."""

    first_cycle: int
    cycles: int
    window: int
    samples: int
    started: bool
    rtol: float
    max_steps: int


class Block(NamedTuple):
    """A run of whole mesh cycles.

    Attributes
    ----------
    samples : (n, STATES)
        States at phases k/samples_per_cycle, first one included, last one not; fewer on a failure.
    state : (STATES,)
        State at the end, before the next engagement.
    status : int
        DONE or the kind of failure.
    reached : float
        Mesh cycles done in this block.
    steps, evaluations : int
    message : str
        The solver's own words, if any.
    """

    samples: np.ndarray
    state: np.ndarray
    status: int
    reached: float
    steps: int
    evaluations: int
    message: str = ""


class Engine(Protocol):
    """Integrates blocks of whole mesh cycles one after the other.

    `started` says whether the next block opens with the engagement at phase 0: not at the start of a run.
    """

    started: bool

    def block(self, state: np.ndarray, first_cycle: int, cycles: int) -> Block:
        """Integrate `cycles` cycles; `state` stands before the engagement that opens the block."""
        ...


def mean_stiffness(model: Model) -> float:
    """Stiffness of one pair, from its mean compliance over the mesh cycle, N/m."""
    return 1.0 / float(np.mean(np.asarray(model.table.channel)[..., 4, 0]))


def absolute_tolerances(
    model: Model, rtol: float, deflection: float, stiffness: float | None = None
) -> np.ndarray:
    """Rtol times the scale of every state, from the static deflection of the mesh (m).

    Displacements scale with the deflection, velocities with the deflection times the mesh's natural
    frequency, works with the energy transmitted in one mesh cycle. `stiffness` is `mean_stiffness`, if known.
    """
    mechanics, table = model.mechanics, model.table
    pinion_radius, gear_radius = float(table.pinion_pitch_radius), float(table.gear_pitch_radius)
    mass = 1.0 / (pinion_radius**2 / mechanics.pinion_inertia + gear_radius**2 / mechanics.gear_inertia)
    stiffness = stiffness or mean_stiffness(model)
    frequency = np.sqrt(stiffness / mass)
    velocity = deflection * frequency
    scale = np.empty(STATES)
    scale[list(DISPLACEMENTS)] = deflection
    scale[list(VELOCITIES)] = velocity
    scale[[SLIP, MOTOR_SLIP]] = velocity / pinion_radius
    scale[TWIST] = deflection / pinion_radius
    scale[LAG] = deflection / pinion_radius / mechanics.nominal_speed
    energy = stiffness * deflection * pinion_radius * float(table.pitch_angle)
    scale[list(WORKS)] = energy
    return rtol * scale
