"""A free-form path of contact: the pressure angle as a spline through a few values along the path.

α(r) is a cubic spline with continuous curvature over the signed distance r through the values at the knots,
one of which is the pitch point P. A corner, |r| times its slope, may be added; without it α is smooth at P.
Beyond the last knots the slope of α goes to zero within one more interval, and the path on straight, so
that every set of values is a path, whether or not teeth of it exist.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, lowest_contact_radius
from tribodyn.geometry.drive import SIDES, Drive, GearBody, Side, body_of, reference_radii, tip_radius
from tribodyn.geometry.families import Family, family
from tribodyn.geometry.families.points import PointsPath, spline_slopes, turned_from
from tribodyn.geometry.helix import pitch_slope
from tribodyn.geometry.limits.sizes import require_reach
from tribodyn.geometry.path import Path, distance_at_radius, seen_from
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.parameter import Parameter
from tribodyn.numerics.shapes import Array, Float

FEWEST, MOST = 4, 100
# Modules; as near to P as the knot that stands for it must be.
_AT_PITCH_POINT = 1e-9
_REACH = 50
_STEEPEST = np.radians(80.0)


class SplineShape(NamedTuple):
    """Values of the path."""

    angles: Any  # (n,), pressure angles at the knots, rad, from the approach's end to the recess's
    #: (n,), optional; signed distances of the knots, m, ascending, 0 among them; plain numbers
    knots: Any = None
    #: optional; in place of knots: the n knots divide half this length evenly on either side of P, n // 2
    #: intervals in approach and (n − 1) // 2 in recess, m
    path_length: Any = None
    #: by how much the corner at P raises α from P to half the path length on either side, rad
    corner: Any = 0.0


def even_places(count: int) -> Float[Array, " knot"]:
    """Places of the knots over half the path length, −1 … 1, 0 at `count` // 2."""
    before, after = count // 2, count - 1 - count // 2
    return np.concatenate([np.linspace(-1.0, 0.0, before + 1), np.linspace(0.0, 1.0, after + 1)[1:]])


def knots_of(shape: SplineShape) -> tuple[Any, Any, int]:
    """Signed distances of the knots (m), half the path length (m), and which knot is P."""
    if shape.knots is None:
        count = len(shape.angles)
        half = shape.path_length / 2
        return half * even_places(count), half, count // 2
    knots = np.asarray(shape.knots)
    return knots, (knots[-1] - knots[0]) / 2, int(np.argmin(np.abs(knots)))


def working_path(drive: Drive) -> PointsPath:
    """Path of the drive's values; defined for any finite values."""
    xp = namespace(drive)
    shape = drive.shape
    knots, half, at = knots_of(shape)
    angles = xp.asarray(shape.angles)
    knots = xp.asarray(knots) + 0.0 * angles
    corner = shape.corner / half
    side = np.where(np.arange(len(angles) - 1) < at, -1.0, 1.0)
    slopes = spline_slopes(knots, angles - corner * xp.abs(knots))
    left, right = slopes[:-1] + corner * side, slopes[1:] + corner * side
    first, last = knots[1] - knots[0], knots[-1] - knots[-2]
    still = 0.0 * knots[:1]
    path = PointsPath(
        *reference_radii(drive),
        xp.concatenate([knots[:1] - first, knots, knots[-1:] + last]),
        xp.concatenate([angles[:1] - left[:1] * first / 2, angles, angles[-1:] + right[-1:] * last / 2]),
        xp.concatenate([still, left, right[-1:]]),
        xp.concatenate([left[:1], right, still]),
        0.0 * xp.concatenate([still, knots, still]),
    )
    return turned_from(path, at + 1)


def generating_path(drive: Drive, side: Side) -> tuple[Path, Any]:
    """The working path seen from the body, and the shift (m) by which its tooth is higher and thicker."""
    return seen_from(working_path(drive), side), drive.module * body_of(drive, side).profile_shift


def check(drive: Drive) -> None:
    """Refuse values that are no path, shifts that do not balance, and paths that teeth cannot work on."""
    _check_structure(drive)
    shape = drive.shape
    shifts = [body_of(drive, side).profile_shift for side in SIDES]
    if abs(sum(shifts)) > 1e-9:
        rule = "the profile shifts of a free-form path must add up to 0: it belongs to one centre distance"
        raise InputError("drive.gear.profile_shift", shifts[1], rule, f"use {-shifts[0]:g}")
    for place, angle in enumerate(shape.angles):
        if not 0 <= angle < _STEEPEST:
            rule = f"the pressure angle must be from 0° to {np.degrees(_STEEPEST):.0f}°"
            raise InputError(f"drive.shape.angles.{place}", f"{np.degrees(angle):.4g} deg", rule, "change it")
    path = working_path(drive)
    between = np.linspace(path.knots[0], path.knots[-1], 401)
    angle = path.pressure_angle(between)
    if angle.min() < -1e-3 or angle.max() > _STEEPEST:
        worst = angle.argmin() if angle.min() < -1e-3 else angle.argmax()
        place = int(np.argmin(np.abs(path.knots[1:-1] - between[worst])))
        rule = (
            f"between or beyond the knots the spline's pressure angle is {np.degrees(angle[worst]):.3g}° "
            f"at {1e3 * between[worst]:.3g} mm"
        )
        shown = f"{np.degrees(shape.angles[place]):.4g} deg"
        raise InputError(f"drive.shape.angles.{place}", shown, rule, "let the values change less")
    require_reach(drive, path, -_REACH * drive.module, _REACH * drive.module, _advice)


def _check_structure(drive: Drive) -> None:
    """Refuse numbers and places of values from which no spline can be made."""
    angles, knots, length, _ = drive.shape
    if not FEWEST <= len(angles) <= MOST:
        rule = f"there must be {FEWEST} to {MOST} of them"
        raise InputError("drive.shape.angles", f"{len(angles)} values", rule, "write more or fewer")
    if (knots is None) == (length is None):
        rule = "contradict each other" if knots is not None else "one of them is missing"
        raise InputError(
            "drive.shape.path_length", None, f"path_length and knots: {rule}", "give one of them"
        )
    if knots is None:
        return
    if len(knots) != len(angles):
        counts = f"{len(knots)} knots and {len(angles)} angles"
        raise InputError("drive.shape.knots", counts, "each angle has its knot", "write as many of each")
    back = np.flatnonzero(np.diff(knots) <= 0)
    if back.size:
        place = int(back[0]) + 1
        value = f"{1e3 * knots[place]:.4g} mm"
        raise InputError(f"drive.shape.knots.{place}", value, "the knots must ascend", "sort them")
    at = int(np.argmin(np.abs(knots)))
    if abs(knots[at]) > _AT_PITCH_POINT * drive.module or at in (0, len(knots) - 1):
        rule = "the pitch point must be one of the knots, with others on either side"
        raise InputError(f"drive.shape.knots.{at}", f"{1e3 * knots[at]:.4g} mm", rule, 'make "0 mm" one')


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    place = 0 if half < 0 else len(drive.shape.angles) - 1
    shown = f"{np.degrees(drive.shape.angles[place]):.4g} deg"
    return f"shape.angles.{place}", shown, "use other values on this side of P, or lower teeth"


FAMILY = Family(
    "spline",
    working_path,
    generating_path,
    shiftable=False,
    check=check,
    shape=SplineShape,
    parameters=(
        Parameter(
            "angles",
            "angle",
            "pressure angles along the path, from the approach's end to the recess's; the pitch point is one",
            allowed="not negative",
            example='["24 deg", "22 deg", "21 deg", "20.5 deg", "20 deg"]',
            listed=True,
        ),
        Parameter(
            "path_length",
            "length",
            "over which the angles stand, half of it on either side of P, evenly divided; or give knots",
            example='"22 mm"',
            optional=True,
        ),
        Parameter(
            "knots",
            "signed length",
            "signed distances from P at which the angles stand, 0 among them; or give path_length",
            listed=True,
            optional=True,
            fixed=True,
        ),
        Parameter(
            "corner",
            "angle",
            "rise of the angle from P to half the path length that is a corner at P",
            default=0.0,
            source="a smooth path",
            allowed="any",
            optional=True,
        ),
    ),
    pressure_angle=False,
    corner=True,
    about="free-form path; shape.angles along it, over shape.path_length or at shape.knots; shape.corner",
)


# The knots reach as far as the racks' flanks, but not much further than the contact, and a little more.
_FURTHEST, _MARGIN = 1.5, 1.02
# Weight of what only the racks touch.
_BESIDE = 0.1
_FIT_SAMPLES = 400


def fit_spline(assembly: Assembly, values: int) -> Assembly:
    """Fit a free-form path to the path of contact of a pair; teeth of its heights and thicknesses.

    The angles, at least `spline.FEWEST` of them, are the linear least squares over the contact; at P the
    angle is the path's own. Paths that may have a corner at P are fitted with one. A pair of any family at a
    centre distance of its own becomes one of the module 2 r_w/z and the helix angle β_w; the thickness of
    its teeth, and so its backlash, stays. `flank_deviation` says how near it comes.
    """
    path, contact = assembly.path, (float(assembly.r_start), float(assembly.r_end))
    start = max(min(contact[0], float(assembly.pinion.form_distance)), _FURTHEST * contact[0])
    end = min(max(contact[1], -float(assembly.gear.form_distance)), _FURTHEST * contact[1])
    module = 2 * float(path.pinion_pitch_radius) / assembly.drive.pinion.teeth
    intervals = max(values, FEWEST) - 1
    before = int(np.clip(round(intervals * start / (start - end)), 1, intervals - 1))
    knots = np.concatenate(
        [np.linspace(start, 0.0, before + 1), np.linspace(0.0, end, intervals - before + 1)[1:]]
    )
    knots *= _MARGIN
    angle = float(path.pressure_angle(0.0))
    bodies = _bodies(assembly, module, angle)
    shape = SplineShape(np.zeros(len(knots)), knots, None, 0.0)
    helix = math.atan(pitch_slope(assembly)) if assembly.drive.helix_angle else 0.0
    drive = Drive(module, 0.0, bodies[0], bodies[1], shape, helix_angle=helix)

    r = np.linspace(start, end, _FIT_SAMPLES)
    r = r[np.abs(r) > 1e-6 * module]
    columns = [_angle(drive, shape._replace(angles=unit), r) for unit in np.eye(len(knots))]
    if assembly.family.corner:
        columns.append(_angle(drive, shape._replace(corner=1.0), r))
    matrix = np.stack(columns, axis=-1)
    free = np.arange(matrix.shape[1]) != before
    wanted = path.pressure_angle(r) - angle * matrix[:, before]
    angles = np.full(matrix.shape[1], angle)
    weight = np.where((r >= contact[0]) & (r <= contact[1]), 1.0, _BESIDE)
    angles[free] = np.linalg.lstsq(weight[:, None] * matrix[:, free], weight * wanted)[0]
    corner = float(angles[-1]) if assembly.family.corner else 0.0
    return Assembly(
        family("spline"),
        drive._replace(shape=SplineShape(np.maximum(angles[: len(knots)], 0.0), knots, None, corner)),
    )


def _angle(drive: Drive, shape: SplineShape, r: np.ndarray) -> np.ndarray:
    """Pressure angle of a shape, which is linear in its angles and its corner."""
    return working_path(drive._replace(shape=shape)).pressure_angle(r)


def _bodies(assembly: Assembly, module: float, angle: float) -> list[GearBody]:
    """Bodies of the same tips, roots and thicknesses, whose reference circles are the working pitch circles.

    What one tooth is thicker and the other thinner is a shift, what both are is an allowance.
    """
    surplus = []
    for side in SIDES:
        radius = module * body_of(assembly.drive, side).teeth / 2
        half = float(thickness_half_angle(assembly.tooth(side), radius)) * radius
        surplus.append(0.0 if abs(half / module - np.pi / 4) < 1e-9 else half - np.pi / 4 * module)
    shifts, allowances = [0.0, 0.0], [2 * height for height in surplus]
    if angle >= 1e-9:
        shift = (surplus[0] - surplus[1]) / (2 * module * np.tan(angle))
        shifts, allowances = [shift, -shift], [surplus[0] + surplus[1]] * 2
    bodies = []
    for side, shift, allowance in zip(SIDES, shifts, allowances, strict=True):
        body, drive = body_of(assembly.drive, side), assembly.drive
        radius = module * body.teeth / 2
        bodies.append(
            body._replace(
                profile_shift=shift,
                addendum=(float(tip_radius(drive, side)) - radius) / module - shift,
                dedendum=(radius - float(assembly.tooth(side).root_radius)) / module + shift,
                fillet_radius=float(body.fillet_radius * drive.module / module),
                tip_radius=None,
                thickness_allowance=allowance,
                tip_break=0.0,
            )
        )
    return bodies


def flank_deviation(first: Assembly, second: Assembly) -> float:
    """Maximum distance (m) along the normal between the working flanks of two pairs, on either gear.

    Teeth are compared about their axes, so that a difference of thickness counts.
    """
    deviations = []
    for side in SIDES:
        path: Path = first.path_of(side)
        radii = np.linspace(
            lowest_contact_radius(first, side), float(tip_radius(first.drive, side)), _FIT_SAMPLES
        )
        r = distance_at_radius(path, radii)
        arm = path.pinion_pitch_radius * np.cos(path.pressure_angle(r))
        angles = [thickness_half_angle(pair.tooth(side), radii) for pair in (first, second)]
        deviations.append(np.abs((angles[0] - angles[1]) * arm).max())
    return float(max(deviations))
