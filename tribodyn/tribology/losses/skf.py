"""Friction of rolling bearings by SKF's model: M = M_rr + M_sl + M_seal + M_drag."""

import math

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.bearings import DOUBLE, BearingInOil, BearingTorque
from tribodyn.tribology.losses.loss import RPM, OilState
from tribodyn.tribology.losses.palmgren import without_rating
from tribodyn.tribology.losses.skf_constants import CONSTANTS, SEALS, SHAPES

#: K_rs of a low oil bath and of an oil jet.
REPLENISHMENT = 3e-8
#: μ_bl, and μ_EHL: of mineral and of synthetic oils; of cylindrical and tapered rollers in any.
BOUNDARY_FRICTION, FILM_FRICTION, SYNTHETIC_FRICTION = 0.12, 0.05, 0.04
_ROLLER_FRICTION = {"cylindrical-roller": 0.02, "tapered-roller": 0.002}

Pair = tuple[Float[Array, "..."], Float[Array, "..."]]


def skf(
    bearing: BearingInOil,
    speed: Float[Array, "..."],
    oil: OilState,
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
) -> BearingTorque:
    """M_rr + M_sl under load, M_drag + M_seal without (SKF, Rolling bearings, 10000 EN, "Friction").

    M_rr = φ_ish φ_rs G_rr (ν n)^0.6 with φ_ish = 1/[1 + 1.84e-9 (n d_m)^1.28 ν^0.64] and
    φ_rs = exp{−K_rs ν n (d + D) √[K_Z/(2 (D − d))]}; M_sl = μ_sl G_sl with
    μ_sl = φ_bl μ_bl + (1 − φ_bl) μ_EHL, φ_bl = exp[−2.6e-8 (n ν)^1.4 d_m]; N mm with mm, mm²/s, rpm and N.
    μ_bl is 0.12 at every speed; the catalogue starts from rest with 0.15. Rows of a pair are evaluated one by
    one: half the radial force each, the axial force on one of them, or on both of a tandem. For normal
    operation: the minimum load is reached, no misalignment, clearance as usual.
    """
    rows = 1 if bearing.type in DOUBLE else bearing.rows
    radial = np.asarray(radial, dtype=float) / rows
    axial = np.asarray(axial, dtype=float)
    shares = [axial / rows] * rows if not bearing.both_ways else [axial, *[0.0 * axial] * (rows - 1)]
    loaded = sum(_under_load(bearing, speed, oil, radial, share) for share in shares)
    idle = rows * bath_moment(bearing, speed, oil) + seal_moment(bearing)
    exceeded = without_rating(bearing, radial, axial) if bearing.type == "deep-groove-ball" else ()
    return BearingTorque(bearing.count * idle, bearing.count * loaded, exceeded)


def _under_load(
    bearing: BearingInOil,
    speed: Float[Array, "..."],
    oil: OilState,
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
) -> Float[Array, "..."]:
    """M_rr + M_sl of one row, N m."""
    turns, viscosity = np.asarray(speed, dtype=float) / RPM, oil.kinematic
    bore, outside = 1e3 * (bearing.bore or 0.0), 1e3 * (bearing.outside_diameter or 0.0)
    size = 0.5 * (bore + outside)
    rolling, sliding = variables(bearing, size, turns, radial, axial)
    heated = 1.0 / (1.0 + 1.84e-9 * (turns * size) ** 1.28 * viscosity**0.64)
    shape = math.sqrt(SHAPES[bearing.type][0] / (2.0 * (outside - bore)))
    starved = np.exp(-REPLENISHMENT * viscosity * turns * (bore + outside) * shape)
    boundary = np.exp(-2.6e-8 * (turns * viscosity) ** 1.4 * size)
    film = SYNTHETIC_FRICTION if oil.synthetic else FILM_FRICTION
    film = _ROLLER_FRICTION.get(bearing.type, film)
    friction = boundary * BOUNDARY_FRICTION + (1.0 - boundary) * film
    return 1e-3 * (heated * starved * rolling * (viscosity * turns) ** 0.6 + friction * sliding)


def variables(
    bearing: BearingInOil,
    size: float,
    turns: Float[Array, "..."],
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
) -> Pair:
    """G_rr and G_sl of a row with d_m in mm, n in rpm, forces in N: the catalogue's table 2."""
    known = CONSTANTS[bearing.type]
    c = known[bearing.series] if bearing.series else next(iter(known.values()))
    match bearing.type:
        case "deep-groove-ball":
            return _deep_groove(c, size, radial, axial, bearing.static_rating)
        case "self-aligning-ball":
            inertia = size**3.5 * turns**2
            rolling = c[0] * size**2.0 * (radial + c[2] * inertia + c[1] * axial) ** 0.54
            forces = (radial + c[5] * inertia) ** (4.0 / 3.0) + c[4] * axial ** (4.0 / 3.0)
            return rolling, c[3] * size**-0.12 * forces
        case "angular-contact-ball" | "four-point-contact-ball":
            inertia = size**4.0 * turns**2
            rolling = c[0] * size**1.97 * (radial + c[2] * inertia + c[1] * axial) ** 0.54
            forces = (radial + c[5] * inertia) ** (4.0 / 3.0) + c[4] * axial ** (4.0 / 3.0)
            return rolling, c[3] * size**0.26 * forces
        case "cylindrical-roller":
            rolling = c[0] * size**2.41 * radial**0.31
            return rolling, c[1] * size**0.9 * axial + c[2] * size * radial
        case "tapered-roller":
            thrust = 0.4 / math.tan(bearing.contact_angle) * axial
            rolling = c[0] * size**2.38 * (radial + c[1] * thrust) ** 0.31
            return rolling, c[2] * size**0.82 * (radial + c[3] * thrust)
        case "spherical-roller":
            light = c[0] * size**1.85 * (radial + c[1] * axial) ** 0.54
            heavy = c[2] * size**2.3 * (radial + c[3] * axial) ** 0.31
            slow = c[4] * size**0.25 * (radial**4 + c[5] * axial**4) ** (1.0 / 3.0)
            fast = c[6] * size**0.94 * (radial**3 + c[7] * axial**3) ** (1.0 / 3.0)
            return np.minimum(light, heavy), np.minimum(slow, fast)
        case _:  # toroidal rollers carry no axial load
            rolling = np.minimum(c[0] * size**1.97 * radial**0.54, c[1] * size**2.37 * radial**0.31)
            sliding = np.minimum(c[2] * size**-0.19 * radial ** (5.0 / 3.0), c[3] * size**1.05 * radial)
            return rolling, sliding


def _deep_groove(
    c: tuple[float, ...],
    size: float,
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
    rating: float | None,
) -> Pair:
    """α_F = 24.6 (F_a/C_0)^0.24 degrees under load; without C_0 the axial force does not count."""
    pushed = np.asarray(axial > 1e-6 * radial) & (rating is not None)
    share = np.where(pushed, axial, 1.0) / (rating or 1.0)
    sine = np.sin(np.radians(24.6 * share**0.24))
    radially = c[0] * size**1.96 * radial**0.54
    rolling = np.where(pushed, c[0] * size**1.96 * (radial + c[1] / sine * axial) ** 0.54, radially)
    both = (radial**5 + c[3] * size**1.5 / sine * axial**4) ** (1.0 / 3.0)
    sliding = np.where(pushed, c[2] * size**-0.145 * both, c[2] * size**-0.26 * radial ** (5.0 / 3.0))
    return rolling, sliding


def bath_moment(bearing: BearingInOil, speed: Float[Array, "..."], oil: OilState) -> Float[Array, "..."]:
    """M_drag of a row in an oil bath, N m; 0 without an oil level.

    0.4 V_M K_ball d_m⁵ n² of balls or 4 V_M K_roll C_w B d_m⁴ n² of rollers, and
    1.093e-7 n² d_m³ (n d_m² f_t/ν)^−1.379 R_s; V_M of the catalogue's diagram by H/d_m is `bath_factor`.
    """
    turns, viscosity = np.asarray(speed, dtype=float) / RPM, oil.kinematic
    level = 1e3 * bearing.oil_level
    bore, outside, width = (
        1e3 * (size or 0.0) for size in (bearing.bore, bearing.outside_diameter, bearing.width)
    )
    if level <= 0.0:
        return 0.0 * turns * viscosity
    size, slim = 0.5 * (bore + outside), (outside + bore) / (outside - bore)
    filling, length = SHAPES[bearing.type]
    angle = 2.0 * math.acos((0.6 * size - min(level, size)) / (0.6 * size))
    turned = math.sin(0.5 * angle) if angle <= math.pi else 1.0
    wetted = 0.36 * size**2 * (angle - math.sin(angle)) * 0.05 * filling * slim
    if length == 0.0:
        rows = 2.0 if bearing.type in DOUBLE else 1.0
        pushed = 0.4 * bearing.bath_factor * rows * filling * slim * 1e-12 * size**5 * turns**2
    else:
        slender = 5.0 * length * width / size
        resistance = 2.789e-10 * slender**3 - 2.786e-4 * slender**2 + 0.0195 * slender + 0.6439
        pushed = 4.0 * bearing.bath_factor * length * filling * slim * 1e-12
        pushed = pushed * resistance * width * size**4 * turns**2
    sheared = 1.093e-7 * turns**0.621 * size**3 * (size**2 * turned / viscosity) ** -1.379 * wetted
    return 1e-3 * (pushed + sheared)


def seal_moment(bearing: BearingInOil) -> float:
    """M_seal = K_S1 d_s^β + K_S2 of contact seals on both sides, N m; 0 without."""
    if not bearing.seal:
        return 0.0
    outside = 1e3 * (bearing.outside_diameter or 0.0)
    fitting = [row for row in SEALS[bearing.seal] if outside <= row[0]] or [SEALS[bearing.seal][-1]]
    _, exponent, lip, constant = fitting[0]
    return 1e-3 * (lip * (1e3 * bearing.seal_diameter) ** exponent + constant)
