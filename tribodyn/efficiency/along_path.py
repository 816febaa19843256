"""Quasi-static loads, friction and efficiency along the path of contact, for any family and friction law.

No inertia: at each phase of the mesh the loads balance the torque, friction included, and the friction law and
the loads are solved together. The load is shared by the elasticity of the mesh, equally, or not at all (one
pair over half a pitch on either side of the pitch point).
"""

from typing import Any, Literal, NamedTuple

import numpy as np

from tribodyn.efficiency.quadrature import Array, piecewise
from tribodyn.errors import InputError, SimulationError
from tribodyn.geometry.path import Path, kinematics
from tribodyn.mesh_cycle import CHANNELS, MeshCycle, Polynomials, polynomials
from tribodyn.quasi_static import quasi_static
from tribodyn.tribology.contact import Contact, averaged_radius
from tribodyn.tribology.friction import friction

Sharing = Literal["elastic", "uniform", "single-pair"]
SHARINGS: dict[Sharing, str] = {
    "elastic": "by the compliances of the pairs and the body they share",
    "uniform": "equally among the pairs in contact, as ISO/TC 60 has it",
    "single-pair": "one pair over half a pitch on either side of the pitch point: unit contact ratio",
}
#: Nodes between two breaks of the integrand.
POINTS = 20
#: The loads follow friction through μ tan α only: each step shrinks the error tenfold.
STEPS = 60
TOLERANCE = 1e-12


class Places(NamedTuple):
    """The mesh at some phases: K phases, Q pairs.

    Attributes
    ----------
    phase : (K,)
        Mesh cycles.
    cycle : MeshCycle
        A table of one node in each of K segments, driving flanks only; its kinematics are the path's own.
    carrying : (K, Q)
        1 for a pair that may carry load under the load sharing in use.
    normal_arm, friction_arm : (2, K, Q)
        Arms of normal load and friction about pinion and gear, m.
    radius : (K, Q)
        Equivalent radius, m.
    """

    phase: Array
    cycle: MeshCycle
    carrying: Array
    normal_arm: Array
    friction_arm: Array
    radius: Array


class Engagement(NamedTuple):
    """Loads and friction at `Places`; arrays (K, Q) unless said, SI.

    Attributes
    ----------
    normal_load, friction_coefficient : N, 1
    friction_force : on the pinion along the tangent, positive in recess, N
    entrainment, sliding : m/s
    radius : equivalent radius, averaged over the contact where it vanishes at the pitch point, m
    asperity_load_ratio, central_film_thickness, flash_temperature_rise, hertz_pressure, in_range
        As `tribodyn.tribology.friction` gives them.
    deflection : (K,)
        r_p θ_p − r_g θ_g, m; NaN where the load sharing knows no elasticity.
    pinion_torque, gear_torque : (K,)
        N m.
    power_in, power_out, power_friction : (K,)
        W.
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
    in_range: Array
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
    gear_torque : N m, > 0, constant
    pinion_speed : rad/s
    friction_law : code of `tribodyn.tribology.friction`
    surfaces : Contact
    sharing : one of `SHARINGS`
    """

    gear_torque: float
    pinion_speed: float
    friction_law: int
    surfaces: Contact
    sharing: Sharing = "elastic"


def places(cycle: MeshCycle, path: Path, phase: Array, sharing: Sharing = "elastic") -> Places:
    """Look up the mesh at phases 0 … 1: compliance and gap from the table, kinematics from the path.

    Raises
    ------
    InputError
        If one pair shall carry the load over a pitch that its contact does not cover.
    """
    pairs = cycle.front_pairs
    segment = np.clip(np.searchsorted(cycle.boundary, phase, side="right") - 1, 0, len(cycle.boundary) - 2)
    position = phase[:, None] + np.arange(pairs - 1.0, -1.0, -1.0)
    roll = np.clip(cycle.roll_start + cycle.pitch_angle * position, cycle.roll_start, cycle.roll_end)
    inside = (position < cycle.contact_ratio).astype(float)
    if sharing == "single-pair":
        half = cycle.pitch_angle / 2.0
        if cycle.roll_start > -half or cycle.roll_end < half:
            raise InputError(
                "load_sharing",
                f'"{sharing}"',
                "the contact of a pair does not cover half a pitch on either side of the pitch point",
                'use "elastic" or "uniform"',
            )
        inside = inside * ((roll >= -half) & (roll < half))
    motion = kinematics(path, path.signed_distance(roll))
    at = _Lookup(polynomials(cycle), cycle.boundary, segment, phase)
    one = cycle._replace(
        in_contact=inside,
        side=np.ones(pairs),
        phase=phase[:, None],
        pressure_angle=motion.pressure_angle[:, None],
        signed_distance=motion.signed_distance[:, None],
        pinion_speed=motion.pinion_speed[:, None],
        gear_speed=motion.gear_speed[:, None],
        compliance=at.channel("compliance")[:, None, :pairs],
        gap=at.channel("gap")[:, None, :pairs],
        coupling=at.coupling()[:, None, :pairs, :pairs],
    )
    return Places(
        phase,
        one,
        inside,
        np.stack([motion.pinion_normal_arm, motion.gear_normal_arm]),
        np.stack([motion.pinion_friction_arm, motion.gear_friction_arm]),
        1.0 / motion.relative_curvature,
    )


class _Lookup(NamedTuple):
    """The table's splines at given phases."""

    table: Polynomials
    boundary: Array
    segment: Array
    phase: Array

    def _value(self, coefficients: Array) -> Array:
        start, end = self.boundary[self.segment], self.boundary[self.segment + 1]
        cells = coefficients.shape[1]
        place = np.clip((self.phase - start) / (end - start), 0.0, 1.0) * cells
        cell = np.clip(place.astype(int), 0, cells - 1)
        c = coefficients[self.segment, cell]
        u = (place - cell).reshape(-1, *[1] * (c.ndim - 2))
        return c[..., 0] + u * (c[..., 1] + u * (c[..., 2] + u * c[..., 3]))

    def channel(self, name: str) -> Array:
        return self._value(self.table.channel[:, :, :, CHANNELS.index(name)])

    def coupling(self) -> Array:
        return self._value(self.table.coupling)


def engage(mesh: Places, duty: Duty) -> Engagement:
    """Solve loads and friction together at every phase.

    Raises
    ------
    SimulationError
        If they find no common value: friction locks the mesh, or a law's coefficient grows without bound.
    """
    cycle, speed = mesh.cycle, duty.pinion_speed
    side = np.sign(cycle.signed_distance[:, 0])
    rolling = speed * cycle.pinion_speed[:, 0], speed * cycle.gear_speed[:, 0]
    sliding = rolling[0] - rolling[1]
    width = cycle.face_width
    mu = np.zeros_like(side)
    for _ in range(STEPS):
        load, deflection = _loads(mesh, duty, side * mu)
        radius, rolled = mesh.radius, rolling
        if cycle.pitch_point_length > 0.0:
            radius = averaged_radius(
                radius, load / width, duty.surfaces.effective_modulus, cycle.pitch_point_length
            )
            # entrainment is averaged with the radius, to which it is proportional there; sliding is not
            added = speed * cycle.pitch_point_rate * (radius - mesh.radius)
            rolled = rolling[0] + added, rolling[1] + added
        entrainment = (rolled[0] + rolled[1]) / 2.0
        with np.errstate(over="ignore", under="ignore"):
            found, share, film, temperature, pressure, valid = friction(
                duty.friction_law,
                load / width,
                1.0 / radius,
                entrainment,
                sliding,
                *rolled,
                duty.surfaces,
            )
        found = found * mesh.carrying
        change, mu = float(np.max(np.abs(found - mu))), found
        if change < TOLERANCE:
            break
    else:
        raise SimulationError(f"load and friction coefficient do not settle: still moving by {change:.1e}")
    arms = mesh.normal_arm + side * mu * mesh.friction_arm
    pinion_torque, gear_torque = np.sum(load * arms, axis=-1)
    ratio = cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    return Engagement(
        normal_load=load,
        friction_coefficient=mu,
        friction_force=side * mu * load,
        entrainment=entrainment,
        sliding=sliding,
        radius=radius + 0.0 * load,
        asperity_load_ratio=share,
        central_film_thickness=film,
        flash_temperature_rise=temperature,
        hertz_pressure=pressure,
        in_range=valid,
        deflection=deflection,
        pinion_torque=pinion_torque,
        gear_torque=gear_torque,
        power_in=pinion_torque * speed,
        power_out=gear_torque * speed * ratio,
        power_friction=np.sum(mu * load * np.abs(sliding), axis=-1),
    )


def _loads(mesh: Places, duty: Duty, signed_friction: Array) -> tuple[Array, Array]:
    """Loads (K, Q) that give the gear's torque with the friction of the last step, and deflection (K,)."""
    if duty.sharing == "elastic":
        found = quasi_static(mesh.cycle, duty.gear_torque, signed_friction[:, None])
        return found.normal_load[:, 0], found.deflection[:, 0]
    arms = mesh.normal_arm[1] + signed_friction * mesh.friction_arm[1]
    load = mesh.carrying * duty.gear_torque / np.sum(mesh.carrying * arms, axis=-1, keepdims=True)
    return load, np.full(len(mesh.phase), np.nan)


class CycleEfficiency(NamedTuple):
    """Means over a mesh cycle, by energy.

    Attributes
    ----------
    efficiency : useful work over work put in
    power_in, power_out, power_friction : W
    friction_coefficient : mean weighted with load and sliding
    """

    efficiency: float
    power_in: float
    power_out: float
    power_friction: float
    friction_coefficient: float


def cycle_efficiency(cycle: MeshCycle, path: Path, duty: Duty, points: int = POINTS) -> CycleEfficiency:
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
    """
    pitch = cycle.pitch_point_phase - np.arange(cycle.front_pairs - 1.0, -1.0, -1.0)
    breaks = np.unique(np.concatenate([cycle.boundary, (cycle.pitch_point_phase + np.array([0.5])) % 1.0]))
    phase, weight = piecewise(breaks, pitch, points)
    state = engage(places(cycle, path, phase, duty.sharing), duty)
    power_in, power_out, lost = (
        float(weight @ power) for power in (state.power_in, state.power_out, state.power_friction)
    )
    loaded = float(weight @ np.sum(state.normal_load * np.abs(state.sliding), axis=-1))
    return CycleEfficiency(power_out / power_in, power_in, power_out, lost, lost / loaded)


def phases(samples: int) -> Array:
    """Uniform phases of one mesh cycle for a record, both ends included."""
    return np.linspace(0.0, 1.0, samples + 1)


def record_arrays(mesh: Places, state: Engagement, duty: Duty) -> dict[str, Any]:
    """Datasets of a record of one mesh cycle; what a quasi-static state has not stays out."""
    cycle = mesh.cycle
    touching = (mesh.carrying > 0) & (state.normal_load > 0)
    angle = mesh.phase * cycle.pitch_angle
    ratio = cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    zero = np.zeros_like(angle)

    def contacting(values: Array) -> Array:
        return np.where(touching, values, np.nan)

    gear_angle = ratio * angle - np.nan_to_num(state.deflection) / cycle.gear_pitch_radius
    one = np.ones_like(angle)
    return {
        "time": angle / duty.pinion_speed,
        "pinion_angle": angle,
        "displacement": np.stack([zero, zero, zero, zero, angle, gear_angle], axis=-1),
        "velocity": np.stack(
            [zero, zero, zero, zero, one * duty.pinion_speed, one * duty.pinion_speed * ratio], -1
        ),
        "transmission_error": contacting(state.deflection[:, None] * np.cos(cycle.pressure_angle[:, 0])),
        "transmission_error_rotational": state.deflection,
        "normal_load": state.normal_load,
        "friction_force": state.friction_force,
        "friction_coefficient": contacting(state.friction_coefficient),
        "asperity_load_ratio": contacting(state.asperity_load_ratio),
        "central_film_thickness": contacting(state.central_film_thickness),
        "film_parameter": contacting(state.central_film_thickness / duty.surfaces.roughness),
        "flash_temperature_rise": contacting(state.flash_temperature_rise),
        "hertz_pressure": contacting(state.hertz_pressure),
        "equivalent_radius": contacting(state.radius),
        "entrainment_speed": contacting(state.entrainment),
        "sliding_speed": contacting(state.sliding),
        "pressure_angle": contacting(cycle.pressure_angle[:, 0]),
        "mesh_stiffness": np.where(touching, 1.0 / cycle.compliance[:, 0], 0.0),
        "closure_in_range": np.where(touching, state.in_range, np.nan),
        "drive_torque": state.pinion_torque,
        "power_in": state.power_in,
        "power_out": state.power_out,
        "power_friction": state.power_friction,
        "power_damping": zero,
        "power_parametric": zero,
        "efficiency": state.power_out / state.power_in,
    }
