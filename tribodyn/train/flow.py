"""How torque flows through a train whose bodies are rigid: a first guess, and a scale, for every mesh."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.clutches import Standing, accelerating, standing, taken_by_inertia
from tribodyn.train.kinematics import TrainSpeeds
from tribodyn.train.layout import TrainLayout
from tribodyn.train.motor import torque_at
from tribodyn.train.structure import (
    TURN,
    driven_arm,
    driver_arm,
    shift_of,
    turn_of,
)
from tribodyn.train.willis import of_coupling, of_mesh, of_speed, reactions


class TreeBranch(NamedTuple):
    """A body with the one that it turns with, nearer to the reference, and what joins the two."""

    body: int
    nearer: int
    mesh: int  # -1 where a link or a clutch joins them
    link: int  # -1 where a mesh or a clutch joins them


def tree(
    layout: TrainLayout, turning_links: tuple[bool, ...], roots: Sequence[int] | None = None
) -> list[TreeBranch]:
    """A tree from the reference to all bodies, nearer ones first; of a closed loop it leaves a joint out.

    Bodies that are held are roots too. Where clutches are not closed, bodies beyond them are further `roots`.
    """
    joints = [(a, b, m, -1) for m, (a, b) in enumerate(zip(layout.driver, layout.driven, strict=True))]
    ends = zip(layout.first, layout.second, turning_links, strict=True)
    joints += [(a, b, -1, k) for k, (a, b, turns) in enumerate(ends) if b >= 0 and turns]
    if roots is None:
        ends = zip(layout.clutch_first, layout.clutch_second, strict=True)
        joints += [(a, b, -1, -1) for a, b in ends if b >= 0]
    branches: list[TreeBranch] = []
    reached = [0, *(roots or ()), *(a for k, a in enumerate(layout.first) if layout.holds[k])]
    for nearer in reached:
        for a, b, mesh, link in joints:
            body = b if a == nearer else a
            if nearer in (a, b) and body not in reached:
                reached.append(body)
                branches.append(TreeBranch(body, nearer, mesh, link))
    return branches


class Flow(NamedTuple):
    """Torques of a train at rest or accelerated as a rigid one."""

    branches: list[TreeBranch]
    #: torque of a mesh on its driven body, N m, with its signed radius: of that sign where it presses driving
    #: flanks
    on_driven: Float[Array, " mesh"]
    on_link: dict[int, float]  # torque with which a link of the tree turns its first end back, N m
    largest: float  # sum of all torques' magnitudes, as on the reference, N m
    clutches: Standing | None = None  # how they stand; None: there are none, or they are closed


def link_row(k: int, direction: int, model: Any) -> Float[Array, " coordinate"]:
    """What the coordinates strain a link by in x, y or rotation (0, 1, 2); zeros where it does not act."""
    layout = model.options.layout
    row = np.zeros(layout.half)
    ends = layout.first[k], layout.second[k]
    if direction == TURN:
        acts = ends[1] >= 0 or layout.holds[k]
    else:
        acts = max(ends) < layout.planar
    for end, (body, sign) in enumerate(zip(ends, (1.0, -1.0), strict=True)):
        if body < 0 or not acts:
            continue
        row[turn_of(body, layout) if direction == TURN else shift_of(body) + direction] = sign
        if direction != TURN and layout.pins[k]:
            row[turn_of(body, layout)] = sign * float(model.links.lever[k, end, direction])
    return row


def flow(model: Any, extra: float = 0.0, largest_extra: float = 0.0, starting: bool = False) -> Flow:
    """Torques under the constant loads and an extra one on the output; the drive balances or accelerates.

    Clutches are closed and brakes open; or, `starting`, as they stand at the start of a run.

    A mesh that closes a loop is given what flows through all of the train; where links have levers, as pins
    of planets have, the loads are shared so that the sum of the squares of all forces is least.
    """
    layout, bodies, operation = model.options.layout, model.bodies, model.operation
    ratio, inertia = np.asarray(bodies.ratio, dtype=float), np.asarray(bodies.inertia, dtype=float)
    wanted = np.array(bodies.load, dtype=float)
    largest = float(np.sum(np.abs(wanted * ratio)) + abs(largest_extra * ratio[layout.output]))
    wanted[layout.output] += extra
    slip = ratio * float(operation.start_slip) if starting else 0.0 * ratio
    wanted = wanted + np.asarray(bodies.load_damping) * slip
    if model.options.drive:
        speed = float(ratio[layout.input] * operation.nominal_speed + slip[layout.input])
        drive = float(torque_at(speed, slip[layout.input], operation)[0])
        largest += float(abs(drive * ratio[layout.input]))
        wanted[layout.input] -= drive
    stand = standing(model, wanted) if starting and layout.clutches else None
    if stand is not None:
        wanted = wanted + stand.load
        largest += float(np.sum(np.abs(stand.load * ratio)))
        wanted = wanted - accelerating(wanted, stand, model)
    turning_links = tuple(np.asarray(model.links.stiffness)[:, TURN] > 0.0)
    branches = tree(layout, turning_links, stand.roots if stand is not None else None)
    if any(layout.pins):
        on_driven, on_link = _shared(model, wanted, inertia * ratio, stand is None)
        return Flow(branches, on_driven, on_link, largest, stand)
    if model.options.drive and stand is None:
        wanted = wanted - taken_by_inertia(wanted, inertia, ratio)
    through = wanted * ratio  # as on the reference
    for branch in reversed(branches):
        through[branch.nearer] += through[branch.body]
    on_body = through / ratio
    on_driven = np.full(len(model.meshes), np.nan)
    for branch in branches:
        if branch.mesh >= 0:
            mesh, torque = model.meshes[branch.mesh], on_body[branch.body]
            back = -float(mesh.driver_sense * mesh.driven_radius / mesh.driver_radius)
            of_driven = branch.body == layout.driven[branch.mesh]
            on_driven[branch.mesh] = torque * (float(mesh.driven_sense) if of_driven else back)
    for m in np.flatnonzero(np.isnan(on_driven)):
        on_driven[m] = (through[0] if not model.options.drive else largest) / ratio[layout.driven[m]]
    on_link = {
        link: float(-on_body[body] if body == layout.first[link] else on_body[body])
        for body, _, _, link in branches
        if link >= 0
    }
    return Flow(branches, on_driven, on_link, largest, stand)


def _shared(
    model: Any, wanted: Float[Array, " body"], inertia: Float[Array, " body"], closed: bool
) -> tuple[Float[Array, " mesh"], dict[int, float]]:
    """Torques of meshes on their driven bodies and of all turning links that bear `wanted` (N m) together.

    Balances every body in x, y and rotation. Flanks press along the pitch tangent alone. Where the reference
    is free to accelerate, it does, by what is left; `inertia` is then of every body as by its ratio, kg m².
    """
    layout, links = model.options.layout, model.links
    scale = float(np.mean([abs(mesh.driver_radius) for mesh in model.meshes]))
    rows, link_of = [], []
    for m, mesh in enumerate(model.meshes):
        row = np.zeros(layout.half)
        along = float(mesh.along_x), float(mesh.along_y)
        ends = (layout.driver[m], -1.0, driver_arm(mesh)), (layout.driven[m], 1.0, driven_arm(mesh))
        for body, sign, arm in ends:
            row[turn_of(body, layout)] = sign * float(arm)
            if body < layout.planar:
                row[shift_of(body) : shift_of(body) + 2] = sign * np.array(along)
        rows.append(row)
    for k in range(layout.links):
        for direction in np.flatnonzero(np.asarray(links.stiffness)[k] > 0.0):
            row = link_row(k, int(direction), model)
            if direction == TURN and np.any(row):
                link_of.append((len(rows), k))
                row = scale * row
            rows.append(-row)
    for ends in zip(layout.clutch_first, layout.clutch_second, strict=True) if closed else ():
        if ends[1] >= 0:
            row = np.zeros(layout.half)
            row[[turn_of(end, layout) for end in ends]] = -scale, scale
            rows.append(row)
    balance = np.array(rows).T
    loads = np.zeros(layout.half)
    loads[[turn_of(body, layout) for body in range(layout.bodies)]] = wanted
    if model.options.drive:
        accelerating = np.zeros((layout.half, 1))
        accelerating[[turn_of(body, layout) for body in range(layout.bodies)], 0] = inertia
        balance = np.hstack([balance, accelerating * (scale / np.max(inertia))])
    else:  # what holds the reference's speed bears the rest
        balance, loads = np.delete(balance, layout.lag, axis=0), np.delete(loads, layout.lag)
    forces, *_ = np.linalg.lstsq(balance, loads)
    radii = np.array([float(mesh.driven_radius) for mesh in model.meshes])
    return forces[: len(radii)] * radii, {k: float(forces[row] * scale) for row, k in link_of}


class Torques(NamedTuple):
    """Nominal torques of a train, N m; positive where power flows from the input to the loads."""

    driven: tuple[float, ...]  # of each mesh on its driven gear
    source: float  # on the body at which power enters
    #: of each coupling, on its second body in that body's sense of rotation
    coupling: tuple[float, ...]
    #: of each body whose speed is given, along its motion: positive where power enters there
    given: tuple[float, ...] = ()


def nominal_torques(
    motion: TrainSpeeds,
    teeth: Sequence[tuple[int, int]],
    couplings: Sequence[tuple[int, int]],
    loads: Sequence[float],
) -> Torques:
    """Balance the loads (N m, of every body against its motion) through meshes and couplings, without losses.

    `teeth` are those of each mesh's driver and driven gear, without signs; couplings join bodies, by their
    new indices. Held and given bodies bear any torque. In a train with loops the balance leaves open how
    these share the load: here the sum of the squares of all tangential forces, taken over their modules, is
    least, see `willis.reactions`.
    """
    bodies, meshes = len(motion.bodies), len(teeth)
    if (bodies, meshes) == (2, 1) and motion.input == motion.driver[0]:  # without rounding
        driven, driver = (float(loads[body]) for body in (motion.driven[0], motion.driver[0]))
        return Torques((driven,), driver + driven * float(motion.ratio[motion.driven[0]]), ())
    held = [body for body in range(bodies) if motion.ratio[body] == 0]
    ends = zip(motion.driver, motion.driven, motion.carrier, teeth, strict=True)
    turns_like = [
        motion.sense[one] * motion.sense[two] for one, two in zip(motion.driver, motion.driven, strict=True)
    ]
    rows = [
        of_mesh(one, two, (own, -same * other), carrier)
        for (one, two, carrier, (own, other)), same in zip(ends, turns_like, strict=True)
    ]
    rows += [of_coupling(one, two) for one, two in couplings]
    rows += [of_speed(body) for body in (motion.input, *motion.given, *held)]
    along = [
        sense * (1 if ratio >= 0 else -1) for sense, ratio in zip(motion.sense, motion.ratio, strict=True)
    ]
    found = reactions(rows, {body: -along[body] * load for body, load in enumerate(loads) if load})
    on_driven = zip(found, motion.driven, turns_like, teeth, strict=False)
    outside = dict(zip((motion.input, *motion.given), found[meshes + len(couplings) :], strict=False))
    on_second = zip(found[meshes:], couplings, strict=False)
    return Torques(
        tuple(-same * force * other * motion.sense[body] for force, body, same, (_, other) in on_driven),
        outside[motion.input] * along[motion.input],
        tuple(-torque * motion.sense[two] for torque, (_, two) in on_second),
        tuple(outside[body] * along[body] for body in motion.given),
    )
