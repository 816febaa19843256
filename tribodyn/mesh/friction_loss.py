"""Mesh efficiency over whole mesh cycles, from the loads and the kinematics of the mesh cycle."""

from typing import Any, NamedTuple

from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.power_flow import efficiency
from tribodyn.mesh.quasi_static import cycle_integral, cycle_mean, quasi_static
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.iteration import iterate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.contact_friction import contact_friction
from tribodyn.tribology.law import Closure

# Loads follow friction through μ tan α only: each step shrinks the error tenfold or more.
_STEPS = 12


class Engaged(NamedTuple):
    """Loads (N) and friction coefficients of the pairs at the nodes, (S, N, Q)."""

    normal_load: Float[Array, "segment node pair"]
    friction_coefficient: Float[Array, "segment node pair"]


def engaged(
    cycle: MeshCycle, gear_torque: float, pinion_speed: Any, closure: Closure, averaged: bool = False
) -> Engaged:
    """Solve elastic load sharing and friction together at the nodes of the table.

    Parameters
    ----------
    cycle : MeshCycle
        The table, of driving flanks only, in which a segment begins wherever a pair passes the pitch point,
        as for a family with a corner there; may be traced.
    gear_torque : float
        N m; negative where the gear drives, on back flanks that are like the driving ones.
    pinion_speed : float
        rad/s.
    closure : Closure
    averaged : bool
        Whether radius and entrainment vanish at the pitch point, and are averaged over the contact there.
    """
    xp = namespace(*cycle, gear_torque, pinion_speed, *closure.surfaces)
    way = xp.sign(gear_torque)
    middle = cycle.signed_distance.shape[1] // 2
    speed, side = way * pinion_speed, way * xp.sign(cycle.signed_distance[:, middle, None])
    rolling = speed * cycle.pinion_speed, speed * cycle.gear_speed
    vanishing = (cycle.pitch_point_length, speed * cycle.pitch_point_rate) if averaged else (0.0, 0.0)
    # at the pitch point itself the laws are evaluated beside it: there the radius may be zero
    radius = xp.maximum(cycle.equivalent_radius, 1e-9)

    def step(state: Engaged) -> Engaged:
        load = quasi_static(cycle, xp.abs(gear_torque), side * state.friction_coefficient).normal_load
        contact = contact_friction(closure, load / cycle.face_width, radius, *rolling, *vanishing)
        return Engaged(load, contact.surface.friction_coefficient + 0.0 * load)

    nothing = 0.0 * cycle.compliance * speed
    return iterate(step, Engaged(nothing, nothing), _STEPS)


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


def mean_efficiency(
    cycle: MeshCycle,
    gear_torque: Any,
    friction_coefficient: Float[Array, "*#table"],
    normal_load: Float[Array, "segment node pair"] | None = None,
) -> Any:
    """Quasi-static efficiency over a mesh cycle, by energy, with a given friction coefficient.

    Parameters
    ----------
    cycle : MeshCycle
        The table; may be traced, but for `side`.
    gear_torque : float
        N m, ≠ 0; negative where the gear drives, on back flanks that are like the driving ones.
    friction_coefficient : array, () or (S, N, Q)
        μ ≥ 0.
    normal_load : array, (S, N, Q), optional
        Of `engaged`, N; default: loads of `quasi_static`, in which friction does not take part: the error is
        of the order of the loss squared.
    """
    loads = normal_load
    if loads is None:
        loads = quasi_static(cycle, namespace(gear_torque).abs(gear_torque)).normal_load
    gear = gear_torque * cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    loss = friction_loss(cycle, loads, friction_coefficient)
    return efficiency(gear + loss, gear, loss)
