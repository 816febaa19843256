"""Strain energy of the tooth contacts of a mesh, and the torque with which its change in phase acts.

Written for all compilers, as `contact_forces`, whose `work` it reads.
"""

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
    cubic_slope,
    sliced,
)
from tribodyn.dynamics.contact_forces import coupled
from tribodyn.dynamics.parameters import HERTZ_POWER_LAW
from tribodyn.dynamics.smooth import (
    onset_integral,
    positive_part_integral,
    power_law_force,
    power_law_stiffness,
    power_law_work,
)
from tribodyn.numerics.elementary import law, skippable, where


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
