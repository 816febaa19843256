"""Where a run starts: the static equilibrium under load, or the unloaded position."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from tribodyn.dynamics.approach import APPROACH, COS, LEAN_COS, PRESENT
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.loads import load_torque
from tribodyn.dynamics.parameters import Model
from tribodyn.errors import SimulationError
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.step_control import largest_displacement, unbounded
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.train.clutches import Standing, standing
from tribodyn.train.flow import Flow, flow
from tribodyn.train.layout import displacements, velocities
from tribodyn.train.links.chain import are_linear, twist_under
from tribodyn.train.structure import (
    GearMesh,
    driven_arm,
    driver_arm,
    rolling_ratio,
    shift_of,
    turn_of,
    turned,
)

_COSINE, _COMPLIANCE, _GAP, _SHARE = (
    CHANNELS.index(name) for name in ("cosine", "compliance", "gap", "share")
)
#: Values of the unknown states, or what is left of the equations.
Trials = Float[Array, "*trial unknown"]
#: Share of all torques of a model below which what is left of them presses no flanks together.
_NO_LOAD = 1e-12
#: Share of an error by which the first flanks to touch stay apart, so that no rounding presses them.
_APART = 1e-15
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
    states: Float[Array, "*places state"], phase: Any, interval: Any, model: Model
) -> Float[Array, "*places state"]:
    """Derivatives of states per reference cycle, many at once, without compiled code, each at its place."""
    rates: dict[int, Any] = {}
    derivatives(phase, 0.0, interval, np.moveaxis(states, -1, 0), model, contacts_of(model), rates)
    return np.stack(
        [np.broadcast_to(rates[i], states.shape[:-1]) for i in range(model.layout.states)], axis=-1
    )


def static_deflection(mesh: GearMesh, torque: float) -> float:
    """Deflection of a mesh under a torque on its driven body, all on one segment's pairs, m; a scale."""
    table = mesh.table
    channel, in_contact = np.asarray(table.channel)[-1, 0, :, :, 0], np.asarray(table.in_contact)[-1]
    stiffness = float(np.sum(channel[:, _SHARE] / channel[:, _COMPLIANCE] * in_contact))
    cosine = float(channel[-1, _COSINE])
    return abs(torque) / (abs(float(mesh.driven_radius)) * cosine) / stiffness


def static_equilibrium(
    model: Model, phase: float = 0.0, interval: int = 0, near: Float[Array, " state"] | None = None
) -> Float[Array, " state"]:
    """State at which nothing accelerates relative to the reference, at one phase.

    Solved by damped Newton steps on the equations of motion themselves, friction included, for translations
    and micro-rotations; all relative velocities are zero. Load and drive press the driving flanks together,
    or the back flanks where there are any. Where they press neither, in all meshes, every position within the
    backlash is in equilibrium: returned is the one in which the driving flanks begin to touch, the limit of a
    vanishing load. Steps begin at the state `near` it, if known. Raises SimulationError where there is none,
    e.g. because the load does not press the flanks together.
    """
    layout, operation = model.layout, model.operation
    time = phase * float(operation.pitch_angle) / float(operation.nominal_speed)
    varying = float(load_torque(time, operation))
    largest = float(np.sum(np.abs(np.concatenate([operation.load_torques, operation.load_amplitudes]))))
    torques = flow(model, varying, largest, starting=True)
    loads = torques.on_driven
    deflection = np.array(
        [static_deflection(mesh, max(abs(t), 1e-3)) for mesh, t in zip(model.meshes, loads, strict=True)]
    )
    stand = torques.clutches
    roots = set(stand.roots) if stand is not None else set()  # where these are does not count
    fixed = {turn_of(body, layout) for body in roots}
    unknown = [i for i in displacements(layout) if i not in fixed]
    equation = [i for i in velocities(layout) if i - layout.half not in fixed]
    # at which the first of the driving flanks touches while no bearing is loaded
    touch = np.array([min(by_side[1.0]) for by_side in _apart_unloaded(model, phase, interval)])
    touch = touch - _APART * np.abs(touch) + 0.0  # not −0
    y = _closed(model, touch, torques)
    if stand is not None:
        for body in range(1, layout.bodies):
            y[layout.half + turn_of(body, layout)] = stand.rate[body]

    def residual(values: Trials, model: Model = model) -> Trials:
        """What is left of the accelerations at values of the unknown states, the others as in `y`."""
        states = np.broadcast_to(y, (*values.shape[:-1], layout.states)).copy()
        states[..., unknown] = values
        left = accelerations(states, phase, interval, model)
        if stand is not None:
            _against_roots(left, stand, model)
        return left[..., equation]

    ratio = [
        abs(float(rolling_ratio(m, model) * mesh.driver_radius / mesh.driven_radius))
        for m, mesh in enumerate(model.meshes)
    ]
    if np.all(np.abs(loads) * ratio <= _NO_LOAD * torques.largest):
        return y
    side = [
        1.0 if t * float(mesh.driven_radius) >= 0.0 else -1.0
        for mesh, t in zip(model.meshes, loads, strict=True)
    ]
    # beyond the width over which contact sets in, where the stiffness vanishes like the load
    gaps = _maximum_gaps(model, phase, interval, side)
    clear = 3.0 * deflection + float(operation.contact_width) + np.array(gaps)
    values = _closed(model, np.array(side) * clear, torques)[unknown]
    scale = _scales(model, deflection)[unknown]
    tolerance = 1e-6 * float(np.linalg.norm(residual(values))) + 1e-30
    loose = not are_linear(model.links.own)
    root = None if near is None else _root(residual, near[unknown], scale, tolerance, loose)
    root = _root(residual, values, scale, tolerance, loose) if root is None else root
    if root is None:  # damping of a moving error holds the flanks all but apart, or deep in each other
        for share in np.linspace(0.0, 1.0, DAMPING_STEPS).tolist():
            meshes = tuple(mesh._replace(damping=share * mesh.damping) for mesh in model.meshes)
            root = _root(
                partial(residual, model=model._replace(meshes=meshes)), values, scale, tolerance, loose
            )
            if root is None:
                sides = [np.asarray(mesh.table.side) for mesh in model.meshes]
                pressed = all(bool(np.any(of * way > 0)) for of, way in zip(sides, side, strict=True))
                raise SimulationError(DAMPED_AWAY if share else NOT_FOUND if pressed else APART)
            values = root
    y[unknown] = root
    if unbounded(y, model):
        moved = max(float(largest_displacement(m, y, model)) for m in range(layout.meshes))
        raise SimulationError(TOO_SOFT.format(moved))
    return y


def _against_roots(left: Trials, stand: Standing, model: Model) -> None:
    """Take off the accelerations of bodies beyond clutches those that their groups have as rigid ones."""
    layout, ratio = model.layout, np.asarray(model.bodies.ratio)
    for root in stand.roots:
        own = left[..., layout.half + turn_of(root, layout)].copy()
        for body, group in enumerate(stand.group):
            if group == stand.group[root]:
                left[..., layout.half + turn_of(body, layout)] -= own * ratio[body] / ratio[root]


def _closed(model: Model, errors: Float[Array, " mesh"], torques: Flow) -> Float[Array, " state"]:
    """State in which the meshes have rotational errors (m) and shafts the twist of their torque."""
    layout = model.layout
    if any(layout.pins):
        return _closed_on_pins(model, errors, torques)
    y = np.zeros(layout.states)
    for body, nearer, m, link in torques.branches:
        start = float(turned(nearer, y, layout))
        if link >= 0:
            twist = twist_under(link, torques.on_link[link], model)
            value = start + twist if body == layout.first[link] else start - twist
        else:
            mesh = model.meshes[m]
            ends = float(driver_arm(mesh)), float(driven_arm(mesh))
            if body == layout.driven[m]:
                value = (ends[0] * start - errors[m]) / ends[1]
            else:
                value = (ends[1] * start + errors[m]) / ends[0]
        y[turn_of(body, layout)] = value
    return y


def _closed_on_pins(model: Model, errors: Float[Array, " mesh"], torques: Flow) -> Float[Array, " state"]:
    """The same where planets close loops, by the smallest rotations; planets go with their carriers."""
    layout, y = model.layout, np.zeros(model.layout.states)
    rows, wanted = np.zeros((layout.meshes + len(torques.on_link), layout.bodies)), []
    for m, mesh in enumerate(model.meshes):
        rows[m, layout.driver[m]] += float(driver_arm(mesh))
        rows[m, layout.driven[m]] -= float(driven_arm(mesh))
        rows[m, layout.carrier[m]] -= float(mesh.carrier_arm)  # 0 of one in the housing
        wanted.append(float(errors[m]))
    for row, (link, torque) in enumerate(torques.on_link.items(), start=layout.meshes):
        if layout.second[link] >= 0:
            rows[row, layout.first[link]], rows[row, layout.second[link]] = 1.0, -1.0
        wanted.append(twist_under(link, torque, model) if layout.second[link] >= 0 else 0.0)
    still = [0, *(body for k, body in enumerate(layout.first) if layout.holds[k])]
    still += torques.clutches.roots if torques.clutches is not None else ()
    rows[:, still] = 0.0
    size = np.linalg.norm(rows, axis=1)
    size[size == 0.0] = 1.0
    turns, *_ = np.linalg.lstsq(rows / size[:, None], np.array(wanted) / size)
    y[[turn_of(body, layout) for body in range(layout.bodies)]] = turns
    for k, planet in enumerate(layout.first):
        if layout.pins[k]:
            moved = np.asarray(model.links.lever)[k, 1] * turns[layout.second[k]]
            y[shift_of(planet) : shift_of(planet) + 2] = moved
    return y


def _scales(model: Model, deflection: Float[Array, " mesh"]) -> Float[Array, " state"]:
    """Sizes of displacements, from the deflections of the meshes; m, rad."""
    layout = model.layout
    scale = np.zeros(layout.states)
    ends = [(layout.driver, "driver_radius"), (layout.driven, "driven_radius")]
    for bodies, radius in ends:
        for m, body in enumerate(bodies):
            if body < layout.planar:
                place = shift_of(body)
                scale[place : place + 2] = np.maximum(scale[place : place + 2], deflection[m])
            if body < layout.spatial:
                place = layout.tilts + 3 * body
                scale[place] = max(scale[place], deflection[m])
                tilt = deflection[m] / abs(float(getattr(model.meshes[m], radius)))
                scale[place + 1 : place + 3] = np.maximum(scale[place + 1 : place + 3], tilt)
            i = turn_of(body, layout)
            scale[i] = max(scale[i], deflection[m] / abs(float(getattr(model.meshes[m], radius))))
    # of what no mesh moves: as large as any
    rest = scale == 0.0
    turns = [turn_of(body, layout) for body in range(layout.bodies)]
    scale[rest] = np.max(deflection)
    tilts = [layout.tilts + 3 * body + i for body in range(layout.spatial) for i in (1, 2)]
    scale[[i for i in (*turns, *tilts) if rest[i]]] = max(scale[i] for i in turns if not rest[i])
    return scale


def _root(
    residual: Callable[[Trials], Trials],
    values: Float[Array, " unknown"],
    scale: Float[Array, " unknown"],
    tolerance: float,
    loose: bool,
) -> Float[Array, " unknown"] | None:
    """Where the residual is below a tolerance, by damped Newton steps; None where they do not get there.

    `loose`: a link may turn freely, and then stays where it is.
    """
    value = residual(values)
    steps = 1e-5 * np.diag(scale)
    for _ in range(60):
        size = np.linalg.norm(value)
        jacobian = ((residual(values + steps) - value) / (1e-5 * scale[:, None])).T
        if np.linalg.matrix_rank(jacobian) < len(values):
            if not loose:
                break  # the flanks are apart: nothing resists
            change = scale * np.linalg.lstsq(jacobian * scale, -value)[0]
        else:
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


def _maximum_gaps(model: Model, phase: float, interval: int, side: Sequence[float]) -> list[float]:
    """Largest distance between the flanks of a side (±1) of every mesh, as the error of the rotations, m.

    Where teeth differ, of those that are in contact there: it may be negative.
    """
    if not any(len(mesh.teeth.rate) for mesh in model.meshes):
        return [_maximum_gap(model, m, interval, side[m]) for m in range(model.layout.meshes)]
    apart = _apart_unloaded(model, phase, interval)
    gaps = [max(by_side.get(side[m], [0.0])) for m, by_side in enumerate(apart)]
    # where planets close loops the smallest rotations are a mean: none of the meshes may be left open
    return [max(gaps)] * len(gaps) if any(model.layout.pins) else gaps


def _apart_unloaded(model: Model, phase: float, interval: int) -> list[dict[float, list[float]]]:
    """Distances of the flanks of every mesh while no bearing is loaded, by side, as rotational errors, m."""
    work = contacts_of(model)
    derivatives(phase, 0.0, interval, np.zeros(model.layout.states), model, work, {})
    distances = []
    for m, mesh in enumerate(model.meshes):
        by_side: dict[float, list[float]] = {}
        for i, side in enumerate(np.asarray(mesh.table.side).tolist()):
            if work[m][PRESENT, i] > 0.0:
                gap = float(-work[m][APPROACH, i] / (work[m][COS, i] * work[m][LEAN_COS, i]))
                by_side.setdefault(side, []).append(gap)
        distances.append(by_side)
    return distances


def _maximum_gap(model: Model, m: int, interval: int, side: float) -> float:
    """The same of a mesh in which teeth are alike, over the whole segment of its table."""
    table = model.meshes[m].table
    segment = int(np.asarray(model.schedule.segment)[interval, m])
    there = (np.asarray(table.side) * side > 0) & (np.asarray(table.in_contact)[segment] > 0)
    if not there.any():
        return 0.0
    channel = np.asarray(table.channel)[segment][:, there]
    return float(max(0.0, np.max(channel[..., _GAP, 0])) / np.min(channel[..., _COSINE, 0]))


def initial_state(model: Model, kind: str) -> Float[Array, " state"]:
    """State at the start of a run: "static" equilibrium, or "unloaded" with the flanks just touching."""
    if kind == "static":
        return static_equilibrium(model)
    layout, y = model.layout, np.zeros(model.layout.states)
    if layout.clutches:
        rate = standing(model, np.array(model.bodies.load, dtype=float)).rate
        for body in range(1, layout.bodies):
            y[layout.half + turn_of(body, layout)] = rate[body]
    return y
