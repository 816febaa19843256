"""Quasi-static loads, friction and efficiency along the path of contact, for any family and laws.

No inertia: at each phase of the mesh the loads balance the torque, friction included, and the friction law
and the loads are solved together. Where the gear drives, the back flanks carry: driving flanks of the world
mirrored about the plane of the axes, in which the gears turn backwards and slide the other way.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.compliance.sharing.line_load import friction_ratio, peak_ratio
from tribodyn.compliance.sharing.loaded_flanks import LoadedFlanks
from tribodyn.errors import SimulationError
from tribodyn.geometry.path import Path
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.power_flow import efficiency
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.studies.efficiency.places import Places, Sharing, places
from tribodyn.studies.efficiency.quadrature import Array, piecewise
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import ContactFriction, contact_friction, range_shares

#: Nodes between two breaks of the integrand.
POINTS = 20
#: The loads follow friction through μ tan α only: each step shrinks the error tenfold.
STEPS = 60
TOLERANCE = 1e-12


class Engagement(NamedTuple):
    """Loads and friction at `Places`; arrays (K, Q) unless said, SI.

    Attributes
    ----------
    normal_load, friction_coefficient : N, 1
    friction_force : on the pinion along the tangent, positive in recess, N
    entrainment, sliding : m/s; the sliding negative in approach, whichever gear drives
    radius : equivalent radius, averaged over the contact where it vanishes at the pitch point, m
    asperity_load_ratio, central_film_thickness, flash_temperature_rise, hertz_pressure, closure_in_range,
    friction_in_range
        As in `SurfaceState`, where the line load along the face is highest.
    closure_shares, friction_shares : (K, Q, limits)
        See `surface_state.range_shares`.
    deflection : (K,)
        r_p θ_p − r_g θ_g, m; NaN where the load sharing knows no elasticity.
    pinion_torque, gear_torque : (K,)
        N m; on the gear against its motion, on the pinion with it.
    power_in, power_out, power_friction : (K,)
        From the pinion, to the gear, and lost, W; the first two < 0 where the gear drives.
    """

    normal_load: Array
    friction_coefficient: Array
    friction_force: Array
    entrainment: Array
    sliding: Array
    radius: Array
    asperity_load_ratio: Array
    central_film_thickness: Array
    flash_temperature_rise: Array
    hertz_pressure: Array
    closure_in_range: Array
    friction_in_range: Array
    closure_shares: Array
    friction_shares: Array
    deflection: Array
    pinion_torque: Array
    gear_torque: Array
    power_in: Array
    power_out: Array
    power_friction: Array


class Duty(NamedTuple):
    """What the mesh has to do.

    Attributes
    ----------
    gear_torque : N m, ≠ 0, constant; against the gear's motion, < 0 where the gear drives
    pinion_speed : rad/s
    closure : Closure
    sharing : one of `places.SHARINGS`
    """

    gear_torque: float
    pinion_speed: float
    closure: Closure
    sharing: Sharing = "elastic"

    @property
    def way(self) -> float:
        """+1 where the pinion drives, −1 where the gear does: the way in which the flanks roll and slide."""
        return 1.0 if self.gear_torque > 0.0 else -1.0


def engage(mesh: Places, duty: Duty) -> Engagement:
    """Solve loads and friction together at every phase.

    Raises
    ------
    SimulationError
        If they find no common value: friction locks the mesh, or a law's coefficient grows without bound.
    """
    cycle, speed = mesh.cycle, duty.way * duty.pinion_speed
    side = duty.way * np.sign(cycle.signed_distance[:, 0])
    rolling = speed * cycle.pinion_speed[:, 0], speed * cycle.gear_speed[:, 0]
    sliding = rolling[0] - rolling[1]
    width = cycle.face_width

    def contact_at(line_load: Array) -> ContactFriction:
        return contact_friction(
            duty.closure,
            line_load,
            mesh.radius,
            *rolling,
            cycle.pitch_point_length,
            speed * cycle.pitch_point_rate,
        )

    mu, change = np.zeros_like(side), np.inf
    for _ in range(STEPS):
        load, deflection, uneven, peak = _loads(mesh, duty, side * mu)
        contact = contact_at(load / width * uneven)
        new_mu = contact.surface.friction_coefficient * mesh.carrying
        if np.any(mesh.carrying * (mesh.normal_arm + side * new_mu * mesh.friction_arm) < 0.0):
            worst = float(np.max(new_mu))
            raise SimulationError(
                f"friction locks the mesh: a coefficient of {worst:.3g} turns a load's arm over"
            )
        change, mu = float(np.max(np.abs(new_mu - mu))), new_mu
        if change < TOLERANCE:
            break
    else:
        raise SimulationError(f"load and friction coefficient do not settle: still moving by {change:.1e}")
    if np.any(peak != uneven):
        contact = contact_at(load / width * peak)
    surface = contact.surface
    closure_shares, friction_shares = range_shares(contact.contact, duty.closure)
    arms = mesh.normal_arm + side * mu * mesh.friction_arm
    pinion_torque, gear_torque = duty.way * np.sum(load * arms, axis=-1)
    ratio = cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    return Engagement(
        normal_load=load,
        friction_coefficient=mu,
        friction_force=side * mu * load,
        entrainment=contact.entrainment,
        sliding=sliding,
        radius=contact.radius,
        asperity_load_ratio=surface.asperity_load_ratio,
        central_film_thickness=surface.central_film_thickness,
        flash_temperature_rise=surface.flash_temperature_rise,
        hertz_pressure=surface.hertz_pressure,
        closure_in_range=surface.closure_in_range,
        friction_in_range=surface.friction_in_range,
        closure_shares=closure_shares,
        friction_shares=friction_shares,
        deflection=duty.way * deflection,
        pinion_torque=pinion_torque,
        gear_torque=gear_torque,
        power_in=pinion_torque * duty.pinion_speed,
        power_out=gear_torque * duty.pinion_speed * ratio,
        power_friction=np.sum(mu * load * np.abs(sliding), axis=-1),
    )


def _loads(mesh: Places, duty: Duty, signed_friction: Array) -> tuple[Array, Array, Array, Array]:
    """Loads (K, Q) that give the gear's torque with the friction of the last step, and deflection (K,) ≥ 0.

    With the ratios (K, Q) of `sharing.line_load`: 1 for an even load along the face.
    """
    torque = abs(duty.gear_torque)
    if mesh.flanks is not None:
        friction = signed_friction * np.sign(mesh.cycle.signed_distance[:, 0])
        shared = mesh.flanks.share(mesh.roll, torque, friction)
        ratios = friction_ratio(shared.slice_load), peak_ratio(shared.slice_load)
        return mesh.carrying * shared.normal_load, shared.deflection, *ratios
    even = np.ones_like(mesh.roll)
    if duty.sharing == "elastic":
        state = quasi_static(mesh.cycle, torque, signed_friction[:, None])
        return state.normal_load[:, 0], state.deflection[:, 0], even, even
    arms = mesh.normal_arm[1] + signed_friction * mesh.friction_arm[1]
    load = mesh.carrying * torque / np.sum(mesh.carrying * arms, axis=-1, keepdims=True)
    return load, np.full(len(mesh.phase), np.nan), even, even


class CycleEfficiency(NamedTuple):
    """Means over a mesh cycle, by energy.

    Attributes
    ----------
    efficiency : as `mesh.power_flow` defines it
    power_in, power_out, power_friction : W, as in `Engagement`
    friction_coefficient : mean weighted with load and sliding
    """

    efficiency: float
    power_in: float
    power_out: float
    power_friction: float
    friction_coefficient: float


def cycle_efficiency(
    cycle: MeshCycle,
    path: Path,
    duty: Duty,
    points: int = POINTS,
    flanks: LoadedFlanks | None = None,
) -> CycleEfficiency:
    """Integrate power in, out and lost over a mesh cycle.

    The quadrature is split where the set of loaded pairs changes and crowds towards the pitch points, so that
    the degenerate contact there is resolved.

    Parameters
    ----------
    cycle : MeshCycle
        Of concrete numbers.
    path : Path
        The working path that the table was made from.
    duty : Duty
    points : int
        Nodes between two breaks.
    flanks : LoadedFlanks, optional
        As in `places`.
    """
    pitch = cycle.pitch_point_phase - np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)
    breaks = np.unique(np.concatenate([cycle.boundary, (cycle.pitch_point_phase + np.array([0.5])) % 1.0]))
    phase, weight = piecewise(breaks, pitch, points)
    state = engage(places(cycle, path, phase, duty.sharing, flanks), duty)
    power_in, power_out, lost = (
        float(weight @ power) for power in (state.power_in, state.power_out, state.power_friction)
    )
    loaded = float(weight @ np.sum(state.normal_load * np.abs(state.sliding), axis=-1))
    share = float(efficiency(power_in, power_out, lost))
    return CycleEfficiency(share, power_in, power_out, lost, lost / loaded)
