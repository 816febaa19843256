"""Losses that do not depend on the load: churning, windage, bearings, one published formula a function."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple


class Wheel(NamedTuple):
    """A gear; SI."""

    speed: float  # rad/s, > 0
    #: pitch_radius, tip_radius, root_radius: m
    pitch_radius: float
    tip_radius: float
    root_radius: float
    face_width: float  # m
    module: float  # transverse, m
    teeth: float
    #: depth of the tip circle's lowest point below the oil's level at rest, m; 0: not immersed
    immersion: float = 0.0
    helix_angle: float = 0.0  # β on the reference circle, rad, ≥ 0


class Loss(NamedTuple):
    """Power of a loss, W, and in words which limits of the formula's range are exceeded."""

    power: float
    exceeded: tuple[str, ...] = ()


GRAVITY = 9.80665
#: Reynolds numbers between which Changenet & Velex pass from one regime to the other.
LOW, HIGH = 6000.0, 9000.0


def changenet_velex(wheel: Wheel, viscosity: float, density: float, oil_volume: float) -> Loss:
    """Churning loss by Changenet & Velex.

    P = ½ ρ ω³ S_m R³ C_m with the wetted surface S_m of flanks (b/cos β long), sides and teeth, h the depth
    below the pitch circle's lowest point and D = 2 R, Fr = ω² R/g, Re = ω R b/ν:
    Re < 6000: C_m = 1.366 (h/D)^0.45 (V_0/D³)^0.1 Fr^−0.6 Re^−0.21;
    Re > 9000: C_m = 3.644 (h/D)^0.1 (V_0/D³)^−0.35 Fr^−0.88 (b/D)^0.85; between, linear in Re.

    C. Changenet, P. Velex, J. Mech. Des. 129 (2007) 128; from memory of the paper, not checked against it.
    A single gear, immersed at most to its axis. Viscosity (dynamic, Pa·s) and density (kg/m³) are those
    of the oil in the sump, `oil_volume` V_0, m³.
    """
    radius, width = wheel.pitch_radius, wheel.face_width
    diameter = 2.0 * radius
    depth = wheel.immersion - (wheel.tip_radius - radius)
    if depth <= 0.0:
        return Loss(0.0)
    half_angle = math.acos(max(1.0 - depth / radius, -1.0))
    height = wheel.tip_radius - wheel.root_radius
    surface = (
        radius**2 * (2.0 * half_angle - math.sin(2.0 * half_angle))
        + diameter * width * half_angle
        + 2.0 * wheel.teeth * height * width / math.cos(wheel.helix_angle) * half_angle / math.pi
    )
    froude = wheel.speed**2 * radius / GRAVITY
    reynolds = wheel.speed * radius * width * density / viscosity
    slow = 1.366 * (depth / diameter) ** 0.45 * (oil_volume / diameter**3) ** 0.1 * froude**-0.6
    slow *= min(reynolds, HIGH) ** -0.21
    fast = 3.644 * (depth / diameter) ** 0.1 * (oil_volume / diameter**3) ** -0.35 * froude**-0.88
    fast *= (width / diameter) ** 0.85
    share = min(max((reynolds - LOW) / (HIGH - LOW), 0.0), 1.0)
    moment = (1.0 - share) * slow + share * fast
    power = 0.5 * density * wheel.speed**3 * surface * radius**3 * moment
    return Loss(power, ("immersed at most to the axis",) if depth > radius else ())


#: What ISO/TR 14179-1 takes for smaller helix angles, rad.
_LEAST_HELIX = math.radians(10.0)


def iso_14179_1(wheel: Wheel, viscosity: float, density: float) -> Loss:
    """Churning loss of teeth and sides by ISO/TR 14179-1:2001 (AGMA's method).

    P = 7.37 f_g ν n³ D^4.7 b R_f/(√tan β A_g 10²⁶) of the teeth and 1.474 f_g ν n³ D^5.7/(A_g 10²⁶) of both
    sides, kW, with ν in mm²/s, n in rpm, D the tip diameter and b in mm, R_f = 7.93 − 4.648/m_t, A_g = 0.2,
    f_g from 0 (not immersed) to 1 (immersed wholly), and β at least 10°. From memory of the report. Viscosity
    (dynamic, Pa·s) and density (kg/m³) are those of the oil in the sump.
    """
    diameter, width = 2e3 * wheel.tip_radius, 1e3 * wheel.face_width
    dip = min(wheel.immersion / (2.0 * wheel.tip_radius), 1.0)
    common = dip * 1e6 * viscosity / density * (wheel.speed * 30.0 / math.pi) ** 3 / (0.2 * 1e26)
    roughness = 7.93 - 4.648 / (1e3 * wheel.module)
    teeth = 7.37 * diameter**4.7 * width * roughness
    teeth /= math.sqrt(math.tan(max(wheel.helix_angle, _LEAST_HELIX)))
    return Loss(
        1e3 * common * (max(teeth, 0.0) + 1.474 * diameter**5.7),
        ("module ≥ 1 mm",) if wheel.module < 1e-3 else (),
    )


#: Air at 60 °C: density, kg/m³, and viscosity, mPa·s.
AIR_DENSITY, AIR_VISCOSITY = 1.06, 0.020


def dawson(wheel: Wheel) -> Loss:
    """Windage loss in free air by Dawson.

    P = n^2.9 (0.16 D^3.9 + D^2.9 b^0.75 m^1.15) 10^−20 kW with n in rpm, root diameter D, b and m in mm.

    P. H. Dawson, Proc. IMechE A 198 (1984) 51; from memory of the paper. Gears of 300 to 1160 mm.
    """
    diameter = 2e3 * wheel.root_radius
    speed = wheel.speed * 30.0 / math.pi
    sides = 0.16 * diameter**3.9
    teeth = diameter**2.9 * (1e3 * wheel.face_width) ** 0.75 * (1e3 * wheel.module) ** 1.15
    outside = () if 300.0 <= diameter <= 1160.0 else ("root diameter 300 to 1160 mm",)
    return Loss(1e3 * 1e-20 * speed**2.9 * (sides + teeth), outside)


def anderson_loewenthal(wheel: Wheel) -> Loss:
    """Windage loss in air by Anderson & Loewenthal.

    P = 2.82e-7 (1 + 2.3 b/R) ρ^0.8 n^2.8 R^4.6 μ^0.2 kW with n in rpm, pitch radius R in m, ρ in kg/m³ and μ
    in mPa·s; of air alone, without the oil that they mix into it.

    N. E. Anderson, S. H. Loewenthal, NASA TP 1622 (1980); from memory of the report. Spur gears with solid
    bodies.
    """
    speed = wheel.speed * 30.0 / math.pi
    shape = (1.0 + 2.3 * wheel.face_width / wheel.pitch_radius) * wheel.pitch_radius**4.6
    return Loss(1e3 * 2.82e-7 * shape * AIR_DENSITY**0.8 * speed**2.8 * AIR_VISCOSITY**0.2)


#: f_0 in an oil bath by type: Harris, Rolling Bearing Analysis, 4th edition, chapter 14 (from memory).
DRAG_FACTORS = {
    "deep-groove-ball": 2.0,
    "angular-contact-ball": 3.3,
    "cylindrical-roller": 3.0,
    "tapered-roller": 6.0,
    "needle-roller": 12.0,
    "self-aligning-ball": 1.75,
    "spherical-roller": 5.0,
    "four-point-contact-ball": 6.5,  # as two rows of angular contact
}
#: ν n, mm²/s times rpm, below which the moment no longer depends on it.
SLOW = 2000.0


@dataclass(frozen=True)
class BearingDragData:
    """Bearings of a shaft, alike: mean diameter d_m = (bore + outside)/2 (m), factor f_0, number."""

    mean_diameter: float
    drag_factor: float
    count: int


def palmgren(bearings: BearingDragData, speed: float, viscosity: float, density: float) -> Loss:
    """Loss of the load-independent moment by Palmgren, as Harris gives it, at a shaft's speed (rad/s, > 0).

    M_0 = 10^−7 f_0 (ν n)^⅔ d_m³ N mm for ν n ≥ 2000, else 160 · 10^−7 f_0 d_m³, with ν in mm²/s, n in rpm and
    d_m in mm; viscosity (dynamic, Pa·s) and density (kg/m³) are the oil's.
    """
    flow = 1e6 * viscosity / density * speed * 30.0 / math.pi
    size = bearings.drag_factor * (1e3 * bearings.mean_diameter) ** 3
    moment = 1e-7 * size * flow ** (2.0 / 3.0) if flow >= SLOW else 160e-7 * size
    return Loss(bearings.count * 1e-3 * moment * speed)


@dataclass(frozen=True)
class LossData:
    """Which load-independent losses a case requests; None: not requested."""

    churning: str | None = None  # "changenet-velex" or "iso-14179-1"
    windage: str | None = None  # "dawson" or "anderson-loewenthal"
    bearings: str | None = None  # "palmgren"
    #: pinion_immersion, gear_immersion: depth of each tip circle's lowest point below the oil's level, m
    pinion_immersion: float = 0.0
    gear_immersion: float = 0.0
    oil_volume: float | None = None  # in the sump, m³
    #: (BearingDragData or None, the same), of the pinion's and the gear's shaft
    drag: tuple[BearingDragData | None, BearingDragData | None] = (None, None)
    #: of a mesh of several: which of both gears it counts, and bearings of shafts with their speeds, rad/s
    counted: tuple[bool, bool] = (True, True)
    further: tuple[tuple[BearingDragData, float], ...] = ()


def losses_of_pair(
    data: LossData, wheels: tuple[Wheel, Wheel], viscosity: float, density: float
) -> dict[str, Loss]:
    """Return the requested losses of pinion and gear by name: `churning`, `windage`, `bearings`.

    Viscosity (dynamic, Pa·s) and density (kg/m³) are those of the oil that surrounds the gears.
    """
    losses: dict[str, Loss] = {}
    dipping = [wheel for wheel in wheels if wheel.immersion > 0.0]
    if data.churning == "changenet-velex":
        volume = data.oil_volume or 0.0
        losses["churning"] = _sum(changenet_velex(wheel, viscosity, density, volume) for wheel in dipping)
    elif data.churning is not None:
        losses["churning"] = _sum(iso_14179_1(wheel, viscosity, density) for wheel in dipping)
    if data.windage is not None:
        windage = {"dawson": dawson, "anderson-loewenthal": anderson_loewenthal}[data.windage]
        counted = [wheel for wheel, is_counted in zip(wheels, data.counted, strict=True) if is_counted]
        losses["windage"] = _sum(map(windage, counted))
    if data.bearings is not None:
        turning = [(drag, wheel.speed) for wheel, drag in zip(wheels, data.drag, strict=True)]
        losses["bearings"] = _sum(
            palmgren(drag, speed, viscosity, density)
            for drag, speed in (*turning, *data.further)
            if drag is not None
        )
    return losses


def _sum(losses: Iterable[Loss]) -> Loss:
    parts = list(losses)
    exceeded = dict.fromkeys(limit for part in parts for limit in part.exceeded)
    return Loss(sum(part.power for part in parts), tuple(exceeded))
