"""Where a run starts: the static equilibrium under load, or the unloaded position."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from tribodyn.dynamics import parameters
from tribodyn.dynamics.contact_forces import APPROACH, COS
from tribodyn.dynamics.equations import derivatives, load_torque
from tribodyn.errors import SimulationError
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.step_control import largest_displacement, unbounded

_COSINE, _COMPLIANCE, _GAP = (CHANNELS.index(name) for name in ("cosine", "compliance", "gap"))
#: Values of the unknown states, or what is left of the equations.
Trials = Float[Array, "*trial unknown"]
#: Share of all torques of a model below which what is left of them presses no flanks together.
_NO_LOAD = 1e-12
#: Shares of the damping, from none to all of it, over which an equilibrium is followed that is not found at
#: once.
DAMPING_STEPS = 33
APART = (
    "there is no static equilibrium under the load at the start, which turns the flanks apart; check the "
    "sign of operating.gear_torque, give mesh.backlash for the back flanks to carry, or start with "
    'solver.initial = "unloaded"'
)
NOT_FOUND = (
    "no static equilibrium was found under the load at the start, although it presses the flanks together; "
    'use less friction or stiffer bearings, or start with solver.initial = "unloaded"'
)
DAMPED_AWAY = (
    "there is a static equilibrium under the load at the start, but the damping of the moving transmission "
    "error takes it away; use a lower mesh.damping_ratio, error or speed, or start with "
    'solver.initial = "unloaded"'
)
TOO_SOFT = (
    "under the load the gears would move by {:.3g} m, more than the centre distance; use stiffer bearings or "
    "a smaller torque"
)


def accelerations(
    states: Float[Array, "*places state"], phase: Any, segment: Any, model: parameters.Model
) -> Float[Array, "*places state"]:
    """Derivatives of states per mesh cycle, many at once and without compiled code, each at its place."""
    rates: dict[int, Any] = {}
    derivatives(phase, 0.0, segment, np.moveaxis(states, -1, 0), model, {}, rates)
    return np.stack([np.broadcast_to(rates[i], states.shape[:-1]) for i in range(parameters.STATES)], axis=-1)


def static_deflection(model: parameters.Model, torque: float) -> float:
    """Deflection of the mesh under a gear torque, all on the first segment's pairs, m; a scale."""
    table = model.table
    channel, in_contact = np.asarray(table.channel)[-1, 0, :, :, 0], np.asarray(table.in_contact)[-1]
    stiffness = float(np.sum(1.0 / channel[:, _COMPLIANCE] * in_contact))
    cosine = float(channel[-1, _COSINE])
    return abs(torque) / (float(table.gear_pitch_radius) * cosine) / stiffness


def static_equilibrium(
    model: parameters.Model, phase: float = 0.0, segment: int = 0
) -> Float[Array, " state"]:
    """State at which nothing accelerates relative to the pinion, at one phase of the mesh.

    Solved by damped Newton steps on the equations of motion themselves, friction included, for the
    translations, ξ and (with a shaft) its twist; all relative velocities are zero. The load and the drive
    press the driving flanks together, or the back flanks where there are any. Where they press neither, every
    position within the backlash is in equilibrium: returned is the one in which the driving flanks begin to
    touch, the limit of a vanishing load. Raises SimulationError where there is none, e.g. because the load
    does not press the flanks together.
    """
    mechanics = model.mechanics
    time = phase * float(model.table.pitch_angle) / float(mechanics.nominal_speed)
    torque = float(load_torque(time, 0.0, mechanics))
    deflection = static_deflection(model, max(abs(torque), 1e-3))
    unknown: list[int] = list(parameters.DISPLACEMENTS)
    equation = list(parameters.VELOCITIES)
    shaft = model.options.drive == parameters.DRIVE_SHAFT
    scale = np.full(len(unknown), deflection)
    y = np.zeros(parameters.STATES)
    y[parameters.XI] = _first_touch(model, phase, segment)
    if shaft:
        unknown.append(parameters.TWIST)
        torques = max(abs(float(mechanics.drive_torque)), abs(torque), 1e-3)
        scale = np.append(scale, torques / mechanics.shaft_stiffness)
    values = y[unknown]

    def residual(values: Trials, model: parameters.Model = model) -> Trials:
        """What is left of the accelerations at values of the unknown states, the others as in `y`."""
        states = np.broadcast_to(y, (*values.shape[:-1], parameters.STATES)).copy()
        states[..., unknown] = values
        rate = accelerations(states, phase, segment, model)
        if not shaft:
            return rate[..., equation]
        twisting = rate[..., parameters.MOTOR_SLIP] - rate[..., parameters.SLIP]
        return np.concatenate([rate[..., equation], twisting[..., None]], axis=-1)

    if shaft:  # which the free bodies twist in proportion
        twist = np.append(np.zeros(len(scale) - 1), scale[-1])
        free, twisted = residual(values)[-1], residual(values + twist)[-1]
        values[-1] = scale[-1] * free / (free - twisted)
    push = float(residual(values)[equation.index(parameters.XI_RATE)]) * float(mechanics.gear_inertia)
    if abs(push) <= _NO_LOAD * _torques(model) * float(model.table.gear_pitch_radius):
        y[unknown] = values
        return y
    side = 1.0 if push > 0.0 else -1.0
    # beyond the width over which contact sets in, where the stiffness vanishes like the load
    clear = 3.0 * deflection + float(mechanics.contact_width) + _maximum_gap(model, segment, side)
    values[unknown.index(parameters.XI)] = side * clear
    tolerance = 1e-6 * float(np.linalg.norm(residual(values))) + 1e-30
    found = _root(residual, values, scale, tolerance)
    if found is None:  # damping of a moving error holds the flanks all but apart, or deep in each other
        shares = np.linspace(0.0, 1.0, DAMPING_STEPS)
        for damping in shares * float(mechanics.mesh_damping):
            softer = model._replace(mechanics=mechanics._replace(mesh_damping=damping))
            found = _root(partial(residual, model=softer), values, scale, tolerance)
            if found is None:
                pressed = bool(np.any(np.asarray(model.table.side) * side > 0))
                raise SimulationError(DAMPED_AWAY if damping else NOT_FOUND if pressed else APART)
            values = found
    y[unknown] = found
    if unbounded(y, model.table):
        raise SimulationError(TOO_SOFT.format(float(largest_displacement(y))))
    return y


def _root(
    residual: Callable[[Trials], Trials],
    values: Float[Array, " unknown"],
    scale: Float[Array, " unknown"],
    tolerance: float,
) -> Float[Array, " unknown"] | None:
    """Where the residual is below a tolerance, by damped Newton steps; None where they do not get there."""
    value = residual(values)
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
    return values if np.linalg.norm(value) <= tolerance else None


def _maximum_gap(model: parameters.Model, segment: int, side: float) -> float:
    """Largest distance between the flanks of a side (±1), as ξ, m: by static transmission error, backlash."""
    table = model.table
    there = (np.asarray(table.side) * side > 0) & (np.asarray(table.in_contact)[segment] > 0)
    if not there.any():
        return 0.0
    channel = np.asarray(table.channel)[segment][:, there]
    return float(max(0.0, np.max(channel[..., _GAP, 0])) / np.min(channel[..., _COSINE, 0]))


def _first_touch(model: parameters.Model, phase: float, segment: int) -> float:
    """ξ at which the first of the driving flanks touches while no bearing is loaded, m."""
    work: dict[tuple[int, int], Any] = {}
    derivatives(phase, 0.0, segment, np.zeros(parameters.STATES), model, work, {})
    table = model.table
    driving = np.flatnonzero((np.asarray(table.side) > 0) & (np.asarray(table.in_contact)[segment] > 0))
    return min(float(-work[APPROACH, i] / work[COS, i]) for i in map(int, driving)) + 0.0  # not −0


def _torques(model: parameters.Model) -> float:
    """Sum of the magnitudes of all torques on the gears, N m."""
    mechanics = model.mechanics
    load = np.concatenate([mechanics.load_torques, mechanics.load_amplitudes, [mechanics.load_torque]])
    return float(np.sum(np.abs(load)) + abs(mechanics.drive_torque))


def initial_state(model: parameters.Model, kind: str) -> Float[Array, " state"]:
    """State at the start of a run: "static" equilibrium, or "unloaded" with the flanks just touching."""
    return static_equilibrium(model) if kind == "static" else np.zeros(parameters.STATES)
