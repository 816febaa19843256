"""Efficiency by two published methods.

By the ratio of output to input torque of one pair of teeth with unit contact ratio, J. M. Veciana et al.,
Machines 12 (2024) 943: no deflection, one pair at a time over half a pitch on either side of the pitch point,
constant input torque, friction and load solved together at every point. The method needs nothing of the
family but the lever arms, curvature and speeds of its path.

By the loss factor of an involute mesh with a constant friction coefficient, η = 1 − μ H_v, see
`standards.loss_factors`.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.drive import Drive, tip_radius
from tribodyn.geometry.families import Family
from tribodyn.geometry.helix import base_helix_angle
from tribodyn.geometry.path import Path, contact_limits, kinematics, pitch_point
from tribodyn.mesh.equilibrium import Contacts, settled
from tribodyn.numerics.elementary import sense
from tribodyn.standards.loss_factors import equal_loads, hoehn, of_even_lines
from tribodyn.studies.efficiency.mesh_positions import Array, from_pitch_point
from tribodyn.tribology.law import Closure

#: Nodes on either side of the pitch point: the efficiency is then known to 1e-7 for every family and law.
POINTS = 24


class UnitContact(NamedTuple):
    """One pair over one pitch of pinion rotation; arrays (…, point), speeds per rad/s of the pinion."""

    rotation: Array  # pinion angle ψ from the pitch point, −π/z1 … π/z1, rad
    weight: Array  # of the quadrature; they sum to 1
    #: pinion_normal_arm, gear_normal_arm: A, arms of the normal load, m
    pinion_normal_arm: Array
    gear_normal_arm: Array
    #: pinion_friction_arm, gear_friction_arm: T, arms of the friction force, m
    pinion_friction_arm: Array
    gear_friction_arm: Array
    curvature: Array  # relative curvature, 1/m
    #: pinion_speed, gear_speed: rolling speeds u_1, u_2, m/rad
    pinion_speed: Array
    gear_speed: Array
    #: pitch_point_length, pitch_point_rate: how the contact at a vanishing radius is averaged over its width
    #: See `geometry.pitch_point`, m and 1/rad; 0: it is not, as in Veciana's study.
    pitch_point_length: Any = 0.0
    pitch_point_rate: Any = 0.0


class TorqueRatio(NamedTuple):
    """What the pair does; arrays like the contact's, `efficiency` without the last axis."""

    #: mean of Γ_2/Γ_1 over the pitch, divided by the gear ratio; where the gear drives of Γ_1/Γ_2
    efficiency: Any
    torque_ratio: Array  # Γ_2/Γ_1, or Γ_1/Γ_2
    normal_load: Array  # N
    friction_coefficient: Array  # 1


def rotations(
    pinion_teeth: float, points: int = POINTS, limits: tuple[float, float] = (-math.inf, math.inf)
) -> tuple[Array, Array]:
    """Pinion angles over one pitch about the pitch point, rad, and quadrature weights that sum to 1.

    The pitch lies within `limits` of the roll angle, which contain the pitch point: no longer with it in the
    middle where they end before.
    """
    pitch = 2.0 * math.pi / pinion_teeth
    before = min(max(pitch / 2.0, pitch - limits[1]), -limits[0])
    (back, of_back), (ahead, of_ahead) = (from_pitch_point(way, points) for way in (before, pitch - before))
    return np.concatenate([-back[::-1], ahead]), np.concatenate([of_back[::-1], of_ahead]) / pitch


def path_contact(
    path: Path,
    pinion_teeth: float,
    rotation: tuple[Array, Array] | None = None,
    exact_speeds: bool = True,
    averaged: bool = True,
) -> UnitContact:
    """A pair on any path of contact, at rotations (ψ, weights), by default those of `rotations`.

    With `exact_speeds` the rolling speeds contain the motion of the contact along the path, r κ, which
    Veciana leave out; `averaged`: radius and entrainment over the contact's width where they vanish at the
    pitch point.
    """
    psi, weight = rotation or rotations(pinion_teeth)
    motion = kinematics(path, path.signed_distance(psi))
    ratio = path.pinion_pitch_radius / path.gear_pitch_radius
    vanishing, gear_sense = pitch_point(path), sense(path.gear_pitch_radius)
    return UnitContact(
        rotation=psi,
        weight=weight,
        pinion_normal_arm=motion.pinion_normal_arm,
        gear_normal_arm=gear_sense * motion.gear_normal_arm,
        pinion_friction_arm=motion.pinion_friction_arm,
        gear_friction_arm=gear_sense * motion.gear_friction_arm,
        curvature=motion.relative_curvature,
        pinion_speed=motion.pinion_speed if exact_speeds else motion.pinion_friction_arm,
        gear_speed=motion.gear_speed if exact_speeds else ratio * motion.gear_friction_arm,
        pitch_point_length=float(vanishing.length) if averaged else 0.0,
        pitch_point_rate=float(vanishing.speed_per_radius) if averaged else 0.0,
    )


def torque_ratio(
    pair: UnitContact,
    input_torque: Any,
    pinion_speed: Any,
    face_width: Any,
    closure: Closure,
    gear_drives: bool = False,
) -> TorqueRatio:
    """Solve load and friction together: N = Γ_1/(A_1 + s μ T_1), Γ_2 = N (A_2 + s μ T_2), s = sgn ψ.

    Where the gear drives, the gears exchange their places and the flanks slide the other way, s = −sgn ψ.
    The input torque is Γ_1, where the gear drives Γ_2. Raises SimulationError as `equilibrium.settled`.
    """
    normal_arm = np.stack([pair.pinion_normal_arm, pair.gear_normal_arm])
    friction_arm = np.stack([pair.pinion_friction_arm, pair.gear_friction_arm])
    driver, driven = (1, 0) if gear_drives else (0, 1)
    way = -1.0 if gear_drives else 1.0
    speed = way * pinion_speed
    seen = Contacts(
        closure,
        face_width,
        1.0 / pair.curvature,
        speed * pair.pinion_speed,
        speed * pair.gear_speed,
        way * np.sign(pair.rotation),
        (pair.pitch_point_length, speed * pair.pitch_point_rate),
        1.0,
        normal_arm,
        friction_arm,
    )

    def share(friction: Array) -> _Load:
        return _Load(input_torque / (normal_arm[driver] + friction * friction_arm[driver]))

    state = settled(seen, share)
    mu = state.friction_coefficient
    arms = seen.arms(mu)
    ratio = arms[driven] / arms[driver]
    lossless = normal_arm[driver] / normal_arm[driven]
    return TorqueRatio(np.sum(pair.weight * ratio * lossless, axis=-1), ratio, state.normal_load, mu)


class _Load(NamedTuple):
    """Of one pair, N: friction acts at the whole of it."""

    normal_load: Array

    @property
    def friction_load(self) -> Array:
        return self.normal_load


def tip_contact_ratios(family: Family, drive: Drive) -> tuple[float, float]:
    """ε1 of the pinion's tip and ε2 of the gear's; their sum is the contact ratio."""
    path = family.working_path(drive)
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    pitch = 2.0 * math.pi / drive.pinion.teeth
    return float(path.rotation(end)) / pitch, -float(path.rotation(start)) / pitch


def by_loss_factor(family: Family, drive: Drive, coefficient: float) -> dict[str, float]:
    """Loss factor of an involute drive, 1 − μ H_v with it, and by Höhn's formula where that holds.

    Of spur gears it is `equal_loads`, of helical ones `of_even_lines`.
    """
    tips = tip_contact_ratios(family, drive)
    teeth, ratio = drive.pinion.teeth, drive.gear.teeth / drive.pinion.teeth
    lean = abs(float(base_helix_angle(drive)))
    factor = of_even_lines(*tips, teeth, ratio, lean) if lean else equal_loads(*tips, teeth, ratio)
    results = {"loss_factor": factor, "efficiency_loss_factor": 1.0 - coefficient * factor}
    if max(tips) <= 1.0 <= sum(tips) and min(tips) >= 0.0:
        results["efficiency_hoehn"] = 1.0 - coefficient * hoehn(*tips, teeth, ratio, lean)
    return results
