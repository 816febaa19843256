"""Modes of the model linearised at its mean stiffness under load: what the orders of the meshes can meet."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.loads import joins_in_space
from tribodyn.dynamics.parameters import DRIVE_SPEED, Model
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.train.bearing_forces import tangents
from tribodyn.train.coupling import own_mass
from tribodyn.train.flow import flow, link_row
from tribodyn.train.joints import joined
from tribodyn.train.links.chain import tangent_stiffness
from tribodyn.train.structure import (
    ACROSS,
    IN_SPACE,
    MOVES,
    TOWARDS,
    TURN,
    X,
    driven_arm,
    driver_arm,
    place_in_space,
    shift_of,
    turn_of,
)


class Modes(NamedTuple):
    """Undamped modes, lowest first."""

    frequency: Float[Array, " mode"]  # Hz
    #: of translations and rotations, as the state has its coordinates; of unit modal mass
    shape: Float[Array, "mode coordinate"]
    share: Float[Array, "mode body"]  # of the kinetic energy


def natural_frequencies(model: Model, cycles: Sequence[MeshCycle]) -> Float[Array, " mode"]:
    """Undamped natural frequencies, lowest first, Hz; see `modes`."""
    return modes(model, cycles).frequency


def modes(model: Model, cycles: Sequence[MeshCycle]) -> Modes:
    """Undamped modes of a train, from the mesh cycles of its meshes.

    The coordinates are translations and rotations of all bodies; a reference of prescribed speed does not
    turn, and where a torque drives, the rigid rotation is not among the modes. Stiffness is the tangent at
    the static load, the mean over the mesh cycle: at every phase of those driving pairs that carry when the
    load is shared by compliances, gaps and the bearings' give, each at its own load where the Hertz contact
    stiffens with it; so is that of a link with a law, unless it closes a loop: that at rest. No friction but
    that of clutches, which are closed; brakes are open.
    """
    layout = model.layout
    mass, stiffness = linearised(model, cycles)
    free = np.arange(layout.half) if model.options.drive else np.delete(np.arange(layout.half), layout.lag)
    closed = _closed_clutches(model, free) if layout.clutches else np.eye(layout.half)[:, free]
    mass_of_free, stiffness_of_free = (closed.T @ matrix @ closed for matrix in (mass, stiffness))
    root = np.linalg.inv(np.linalg.cholesky(mass_of_free))
    squared, vectors = np.linalg.eigh(root @ stiffness_of_free @ root.T)
    if model.options.drive:
        squared, vectors = squared[1:], vectors[:, 1:]
    shape = np.ascontiguousarray((closed @ (root.T @ vectors)).T)
    energy = shape * (shape @ mass)
    owner = np.array([_body_of(place, model) for place in range(layout.half)])
    share = np.stack([np.sum(energy[:, owner == body], axis=1) for body in range(layout.bodies)], axis=1)
    return Modes(np.sqrt(np.maximum(squared, 0.0)) / (2 * np.pi), shape, share)


def _closed_clutches(model: Model, free: Int[Array, " free"]) -> Float[Array, "coordinate free"]:
    """What the coordinates are of those that are left where the ends of every clutch turn alike."""
    layout = model.layout
    ends = zip(layout.clutch_first, layout.clutch_second, strict=True)
    alike = joined(layout.half, [(turn_of(a, layout), turn_of(b, layout)) for a, b in ends if b >= 0])
    held = {alike[i] for i in set(range(layout.half)) - set(free.tolist())}
    left = np.array([one for one in dict.fromkeys(alike) if one not in held])
    return (np.array(alike)[:, None] == left).astype(float)


def linearised(
    model: Model, cycles: Sequence[MeshCycle]
) -> tuple[Float[Array, "coordinate coordinate"], Float[Array, "coordinate coordinate"]]:
    """Mass and stiffness that `modes` are of, over all coordinates and the turn of the reference."""
    layout, bodies, links = model.layout, model.bodies, model.links
    mass, stiffness = np.diag(own_mass(layout, bodies)), np.zeros((layout.half, layout.half))
    extra = range(layout.half - layout.modes, layout.half)
    mass[extra, extra] = 0.0  # all that these have is in the couplings
    mass[layout.inertial_rows, layout.inertial_columns] += links.coupled.mass
    stiffness[layout.coupled_rows, layout.coupled_columns] += links.coupled.stiffness
    if model.options.bearings.number:
        stiffness += tangents(model)
    still = model._replace(options=model.options._replace(drive=DRIVE_SPEED))
    torques = flow(still)
    for k, (first, second) in enumerate(zip(layout.first, layout.second, strict=True)):
        ends = [body for body in (first, second) if body >= 0]
        in_space = joins_in_space(k, layout)
        if in_space:
            rows = np.zeros((IN_SPACE, layout.half))
            for sign, body in zip((1.0, -1.0), ends, strict=False):
                places = [place_in_space(body, direction, layout) for direction in range(IN_SPACE)]
                rows[np.arange(IN_SPACE), places] = sign
            stiffness += rows.T @ np.asarray(links.stiffness_in_space)[k] @ rows
        for direction in range(TURN if in_space else X, TURN + 1):
            row = link_row(k, direction, model)
            if not np.any(row):
                continue
            tangent = float(np.asarray(links.stiffness)[k, direction])
            if direction == TURN and tangent > 0.0:
                tangent = tangent_stiffness(k, torques.on_link.get(k, 0.0), model)
            stiffness += tangent * np.outer(row, row)
    for m, cycle in enumerate(cycles):
        rows = _directions(model, m)
        stiffness += rows.T @ _mean_stiffness(model, m, cycle, float(torques.on_driven[m])) @ rows
    return mass, stiffness


def _body_of(place: int, model: Model) -> int:
    """Body that a coordinate belongs to; behind all bodies where it is no body's."""
    layout = model.layout
    if place >= layout.half - layout.modes:
        return layout.bodies
    if place >= layout.tilts:
        return (place - layout.tilts) // 3
    return place // 3 if place < 3 * layout.planar else place - 2 * layout.planar


def _directions(model: Model, m: int) -> Float[Array, "move coordinate"]:
    """What the coordinates move a mesh by: `structure.MOVES`."""
    layout, mesh = model.layout, model.meshes[m]
    rows = np.zeros((MOVES, layout.half))
    ends = (layout.driver[m], driver_arm(mesh)), (layout.driven[m], -driven_arm(mesh))
    for end, (body, turn) in enumerate(ends):
        moving = IN_SPACE if body < layout.spatial else 2 if body < layout.planar else 0
        places = [place_in_space(body, direction, layout) for direction in range(moving)]
        rows[:, places] = np.asarray(mesh.moves)[end, :, :moving]
        rows[TOWARDS, turn_of(body, layout)] = float(turn)
    first, count = layout.rim_first[m], layout.rim_count[m]
    rows[: ACROSS + 1, first : first + count] = np.asarray(mesh.rim)[:, :count]
    return rows


def _support(model: Model, m: int) -> float:
    """How much the axes of a mesh move apart per force along the line of centres, by bearings alone, m/N."""
    layout, mesh = model.layout, model.meshes[m]
    stiffness = np.asarray(model.links.stiffness)
    total = _support_of_couplings(model, m)
    for body in (layout.driver[m], layout.driven[m]):
        mesh_bodies = [
            k
            for k, (a, b) in enumerate(zip(layout.first, layout.second, strict=True))
            if (a, b) == (body, -1)
        ]
        held = np.sum(stiffness[mesh_bodies, :TURN], axis=0)
        across = np.array([mesh.across_x, mesh.across_y], dtype=float)
        total += float(np.sum(across[held > 0.0] ** 2 / held[held > 0.0]))
    return total


def _support_of_couplings(model: Model, m: int) -> float:
    """The same of what couples many coordinates, m/N; 0 where a body of the mesh is not among them."""
    layout, coupled = model.layout, model.links.coupled
    places = sorted(set(layout.coupled_rows))
    across = _directions(model, m)[ACROSS][places]
    if not np.any(across):
        return 0.0
    stiffness = np.zeros((layout.half, layout.half))
    stiffness[layout.coupled_rows, layout.coupled_columns] = coupled.stiffness
    if model.options.bearings.number:
        stiffness += tangents(model)
    moved, *_ = np.linalg.lstsq(stiffness[np.ix_(places, places)], across)
    return float(across @ moved)


def _mean_stiffness(model: Model, m: int, cycle: MeshCycle, on_driven: float) -> Float[Array, "move move"]:
    """Mean over the mesh cycle of Σ_ij k_ij n_i n_jᵀ of the pairs that carry; N/m, N, N m.

    n is what the `MOVES` press a contact by: (cos α, sin α, 0, 0, 0) of a spur gear.
    """
    radius = float(model.meshes[m].driven_radius)
    if on_driven / radius < 0.0:  # it presses the back flanks together, in the mirrored world
        cycle = cycle._replace(side=-cycle.side)
    # N m; 1 N on the pitch circle where there is no load
    torque = float(np.copysign(max(abs(on_driven), abs(radius)), radius))
    if cycle.slices > 1:
        return _mean_of_slices(model, m, cycle, torque)
    still = np.sin(cycle.pressure_angle)
    # what a load on one pair moves the axes apart, it takes from the others: one more compliance they share
    shared = _support(model, m) * still[..., :, None] * still[..., None, :]
    direct = np.einsum("...ii->...i", shared)
    moving = cycle._replace(
        compliance=cycle.compliance + direct,
        coupling=cycle.coupling + shared - direct[..., None] * np.eye(direct.shape[-1]),
    )
    load = quasi_static(moving, torque).normal_load
    carrying = np.where(load > 0.0, 1.0, 0.0)
    contact = carrying * 0.9 * float(cycle.hertz_coefficient) * np.maximum(load, 1e-6) ** -0.1
    both = carrying[..., :, None] * carrying[..., None, :]
    tangent = cycle.coupling * both + np.eye(direct.shape[-1]) * (cycle.compliance + contact)[..., None]
    scale = float(np.mean(cycle.compliance))
    stiffness = np.linalg.inv(tangent / scale) / scale * both
    nothing = 0.0 * still
    normal = np.stack([np.cos(cycle.pressure_angle), still, nothing, nothing, nothing], axis=-1)
    matrix = np.einsum("snij,snik,snjl->snkl", stiffness, normal, normal)
    inside = (matrix[:, 1:] + matrix[:, :-1]).mean(axis=1) / 2.0
    return np.tensordot(np.diff(cycle.boundary), inside, axes=1)


def _mean_of_slices(model: Model, m: int, cycle: MeshCycle, torque: float) -> Float[Array, "move move"]:
    """`_mean_stiffness` of slices, which deflect one by one; those that carry with rigid bearings."""
    load = quasi_static(cycle, torque).normal_load
    whole = np.maximum(load, 1e-6) / np.maximum(cycle.share, 1e-12)
    contact = 0.9 * float(cycle.hertz_coefficient) * whole**-0.1
    stiffness = np.where(load > 0.0, cycle.share, 0.0) / (cycle.compliance + contact)
    hand = float(model.meshes[m].hand)
    cosine, sine = np.cos(cycle.pressure_angle), np.sin(cycle.pressure_angle)
    steep = cycle.side * hand * cycle.pitch_slope * cosine
    lean = 1.0 / np.sqrt(1.0 + steep**2)
    z = hand * np.asarray(cycle.face_place)
    along, across, axial = cycle.side * cosine * lean, sine * lean, steep * lean
    at_along, at_across = cycle.side * cycle.signed_distance * cosine, cycle.signed_distance * sine
    normal = np.stack(
        [along, across, axial, z * along - at_along * axial, z * across - at_across * axial], axis=-1
    )
    matrix = np.einsum("sni,snik,snil->snkl", stiffness, normal, normal)
    inside = (matrix[:, 1:] + matrix[:, :-1]).mean(axis=1) / 2.0
    return np.tensordot(np.diff(cycle.boundary), inside, axes=1)


ROTATIONAL, TRANSLATIONAL, PLANET, MIXED = "rotational", "translational", "planet", "mixed"
#: Share of a mode's kinetic energy below which a motion is none: rounding leaves 1e-20, or where modes of two
#: kinds are all but equally fast its size over the distance of the frequencies, squared.
NO_MOTION = 1e-9


def mode_kinds(modes: Modes, model: Model, central: Sequence[int]) -> tuple[str, ...]:
    """Kind of every mode; `central` are the bodies sun, ring and carrier. `MIXED`: planets are not alike."""
    layout, bodies = model.layout, model.bodies
    turning, shifting = np.zeros((2, len(modes.frequency)))
    for body in central:
        turning += float(bodies.inertia[body]) * modes.shape[:, turn_of(body, layout)] ** 2
        if body < layout.planar:
            moved = modes.shape[:, shift_of(body) : shift_of(body) + 2]
            shifting += float(bodies.mass[body]) * np.sum(moved**2, axis=1)
    names = {
        (True, False): ROTATIONAL,
        (False, True): TRANSLATIONAL,
        (False, False): PLANET,
        (True, True): MIXED,
    }
    shares = zip(turning > NO_MOTION, shifting > NO_MOTION, strict=True)
    return tuple(names[bool(turns), bool(shifts)] for turns, shifts in shares)
