"""Error control: a relative tolerance, and absolute ones from the scale of every state."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics import parameters
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
    """What tolerances take from the mesh cycle's table alone."""

    stiffness: float  # of one pair, from its mean compliance over the mesh cycle, N/m
    per_torque: float  # deflection per torque, m/(N m)
    gap_slope: float  # largest slope of the gaps over the pinion's rotation, m/rad


def table_scales(model: parameters.Model) -> TableScales:
    """The scales of a model's table."""
    channel, boundary = np.asarray(model.table.channel), np.asarray(model.table.boundary)
    widths = np.diff(boundary) * float(model.table.pitch_angle) / channel.shape[1]
    steepest = np.max(np.abs(channel[..., _GAP, 1]), axis=1) * np.asarray(model.table.in_contact)
    return TableScales(
        1.0 / float(np.mean(channel[..., _COMPLIANCE, 0])),
        static_deflection(model, 1.0),
        float(np.max(np.max(steepest, axis=-1) / widths)),
    )


def _mass(model: parameters.Model) -> float:
    """Mass that the two inertias have along the pitch tangent, kg."""
    mechanics, table = model.mechanics, model.table
    pinion, gear = float(table.pinion_pitch_radius), float(table.gear_pitch_radius)
    return float(1.0 / (pinion**2 / mechanics.pinion_inertia + gear**2 / mechanics.gear_inertia))


def _transmitted(model: parameters.Model, deflection: float, stiffness: float) -> float:
    """Energy that a mesh with a deflection transmits in one mesh cycle, J."""
    return stiffness * deflection * float(model.table.pinion_pitch_radius) * float(model.table.pitch_angle)


def absolute_tolerances(
    model: parameters.Model,
    rtol: float,
    deflection: float,
    scales: TableScales | None = None,
    energy: float | None = None,
) -> Float[Array, " state"]:
    """Rtol times the scale of every state, from the static deflection of the mesh (m).

    Displacements scale with the deflection, velocities with the deflection times the mesh's natural
    frequency, works with a share of an energy (J; None: that transmitted in one mesh cycle). `scales` are
    those of the table, if known.
    """
    pinion_radius = float(model.table.pinion_pitch_radius)
    stiffness = (scales or table_scales(model)).stiffness
    velocity = deflection * np.sqrt(stiffness / _mass(model))
    scale = np.empty(parameters.STATES)
    scale[list(parameters.DISPLACEMENTS)] = deflection
    scale[list(parameters.VELOCITIES)] = velocity
    scale[[parameters.SLIP, parameters.MOTOR_SLIP]] = velocity / pinion_radius
    scale[parameters.TWIST] = deflection / pinion_radius
    scale[parameters.LAG] = deflection / pinion_radius / model.mechanics.nominal_speed
    energy = _transmitted(model, deflection, stiffness) if energy is None else energy
    scale[list(parameters.WORKS)] = SHARE_OF_WORKS * energy
    return rtol * scale


def state_scales(model: parameters.Model, state: Float[Array, " state"]) -> Float[Array, " state"]:
    """Sizes of all states by the deflection that the mesh has in a state or would have under the load."""
    scales = table_scales(model)
    return absolute_tolerances(model, 1.0, max(_loaded(model, state, scales), _least(model)), scales)


def _least(model: parameters.Model) -> float:
    """Smallest deflection that tolerances are scaled by, at least the width over which contact sets in; m."""
    return max(float(model.mechanics.contact_width), MINIMUM_DEFLECTION)


def _loaded(model: parameters.Model, state: Float[Array, " state"], scales: TableScales) -> float:
    """Deflection that the mesh has in a state or would have under its load, without the bearings; m.

    The load is the largest that constant part, harmonics and table can add up to.
    """
    mechanics, table = model.mechanics, model.table
    torque = abs(float(mechanics.load_torque)) + float(np.sum(np.abs(mechanics.load_amplitudes)))
    torque += float(np.max(np.abs(mechanics.load_torques), initial=0.0))
    there = np.asarray(table.in_contact)[0] > 0
    pairs, side = np.asarray(table.channel)[0, 0, there, :, 0], np.asarray(table.side)[there]
    along, across = (
        state[parameters.XI] + state[parameters.X_P] - state[parameters.X_G],
        state[parameters.Y_P] - state[parameters.Y_G],
    )
    pressed = side * along * pairs[:, _COSINE] + across * pairs[:, _SINE] - pairs[:, _GAP]
    return max(float(np.max(pressed)), scales.per_torque * torque)


def _energy(model: parameters.Model, loaded: float, scales: TableScales) -> float:
    """Energy that works are measured by, J.

    That transmitted in one mesh cycle; where there is no load, the kinetic energy that the gaps give, and at
    least the strain energy over the width in which contact sets in.
    """
    moved = _mass(model) * (scales.gap_slope * float(model.mechanics.nominal_speed)) ** 2
    strain = scales.stiffness * _least(model) ** 2
    return max(_transmitted(model, loaded, scales.stiffness), moved, strain)


def tolerances_from(
    model: parameters.Model, state: Float[Array, " state"], rtol: float, max_steps: int
) -> StepTolerances:
    """Tolerances scaled by the deflection that the mesh has in `state` or would have under the load."""
    return StepTolerances(rtol, tolerances_of_many([model], state[None], rtol)[0], max_steps)


def tolerances_of_many(
    models: Sequence[parameters.Model], states: Float[Array, "case state"], rtol: float
) -> Float[Array, "case state"]:
    """Absolute tolerances of many cases; what depends on the table alone is computed once per table."""
    known: dict[int, TableScales] = {}
    tolerances = np.empty((len(models), parameters.STATES))
    for case, model in enumerate(models):
        if id(model.table) not in known:
            known[id(model.table)] = table_scales(model)
        scales = known[id(model.table)]
        loaded = _loaded(model, states[case], scales)
        deflection, energy = max(loaded, _least(model)), _energy(model, loaded, scales)
        tolerances[case] = absolute_tolerances(model, rtol, deflection, scales, energy)
    # no relative part, see `step_control.RELATIVE`: in its place that of the deflection
    tolerances[:, list(parameters.DISPLACEMENTS)] *= 2.0
    return tolerances
