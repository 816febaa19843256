"""What is recorded, recomputed from the states alone by the very functions the right-hand side uses."""

from typing import Any, NamedTuple, Self

import numpy as np

from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.energy import stored_energy
from tribodyn.dynamics.equations import derivatives, resultants
from tribodyn.dynamics.loads import (
    apart_in_plane,
    apart_in_space,
    joins_in_space,
    stretch_in_plane,
)
from tribodyn.dynamics.mesh_motion import by_rim, motion_of, place_in_mesh
from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.clutches import clutch_outputs
from tribodyn.dynamics.recorded.extremes import LOWEST, Extremes, highest_loaded
from tribodyn.dynamics.recorded.faces import over_faces
from tribodyn.mesh.quasi_static import efficiency
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.train.bearing_forces import bearing_answers, cage_power
from tribodyn.train.layout import displacements, rim_places, work_of, works_of_meshes
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import (
    ACROSS,
    DAMPING,
    IN,
    IN_SPACE,
    OUT,
    PARAMETRIC,
    TOWARDS,
    TURN,
    rotational_error,
    shift_of,
    speed_of,
    turned,
)
from tribodyn.train.structure import FRICTION as WORK_FRICTION
from tribodyn.tribology.contact import LocalContact
from tribodyn.tribology.surface_state import limits_last, surface_and_limits

#: What `derivatives` returns, in order.
POWERS = ("power_in", "power_out", "power_friction", "power_damping", "power_parametric", "drive_torque")
#: What is worked out with them for the summary alone: shares allowed by each limit of film and friction law.
UNRECORDED = ("closure_shares", "friction_shares")
#: What rims that bend do at their meshes.
RIM_NAMES = {"rim_along": TOWARDS, "rim_across": ACROSS}
#: What bodies that move in space do beside moving in the plane.
IN_SPACE_NAMES = ("z", "tilt_x", "tilt_y")


class Evaluated(NamedTuple):
    """States with all that the right-hand side makes of them."""

    cycles: Float[Array, " sample"]  # reference cycles since the start, whole and fraction
    phase: Float[Array, " sample"]
    interval: Int[Array, " sample"]
    y: Float[Array, "state sample"]
    work: list[Any]  # contacts of every mesh
    powers: dict[str, Float[Array, " sample"]]  # by the names of `POWERS`
    model: Model  # with NumPy arrays
    bearings: tuple[Any, ...]  # `bearing_answers`

    @property
    def size(self) -> int:
        """Number of samples."""
        return len(self.cycles)


def evaluated(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    model: Model,
    interval: Int[Array, " sample"] | None = None,
) -> Evaluated:
    """Evaluate states at so many reference cycles since the start.

    `interval` is that of each sample: on a boundary it says on which side; by default the one that begins
    there.
    """
    whole, phase, interval_index = interval_of(cycles, model.schedule)
    if interval is None:
        interval = interval_index
    else:  # a phase before its interval ends a reference cycle
        before = phase < np.asarray(model.schedule.start)[interval] - 1e-9
        whole, phase = whole - before, phase + before
    y = np.ascontiguousarray(states.T)
    work: list[Any] = [{} for _ in model.meshes]
    # rates with respect to the phase have no limit where the reference comes to rest; they are not recorded
    with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
        powers = derivatives(phase, whole, interval, y, model, work, {})
    named = {name: np.broadcast_to(power, len(cycles)) for name, power in zip(POWERS, powers, strict=True)}
    return Evaluated(cycles, phase, interval, y, work, named, model, bearing_answers(cycles, y, model))


def mesh_outputs(m: int, samples: Evaluated, shares: bool = False) -> dict[str, np.ndarray]:
    """Datasets of one mesh by name: (n,) or (n, pairs), SI; of slices also `line_load` (n, pairs, slices).

    Quantities of a pair that carries no load are NaN where they mean nothing then (film, pressure, …) and 0
    where the loss of contact itself is the answer (loads, stiffness). `shares` says whether those of
    `UNRECORDED` are among them, (n, pairs, limits).
    """
    model, work, count = samples.model, samples.work[m], samples.size
    mesh = model.meshes[m]
    table = mesh.table
    place = place_in_mesh(m, samples.phase, samples.interval, model)
    pairs = range(table.side.shape[0])

    def per_pair(row: int) -> np.ndarray:
        return np.stack([np.broadcast_to(work.get((row, i), np.nan), count) for i in pairs], axis=-1)

    load = per_pair(contact.NORMAL_LOAD)
    inside = per_pair(contact.PRESENT) > 0.0
    touching = inside & (load > 0.0)
    speeds = per_pair(contact.DRIVER_SPEED) + per_pair(contact.DRIVEN_SPEED)

    def contacting(values: np.ndarray, mask: np.ndarray = touching) -> np.ndarray:
        return np.where(mask, values, np.nan)

    with np.errstate(over="ignore", under="ignore"):
        points = [highest_loaded(i, place, mesh, model, work) for i in pairs]
        fields = ([np.broadcast_to(v, count) for v in values] for values in zip(*points, strict=True))
        contacts = LocalContact(*(np.stack(values, axis=-1) for values in fields))
        surface, limits = surface_and_limits(contacts, model.closure(m))
    friction = per_pair(contact.FRICTION_FORCE)
    _, _, axial, _, _, resisting, driving, *_ = resultants(place, mesh, model, work)
    rubbing = load
    # where the pitch line crosses a slice friction acts to either side
    if np.shape(table.face_position)[0] > 1:
        full = load * per_pair(contact.FRICTION_COEFFICIENT)
        rubbing = np.where(full > 0.0, load * np.abs(friction) / np.where(full > 0.0, full, 1.0), load)
    arm = per_pair(contact.LEAN_COS) * per_pair(contact.COS)
    stiffness = per_pair(contact.PRESENT) * per_pair(contact.STIFFNESS)
    result = {name: contacting(values) for name, values in surface._asdict().items()}
    result |= {
        # of the whole face; the others of the surface are where the line load is highest
        "friction_coefficient": contacting(per_pair(contact.FRICTION_COEFFICIENT)),
        # geometry exists on the whole path of contact, loaded or not
        "transmission_error_normal": contacting(per_pair(contact.TRANSMISSION_ERROR), inside),
        "pressure_angle": contacting(np.arctan2(per_pair(contact.SIN), per_pair(contact.COS)), inside),
        "signed_distance": contacting(per_pair(contact.DISTANCE), inside),
        # of the bodies in their own senses; the power that rolls, against the frame of the mesh
        "driver_torque": np.broadcast_to(mesh.driver_sense * resisting, count),
        "driven_torque": np.broadcast_to(mesh.driven_sense * driving, count),
        "driven_power": np.broadcast_to(driving * motion_of(m, samples.y, model).driven_speed, count),
        "transmission_error_rotational": rotational_error(samples.y.T, m, model),
        "normal_load": np.where(inside, load, 0.0),
        "friction_force": np.where(inside, friction, 0.0),
        "film_parameter": result["central_film_thickness"] / mesh.surfaces.roughness,
        "equivalent_radius": contacting(per_pair(contact.RADIUS), inside),
        "entrainment_speed": contacting(0.5 * speeds, inside),
        "sliding_speed": contacting(contacts.sliding, inside),
        "mesh_stiffness": np.where(touching, stiffness, 0.0),
        **{
            name: np.broadcast_to(by_rim(which, m, 0, samples.y, model), count)
            for name, which in RIM_NAMES.items()
            if model.layout.rim_count[m] > 0
        },
        # along the pitch tangent
        "tangent_load": np.where(touching, load * arm, 0.0),
        "tangent_stiffness": np.where(touching, stiffness * arm**2, 0.0),
        "axial_force": np.broadcast_to(axial, count),
        # where the film law states a range, 1 also where there is no contact
        "closure_in_range": np.where(
            touching, result["closure_in_range"], 1.0 + 0.0 * surface.closure_in_range
        ),
        # by the sliding that friction is given, against which it acts at every moment: with the nominal one
        # power_friction, the work on the moving bodies, is another
        "sliding_loss": np.sum(friction * contacts.sliding, axis=1),
        # what that would be with a friction coefficient of 1
        "sliding_load": np.sum(rubbing * np.abs(contacts.sliding), axis=1, where=touching),
        "mesh_power_friction": np.sum(friction * per_pair(contact.RELATIVE_VELOCITY), axis=1, where=inside),
    }
    if shares:
        result |= {name: limits_last(law) for name, law in zip(UNRECORDED, limits, strict=True)}
    slices = np.shape(table.face_position)[0]
    line_load = np.where(touching, per_pair(contact.LINE_LOAD) * peak_of(m, place, model), 0.0)
    return over_faces(result, len(pairs) // slices, line_load)


def peak_of(m: int, place: Any, model: Model) -> Float[Array, "sample slot"]:
    """Largest line load along a slot over its load per width."""
    channel = model.meshes[m].table.channel
    slots = range(model.meshes[m].table.side.shape[0])
    values = [contact.cubic(channel, place.segment, place.cell, i, contact.PEAK, place.u) for i in slots]
    return np.stack([np.broadcast_to(value, np.shape(place.u)) for value in values], axis=-1)


def train_outputs(samples: Evaluated, sliding_loss: Float[Array, " sample"]) -> dict[str, np.ndarray]:
    """Datasets of the whole train by name: (n,), and those of its bodies (n, body), SI.

    Rotations of a body are positive in its own nominal sense. `sliding_loss` is that of all meshes, W.
    """
    model, y = samples.model, samples.y
    layout, operation, ratio = model.layout, model.operation, np.asarray(model.bodies.ratio)
    angle = samples.cycles * operation.pitch_angle
    planar, bodies = range(layout.planar), range(layout.bodies)
    works = {
        "work_in": y[work_of(layout, IN)],
        "work_out": y[work_of(layout, OUT)],
        "work_friction": np.sum(y[works_of_meshes(layout, WORK_FRICTION)], axis=0),
        "work_damping": y[work_of(layout, DAMPING)],
        "work_parametric": y[work_of(layout, PARAMETRIC)],
    }
    power = samples.powers

    def over(places: Any) -> np.ndarray:
        columns = [np.broadcast_to(values, samples.size) for values in places]
        return np.stack(columns, axis=-1) if columns else np.empty((samples.size, 0))

    stored = np.broadcast_to(stored_energy(samples.cycles, y, model, samples.work), samples.size)
    cages: dict[str, np.ndarray] = {}
    if samples.bearings:
        stored = stored + sum(answer[-1] for answer in samples.bearings)
        cages["power_cages"] = cage_power(samples.bearings, y, model)
    return {
        "time": samples.cycles * operation.pitch_angle / operation.nominal_speed + y[layout.lag],
        "reference_angle": angle,
        **{
            name + end: over(y[first + layout.tilts + 3 * b + i] for b in range(layout.spatial))
            for i, name in enumerate(IN_SPACE_NAMES)
            for first, end in ((0, ""), (layout.half, "_rate"))
        },
        "x": over(y[shift_of(b)] for b in planar),
        "y": over(y[shift_of(b) + 1] for b in planar),
        "moved": over(_moved(b, y, model) for b in planar),
        "rim_wave": over(y[place] for place in rim_places(layout)),
        **{
            f"bearing_force_{name}": over(
                [
                    *(bearing_force(k, row, y, model) for k in holding_links(model)),
                    *(reaction(k, row, samples) for k in range(len(model.links.coupled.reaction_at_rest))),
                ]
            )
            for row, name in enumerate("xy")
        },
        "angle": over(ratio[b] * angle + turned(b, y, layout) for b in bodies),
        "x_rate": over(y[layout.half + shift_of(b)] for b in planar),
        "y_rate": over(y[layout.half + shift_of(b) + 1] for b in planar),
        "speed": over(speed_of(b, y, model) for b in bodies),
        **power,
        "stored_energy": stored,
        **cages,
        **works,
        "efficiency": efficiency(power["power_in"], power["power_out"], sliding_loss),
        **clutch_outputs(samples.cycles, y, model),
    }


def holding_links(model: Model) -> list[int]:
    """Numbers of the links that hold bodies in x and y: bearings, pins."""
    layout, links = model.layout, model.links
    planar = np.any(np.asarray(links.stiffness)[:, :TURN] > 0.0, axis=1) if layout.links else np.zeros(0)
    numbers = np.flatnonzero(planar).tolist()
    return [k for k in numbers if layout.first[k] < layout.planar > layout.second[k]]


def bearing_force(k: int, row: int, y: np.ndarray, model: Model) -> np.ndarray:
    """Force of the first body of a link on what holds it, in x or y (0, 1), N."""
    layout, links = model.layout, model.links
    first, second, half = layout.first[k], layout.second[k], layout.half
    if joins_in_space(k, layout):
        moved, moving = (
            np.stack([apart_in_space(first, second, i, at, y, layout) for i in range(IN_SPACE)])
            for at in (0, half)
        )
        elastic = np.tensordot(np.asarray(links.stiffness_in_space)[k, row], moved, axes=1)
        return elastic + np.tensordot(np.asarray(links.damping_in_space)[k, row], moving, axes=1)
    damping = links.damping[k, row] * apart_in_plane(k, row, half, y, model)
    return links.stiffness[k, row] * stretch_in_plane(k, row, y, model) + damping


def reaction(k: int, row: int, samples: Evaluated) -> np.ndarray:
    """Force of a shaft on a bearing of a drawn shaft, in x, y or z (0, 1, 2), N."""
    model, y = samples.model, samples.y
    layout, parts = model.layout, model.links.coupled
    if k in (in_time := model.options.bearings.bearings):
        rows = (answer[row] for n, answer in zip(in_time, samples.bearings, strict=True) if n == k)
        return np.broadcast_to(sum(rows), samples.size)
    places = displacements(layout)  # the reference has no micro-rotation
    force = np.tensordot(parts.reaction[k, row, places], np.stack([y[i] for i in places]), axes=1)
    return parts.reaction_at_rest[k, row] + force


def _moved(b: int, y: np.ndarray, model: Model) -> np.ndarray:
    """How far a body is from where its bearing, or the carrier of its pin, would have it, m."""
    layout = model.layout
    x, across = y[shift_of(b)], y[shift_of(b) + 1]
    for k in range(layout.links):
        if layout.pins[k] and layout.first[k] == b:
            lever, turn = np.asarray(model.links.lever)[k, 1], turned(layout.second[k], y, layout)
            x, across = x - lever[0] * turn, across - lever[1] * turn
    return np.hypot(x, across)


class Sampled(NamedTuple):
    """Datasets by name at samples: of the whole train, (n,) or (n, body), and `mesh_outputs` of each mesh."""

    cycles: Float[Array, " sample"]  # reference cycles since the start
    whole: dict[str, np.ndarray]
    meshes: list[dict[str, np.ndarray]]

    def part(self, which: slice) -> Self:
        """Some of the samples."""
        meshes = [{name: values[which] for name, values in mesh.items()} for mesh in self.meshes]
        whole = {name: values[which] for name, values in self.whole.items()}
        return self._replace(cycles=self.cycles[which], whole=whole, meshes=meshes)


def sampled(samples: Evaluated, shares: bool = False) -> Sampled:
    """All datasets of states; `shares` as of `mesh_outputs`."""
    meshes = [mesh_outputs(m, samples, shares) for m in range(len(samples.model.meshes))]
    loss = sum((mesh["sliding_loss"] for mesh in meshes), np.zeros(samples.size))
    return Sampled(samples.cycles, train_outputs(samples, loss), meshes)


def evaluated_with_extremes(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    extremes: Extremes | None,
    model: Model,
    shares: bool = False,
) -> tuple[Evaluated, Sampled, Sampled]:
    """Samples and, behind them, where the motion between them is extreme, evaluated; datasets of either."""
    count, interval = len(cycles), interval_of(cycles, model.schedule)[2]
    if extremes is not None:
        there = extremes.measure > LOWEST
        cycles = np.concatenate([cycles, extremes.cycles[there]])
        states = np.concatenate([states, extremes.state[there]])
        interval = np.concatenate([interval, extremes.interval[there].astype(int)])
    samples = evaluated(cycles, states, model, interval)
    both = sampled(samples, shares)
    return samples, both.part(slice(count)), both.part(slice(count, None))
