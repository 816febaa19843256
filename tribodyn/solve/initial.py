"""Where a run starts: the static equilibrium under load, or the unloaded position."""

from typing import Any

import numpy as np

from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import (
    DISPLACEMENTS,
    DRIVE_SHAFT,
    MOTOR_SLIP,
    SLIP,
    STATES,
    TWIST,
    VELOCITIES,
    XI,
    Model,
)
from tribodyn.errors import SimulationError
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float

_COSINE, _COMPLIANCE, _GAP = (CHANNELS.index(name) for name in ("cosine", "compliance", "gap"))


def accelerations(
    states: Float[Array, "*places state"], phase: Any, segment: Any, model: Model
) -> Float[Array, "*places state"]:
    """Derivatives of states per mesh cycle, many at once and without compiled code.

    Parameters
    ----------
    states : (..., STATES)
    phase, segment : float and int, or (...)
        Where in the mesh cycle each state stands.
    """
    rates: dict[int, Any] = {}
    derivatives(phase, 0.0, segment, np.moveaxis(states, -1, 0), model, {}, rates)
    return np.stack([np.broadcast_to(rates[i], states.shape[:-1]) for i in range(STATES)], axis=-1)


def static_deflection(model: Model, torque: float) -> float:
    """Deflection of the mesh under a gear torque, all on the first segment's pairs, m; a scale."""
    table = model.table
    channel, in_contact = np.asarray(table.channel)[-1, 0, :, :, 0], np.asarray(table.in_contact)[-1]
    stiffness = float(np.sum(1.0 / channel[:, _COMPLIANCE] * in_contact))
    cosine = float(channel[-1, _COSINE])
    return abs(torque) / (float(table.gear_pitch_radius) * cosine) / stiffness


def static_equilibrium(model: Model, phase: float = 0.0, segment: int = 0) -> Float[Array, " state"]:
    """State at which nothing accelerates relative to the pinion, at one phase of the mesh.

    Solved by damped Newton steps on the equations of motion themselves, friction included, for the
    translations, ξ and (with a shaft) its twist; all relative velocities are zero.

    Raises
    ------
    SimulationError
        If there is none, e.g. because the load does not press the flanks together.
    """
    torque = float(model.mechanics.load_torque)
    if model.mechanics.load_times.shape[0]:
        torque += float(model.mechanics.load_torques[0])
    deflection = static_deflection(model, max(abs(torque), 1e-3))
    unknown: list[int] = list(DISPLACEMENTS)
    equation = list(VELOCITIES)
    shaft = model.options.drive == DRIVE_SHAFT
    scale = np.full(len(unknown), deflection)
    y = np.zeros(STATES)
    y[XI] = 3.0 * deflection + _maximum_gap(model, segment)
    if shaft:
        unknown.append(TWIST)
        scale = np.append(scale, model.mechanics.drive_torque / model.mechanics.shaft_stiffness)
        y[TWIST] = scale[-1]

    def residual(values: Float[Array, "*trial unknown"]) -> Float[Array, "*trial unknown"]:
        states = np.broadcast_to(y, (*values.shape[:-1], STATES)).copy()
        states[..., unknown] = values
        rate = accelerations(states, phase, segment, model)
        if not shaft:
            return rate[..., equation]
        twisting = rate[..., MOTOR_SLIP] - rate[..., SLIP]
        return np.concatenate([rate[..., equation], twisting[..., None]], axis=-1)

    values = y[unknown]
    value = residual(values)
    start = np.linalg.norm(value)
    steps = 1e-5 * np.diag(scale)
    for _ in range(60):
        size = np.linalg.norm(value)
        jacobian = ((residual(values + steps) - value) / (1e-5 * scale[:, None])).T
        if np.linalg.matrix_rank(jacobian) < len(values):
            break  # the flanks are apart: nothing resists
        change = np.linalg.solve(jacobian, -value)
        factor = 1.0
        while factor > 1e-4:
            trial = residual(values + factor * change)
            if np.all(np.isfinite(trial)) and np.linalg.norm(trial) < size:
                break
            factor *= 0.5
        else:
            break
        values, value = values + factor * change, trial
        if np.linalg.norm(factor * change / scale) < 1e-12:
            break
    if not np.linalg.norm(value) <= 1e-6 * start + 1e-30:
        raise SimulationError(
            "there is no static equilibrium under the load at the start; check the sign of "
            'operating.gear_torque or start with solver.initial = "unloaded"'
        )
    y[unknown] = values
    return y


def _maximum_gap(model: Model, segment: int) -> float:
    """Largest distance that the static transmission error can put between the front flanks, as ξ; m."""
    table = model.table
    front = (np.asarray(table.side) > 0) & (np.asarray(table.in_contact)[segment] > 0)
    channel = np.asarray(table.channel)[segment][:, front]
    return float(max(0.0, np.max(channel[..., _GAP, 0])) / np.min(channel[..., _COSINE, 0]))


def initial_state(model: Model, kind: str) -> Float[Array, " state"]:
    """State at the start of a run: "static" equilibrium, or "unloaded" with the flanks just touching."""
    return static_equilibrium(model) if kind == "static" else np.zeros(STATES)
