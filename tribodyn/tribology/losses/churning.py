"""Churning: gears that dip into the oil; torques at the gear's own shaft by its speed, rad/s, at least 0."""

import math
from collections.abc import Callable

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.loss import RPM, OilState, Sump, Torque, Wheel

GRAVITY = 9.80665
#: Reynolds numbers between which Changenet & Velex pass from one regime to the other.
LOW, HIGH = 6000.0, 9000.0


def changenet_velex(wheel: Wheel, speed: Float[Array, "..."], oil: OilState, sump: Sump) -> Torque:
    """Churning by Changenet & Velex.

    T = ½ ρ ω² S_m R³ C_m with the wetted surface S_m of the rim, the sides and the teeth, whose flanks are
    b/cos β long and their depth over cos α high, h the depth below the pitch circle's lowest point and
    D = 2 R, Fr = ω² R/g, Re = ω R b/ν:
    Re < 6000: C_m = 1.366 (h/D)^0.45 (V_0/D³)^0.1 Fr^−0.6 Re^−0.21;
    Re > 9000: C_m = 3.644 (h/D)^0.1 (V_0/D³)^−0.35 Fr^−0.88 (b/D)^0.85; between, linear in Re.

    C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128; from memory of the paper, not checked against it.
    A single gear, immersed at most to its axis.
    """
    radius, width = wheel.pitch_radius, wheel.face_width
    diameter = 2.0 * radius
    speed = np.asarray(speed, dtype=float)
    depth = wheel.immersion - (wheel.tip_radius - radius)
    if depth <= 0.0:
        return Torque(np.zeros(np.broadcast_shapes(speed.shape, np.shape(oil.viscosity))))
    half_angle = math.acos(max(1.0 - depth / radius, -1.0))
    height = wheel.tip_radius - wheel.root_radius
    flank = height * width / (math.cos(wheel.pressure_angle) * math.cos(wheel.helix_angle))
    surface = (
        radius**2 * (2.0 * half_angle - math.sin(2.0 * half_angle))
        + diameter * width * half_angle
        + 2.0 * wheel.teeth * flank * half_angle / math.pi
    )
    turning = np.where(speed > 0.0, speed, 1.0)
    froude = turning**2 * radius / GRAVITY
    reynolds = turning * radius * width * oil.density / oil.viscosity
    slow = 1.366 * (depth / diameter) ** 0.45 * (sump.volume / diameter**3) ** 0.1 * froude**-0.6
    slow = slow * np.minimum(reynolds, HIGH) ** -0.21
    fast = 3.644 * (depth / diameter) ** 0.1 * (sump.volume / diameter**3) ** -0.35 * froude**-0.88
    fast = fast * (width / diameter) ** 0.85
    share = np.clip((reynolds - LOW) / (HIGH - LOW), 0.0, 1.0)
    moment = (1.0 - share) * slow + share * fast
    torque = 0.5 * oil.density * speed**2 * surface * radius**3 * moment
    return Torque(torque, ("immersed at most to the axis",) if depth > radius else ())


#: What ISO/TR 14179-1 takes for smaller helix angles, rad.
_LEAST_HELIX = math.radians(10.0)


def iso_14179_1(wheel: Wheel, speed: Float[Array, "..."], oil: OilState, sump: Sump) -> Torque:
    """Churning of teeth and sides by ISO/TR 14179-1:2001 (AGMA's method).

    P = 7.37 f_g ν n³ D^4.7 b R_f/(√tan β A_g 10²⁶) of the teeth and 1.474 f_g ν n³ D^5.7/(A_g 10²⁶) of both
    sides, kW, with ν in mm²/s, n in rpm, D the tip diameter and b in mm, R_f = 7.93 − 4.648/m_t, A_g = 0.2,
    f_g from 0 (not immersed) to 1 (immersed wholly), and β at least 10°. From memory of the report.
    """
    diameter, width = 2e3 * wheel.tip_radius, 1e3 * wheel.face_width
    dip = min(wheel.immersion / (2.0 * wheel.tip_radius), 1.0)
    speed = np.asarray(speed, dtype=float)
    common = dip * oil.kinematic * (speed / RPM) ** 2 / (0.2 * 1e26)
    roughness = 7.93 - 4.648 / (1e3 * wheel.module)
    teeth = 7.37 * diameter**4.7 * width * roughness
    teeth /= math.sqrt(math.tan(max(wheel.helix_angle, _LEAST_HELIX)))
    return Torque(
        1e3 / RPM * common * (max(teeth, 0.0) + 1.474 * diameter**5.7),
        ("module ≥ 1 mm",) if wheel.module < 1e-3 else (),
    )


#: Methods by the names that a scenario has.
CHURNING: dict[str, Callable[[Wheel, Float[Array, "..."], OilState, Sump], Torque]] = {
    "changenet-velex": changenet_velex,
    "iso-14179-1": iso_14179_1,
}
