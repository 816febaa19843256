"""Mesh efficiency over whole mesh cycles, from the loads and the kinematics of the mesh cycle."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.power_flow import efficiency
from tribodyn.mesh.quasi_static import cycle_integral, cycle_mean, quasi_static
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.iteration import iterate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import ContactFriction, contact_friction

# Loads follow friction through μ tan α only: each step shrinks the error tenfold or more.
_STEPS, _DIFFERENTIATED = 12, 6


class Engaged(NamedTuple):
    """Loads (N) and friction coefficients of the pairs at the nodes, (S, N, Q)."""

    normal_load: Float[Array, "segment node pair"]
    friction_coefficient: Float[Array, "segment node pair"]


class Contacts(NamedTuple):
    """Speeds and radii of the pairs' contacts at the nodes, and the laws in use on them; `contacts` makes it.

    Parameters
    ----------
    closure : Closure
    face_width : float
        m.
    radius, pinion_speed, gear_speed : array, (S, N, Q)
        m, and rolling speeds in m/s.
    side : array
        Sign of the sliding of each pair in each segment.
    vanishing : tuple
        As `contact_friction` takes them.
    """

    closure: Closure
    face_width: Any
    radius: Any
    pinion_speed: Any
    gear_speed: Any
    side: Any
    vanishing: tuple[Any, Any]

    def under(self, normal_load: Any) -> ContactFriction:
        """What the laws give under these loads (N)."""
        rolling = self.pinion_speed, self.gear_speed
        line_load = normal_load / self.face_width
        return contact_friction(self.closure, line_load, self.radius, *rolling, *self.vanishing)


def contacts(
    cycle: MeshCycle, gear_torque: Any, pinion_speed: Any, closure: Closure, averaged: bool = False
) -> Contacts:
    """What the laws in use see of the mesh; parameters as those of `engaged`."""
    xp = namespace(*cycle, gear_torque, pinion_speed, *closure.surfaces)
    way = xp.sign(gear_torque)
    middle = cycle.signed_distance.shape[1] // 2
    speed, side = way * pinion_speed, way * xp.sign(cycle.signed_distance[:, middle, None])
    vanishing = (cycle.pitch_point_length, speed * cycle.pitch_point_rate) if averaged else (0.0, 0.0)
    # at the pitch point itself the laws are evaluated beside it: there the radius may be zero
    radius = xp.maximum(cycle.equivalent_radius, 1e-9)
    rolling = speed * cycle.pinion_speed, speed * cycle.gear_speed
    return Contacts(closure, cycle.face_width, radius, *rolling, side, vanishing)


def engaged(cycle: MeshCycle, gear_torque: Any, seen: Contacts) -> Engaged:
    """Solve elastic load sharing and friction together at the nodes of the table.

    Parameters
    ----------
    cycle : MeshCycle
        The table, of driving flanks only, in which a segment begins wherever a pair passes the pitch point,
        as for a family with a corner there; may be traced.
    gear_torque : float
        N m; negative where the gear drives, on back flanks that are like the driving ones.
    seen : Contacts
        Of the same table and torque; `contacts` takes pinion speed (rad/s), closure, and whether radius and
        entrainment vanish at the pitch point and are averaged over the contact there.
    """
    xp = namespace(*cycle, gear_torque)

    def step(state: Engaged) -> Engaged:
        friction = seen.side * state.friction_coefficient
        load = quasi_static(cycle, xp.abs(gear_torque), friction).normal_load
        return Engaged(load, seen.under(load).surface.friction_coefficient + 0.0 * load)

    nothing = 0.0 * cycle.compliance * seen.pinion_speed
    return iterate(step, Engaged(nothing, nothing), _STEPS, _DIFFERENTIATED)


def settled(cycle: MeshCycle, gear_torque: float, seen: Contacts) -> Engaged:
    """Return what `engaged` does of plain numbers; `cycle`, `gear_torque` and `seen` as there.

    Raises
    ------
    SimulationError
        If friction locks the mesh: no load of a pair balances the torque.
    """
    with np.errstate(all="ignore"):
        found = engaged(cycle, gear_torque, seen)
    if np.all(np.isfinite(found.normal_load)) and np.all(np.isfinite(found.friction_coefficient)):
        return found
    slow = quasi_static(cycle, abs(gear_torque)).normal_load
    worst = float(np.max(seen.under(slow).surface.friction_coefficient * (slow > 0.0)))
    raise SimulationError(
        f"friction locks the mesh in slow rotation, with coefficients up to {worst:.3g}: use another "
        "friction law, or conditions nearer to those that it holds for"
    )


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
