"""Mesh efficiency over whole mesh cycles, from the loads and the kinematics of the mesh cycle."""

from typing import Any

from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.power_flow import efficiency
from tribodyn.mesh.quasi_static import cycle_integral, cycle_mean, quasi_static
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.shapes import Array, Float


def friction_loss(
    cycle: MeshCycle,
    normal_load: Float[Array, "segment node slot"],
    friction_coefficient: Float[Array, "*#table"],
) -> Any:
    """Mean friction power over a mesh cycle per pinion speed, N m: Σ μ F |v_s|/ω_p.

    Sliding changes sign at the pitch point; the integral is split there, exactly, so that it is smooth in
    the drive's parameters.

    Parameters
    ----------
    cycle : MeshCycle
        The table; its `side` must not be traced.
    normal_load : array, (S, N, Q)
        Load of each pair at the nodes, N; smooth in every segment.
    friction_coefficient : array, () or (S, N, Q)
        μ ≥ 0.
    """
    xp = namespace(*cycle, normal_load, friction_coefficient)
    pairs = cycle.front_pairs
    sliding = (cycle.pinion_speed - cycle.gear_speed)[..., :pairs]
    power = (friction_coefficient * cycle.in_contact[:, None, :] * normal_load)[..., :pairs] * sliding
    pitch_point = cycle.pitch_point_phase - xp.arange(pairs - 1.0, -1.0, -1.0)
    return (cycle_mean(cycle, power) - 2.0 * cycle_integral(cycle, power, pitch_point[None, :])).sum()


def mean_efficiency(cycle: MeshCycle, gear_torque: Any, friction_coefficient: Float[Array, "*#table"]) -> Any:
    """Quasi-static efficiency over a mesh cycle, by energy, with a given friction coefficient.

    Loads are those of `quasi_static`, in which friction does not take part: the error is of the order of
    the loss squared.

    Parameters
    ----------
    cycle : MeshCycle
        The table; may be traced, but for `side`.
    gear_torque : float
        N m, ≠ 0; negative where the gear drives, on back flanks that are like the driving ones.
    friction_coefficient : array, () or (S, N, Q)
        μ ≥ 0.
    """
    loads = quasi_static(cycle, namespace(gear_torque).abs(gear_torque)).normal_load
    gear = gear_torque * cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    loss = friction_loss(cycle, loads, friction_coefficient)
    return efficiency(gear + loss, gear, loss)
