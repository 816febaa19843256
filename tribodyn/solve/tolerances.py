"""Error control: a relative tolerance, and absolute ones from the scale of every state."""

from collections.abc import Sequence
from typing import NamedTuple

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
    X_G,
    X_P,
    XI,
    Y_G,
    Y_P,
    Model,
)
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.initial import static_deflection

_COMPLIANCE = CHANNELS.index("compliance")
_COSINE, _SINE = CHANNELS.index("cosine"), CHANNELS.index("sine")
#: Smallest deflection that tolerances are scaled by, m.
MINIMUM_DEFLECTION = 1e-9
#: Scale of the works over the energy transmitted in a mesh cycle: errors of steps add up over the cycle. With
#: stiff bearings it costs no step.
SHARE_OF_WORKS = 1.0 / 30.0


class Tolerances(NamedTuple):
    """Relative tolerance, absolute ones for every state, and the steps that a mesh cycle may take."""

    rtol: float
    atol: Float[Array, " state"]
    max_steps: int


def mean_stiffness(model: Model) -> float:
    """Stiffness of one pair, from its mean compliance over the mesh cycle, N/m."""
    return 1.0 / float(np.mean(np.asarray(model.table.channel)[..., _COMPLIANCE, 0]))


def absolute_tolerances(
    model: Model, rtol: float, deflection: float, stiffness: float | None = None
) -> Float[Array, " state"]:
    """Rtol times the scale of every state, from the static deflection of the mesh (m).

    Displacements scale with the deflection, velocities with the deflection times the mesh's natural
    frequency, works with a share of the energy transmitted in one mesh cycle. `stiffness` is that of
    `mean_stiffness`, if known.
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
    scale[list(WORKS)] = SHARE_OF_WORKS * energy
    return rtol * scale


def mesh_deflection(model: Model, state: Float[Array, " state"], per_torque: float | None = None) -> float:
    """Deflection that the mesh has in a state or would have under its load, without the bearings; m.

    The load is the largest that constant part, harmonics and table can add up to. At least the width over
    which contact sets in. `per_torque` is `static_deflection(model, 1.0)`, if known.
    """
    mechanics = model.mechanics
    torque = abs(float(mechanics.load_torque)) + float(np.sum(np.abs(mechanics.load_amplitudes)))
    torque += float(np.max(np.abs(mechanics.load_torques), initial=0.0))
    per_torque = static_deflection(model, 1.0) if per_torque is None else per_torque
    pair = np.asarray(model.table.channel)[0, 0, -1, :, 0]
    along = state[XI] + state[X_P] - state[X_G]
    pressed = abs(float(along * pair[_COSINE] + (state[Y_P] - state[Y_G]) * pair[_SINE]))
    return max(pressed, per_torque * torque, float(mechanics.contact_width), MINIMUM_DEFLECTION)


def tolerances_from(model: Model, state: Float[Array, " state"], rtol: float, max_steps: int) -> Tolerances:
    """Tolerances scaled by the deflection that the mesh has in `state` or would have under the load."""
    return Tolerances(rtol, tolerances_of_many([model], state[None], rtol)[0], max_steps)


def tolerances_of_many(
    models: Sequence[Model], states: Float[Array, "case state"], rtol: float
) -> Float[Array, "case state"]:
    """Absolute tolerances of many cases; what depends on the table alone is computed once per table."""
    known: dict[int, tuple[float, float]] = {}
    tolerances = np.empty((len(models), STATES))
    for case, model in enumerate(models):
        if id(model.table) not in known:
            known[id(model.table)] = mean_stiffness(model), static_deflection(model, 1.0)
        stiffness, per_torque = known[id(model.table)]
        deflection = mesh_deflection(model, states[case], per_torque)
        tolerances[case] = absolute_tolerances(model, rtol, deflection, stiffness)
    # no relative part, see `step_control.RELATIVE`: in its place that of the deflection
    tolerances[:, list(DISPLACEMENTS)] *= 2.0
    return tolerances
