"""Quasi-static loads, friction and efficiency along the path of contact, for any family and laws.

No inertia: at each phase of the mesh the loads balance the torque, friction included, and the friction law
and the loads are solved together. Where the gear drives, the back flanks carry: driving flanks of the world
mirrored about the plane of the axes, in which the gears turn backwards and slide the other way.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.slices import friction_ratio, peak_ratio
from tribodyn.gears.motion.recorded import DOF, DOF_IN_SPACE, samples_of
from tribodyn.geometry.path import Path
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.equilibrium import Contacts, contacts, settled
from tribodyn.mesh.quasi_static import efficiency, normal_arms, quasi_static
from tribodyn.studies.efficiency.mesh_positions import (
    Array,
    Places,
    Sharing,
    judged,
    of_pairs,
    phases_of,
    piecewise,
    places,
    share_evenly,
)
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import range_shares

#: Nodes between two breaks of the integrand.
POINTS = 20
#: What a `PathState` has of `SurfaceState`.
_OF_SURFACE = (
    *("asperity_load_ratio", "central_film_thickness", "flash_temperature_rise", "hertz_pressure"),
    *("closure_in_range", "friction_in_range"),
)


class PathState(NamedTuple):
    """Loads and friction at `Places`; arrays (K, Q) unless another shape stands beside them, SI."""

    normal_load: Array  # N
    friction_coefficient: Array
    friction_force: Array  # on the pinion along the tangent, positive in recess, N
    entrainment: Array  # m/s
    sliding: Array  # m/s; negative in approach, whichever gear drives
    radius: Array  # equivalent, averaged over the contact where it vanishes at the pitch point, m
    # as in `SurfaceState`, where the line load along the face is highest
    asperity_load_ratio: Array
    central_film_thickness: Array
    flash_temperature_rise: Array
    hertz_pressure: Array
    closure_in_range: Array
    friction_in_range: Array
    closure_shares: Array  # (K, Q, limits), see `surface_state.range_shares`
    friction_shares: Array
    deflection: Array  # (K,), r_p θ_p − r_g θ_g, m; NaN where the load sharing knows no elasticity
    pinion_torque: Array  # (K,), with its motion, N m
    gear_torque: Array  # (K,), against its motion, N m
    power_in: Array  # (K,), from the pinion, W; < 0 where the gear drives, as the next
    power_out: Array  # (K,), to the gear, W
    power_friction: Array  # (K,), lost, W


class MeshDuty(NamedTuple):
    """What the mesh has to do."""

    gear_torque: float  # N m, ≠ 0, constant; against the gear's motion, < 0 where the gear drives
    pinion_speed: float  # rad/s
    closure: Closure
    sharing: Sharing = "elastic"  # one of `places.SHARINGS`
    lever_arms: bool = False  # see `FrictionData`

    @property
    def way(self) -> float:
        """+1 where the pinion drives, −1 where the gear does: the way in which the flanks roll and slide."""
        return 1.0 if self.gear_torque > 0.0 else -1.0


class _Loads(NamedTuple):
    """Loads (K, 1, Q) of pairs, those at which friction acts, the highest along the face, and deflection."""

    normal_load: Array
    friction_load: Array
    peak_load: Array
    deflection: Array


def engage(mesh: Places, duty: MeshDuty) -> PathState:
    """Solve loads and friction together at every phase; raises as `equilibrium.settled`."""
    cycle = mesh.cycle
    torque, speed = duty.gear_torque, duty.pinion_speed
    seen = contacts(cycle, torque, speed, duty.closure, lever_arms=duty.lever_arms)
    state = settled(seen, lambda friction: _share(mesh, duty, seen, friction))
    load, mu, shared = state.normal_load[:, 0], state.friction_coefficient[:, 0], state.shared
    contact = seen.under(shared.peak_load)
    closure_shares, friction_shares = range_shares(contact.contact, duty.closure)
    torques = duty.way * np.sum(load * seen.arms(state.friction_coefficient)[:, :, 0], axis=-1)
    sliding = (seen.pinion_speed - seen.gear_speed)[:, 0]
    return PathState(
        normal_load=load,
        friction_coefficient=mu,
        friction_force=seen.side[:, 0] * mu * load,
        entrainment=contact.entrainment[:, 0],
        sliding=sliding,
        radius=contact.radius[:, 0],
        **{name: getattr(contact.surface, name)[:, 0] for name in _OF_SURFACE},
        closure_shares=closure_shares[:, 0],
        friction_shares=friction_shares[:, 0],
        deflection=duty.way * shared.deflection[:, 0],
        pinion_torque=torques[0],
        gear_torque=torques[1],
        power_in=torques[0] * duty.pinion_speed,
        power_out=torques[1] * duty.pinion_speed * cycle.speed_ratio,
        # of a slice that passes the pitch point the mean over its width
        power_friction=np.sum(mu * load * seen.side[:, 0] * sliding, axis=-1),
    )


def _share(mesh: Places, duty: MeshDuty, seen: Contacts, friction: Array) -> _Loads:
    """Loads that give the gear's torque; deflection ≥ 0, NaN where the sharing knows no elasticity."""
    torque = abs(duty.gear_torque)
    if mesh.flanks is not None:
        coefficient = friction * np.sign(mesh.cycle.signed_distance)
        shared = mesh.flanks.share(mesh.roll, torque, coefficient[:, 0])
        load = (mesh.cycle.in_contact * shared.normal_load)[:, None]
        ratios = friction_ratio(shared.slice_load)[:, None], peak_ratio(shared.slice_load)[:, None]
        return _Loads(load, load * ratios[0], load * ratios[1], shared.deflection[:, None])
    if duty.sharing == "elastic":
        state = quasi_static(mesh.cycle, mesh.cycle.gear_sense * torque, friction)
        return _Loads(state.normal_load, state.normal_load, state.normal_load, state.deflection)
    arms = seen.normal_arm[1] + friction * seen.friction_arm[1]
    load = share_evenly(seen, mesh.cycle, arms, torque)
    return _Loads(load, load, load, np.full(load.shape[:2], np.nan))


class CycleEfficiency(NamedTuple):
    """Means over a mesh cycle, by energy."""

    efficiency: float  # as `mesh.power_flow` defines it
    # W, as in `PathState`
    power_in: float
    power_out: float
    power_friction: float
    friction_coefficient: float  # mean weighted with load and sliding


def cycle_efficiency(
    cycle: MeshCycle, path: Path, duty: MeshDuty, points: int = POINTS, flanks: LoadedFlanks | None = None
) -> CycleEfficiency:
    """Integrate power in, out and lost over a mesh cycle.

    The quadrature is split where the set of loaded pairs changes, with so many `points` between two breaks,
    and crowds towards the pitch points, so that the degenerate contact there is resolved. Arguments as in
    `places`.
    """
    if cycle.slices > 1:
        phase, weight = phases_of(cycle)
    else:
        pitch = cycle.pitch_point_phase - np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)
        passing = (cycle.pitch_point_phase + np.array([0.5])) % 1.0
        breaks = np.unique(np.concatenate([cycle.boundary, passing]))
        phase, weight = piecewise(breaks, pitch, points)
    state = engage(places(cycle, path, phase, duty.sharing, flanks), duty)
    power_in, power_out, lost = (
        float(weight @ power) for power in (state.power_in, state.power_out, state.power_friction)
    )
    loaded = float(weight @ np.sum(state.normal_load * np.abs(state.sliding), axis=-1))
    share = float(efficiency(power_in, power_out, lost))
    return CycleEfficiency(share, power_in, power_out, lost, lost / loaded)


#: By how much of a pitch the first and the last sample stand off the end of the path.
_INSIDE = 1e-9


class Samples(NamedTuple):
    """Phases of the table in the order in which they are passed."""

    turned: Array  # (K,), rotation since the first sample, in pitches
    #: (K,), phase of the table at each sample. Where the gear drives it falls: contact begins where the
    #: table's ends, in the mirrored world in which the back flanks are driving flanks
    phase: Array
    later: np.ndarray  # (K,); where the table counts the pairs one slot later than the record
    way: float  # +1, or −1 where the gear drives

    def by_pair(self, values: Array) -> Array:
        """Values (K, Q) of the table's slots, as those of the record's: the pair that entered last, last."""
        if self.way > 0.0:
            return values
        later = self.later.reshape(-1, *[1] * (values.ndim - 1))
        return np.where(later, np.roll(values, -1, axis=1), values)[:, ::-1]


def samples(cycle: MeshCycle, count: int, way: float) -> Samples:
    """Return count + 1 samples over one mesh cycle of the driving flanks, or of the back flanks.

    The last one ends the cycle, before the next pair enters. Of slices, which come and go without a jump, it
    begins the next cycle, as in records over time: the pair that entered last is then the one before it.
    """
    turned = np.linspace(0.0, 1.0, count + 1)
    passed = np.where((turned < 1.0) | (cycle.slices == 1), turned, 0.0)
    if way > 0.0:
        return Samples(turned, passed, np.zeros(count + 1, dtype=bool), way)
    span = float((cycle.roll_end - cycle.roll_start) / cycle.pitch_angle)
    # the pair in the first slot enters where the table lets it leave: just inside the path, and the next one
    # is just outside when the cycle ends
    falling = span - (cycle.front_pairs - 1.0) - passed - _INSIDE * (1.0 - 2.0 * passed)
    later = falling < 0.0
    return Samples(turned, np.where(later, falling + 1.0, falling), later, way)


def record_arrays(over: Samples, mesh: Places, state: PathState, duty: MeshDuty) -> dict[str, Any]:
    """Datasets at the samples; what a quasi-static state has not stays out."""
    cycle = mesh.cycle
    touching = (cycle.in_contact > 0) & judged(cycle, state.normal_load)
    angle = over.turned * cycle.pitch_angle
    ratio = cycle.speed_ratio
    zero, speed = np.zeros_like(angle), np.full_like(angle, duty.pinion_speed)
    share = cycle.share[:, 0] if cycle.slices > 1 else 1.0
    in_space = (len(DOF_IN_SPACE) - len(DOF)) * [zero] if cycle.slices > 1 else []

    def contacting(values: Array) -> Array:
        return np.where(touching, values, np.nan)

    behind = np.nan_to_num(state.deflection) / (cycle.gear_sense * cycle.gear_pitch_radius)
    gear_angle = ratio * angle - behind
    arrays = {
        "time": angle / duty.pinion_speed,
        "pinion_angle": angle,
        "displacement": np.stack([zero, zero, zero, zero, angle, gear_angle, *in_space], axis=-1),
        "velocity": np.stack([zero, zero, zero, zero, speed, ratio * speed, *in_space], axis=-1),
        "transmission_error_normal": contacting(
            duty.way * state.deflection[:, None] * normal_arms(cycle)[:, 0]
        ),
        "transmission_error_rotational": state.deflection,
        "normal_load": state.normal_load,
        "friction_force": state.friction_force,
        "friction_coefficient": contacting(state.friction_coefficient),
        "film_parameter": contacting(state.central_film_thickness / duty.closure.surfaces.roughness),
        "equivalent_radius": contacting(state.radius),
        "entrainment_speed": contacting(state.entrainment),
        "sliding_speed": contacting(state.sliding),
        "pressure_angle": contacting(cycle.pressure_angle[:, 0]),
        "mesh_stiffness": np.where(touching, share / cycle.compliance[:, 0], 0.0),
        **{name: contacting(getattr(state, name)) for name in _OF_SURFACE},
        "drive_torque": state.pinion_torque,
        "power_in": state.power_in,
        "power_out": state.power_out,
        "power_friction": state.power_friction,
        "power_damping": zero,
        "power_parametric": zero,
        "efficiency": efficiency(state.power_in, state.power_out, state.power_friction),
    }
    if cycle.slices > 1:
        arrays = of_pairs(cycle, arrays, state.normal_load, duty.way)
    variables = samples_of(cycle.slices)
    paired = {name for name, sample in variables.items() if sample.dims[:2] == ("time", "pair")}
    return {name: over.by_pair(values) if name in paired else values for name, values in arrays.items()}
