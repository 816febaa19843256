"""What a march by time gives at a moment: of the input, the output, the whole train, and of each mesh."""

from typing import NamedTuple

from tribodyn.dynamics.approach import NORMAL_LOAD, absent
from tribodyn.dynamics.energy import stored_energy
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.loads import load_on
from tribodyn.dynamics.mesh_motion import place_in_mesh
from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.extremes import highest_loaded
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import law, truncate
from tribodyn.solve.march.crossing import INTERVAL, TIME, WHOLE, nominal_time, phase_at
from tribodyn.solve.march.marching import SCRATCH
from tribodyn.train.clutches import work_of_clutch
from tribodyn.train.structure import (
    FRICTION,
    OF_MESHES,
    WORKS_OF_MESH,
    rotational_error_of,
    speed_of,
    turned,
)
from tribodyn.tribology.law import ActiveLaw
from tribodyn.tribology.surface_state import film_and_temperature


class TimeOutput(NamedTuple):
    """A quantity: its name and unit, the mesh that it is of, and what it is."""

    name: str
    unit: str
    mesh: int | None
    about: str


#: Name, unit and meaning of what is of the whole train, in order; and of each mesh behind it.
OF_TRAIN = (
    ("input_angle", "rad", "rotation of the input since the start, positive as it nominally turns"),
    ("input_speed", "rad/s", "speed of the input"),
    ("input_torque", "N.m", "torque of the drive on the input, in the direction of its nominal rotation"),
    ("output_angle", "rad", "rotation of the output since the start, positive as it nominally turns"),
    ("output_speed", "rad/s", "speed of the output"),
    ("output_torque", "N.m", "torque of the load on the output, against its nominal rotation"),
    ("power_in", "W", "power of the drive"),
    ("power_out", "W", "power on the loads"),
    ("friction_loss", "W", "power lost to friction between teeth"),
    ("damping_loss", "W", "power lost to the damping of meshes, bearings and shafts"),
    ("clutch_loss", "W", "power lost to friction in clutches and brakes"),
    ("parametric_power", "W", "power of the stiffness and geometry that change with the rotation"),
    ("stored_energy", "J", "kinetic and strain energy"),
)
OF_EACH_MESH = (
    ("transmission_error", "m", "rotational transmission error along the pitch circle"),
    ("normal_load", "N", "sum of the normal loads of all pairs"),
    ("film_min", "m", "film thickness by the film law, the least of all pairs; 0 while none carries load"),
    ("lambda_min", "1", "the same over the composite roughness"),
    ("friction_loss", "W", "power lost to friction between its teeth"),
)


def time_outputs(model: Model) -> tuple[TimeOutput, ...]:
    """What `outputs` gives of a model, in order."""
    whole = [TimeOutput(name, unit, None, about) for name, unit, about in OF_TRAIN]
    meshes = range(model.layout.meshes)
    return (*whole, *(TimeOutput(name, unit, m, about) for m in meshes for name, unit, about in OF_EACH_MESH))


@law
def angle_of(body, cycles, y, model):
    """Rotation of a body after so many reference cycles, rad."""
    nominal = model.bodies.ratio[body] * model.operation.pitch_angle * cycles
    return nominal + turned(body, y, model.options.layout)


@law
def thinnest_film(phase, interval, m, model, work):
    """Film thickness, the least of all pairs of a mesh that carry load, m; 0.0 where none does."""
    mesh = model.meshes[m]
    place = place_in_mesh(m, phase, interval, model)
    film, friction = (
        ActiveLaw(model.options.film, mesh.film),
        ActiveLaw(model.options.friction, mesh.friction),
    )
    least = 0.0
    for i in range(mesh.table.side.shape[0]):
        if absent(i, work):
            continue
        if work[NORMAL_LOAD, i] > 0.0:
            contact = highest_loaded(i, place, mesh, model, work)
            thickness, _ = film_and_temperature(contact, mesh.surfaces, film, friction)
            if least == 0.0 or thickness < least:
                least = thickness
    return least


@kernel
def outputs(model, y, clock, work, buffer, out):
    """Fill `out` as `time_outputs` says, from the state of a march by time; of inputs as they are now."""
    layout, rates = model.options.layout, buffer[SCRATCH]
    interval, whole, time = truncate(clock[INTERVAL]), clock[WHOLE], clock[TIME]
    phase = phase_at(time, y[layout.lag], whole, model)
    powers = derivatives(phase, whole, interval, y, model, work, rates)
    power_in, power_out, friction_loss, damping_loss, parametric_power, drive_torque = powers
    first, last, cycles = layout.input, layout.output, whole + phase
    out[0] = angle_of(first, cycles, y, model)
    out[1] = speed_of(first, y, model)
    out[2] = drive_torque
    out[3] = angle_of(last, cycles, y, model)
    out[4] = speed_of(last, y, model)
    out[5] = load_on(last, time * nominal_time(model), y, model)
    out[6], out[7], out[8], out[9] = power_in, power_out, friction_loss, damping_loss
    clutch_loss = 0.0
    for c in range(layout.clutches):
        clutch_loss += rates[work_of_clutch(c, layout)] / nominal_time(model)
    out[10], out[11] = clutch_loss, parametric_power
    turns = cycles * model.operation.pitch_angle
    of_bearings = model.options.bearings.energy(turns, y, model)
    out[12] = stored_energy(cycles, y, model, work) + of_bearings
    at = len(OF_TRAIN)
    for m in range(layout.meshes):
        mesh, contacts = model.meshes[m], work[m]
        load = 0.0
        for i in range(mesh.table.side.shape[0]):
            load += 0.0 if absent(i, contacts) else contacts[NORMAL_LOAD, i]
        film = thinnest_film(phase, interval, m, model, contacts)
        of_mesh = layout.mechanical + OF_MESHES + WORKS_OF_MESH * m
        out[at] = rotational_error_of(m, y, model)
        out[at + 1], out[at + 2], out[at + 3] = load, film, film / mesh.surfaces.roughness
        out[at + 4] = rates[of_mesh + FRICTION] / nominal_time(model)
        at += len(OF_EACH_MESH)
