"""Where a run starts: the static equilibrium under load, or the unloaded position."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.approach import APPROACH, COS, LEAN_COS, PRESENT
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.loads import load_torque
from tribodyn.dynamics.mesh_motion import motion_of
from tribodyn.dynamics.parameters import Model
from tribodyn.errors import SimulationError
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.closing import closed_state, sizes_of
from tribodyn.solve.march.step_control import largest_displacement, unbounded
from tribodyn.solve.newton import Trials, roots_of
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.train.clutches import Standing, standing
from tribodyn.train.flow import flow
from tribodyn.train.layout import displacements, velocities
from tribodyn.train.links.chain import are_linear
from tribodyn.train.structure import (
    GearMesh,
    rolling_ratio,
    turn_of,
)

_COSINE, _COMPLIANCE, _GAP, _SHARE = (
    CHANNELS.index(name) for name in ("cosine", "compliance", "gap", "share")
)
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
    """One of `static_equilibria`."""
    start = None if near is None else near[None]
    return static_equilibria(model, np.array([phase]), np.array([interval]), start)[0]


def static_equilibria(
    model: Model,
    phases: Float[Array, " place"],
    intervals: Int[Array, " place"],
    near: Float[Array, "place state"] | None = None,
) -> Float[Array, "place state"]:
    """States at which nothing accelerates relative to the reference, each at its phase, all found together.

    Solved by damped Newton steps on the equations of motion themselves, friction included, for translations
    and micro-rotations; all relative velocities are zero. Load and drive press the driving flanks together,
    or the back flanks where there are any. Where they press neither, in all meshes, every position within the
    backlash is in equilibrium: returned is the one in which the driving flanks begin to touch, the limit of a
    vanishing load. Steps begin at the states `near` them, if known. Raises SimulationError where there is
    none, e.g. because the load does not press the flanks together.
    """
    layout = model.layout
    begin = [
        _begin(model, *place)
        for place in zip(phases, intervals, _apart(model, phases, intervals), strict=True)
    ]
    y, stand = np.array([each.touch for each in begin]), begin[0].stand
    # where bodies beyond clutches are does not count
    fixed = {turn_of(body, layout) for body in stand.roots} if stand is not None else set()
    unknown = [i for i in displacements(layout) if i not in fixed]
    equation = [i for i in velocities(layout) if i - layout.half not in fixed]

    def residual(rows: Int[Array, " row"], values: Trials, model: Model = model) -> Trials:
        """What is left of the accelerations at trials of places, the other states as in `y`."""
        states = np.repeat(y[rows, None], values.shape[1], axis=1)
        states[..., unknown] = values
        left = accelerations(states, phases[rows, None], intervals[rows, None], model)
        if stand is not None:
            _against_roots(left, stand, model)
        return left[..., equation]

    rows = np.flatnonzero([each.pressed is not None for each in begin])
    if not rows.size:
        return y
    every, scale = np.arange(len(rows)), np.max([begin[row].scale for row in rows], axis=0)[unknown]
    values = np.array([begin[row].pressed for row in rows])[:, unknown]
    tolerance = 1e-6 * np.linalg.norm(residual(rows, values[:, None])[:, 0], axis=-1) + 1e-30
    # a link may turn freely, and then stays where it is
    linear = are_linear(model.links.own) and not model.options.bearings.number
    bending = _seen_by_meshes(model, unknown) if linear else None
    roots = values.copy()

    def solve(some: Array, start: Array, model: Model = model) -> Array:
        """Fill in the roots of some of the rows; of which of them there are none."""

        def of_some(numbers: Array, trials: Trials) -> Trials:
            return residual(rows[some[numbers]], trials, model)

        roots[some], found = roots_of(of_some, start, scale, tolerance[some], bending)
        return some[~found]

    missing = every if near is None else solve(every, near[rows][:, unknown])
    missing = solve(missing, values[missing]) if missing.size else missing
    # damping of a moving error holds the flanks all but apart, or deep in each other
    begun = values
    for share in np.linspace(0.0, 1.0, DAMPING_STEPS).tolist() if missing.size else ():
        meshes = tuple(mesh._replace(damping=share * mesh.damping) for mesh in model.meshes)
        failed = solve(missing, begun[missing], model._replace(meshes=meshes))
        if failed.size:
            side = begin[rows[failed[0]]].side
            sides = [np.asarray(mesh.table.side) for mesh in model.meshes]
            pressed = all(bool(np.any(of * way > 0)) for of, way in zip(sides, side, strict=True))
            raise SimulationError(DAMPED_AWAY if share else NOT_FOUND if pressed else APART)
        begun = roots
    y[rows[:, None], unknown] = roots
    for state in y[rows]:
        if unbounded(state, model):
            moved = max(float(largest_displacement(m, state, model)) for m in range(layout.meshes))
            raise SimulationError(TOO_SOFT.format(moved))
    return y


def _seen_by_meshes(model: Model, unknown: Int[Array, " unknown"]) -> Float[Array, "number unknown"]:
    """What the contacts of all meshes see of positions."""
    y = np.zeros((model.layout.states, len(unknown)))
    y[unknown, np.arange(len(unknown))] = 1.0
    motions = [motion_of(m, y, model) for m in range(model.layout.meshes)]
    places = [(one.towards, one.across, one.axial, one.lean_along, one.lean_across) for one in motions]
    return np.array(places).reshape(-1, len(unknown))


class _Begin(NamedTuple):
    """Where the search for an equilibrium begins."""

    touch: Float[Array, " state"]  # the first of the driving flanks touches while no bearing is loaded
    pressed: Float[Array, " state"] | None  # deep in each other; None: no load presses any flanks
    scale: Float[Array, " state"]  # sizes of displacements; m, rad
    side: list[float]  # ±1: the flanks that the load presses, of every mesh
    stand: Standing | None  # what clutches hold


def _begin(model: Model, phase: float, interval: int, apart: list[dict[float, list[float]]]) -> _Begin:
    operation = model.operation
    time = phase * float(operation.pitch_angle) / float(operation.nominal_speed)
    varying = float(load_torque(time, operation))
    largest = float(np.sum(np.abs(np.concatenate([operation.load_torques, operation.load_amplitudes]))))
    torques = flow(model, varying, largest, starting=True)
    loads = torques.on_driven
    deflection = np.array(
        [static_deflection(mesh, max(abs(t), 1e-3)) for mesh, t in zip(model.meshes, loads, strict=True)]
    )
    touch = np.array([min(by_side[1.0]) for by_side in apart])
    touch = touch - _APART * np.abs(touch) + 0.0  # not −0
    side = [
        1.0 if t * float(mesh.driven_radius) >= 0.0 else -1.0
        for mesh, t in zip(model.meshes, loads, strict=True)
    ]
    ratio = [
        abs(float(rolling_ratio(m, model) * mesh.driver_radius / mesh.driven_radius))
        for m, mesh in enumerate(model.meshes)
    ]
    pressed = None
    if np.any(np.abs(loads) * ratio > _NO_LOAD * torques.largest):
        # beyond the width over which contact sets in, where the stiffness vanishes like the load
        gaps = _maximum_gaps(model, interval, side, apart)
        clear = 3.0 * deflection + float(operation.contact_width) + np.array(gaps)
        start, nearer = _settled_shafts(model)
        pressed = closed_state(model, np.array(side) * clear - nearer, torques) + start
    closed = closed_state(model, touch, torques)
    half = model.layout.half
    closed[half:] = _starting(model, torques.clutches)[half:]
    return _Begin(closed, pressed, sizes_of(model, deflection), side, torques.clutches)


def _settled_shafts(model: Model) -> tuple[Float[Array, " state"], Any]:
    """State of shafts whose bearings act in time, under the mean loads, and how far it closes the meshes, m.

    With clearance these do not hold shafts that are not displaced.
    """
    layout, start = model.layout, np.zeros(model.layout.states)
    if not model.options.bearings.number:
        return start, 0.0
    start[: layout.half] = model.links.bearings.settled
    return start, np.array([motion_of(m, start, model).towards for m in range(layout.meshes)])


def _against_roots(left: Trials, stand: Standing, model: Model) -> None:
    """Take off the accelerations of bodies beyond clutches those that their groups have as rigid ones."""
    layout, ratio = model.layout, np.asarray(model.bodies.ratio)
    for root in stand.roots:
        own = left[..., layout.half + turn_of(root, layout)].copy()
        for body, group in enumerate(stand.group):
            if group == stand.group[root]:
                left[..., layout.half + turn_of(body, layout)] -= own * ratio[body] / ratio[root]


def _maximum_gaps(
    model: Model, interval: int, side: Sequence[float], apart: list[dict[float, list[float]]]
) -> list[float]:
    """Largest distance between the flanks of a side (±1) of every mesh, as the error of the rotations, m.

    Where teeth differ, of those that are in contact there: it may be negative.
    """
    if not any(len(mesh.teeth.rate) for mesh in model.meshes):
        return [_maximum_gap(model, m, interval, side[m]) for m in range(model.layout.meshes)]
    gaps = [max(by_side.get(side[m], [0.0])) for m, by_side in enumerate(apart)]
    # where planets close loops the smallest rotations are a mean: none of the meshes may be left open
    return [max(gaps)] * len(gaps) if any(model.layout.pins) else gaps


def _apart(
    model: Model, phases: Float[Array, " place"], intervals: Int[Array, " place"]
) -> list[list[dict[float, list[float]]]]:
    """Distances of the flanks while no bearing is loaded, by place, mesh and side, as rotational errors."""
    work, count = contacts_of(model), len(phases)
    states = np.zeros((model.layout.states, count))
    derivatives(phases, 0.0, intervals, states, model, work, {})
    distances: list[list[dict[float, list[float]]]] = [[{} for _ in model.meshes] for _ in range(count)]
    for m, mesh in enumerate(model.meshes):
        for i, side in enumerate(np.asarray(mesh.table.side).tolist()):
            present = np.broadcast_to(work[m][PRESENT, i], count) > 0.0
            if not present.any():
                continue
            gap = -work[m][APPROACH, i] / (work[m][COS, i] * work[m][LEAN_COS, i])
            for place in np.flatnonzero(present).tolist():
                by_side = distances[place][m]
                by_side.setdefault(side, []).append(float(np.broadcast_to(gap, count)[place]))
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
    unbalanced = np.array(model.bodies.load, dtype=float)
    return _starting(model, standing(model, unbalanced) if model.layout.clutches else None)


def _starting(model: Model, stand: Standing | None) -> Float[Array, " state"]:
    """State of undisplaced bodies with the rates that they start with."""
    layout, y = model.layout, np.zeros(model.layout.states)
    if stand is not None:
        for body in range(1, layout.bodies):
            y[layout.half + turn_of(body, layout)] = stand.rate[body]
    y[layout.half + layout.lag] = model.operation.start_slip
    return y
