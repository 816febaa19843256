"""The quasi-static equilibrium with friction: loads that balance the torque with the friction they make."""

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import normal_arms, quasi_static, sliding_side
from tribodyn.numerics.elementary import maximum, namespace, sin
from tribodyn.numerics.iteration import iterate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import ContactFriction, contact_friction

# Loads follow friction through μ tan α only: each step shrinks the error tenfold or more. Under JAX the steps
# are so many, and so many of them are differentiated; plain numbers take steps until μ moves by less.
_STEPS, _DIFFERENTIATED = 12, 6
_MOST, _TOLERANCE = 60, 1e-12


class Loads(Protocol):
    """How a torque is shared, N."""

    @property
    def normal_load(self) -> Float[Array, "*pair"]:
        """Loads of the pairs."""

    @property
    def friction_load(self) -> Float[Array, "*pair"]:
        """Loads at which friction acts as along the face."""


class Contacts(NamedTuple):
    """Contacts of pairs of teeth and the laws in use on them; arrays of one shape (…)."""

    closure: Closure
    face_width: Any  # m; of slices the length of the line of contact of each
    #: radius, pinion_speed, gear_speed: m, and rolling speeds in m/s
    radius: Any
    pinion_speed: Any
    gear_speed: Any
    side: Any  # sign of the sliding
    vanishing: tuple[Any, Any]  # as `contact_friction` takes them
    carrying: Any  # 1 where the pair may carry load, else 0
    #: normal_arm, friction_arm: (2, …), arms of normal load and friction about pinion and gear, m, each in
    #: the gear's own sense: positive of the load, of an internal gear too
    normal_arm: Any
    friction_arm: Any

    def under(self, normal_load: Any) -> ContactFriction:
        """What the laws give under these loads (N)."""
        rolling = self.pinion_speed, self.gear_speed
        line_load = normal_load / self.face_width
        return contact_friction(self.closure, line_load, self.radius, *rolling, *self.vanishing)

    def arms(self, friction_coefficient: Any) -> Any:
        """Arms (2, …) of load and friction together, m; negative: friction locks the pair."""
        return self.normal_arm + self.side * friction_coefficient * self.friction_arm


class Equilibrium(NamedTuple):
    """Loads (N) and friction coefficients of the pairs; of plain numbers also all that the sharing gave."""

    normal_load: Float[Array, "*pair"]
    friction_coefficient: Float[Array, "*pair"]
    shared: Any = None


Share = Callable[[Float[Array, "*pair"]], Loads]


def contacts(
    cycle: MeshCycle,
    gear_torque: Any,
    pinion_speed: Any,
    closure: Closure,
    averaged: bool = True,
    lever_arms: bool = False,
) -> Contacts:
    """Contacts at the nodes of a table of driving flanks, (S, N, Q); may be traced.

    A segment begins wherever a pair passes the pitch point, as for a family with a corner there. The torque
    (N m) is negative where the gear drives, on back flanks that are like the driving ones. `averaged`: radius
    and entrainment are averaged over the contact where they vanish at the pitch point. `lever_arms`, of spur
    gears: rolling speeds without the motion of the contact along the path, r κ, and nothing averaged.
    """
    xp = namespace(*cycle, gear_torque, pinion_speed, *closure.surfaces)
    way = xp.sign(gear_torque)
    r, angle = cycle.signed_distance, cycle.pressure_angle
    speed, side = way * cycle.pinion_sense * pinion_speed, way * sliding_side(cycle)
    normal, length = normal_arms(cycle), cycle.face_width
    sense = cycle.pinion_sense, cycle.gear_sense
    if cycle.slices > 1:
        # of a slice that comes or goes over its whole width: what is inside it is not resolved
        length = cycle.slice_width / cycle.line_load_friction
    friction_arm = xp.stack(
        [
            sense[0] * (cycle.pinion_pitch_radius * sin(angle) + r),
            sense[1] * (cycle.gear_pitch_radius * sin(angle) - r),
        ]
    )
    along_path = speed * cycle.pinion_speed - way * pinion_speed * friction_arm[0] if lever_arms else 0.0
    rate = speed * cycle.pitch_point_rate
    return Contacts(
        closure,
        length,
        # at the pitch point itself the laws are evaluated beside it: there the radius may be zero
        maximum(cycle.equivalent_radius, 1e-9),
        speed * cycle.pinion_speed - along_path,
        speed * cycle.gear_speed - along_path,
        side,
        (cycle.pitch_point_length, rate) if averaged and not lever_arms else (0.0, 0.0),
        (cycle.in_contact * (cycle.side > 0))[:, None, :],
        xp.stack(
            [sense[0] * cycle.pinion_pitch_radius * normal, sense[1] * cycle.gear_pitch_radius * normal]
        ),
        friction_arm,
    )


def elastic(cycle: MeshCycle, gear_torque: Any) -> Share:
    """Sharing of the gear's torque by the compliances of the table."""
    torque = cycle.gear_sense * namespace(gear_torque).abs(gear_torque)
    return lambda friction: quasi_static(cycle, torque, friction)


def equilibrium(seen: Contacts, share: Share) -> Equilibrium:
    """Solve load sharing and friction together; may be traced.

    `share` takes friction force over normal load, with the sign of the sliding, to `Loads`.
    """
    return _solved(seen, share)[0]


def settled(seen: Contacts, share: Share) -> Equilibrium:
    """Return what `equilibrium` does of plain numbers.

    Raises SimulationError if friction locks the mesh, no load of a pair balances the torque, or a law's
    coefficient grows without bound.
    """
    contacts, change = _solved(seen, share)
    mu = contacts.friction_coefficient
    finite = np.all(np.isfinite(contacts.normal_load)) and np.all(np.isfinite(mu))
    if not finite or np.any(seen.carrying * seen.arms(mu) < 0.0):
        slow = share(np.zeros_like(mu)).friction_load
        worst = float(np.max(seen.under(slow).surface.friction_coefficient * (slow > 0.0)))
        raise SimulationError(
            f"friction locks the mesh in slow rotation, with coefficients up to {worst:.3g}: use another "
            "friction law, or conditions nearer to those that it holds for"
        )
    if change >= _TOLERANCE:
        raise SimulationError(f"load and friction coefficient do not settle: still moving by {change:.1e}")
    return contacts


def _solved(seen: Contacts, share: Share) -> tuple[Equilibrium, float]:
    def step(state: tuple[Any, Any]) -> tuple[Any, Any]:
        shared = share(seen.side * state[1])
        load = shared.friction_load
        return shared, seen.under(load).surface.friction_coefficient * seen.carrying + 0.0 * load

    nothing = 0.0 * seen.radius * seen.pinion_speed
    if namespace(*seen) is not np:

        def loads(state: tuple[Any, Any]) -> tuple[Any, Any]:
            shared, mu = step(state)
            return shared.normal_load, mu

        load, mu = iterate(loads, (nothing, nothing), _STEPS, _DIFFERENTIATED)
        return Equilibrium(load, mu), 0.0
    with np.errstate(all="ignore"):
        state, change = step((None, nothing)), np.inf
        for _ in range(_MOST):
            before, state = state[1], step(state)
            change = float(np.max(np.abs(state[1] - before)))
            if not change >= _TOLERANCE:
                break
    shared, mu = state
    return Equilibrium(shared.normal_load, mu, shared), change
