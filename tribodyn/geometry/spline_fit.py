"""The free-form path nearest to another family's: where a search for a better tooth begins."""

import math

import numpy as np

from tribodyn.geometry.assembly import Assembly, lowest_contact_radius
from tribodyn.geometry.drive import SIDES, Drive, GearBody, body_of, tip_radius
from tribodyn.geometry.families import family
from tribodyn.geometry.families.spline import FEWEST, SplineShape, working_path
from tribodyn.geometry.helix import pitch_slope
from tribodyn.geometry.path import Path, distance_at_radius
from tribodyn.geometry.tooth import thickness_half_angle

# The knots reach as far as the racks' flanks, but not much further than the contact, and a little more.
_FURTHEST, _MARGIN = 1.5, 1.02
# Weight of what only the racks touch.
_BESIDE = 0.1
_SAMPLES = 400


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

    r = np.linspace(start, end, _SAMPLES)
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
            lowest_contact_radius(first, side), float(tip_radius(first.drive, side)), _SAMPLES
        )
        r = distance_at_radius(path, radii)
        arm = path.pinion_pitch_radius * np.cos(path.pressure_angle(r))
        angles = [thickness_half_angle(pair.tooth(side), radii) for pair in (first, second)]
        deviations.append(np.abs((angles[0] - angles[1]) * arm).max())
    return float(max(deviations))
