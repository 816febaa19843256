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
_COSINE, _SINE, _GAP = CHANNELS.index("cosine"), CHANNELS.index("sine"), CHANNELS.index("gap")
#: Smallest deflection that tolerances are scaled by, m.
MINIMUM_DEFLECTION = 1e-9
#: Scale of the works over the energy transmitted in a mesh cycle: errors of steps add up over the cycle. With
#: stiff bearings it costs no step.
SHARE_OF_WORKS = 1.0 / 30.0


class StepTolerances(NamedTuple):
    """Relative tolerance, absolute ones for every state, and the steps that a mesh cycle may take."""

    rtol: float
    atol: Float[Array, " state"]
    max_steps: int


class TableScales(NamedTuple):
    """What tolerances take from the mesh cycle's table alone.

    Attributes
    ----------
    stiffness : see `mean_stiffness`
    per_torque : deflection per torque, `static_deflection(model, 1.0)`, m/(N m)
    gap_slope : see `gap_slope`
    """

    stiffness: float
    per_torque: float
    gap_slope: float


def mean_stiffness(model: Model) -> float:
    """Stiffness of one pair, from its mean compliance over the mesh cycle, N/m."""
    return 1.0 / float(np.mean(np.asarray(model.table.channel)[..., _COMPLIANCE, 0]))


def _mass(model: Model) -> float:
    """Mass that the two inertias have along the pitch tangent, kg."""
    mechanics, table = model.mechanics, model.table
    pinion, gear = float(table.pinion_pitch_radius), float(table.gear_pitch_radius)
    return float(1.0 / (pinion**2 / mechanics.pinion_inertia + gear**2 / mechanics.gear_inertia))


def _transmitted(model: Model, deflection: float, stiffness: float) -> float:
    """Energy that a mesh with a deflection transmits in one mesh cycle, J."""
    return stiffness * deflection * float(model.table.pinion_pitch_radius) * float(model.table.pitch_angle)


def absolute_tolerances(
    model: Model,
    rtol: float,
    deflection: float,
    stiffness: float | None = None,
    energy: float | None = None,
) -> Float[Array, " state"]:
    """Rtol times the scale of every state, from the static deflection of the mesh (m).

    Displacements scale with the deflection, velocities with the deflection times the mesh's natural
    frequency, works with a share of an energy (J; None: that transmitted in one mesh cycle). `stiffness` is
    that of `mean_stiffness`, if known.
    """
    mechanics, table = model.mechanics, model.table
    pinion_radius = float(table.pinion_pitch_radius)
    stiffness = stiffness or mean_stiffness(model)
    frequency = np.sqrt(stiffness / _mass(model))
    velocity = deflection * frequency
    scale = np.empty(STATES)
    scale[list(DISPLACEMENTS)] = deflection
    scale[list(VELOCITIES)] = velocity
    scale[[SLIP, MOTOR_SLIP]] = velocity / pinion_radius
    scale[TWIST] = deflection / pinion_radius
    scale[LAG] = deflection / pinion_radius / mechanics.nominal_speed
    energy = _transmitted(model, deflection, stiffness) if energy is None else energy
    scale[list(WORKS)] = SHARE_OF_WORKS * energy
    return rtol * scale


def mesh_deflection(model: Model, state: Float[Array, " state"], per_torque: float | None = None) -> float:
    """`loaded_deflection`, at least the width over which contact sets in; m."""
    loaded = loaded_deflection(model, state, per_torque)
    return max(loaded, float(model.mechanics.contact_width), MINIMUM_DEFLECTION)


def loaded_deflection(model: Model, state: Float[Array, " state"], per_torque: float | None = None) -> float:
    """Deflection that the mesh has in a state or would have under its load, without the bearings; m.

    The load is the largest that constant part, harmonics and table can add up to. `per_torque` is
    `static_deflection(model, 1.0)`, if known.
    """
    mechanics = model.mechanics
    torque = abs(float(mechanics.load_torque)) + float(np.sum(np.abs(mechanics.load_amplitudes)))
    torque += float(np.max(np.abs(mechanics.load_torques), initial=0.0))
    per_torque = static_deflection(model, 1.0) if per_torque is None else per_torque
    pairs = np.asarray(model.table.channel)[0, 0, np.asarray(model.table.in_contact)[0] > 0, :, 0]
    side = np.asarray(model.table.side)[np.asarray(model.table.in_contact)[0] > 0]
    along, across = state[XI] + state[X_P] - state[X_G], state[Y_P] - state[Y_G]
    pressed = side * along * pairs[:, _COSINE] + across * pairs[:, _SINE] - pairs[:, _GAP]
    return max(float(np.max(pressed)), per_torque * torque)


def gap_slope(model: Model) -> float:
    """Largest slope of the gaps over the pinion's rotation, m/rad."""
    channel, boundary = np.asarray(model.table.channel), np.asarray(model.table.boundary)
    widths = np.diff(boundary) * float(model.table.pitch_angle) / channel.shape[1]
    steepest = np.max(np.abs(channel[..., _GAP, 1]), axis=1) * np.asarray(model.table.in_contact)
    return float(np.max(np.max(steepest, axis=-1) / widths))


def energy_scale(model: Model, loaded: float, scales: TableScales) -> float:
    """Energy that works are measured by, J.

    That transmitted in one mesh cycle; where there is no load, the kinetic energy that the gaps give, and at
    least the strain energy over the width in which contact sets in.
    """
    mechanics = model.mechanics
    width = max(float(mechanics.contact_width), MINIMUM_DEFLECTION)
    moved = _mass(model) * (scales.gap_slope * float(mechanics.nominal_speed)) ** 2
    return max(_transmitted(model, loaded, scales.stiffness), moved, scales.stiffness * width**2)


def tolerances_from(
    model: Model, state: Float[Array, " state"], rtol: float, max_steps: int
) -> StepTolerances:
    """StepTolerances scaled by the deflection that the mesh has in `state` or would have under the load."""
    return StepTolerances(rtol, tolerances_of_many([model], state[None], rtol)[0], max_steps)


def tolerances_of_many(
    models: Sequence[Model], states: Float[Array, "case state"], rtol: float
) -> Float[Array, "case state"]:
    """Absolute tolerances of many cases; what depends on the table alone is computed once per table."""
    known: dict[int, TableScales] = {}
    tolerances = np.empty((len(models), STATES))
    for case, model in enumerate(models):
        if id(model.table) not in known:
            known[id(model.table)] = TableScales(
                mean_stiffness(model), static_deflection(model, 1.0), gap_slope(model)
            )
        scales = known[id(model.table)]
        deflection = mesh_deflection(model, states[case], scales.per_torque)
        energy = energy_scale(model, loaded_deflection(model, states[case], scales.per_torque), scales)
        tolerances[case] = absolute_tolerances(model, rtol, deflection, scales.stiffness, energy)
    # no relative part, see `step_control.RELATIVE`: in its place that of the deflection
    tolerances[:, list(DISPLACEMENTS)] *= 2.0
    return tolerances
