"""Energy that a train stores, and its jump where the set of contacting pairs changes. For all compilers."""

from tribodyn.dynamics.approach import approach
from tribodyn.dynamics.contact_energy import mesh_energy
from tribodyn.dynamics.contact_forces import elastic_loads
from tribodyn.dynamics.frame import frame_energy
from tribodyn.dynamics.loads import link_energy
from tribodyn.dynamics.mesh_motion import latest_teeth, locate, motion_of
from tribodyn.dynamics.parameters import DRIVE_SPEED, ENERGY_CONSISTENT
from tribodyn.numerics.elementary import by_chain_rule, independent, law, maximum, skippable, sqrt, truncate
from tribodyn.train.structure import shift_of, slip_of, speed_of


@law
def strain_energy(phase, segment, interval, m, y, model, work):
    """Strain energy of a mesh's contacts at a phase of its own, J; fills its `work` with elastic loads."""
    mesh = model.meshes[m]
    one, two = latest_teeth(m, interval, model)
    place = locate(phase, segment, one, two, mesh.table)
    motion = motion_of(m, y, model)
    approach(place, independent(motion, work), mesh, work)
    elastic_loads(place, mesh, model, work)
    (energy,) = by_chain_rule((mesh_energy(mesh, model, work),), motion, work)
    return energy


@law
def engagement(interval, y, model, work):
    """Changes of (reference slip, work in, parametric work) where an interval begins.

    The strain energy that appears or vanishes where the set of contacting pairs changes is the parametric
    work of an impulse. The classical equations leave it unbalanced and the energy audit counts it; the
    energy-consistent ones take it from the drive (prescribed speed) or from the reference's kinetic energy;
    where that is too small, the reference comes to rest, and what is missing is parametric work.
    """
    layout, schedule = model.options.layout, model.schedule
    zero = 0.0 * y[0]
    step = zero
    count = schedule.segment.shape[0]
    before = (interval + count - 1) % count
    for m in range(layout.meshes):
        if skippable(schedule.opens[interval, m] == 0.0):
            continue
        boundary = model.meshes[m].table.boundary
        behind, ahead = truncate(schedule.segment[before, m]), truncate(schedule.segment[interval, m])
        gained = strain_energy(boundary[ahead], ahead, interval, m, y, model, work[m]) - strain_energy(
            boundary[behind + 1], behind, before, m, y, model, work[m]
        )
        step = step + schedule.opens[interval, m] * gained
    if model.options.formulation != ENERGY_CONSISTENT:
        return zero, zero, step
    if model.options.drive == DRIVE_SPEED:
        return zero, step, zero
    inertia = model.bodies.inertia[0]
    speed = model.operation.nominal_speed + slip_of(y, layout)
    squared = speed * speed - 2.0 * step / inertia
    slip = sqrt(maximum(squared, 0.0)) - speed
    return slip, zero, 0.5 * inertia * maximum(-squared, 0.0)


@law
def stored_energy(y, model, work):
    """Kinetic and strain energy of the whole train, J; `work` as `contact_forces` left it."""
    layout, bodies = model.options.layout, model.bodies
    half = layout.half
    energy = 0.0 * y[0]
    for m in range(layout.meshes):
        energy = energy + mesh_energy(model.meshes[m], model, work[m])
    for b in range(layout.bodies):
        speed = speed_of(b, y, model)
        energy = energy + 0.5 * bodies.inertia[b] * speed * speed
        if b < layout.planar:
            x, z = y[half + shift_of(b)], y[half + shift_of(b) + 1]
            energy = energy + 0.5 * bodies.mass[b] * (x * x + z * z)
            if layout.frames > 0:
                energy = energy + frame_energy(b, y, model)
        if b < layout.spatial:
            first = half + layout.tilts + 3 * b
            energy = energy + 0.5 * bodies.mass[b] * y[first] * y[first]
            for i in range(first + 1, first + 3):
                energy = energy + 0.5 * bodies.tilting[b] * y[i] * y[i]
    return energy + link_energy(y, model)
