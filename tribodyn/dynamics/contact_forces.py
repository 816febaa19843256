"""State of the tooth contacts of one mesh: approach, elastic and normal load, film, friction.

Written once for all compilers: `work` is whatever takes `work[quantity, slot] = value`: a 2-D array in the
native kernel, a dict everywhere else, so that the same lines run on floats, arrays and under JAX tracing.
"""

from tribodyn.dynamics.approach import (
    APPROACH,
    APPROACH_RATE,
    COMPLIANCE,
    COS,
    COUPLING,
    DRIVEN_SPEED,
    DRIVER_SPEED,
    EFFECTIVE_APPROACH,
    ELASTIC_LOAD,
    FRICTION_COEFFICIENT,
    FRICTION_FORCE,
    LINE_LOAD,
    NORMAL_LOAD,
    OWN_FRICTION,
    PRESENT,
    RADIUS,
    RELATIVE_VELOCITY,
    SLIDING,
    STIFFNESS,
    TURNED,
    WHOLE_LOAD,
    absent,
    approach,
    cubic,
    sliced,
)
from tribodyn.dynamics.parameters import HERTZ_POWER_LAW, SLIDING_DYNAMIC
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.mesh.teeth.lookup import deflect_apart
from tribodyn.numerics.elementary import law, maximum, skippable, sqrt, where
from tribodyn.numerics.smooth import (
    load_with_damping,
    mean_sign,
    onset,
    positive_part,
    power_law_force,
    power_law_stiffness,
    ramp,
    sign,
)
from tribodyn.tribology.contact import averaged_radius, local_contact
from tribodyn.tribology.law import ActiveLaw

_UNEVEN = CHANNELS.index("line_load_friction")


@law
def coupled(mesh, model):
    """Whether the pairs of a mesh deflect each other."""
    return model.options.sweeps > 1 and not sliced(mesh)


@law
def elastic_loads(place, mesh, model, work):
    """Elastic load of every pair, never tensile, with the pairs coupled through the bodies.

    Solves δ_i = C_ii F_i + Σ_j C_ij F_j, F ≥ 0: from the tabulated inverse, with tension cut off, by
    projected Gauss-Seidel sweeps. With all pairs loaded the start is the answer up to interpolation, and each
    sweep reduces an error by (C_ij/C_ii)² ≈ 0.1; a pair that separates is out after the first.
    """
    segment, cell, u, _, _, _, _ = place
    table = mesh.table
    pairs = table.side.shape[0]
    width = model.operation.contact_width
    coefficient = table.hertz_coefficient
    together = coupled(mesh, model)
    for i in range(pairs):
        work[ELASTIC_LOAD, i] = 0.0
        if absent(i, work):
            continue
        work[STIFFNESS, i] = 1.0 / work[COMPLIANCE, i]
        if not together:
            continue
        load = 0.0
        for j in range(pairs):
            if absent(j, work):
                continue
            if j < i:
                work[COUPLING + j, i] = cubic(table.coupling, segment, cell, i, j, u)
            elif j > i:
                work[COUPLING + j, i] = cubic(table.coupling, segment, cell, j, i, u)
            load = load + cubic(table.stiffness, segment, cell, i, j, u) * work[APPROACH, j]
        work[ELASTIC_LOAD, i] = maximum(load, 0.0)
    for _ in range(model.options.sweeps if together else 1):
        for i in range(pairs):
            if absent(i, work):
                continue
            free = work[APPROACH, i]
            if together:
                for j in range(pairs):
                    if j != i and not absent(j, work):
                        free = free - work[COUPLING + j, i] * work[ELASTIC_LOAD, j]
            if model.options.hertz == HERTZ_POWER_LAW:
                compliance = work[COMPLIANCE, i]
                load = power_law_force(where(free >= width, free, width), compliance, coefficient)
                stiffness = power_law_stiffness(load, compliance, coefficient)
                if not skippable(free >= width):
                    load = where(free >= width, load, onset(free, width, load, stiffness))
                work[STIFFNESS, i] = stiffness
            else:
                load = positive_part(free, width) * work[STIFFNESS, i]
            work[EFFECTIVE_APPROACH, i] = free
            work[WHOLE_LOAD, i] = load
            work[ELASTIC_LOAD, i] = work[PRESENT, i] * load


@law
def reversals_per_velocity(ratio, mesh, model):
    """One over the sliding velocity at which friction has reversed, that of the width of reversal; s/m.

    `ratio` is that of the driver's speed against the frame of the mesh to the reference's.
    """
    operation = model.operation
    nominal_speed = ratio * operation.nominal_speed
    return 1.0 / ((1.0 + mesh.driver_radius / mesh.driven_radius) * operation.reversal_width * nominal_speed)


@law
def normal_contacts(place, motion, mesh, model, work):
    """Fill `work` with everything about the contacts of a mesh but their friction."""
    approach(place, motion, mesh, work)
    elastic_loads(place, mesh, model, work)
    for i in range(mesh.table.side.shape[0]):
        if absent(i, work):
            work[NORMAL_LOAD, i] = 0.0
            continue
        _normal_contact(i, place, motion, mesh, model, work)


@law
def _normal_contact(i, place, motion, mesh, model, work):
    """Fill `work` with slot i's normal load and what depends on it; return the line load of its friction."""
    width, table = model.operation.contact_width, mesh.table
    segment, cell, u, _, _, _, _ = place
    stiffness = work[STIFFNESS, i]
    engaged = ramp(work[EFFECTIVE_APPROACH, i], width)
    damping = mesh.damping * sqrt(stiffness) * work[APPROACH_RATE, i]
    damping = engaged * damping
    load = load_with_damping(work[WHOLE_LOAD, i], damping, width * stiffness)
    load = work[PRESENT, i] * load
    work[NORMAL_LOAD, i] = load
    # of a slice that comes or goes over its whole width: what is inside it is not resolved
    work[LINE_LOAD, i] = load / table.slice_width
    # the line load at which friction acts as it does along the uneven face
    line_load = work[LINE_LOAD, i] * cubic(table.channel, segment, cell, i, _UNEVEN, u)
    if model.options.averaged:
        radius = work[RADIUS, i]
        averaged = averaged_radius(
            radius, line_load, mesh.surfaces.effective_modulus, table.pitch_point_length
        )
        # entrainment is averaged with the radius, to which it is proportional there; sliding is not
        added = table.side[i] * motion.driver_speed * table.pitch_point_rate * (averaged - radius)
        work[RADIUS, i] = averaged
        work[DRIVER_SPEED, i] = work[DRIVER_SPEED, i] + added
        work[DRIVEN_SPEED, i] = work[DRIVEN_SPEED, i] + added
    return line_load


@law
def contact_forces(place, motion, reversals, mesh, model, work):
    """Fill `work` with everything about every contact of a mesh.

    The segment is given, never derived from the phase; `reversals` are those per sliding velocity, see
    `reversals_per_velocity`. `work` receives `work[quantity, slot]`.
    """
    approach(place, motion, mesh, work)
    elastic_loads(place, mesh, model, work)
    for i in range(mesh.table.side.shape[0]):
        if absent(i, work):
            work[NORMAL_LOAD, i] = 0.0
            work[FRICTION_FORCE, i] = 0.0
            continue
        line_load = _normal_contact(i, place, motion, mesh, model, work)
        if model.options.sliding == SLIDING_DYNAMIC:
            sliding = work[RELATIVE_VELOCITY, i]
        else:
            sliding = work[SLIDING, i]
        speed_1 = work[DRIVER_SPEED, i]
        speed_2 = work[DRIVEN_SPEED, i]
        state = local_contact(
            line_load, 1.0 / work[RADIUS, i], 0.5 * (speed_1 + speed_2), sliding, speed_1, speed_2
        )
        film = ActiveLaw(model.options.film, mesh.film)
        coefficient = model.options.friction.coefficient(state, film, mesh.surfaces, mesh.friction)
        if deflect_apart(mesh):
            coefficient = coefficient * (1.0 + work[OWN_FRICTION, i])
        work[FRICTION_COEFFICIENT, i] = coefficient
        work[TURNED, i] = sliding * reversals
        turned = sign(work[TURNED, i])
        if sliced(mesh):
            # the part of the slice on either side of the pitch line
            reach = 0.5 * work[PRESENT, i] * mesh.table.slice_width * mesh.table.pitch_slope * work[COS, i]
            turned = mean_sign(work[TURNED, i], reach / model.operation.reversal_width)
        work[FRICTION_FORCE, i] = coefficient * work[NORMAL_LOAD, i] * turned
