"""What is recorded, recomputed from the states alone by the very functions the right-hand side uses."""

from typing import Any

import numpy as np

from tribodyn.dynamics import contact_forces as contact
from tribodyn.dynamics.equations import derivatives, locate, stored_energy
from tribodyn.dynamics.extremes import LOWEST, Extremes, highest_loaded
from tribodyn.dynamics.parameters import (
    LAG,
    SLIP,
    VX_G,
    VX_P,
    VY_G,
    VY_P,
    WORK_IN,
    X_G,
    X_P,
    XI,
    XI_RATE,
    Y_G,
    Y_P,
    Model,
)
from tribodyn.dynamics.recorded import UNRECORDED
from tribodyn.mesh.quasi_static import efficiency
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.tribology.contact import LocalContact
from tribodyn.tribology.surface_state import limits_last, surface_and_limits

#: What `derivatives` returns, in order; the first five have their works in the state, in the same order.
POWERS = ("power_in", "power_out", "power_friction", "power_damping", "power_parametric", "drive_torque")


def segment_of(phase: Float[Array, "*sample"], boundary: Float[Array, " boundary"]) -> Int[Array, "*sample"]:
    """Segment of each phase in [0, 1); a phase on a boundary belongs to the segment that begins there."""
    return np.clip(np.searchsorted(boundary, phase, side="right") - 1, 0, len(boundary) - 2)


def outputs(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    model: Model,
    segment: Int[Array, " sample"] | None = None,
    shares: bool = False,
) -> dict[str, np.ndarray]:
    """All datasets of a record at samples (n,), by name: (n,), (n, pairs) or (n, dof), SI.

    Quantities of a pair that carries no load are NaN where they mean nothing then (film, pressure, …) and 0
    where the loss of contact itself is the answer (loads, stiffness).

    Parameters
    ----------
    cycles : mesh cycles since the start, whole and fraction
    model : with NumPy arrays
    segment : of each sample: on a boundary it says on which side; by default the one that begins there
    shares : whether those of `UNRECORDED` are among them, (n, pairs, limits)
    """
    table, mechanics = model.table, model.mechanics
    whole = np.floor(cycles + 1e-12)
    phase = np.maximum(cycles - whole, 0.0)
    y = np.ascontiguousarray(states.T)
    boundary = np.asarray(table.boundary)
    if segment is None:
        segment = segment_of(phase, boundary)
    else:  # a phase before its segment ends a mesh cycle
        before = phase < boundary[segment] - 1e-9
        whole, phase = whole - before, phase + before
    work: dict[tuple[int, int], Any] = {}
    rates: dict[int, Any] = {}
    # rates with respect to the phase have no limit where the pinion comes to rest; they are not recorded
    with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
        powers = derivatives(phase, whole, segment, y, model, work, rates)
    count, pairs = len(cycles), table.side.shape[0]

    def per_pair(row: int) -> np.ndarray:
        return np.stack([np.broadcast_to(work[row, i], count) for i in range(pairs)], axis=-1)

    load = per_pair(contact.NORMAL_LOAD)
    inside = table.in_contact[segment] > 0
    touching = inside & (load > 0.0)
    pinion_speed = mechanics.nominal_speed + y[SLIP]
    ratio = table.pinion_pitch_radius / table.gear_pitch_radius
    time = cycles * table.pitch_angle / mechanics.nominal_speed + y[LAG]
    pinion_angle = cycles * table.pitch_angle
    gear_angle = (table.pinion_pitch_radius * pinion_angle - y[XI]) / table.gear_pitch_radius
    gear_speed = ratio * pinion_speed - y[XI_RATE] / table.gear_pitch_radius
    speed_p, speed_g = per_pair(contact.PINION_SPEED), per_pair(contact.GEAR_SPEED)
    power = dict(zip(POWERS, (np.broadcast_to(power, count) for power in powers), strict=True))

    def contacting(values: np.ndarray, mask: np.ndarray = touching) -> np.ndarray:
        return np.where(mask, values, np.nan)

    with np.errstate(over="ignore", under="ignore"):
        contacts = _contacts(phase, segment, model, work, count)
        surface, limits = surface_and_limits(contacts, model.closure)
    # by the sliding that friction is given, against which it acts at every moment: with the nominal one
    # power_friction, the work on the vibrating bodies, is another
    sliding_loss = np.sum(per_pair(contact.FRICTION_FORCE) * contacts.sliding, axis=1)
    result = {name: contacting(values) for name, values in surface._asdict().items()}
    result |= {
        # of the whole face; the others of the surface are where the line load is highest
        "friction_coefficient": contacting(per_pair(contact.FRICTION_COEFFICIENT)),
        # geometry exists on the whole path of contact, loaded or not
        "transmission_error_normal": contacting(per_pair(contact.TRANSMISSION_ERROR), inside),
        "pressure_angle": contacting(np.arctan2(per_pair(contact.SIN), per_pair(contact.COS)), inside),
        "time": time,
        "pinion_angle": pinion_angle,
        "displacement": np.stack([y[X_P], y[Y_P], y[X_G], y[Y_G], pinion_angle, gear_angle], axis=-1),
        "velocity": np.stack([y[VX_P], y[VY_P], y[VX_G], y[VY_G], pinion_speed, gear_speed], axis=-1),
        "transmission_error_rotational": y[XI],
        "normal_load": np.where(inside, load, 0.0),
        "friction_force": np.where(inside, per_pair(contact.FRICTION_FORCE), 0.0),
        "film_parameter": result["central_film_thickness"] / model.surfaces.roughness,
        "equivalent_radius": contacting(per_pair(contact.RADIUS), inside),
        "entrainment_speed": contacting(0.5 * (speed_p + speed_g), inside),
        "sliding_speed": contacting(contacts.sliding, inside),
        "mesh_stiffness": np.where(touching, per_pair(contact.STIFFNESS), 0.0),
        # where the film law states a range, 1 also where there is no contact
        "closure_in_range": np.where(
            touching, result["closure_in_range"], 1.0 + 0.0 * surface.closure_in_range
        ),
        **power,
        "stored_energy": np.broadcast_to(stored_energy(y, model, work), count),
        **{name.replace("power", "work"): y[WORK_IN + i] for i, name in enumerate(POWERS[:5])},
        "efficiency": efficiency(power["power_in"], power["power_out"], sliding_loss),
    }
    if shares:
        result |= {name: limits_last(law) for name, law in zip(UNRECORDED, limits, strict=True)}
    return result


def outputs_with_extremes(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    extremes: Extremes | None,
    model: Model,
    shares: bool = False,
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray], np.ndarray]:
    """`outputs` at samples and where a motion is extreme, and the mesh cycles (n,) of the latter."""
    if extremes is None:
        return outputs(cycles, states, model, shares=shares), {}, np.empty(0)
    there = extremes.measure > LOWEST
    phase = np.maximum(cycles - np.floor(cycles + 1e-12), 0.0)
    segment = segment_of(phase, np.asarray(model.table.boundary))
    block = outputs(
        np.concatenate([cycles, extremes.cycles[there]]),
        np.concatenate([states, extremes.state[there]]),
        model,
        np.concatenate([segment, extremes.segment[there].astype(int)]),
        shares,
    )
    count = len(cycles)
    sampled, extreme = (
        {name: values[part] for name, values in block.items()} for part in (slice(count), slice(count, None))
    )
    return sampled, extreme, extremes.cycles[there]


def _contacts(
    phase: Float[Array, " sample"], segment: Int[Array, " sample"], model: Model, work: Any, count: int
) -> LocalContact:
    """Contacts of all pairs (n, pairs), where their line loads are highest."""
    cell, u, _ = locate(phase, segment, model.table)
    pairs = range(model.table.side.shape[0])
    contacts = [highest_loaded(i, segment, cell, u, model, work) for i in pairs]
    fields = ([np.broadcast_to(value, count) for value in values] for values in zip(*contacts, strict=True))
    return LocalContact(*(np.stack(values, axis=-1) for values in fields))
