"""Loads, slip, losses and efficiency of the gear with intermediate rolling elements.

Two modes. ``corrected`` resolves the motion in time: the elements pass through the loaded half one after
the other, sliding and rolling follow from the speeds relative to the eccentric, and the efficiency is one of
energy. ``as_published`` is the paper's single position with its printed formulas, to compare with its table:

- the slip speed (14) and the spin (17) multiply the cam's absolute speed 2 ω1/(Z2 − 1) by a ratio that holds
  relative to the eccentric, where the cam turns with ω1 (Z2 + 1)/(Z2 − 1): both come out too small by
  (Z2 + 1)/2;
- the slip speed enters the loss (20) with its sign, so that sliding makes the loss smaller;
- the efficiency (23) is a product over elements that share one input, where their losses add.

Source: E. A. Efremenkov et al., Mathematics 12:873 (2024). The paper prints no equation for the loads; those
here reproduce its table. Shapes: time first, element last. SI units.
"""

from typing import Literal, NamedTuple

import numpy as np

from tribodyn.studies.irefc.geometry import (
    Array,
    RollingDrive,
    lever_arm,
    normal_direction,
    pitch_point_distance,
)

#: Lever arm over pitch radius up to which an element stands at a dead point and carries nothing.
DEAD_POINT = 1e-12

Mode = Literal["as_published", "corrected"]


class RollingFriction(NamedTuple):
    """Friction of the contacts."""

    rolling_arm: float  # μ, lever arm of rolling resistance, m
    sliding_coefficient: float  # f_s of the slip between element and cam


class ElementStates(NamedTuple):
    """Every element at every instant; arrays (time, element), or (time,) where stated."""

    element_angle: Array  # φ, 0 … 2π, rad
    #: cam_distance, crown_distance: L_A and L_B, distances of the contacts from the pitch point, m
    cam_distance: Array
    crown_distance: Array
    normal_load: Array  # R, N; zero where the element carries nothing
    slip_speed: Array  # of the element's surface over the cam's, m/s; positive counter-clockwise about P
    spin_speed: Array  # ω_b, rotation of the element in the cage, rad/s
    #: power_cam, power_crown: losses at the cam (rolling and sliding) and at the crown (rolling), W
    power_cam: Array
    power_crown: Array
    #: power_in, power_out: of shaft and cam, (time,), W
    power_in: Array
    power_out: Array
    efficiency: Array  # (time,)

    @property
    def power_friction(self) -> Array:
        """Sum of all losses, (time,), W."""
        return np.sum(self.power_cam + self.power_crown, axis=-1)


def element_speed(drive: RollingDrive, input_speed: float) -> float:
    """Speed of the elements about the cage's centre as seen from the eccentric, rad/s: −ω1 (Z2 + 1)/Z2."""
    return -input_speed * (drive.elements + 1) / drive.elements


def pattern_period(drive: RollingDrive, input_speed: float) -> float:
    """Time in which each element takes its neighbour's place, s; Z2 + 1 of them make an input revolution."""
    return 2.0 * np.pi / ((drive.elements + 1) * input_speed)


def element_angles(drive: RollingDrive, input_angle: Array) -> Array:
    """Angles φ (time, element) at rotations (time,) of the input; the first element starts at φ = 0."""
    start = drive.element_pitch * np.arange(drive.elements)
    moved = input_angle[:, None] * element_speed(drive, 1.0)
    return np.mod(start + moved, 2.0 * np.pi)


def published_angles(drive: RollingDrive) -> Array:
    """Angles (1, element) of the paper's table: the loaded half with both ends, from the depression."""
    return drive.element_pitch * np.arange(drive.elements // 2 + 1)[None, :]


def normal_loads(drive: RollingDrive, angle: Array, input_torque: float) -> Array:
    """Loads R (time, element), N, of elements of one stiffness that balance the input torque.

    An element's approach under a small rotation of the cam is in proportion to its lever arm, and so is its
    load (Hooke); only elements with 0 < φ < π are pressed. The sum of R a is M_in Z2/2 at every instant.
    """
    arm = lever_arm(drive, angle)
    # at a dead point rounding leaves an arm of 1e-16
    arm = np.where(arm > DEAD_POINT * drive.pitch_radius, arm, 0.0)
    return 0.5 * input_torque * drive.elements * arm / np.sum(arm**2, axis=-1, keepdims=True)


def slip_speed(drive: RollingDrive, angle: Array, input_speed: float, mode: Mode) -> Array:
    """Slip between element and cam, m/s, where the element rolls on the crown without slip: (14)."""
    distance = pitch_point_distance(drive, angle)
    count = drive.elements
    by_cam = (distance - drive.element_radius) / (count - 1)
    by_crown = (distance + drive.element_radius) / (count + 1)
    return 2.0 * input_speed / count * _relative(drive, mode) * (by_cam - by_crown)


def spin_speed(drive: RollingDrive, angle: Array, input_speed: float, mode: Mode) -> Array:
    """Rotation ω_b of an element in the cage, rad/s: (17)."""
    count = drive.elements
    distance = pitch_point_distance(drive, angle) + drive.element_radius
    printed = 2.0 * input_speed * distance / (drive.element_radius * count * (count + 1))
    return printed * _relative(drive, mode)


def _relative(drive: RollingDrive, mode: Mode) -> float:
    """The cam's speed relative to the eccentric over its absolute speed: what the printed speeds lack."""
    return (drive.elements + 1) / 2.0 if mode == "corrected" else 1.0


def engage(
    drive: RollingDrive,
    angle: Array,
    input_power: float,
    input_speed: float,
    friction: RollingFriction,
    mode: Mode = "corrected",
) -> ElementStates:
    """Resolve loads, speeds and losses at input power (W) and speed (rad/s) of the shaft.

    Angles (time, element) are those of `element_angles`, or `published_angles` for the paper's table.
    """
    load = normal_loads(drive, angle, input_power / input_speed)
    slip = slip_speed(drive, angle, input_speed, mode)
    spin = spin_speed(drive, angle, input_speed, mode)
    sliding = np.abs(slip) if mode == "corrected" else slip  # the sign is the paper's slip
    rolling = load * friction.rolling_arm * spin
    cam = rolling + load * friction.sliding_coefficient * sliding
    lost = cam + rolling
    normal = normal_direction(drive, angle)
    # the shaft presses the cam at its centre, on the eccentric; every normal passes through P, which lies on
    # the x axis at the cam's pitch radius from its centre
    shaft_torque = drive.eccentricity * np.sum(load[..., None] * normal, axis=-2)[..., 1]
    cam_torque = np.sum(load * drive.cam_pitch_radius * normal[..., 1], axis=-1)
    power_in = input_speed * shaft_torque
    power_out = input_speed / drive.ratio * cam_torque - lost.sum(axis=-1)
    by_energy = power_out / power_in
    distance = pitch_point_distance(drive, angle)
    return ElementStates(
        element_angle=angle,
        cam_distance=distance - drive.element_radius,
        crown_distance=distance + drive.element_radius,
        normal_load=load,
        slip_speed=slip,
        spin_speed=spin,
        power_cam=cam,
        power_crown=rolling,
        power_in=power_in,
        power_out=power_out,
        efficiency=by_energy if mode == "corrected" else np.prod(1.0 - lost / input_power, axis=-1),
    )
