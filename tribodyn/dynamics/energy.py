"""Energy that a train stores, and its jump where the set of contacting pairs changes. For all compilers."""

from tribodyn.dynamics.approach import (
    APPROACH_SLOPE,
    COMPLIANCE,
    COMPLIANCE_SLOPE,
    COUPLING,
    EFFECTIVE_APPROACH,
    ELASTIC_LOAD,
    NORMAL_LOAD,
    PRESENT,
    PRESENT_SLOPE,
    STIFFNESS,
    WHOLE_LOAD,
    absent,
    approach,
    cubic_slope,
    sliced,
)
from tribodyn.dynamics.contact_forces import coupled, elastic_loads
from tribodyn.dynamics.loads import frame_energy, link_energy
from tribodyn.dynamics.mesh_motion import latest_teeth, locate, motion_of
from tribodyn.dynamics.parameters import DRIVE_SPEED, ENERGY_CONSISTENT, HERTZ_POWER_LAW
from tribodyn.numerics.elementary import (
    by_chain_rule,
    independent,
    law,
    maximum,
    skippable,
    sqrt,
    truncate,
    where,
)
from tribodyn.numerics.smooth import (
    onset_integral,
    positive_part_integral,
    power_law_force,
    power_law_stiffness,
    power_law_work,
)
from tribodyn.train.coupling import coupling_energy
from tribodyn.train.structure import shift_of, slip_of, speed_of

# Strain energy of the tooth contacts of a mesh, and the torque with which its change in phase acts.
#
# Written for all compilers, as `contact_forces`, whose `work` it reads.


@law
def pair_energy(i, mesh, model, work):
    """Strain energy of one pair without the coupling, of a slice as if its whole width touched, J."""
    width = model.operation.contact_width
    free = work[EFFECTIVE_APPROACH, i]
    load = work[WHOLE_LOAD, i]
    if model.options.hertz == HERTZ_POWER_LAW:
        compliance, coefficient = work[COMPLIANCE, i], mesh.table.hertz_coefficient
        at_width = power_law_force(width, compliance, coefficient)
        stiffness = power_law_stiffness(at_width, compliance, coefficient)
        above = power_law_work(load, compliance, coefficient) - power_law_work(
            at_width, compliance, coefficient
        )
        energy = onset_integral(free, width, at_width, stiffness) + where(free > width, above, 0.0)
    else:
        energy = positive_part_integral(free, width) * work[STIFFNESS, i]
    return where(load > 0.0, energy, 0.0)


@law
def compliance_force(i, mesh, model, work):
    """−∂V/∂C of one pair's strain energy at fixed effective approach, N²: ½ F² but for the contact's onset.

    At the onset's width w, ∂F/∂C = −F k and ∂k/∂C = −k² (1 + 0.09 h F^-0.1 k), where h F^0.9 is the Hertz
    contact's part of w and k the stiffness there.
    """
    if model.options.hertz == HERTZ_POWER_LAW:
        width = model.operation.contact_width
        free = work[EFFECTIVE_APPROACH, i]
        compliance = work[COMPLIANCE, i]
        at_width = power_law_force(width, compliance, mesh.table.hertz_coefficient)
        stiffness = power_law_stiffness(at_width, compliance, mesh.table.hertz_coefficient)
        hertz = (1.0 / stiffness - compliance) / 0.9
        load_slope = at_width * stiffness
        stiffness_slope = stiffness * stiffness * (1.0 + 0.09 * hertz * stiffness)
        load = work[WHOLE_LOAD, i]
        above = 0.5 * (load * load - at_width * at_width)
        whole = onset_integral(free, width, load_slope, stiffness_slope) + where(free > width, above, 0.0)
        return where(load > 0.0, whole, 0.0)
    return pair_energy(i, mesh, model, work) * work[STIFFNESS, i]


@law
def mesh_energy(mesh, model, work):
    """Strain energy V of all contacts, J, after `elastic_loads`."""
    pairs = mesh.table.side.shape[0]
    energy = 0.0
    for i in range(pairs):
        if skippable(work[ELASTIC_LOAD, i] == 0.0):
            continue
        energy = energy + work[PRESENT, i] * pair_energy(i, mesh, model, work)
        if coupled(mesh, model):
            for j in range(i):
                if skippable(work[ELASTIC_LOAD, j] == 0.0):
                    continue
                energy = energy + work[COUPLING + j, i] * work[ELASTIC_LOAD, i] * work[ELASTIC_LOAD, j]
    return energy


@law
def parametric_torque(place, mesh, model, work):
    """Torque ∂V/∂φ on the driver at fixed coordinates that the classical equations leave out, N m.

    Σ (½ k_i' δ_i² + F_i ∂δ_i/∂φ), k_i by the part of a slice that touches, with the coupling's share (Oh,
    Grosh & Barber 2005); the damping part of F_i belongs to it, so that damping dissipates c_i δ_i'² and
    nothing else.
    """
    segment, cell, u, cells_per_radian, _, _, _ = place
    pairs = mesh.table.side.shape[0]
    torque = 0.0
    for i in range(pairs):
        if absent(i, work):
            continue
        load = work[ELASTIC_LOAD, i]
        torque = torque - work[PRESENT, i] * (
            compliance_force(i, mesh, model, work) * work[COMPLIANCE_SLOPE, i]
        )
        torque = torque + work[NORMAL_LOAD, i] * work[APPROACH_SLOPE, i]
        if sliced(mesh):
            torque = torque + work[PRESENT_SLOPE, i] * pair_energy(i, mesh, model, work)
        if coupled(mesh, model):
            for j in range(i):
                if absent(j, work):
                    continue
                slope = cubic_slope(mesh.table.coupling, segment, cell, i, j, u) * cells_per_radian
                torque = torque - slope * load * work[ELASTIC_LOAD, j]
    return torque


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
def stored_energy(cycles, y, model, work):
    """Kinetic and strain energy of the whole train after so many reference cycles, J.

    `work` is as `contact_forces` left it.
    """
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
    if layout.coupled > 0 or layout.inertial > 0:
        energy = energy + coupling_energy(cycles, y, model)
    return energy + link_energy(y, model)
