"""Efficiency from the ratio of output to input torque of one pair of teeth with unit contact ratio.

J. M. Veciana et al., Machines 12 (2024) 943: no deflection, one pair at a time over half a pitch on either
side of the pitch point, constant input torque, friction and load solved together at every point. The method
needs nothing of the family but the lever arms, curvature and speeds of its path.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.geometry.path import Path, kinematics
from tribodyn.geometry.pitch_point import pitch_point
from tribodyn.studies.efficiency.quadrature import Array, from_pitch_point
from tribodyn.tribology.law import Closure
from tribodyn.tribology.surface_state import contact_friction

#: Nodes on either side of the pitch point: the efficiency is then known to 1e-7 for every family and law.
POINTS = 24
#: The load follows the friction coefficient through μ tan α only: each step shrinks the error tenfold.
STEPS = 60
TOLERANCE = 1e-13


class UnitContact(NamedTuple):
    """One pair over one pitch of pinion rotation; arrays (…, point), speeds per rad/s of the pinion.

    Attributes
    ----------
    rotation : pinion angle ψ from the pitch point, −π/z1 … π/z1, rad
    weight : of the quadrature; they sum to 1
    pinion_normal_arm, gear_normal_arm : A, arms of the normal load, m
    pinion_friction_arm, gear_friction_arm : T, arms of the friction force, m
    curvature : relative curvature, 1/m
    pinion_speed, gear_speed : rolling speeds u_1, u_2, m/rad
    pitch_point_length, pitch_point_rate : how the contact at a vanishing radius is averaged over its width
        See `geometry.pitch_point`, m and 1/rad; 0: it is not, as in Veciana's study.
    """

    rotation: Array
    weight: Array
    pinion_normal_arm: Array
    gear_normal_arm: Array
    pinion_friction_arm: Array
    gear_friction_arm: Array
    curvature: Array
    pinion_speed: Array
    gear_speed: Array
    pitch_point_length: Any = 0.0
    pitch_point_rate: Any = 0.0


class TorqueRatio(NamedTuple):
    """What the pair does; arrays like the contact's, `efficiency` without the last axis.

    Attributes
    ----------
    efficiency : mean of Γ_2/Γ_1 over the pitch, divided by the gear ratio; where the gear drives of Γ_1/Γ_2
    torque_ratio : Γ_2/Γ_1, or Γ_1/Γ_2
    normal_load : N
    friction_coefficient : 1
    """

    efficiency: Any
    torque_ratio: Array
    normal_load: Array
    friction_coefficient: Array


def rotations(pinion_teeth: float, points: int = POINTS) -> tuple[Array, Array]:
    """Pinion angles over one pitch about the pitch point, rad, and quadrature weights that sum to 1."""
    half = math.pi / pinion_teeth
    place, weight = from_pitch_point(half, points)
    return np.concatenate([-place[::-1], place]), np.concatenate([weight[::-1], weight]) / (2.0 * half)


def involute_contact(
    pinion_teeth: float,
    pinion_radius: Any,
    ratio: Any,
    pressure_angle: float,
    rotation: tuple[Array, Array] | None = None,
) -> UnitContact:
    """An involute pair: A = r_b, T = r sin α ± ψ r_b1 (Veciana (51), (52), (57)).

    Parameters
    ----------
    pinion_teeth : z1
    pinion_radius : working pitch radius, m
    ratio : i = d_2/d_1
    pressure_angle : working, rad
    rotation : (ψ, weights), optional
        Default: `rotations`.
    """
    psi, weight = rotation or rotations(pinion_teeth)
    base = pinion_radius * math.cos(pressure_angle) + np.zeros_like(psi)
    pinion = pinion_radius * math.sin(pressure_angle) + psi * base
    gear = ratio * pinion_radius * math.sin(pressure_angle) - psi * base
    return UnitContact(
        rotation=psi,
        weight=weight,
        pinion_normal_arm=base,
        gear_normal_arm=ratio * base,
        pinion_friction_arm=pinion,
        gear_friction_arm=gear,
        curvature=1.0 / pinion + 1.0 / gear,
        pinion_speed=pinion,
        gear_speed=gear / ratio,
    )


def cycloid_contact(
    pinion_teeth: float,
    pinion_radius: float,
    ratio: float,
    approach_circle: Any,
    recess_circle: Any,
    rotation: tuple[Array, Array] | None = None,
    exact_speeds: bool = False,
) -> UnitContact:
    """A cycloidal pair: a = |ψ|/(2c), A = r cos a, T = r sin a ± d_g sin a (Veciana (24)-(40), (A9)-(A13)).

    Parameters
    ----------
    pinion_teeth, pinion_radius, ratio, rotation
        As in `involute_contact`.
    approach_circle, recess_circle : scalar or array (…)
        c_h = d_g1/d_1 and c_e = d_g2/d_1 of the generating circles.
    exact_speeds : bool
        The rolling speeds contain the motion of the contact along the path, r κ. Veciana (43)-(50) leave it
        out and take angular speed times lever arm; sliding is the same either way.
    """
    psi, weight = rotation or rotations(pinion_teeth)
    circles = np.asarray(approach_circle, dtype=float), np.asarray(recess_circle, dtype=float)
    share = np.where(psi < 0, circles[0][..., None], circles[1][..., None])
    angle = np.abs(psi) / (2.0 * share)
    generating = 2.0 * pinion_radius * share
    distance = np.sign(psi) * generating * np.sin(angle)
    pinion, gear = 2.0 * pinion_radius, 2.0 * pinion_radius * ratio
    inner = np.where(psi < 0, pinion, gear)  # the flank inside its pitch circle: a hypocycloid
    outer = np.where(psi < 0, gear, pinion)
    radius = 2.0 * np.sin(angle) * (outer + generating) * (inner - generating) / (pinion + gear)
    pinion_arm = pinion_radius * np.sin(angle) + distance
    gear_arm = ratio * pinion_radius * np.sin(angle) - distance
    along_path = np.abs(distance) / (2.0 * share) if exact_speeds else 0.0
    return UnitContact(
        rotation=psi,
        weight=weight,
        pinion_normal_arm=pinion_radius * np.cos(angle),
        gear_normal_arm=ratio * pinion_radius * np.cos(angle),
        pinion_friction_arm=pinion_arm,
        gear_friction_arm=gear_arm,
        curvature=1.0 / radius,
        pinion_speed=pinion_arm + along_path,
        gear_speed=gear_arm / ratio + along_path,
    )


def path_contact(
    path: Path,
    pinion_teeth: float,
    rotation: tuple[Array, Array] | None = None,
    exact_speeds: bool = True,
    averaged: bool = True,
) -> UnitContact:
    """A pair on any path of contact.

    Parameters
    ----------
    path : Path
    pinion_teeth, rotation, exact_speeds
        As in `cycloid_contact`.
    averaged : bool
        Average radius and entrainment over the contact's width where they vanish at the pitch point.
    """
    psi, weight = rotation or rotations(pinion_teeth)
    motion = kinematics(path, path.signed_distance(psi))
    ratio = path.pinion_pitch_radius / path.gear_pitch_radius
    vanishing = pitch_point(path)
    return UnitContact(
        rotation=psi,
        weight=weight,
        pinion_normal_arm=motion.pinion_normal_arm,
        gear_normal_arm=motion.gear_normal_arm,
        pinion_friction_arm=motion.pinion_friction_arm,
        gear_friction_arm=motion.gear_friction_arm,
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

    Parameters
    ----------
    pair : UnitContact
    input_torque, pinion_speed, face_width : float
        Γ_1 (of the gear, where that drives: Γ_2) N m, ω_1 rad/s, b m.
    closure : Closure
    gear_drives : bool

    Raises
    ------
    SimulationError
        If load and friction find no common value: a law whose coefficient grows without bound.
    """
    pinion = pair.pinion_normal_arm, pair.pinion_friction_arm
    gear = pair.gear_normal_arm, pair.gear_friction_arm
    (arm, lever), (arm_out, lever_out) = (gear, pinion) if gear_drives else (pinion, gear)
    way = -1.0 if gear_drives else 1.0
    side, speed = way * np.sign(pair.rotation), way * pinion_speed
    mu, load, change = np.zeros_like(arm), input_torque / arm, np.inf
    for _ in range(STEPS):
        load = input_torque / (arm + side * mu * lever)
        new_mu = contact_friction(
            closure,
            load / face_width,
            1.0 / pair.curvature,
            speed * pair.pinion_speed,
            speed * pair.gear_speed,
            pair.pitch_point_length,
            speed * pair.pitch_point_rate,
        ).surface.friction_coefficient
        if any(np.any(one + side * new_mu * other <= 0.0) for one, other in (pinion, gear)):
            worst = float(np.max(new_mu))
            raise SimulationError(
                f"friction locks the pair: a coefficient of {worst:.3g} turns the load's arm over"
            )
        change, mu = np.max(np.abs(new_mu - mu)), new_mu
        if change < TOLERANCE:
            break
    else:
        raise SimulationError(f"load and friction coefficient do not settle: still moving by {change:.1e}")
    ratio = (arm_out + side * mu * lever_out) / (arm + side * mu * lever)
    return TorqueRatio(np.sum(pair.weight * ratio * arm / arm_out, axis=-1), ratio, load, mu)
