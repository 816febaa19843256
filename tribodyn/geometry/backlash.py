"""Backlash of a pair whose teeth are cut: how far a gear can turn, and how far the back flanks are apart."""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.geometry.helix import as_written, from_written, normal_slope, pitch_slope
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.numerics.elementary import cos, sqrt


def circumferential_backlash(assembly: Assembly) -> Any:
    """Arc j_wt of the working pitch circle by which a gear can turn, m: pitch less both tooth thicknesses."""
    radius = assembly.path.pinion_pitch_radius
    pitch = 2 * np.pi * radius / assembly.drive.pinion.teeth
    thicknesses = 0.0
    for side in SIDES:
        radius = assembly.path_of(side).pinion_pitch_radius
        thicknesses = thicknesses + 2 * radius * thickness_half_angle(assembly.tooth(side), radius)
    return pitch - thicknesses


def normal_backlash(assembly: Assembly) -> Any:
    """Distance j_bn between the back flanks along their normal at the pitch point, m; negative: overlap.

    j_bn = j_wt cos α_wt cos β_b (ISO 21771); of other families β_n at the pitch point stands for β_b.
    """
    angle = assembly.path.pressure_angle(0.0)
    leaning = sqrt(1.0 + normal_slope(pitch_slope(assembly), angle) ** 2)
    return circumferential_backlash(assembly) * cos(angle) / leaning


def at_limits(
    assembly: Assembly, tolerances: Sequence[float], distance_allowance: float
) -> Iterator[Assembly]:
    """The pair with both teeth at their least and greatest thickness, at both limits of the centre distance.

    Tolerances of the normal tooth thickness, m, of which half lies on either side of what the drive has; the
    allowance of the centre distance, m, ±, of involutes.
    """
    drive = as_written(assembly.family, assembly.drive)
    path = assembly.path
    distance = float(path.pinion_pitch_radius + path.gear_pitch_radius)
    for thicker, apart in product((-0.5, 0.5), sorted({-distance_allowance, distance_allowance})):
        limit = drive._replace(centre_distance=distance + apart) if apart else drive
        for side, tolerance in zip(SIDES, tolerances, strict=True):
            body = body_of(drive, side)
            allowance = body.thickness_allowance + thicker * tolerance
            limit = limit._replace(**{side: body._replace(thickness_allowance=allowance)})
        yield Assembly(assembly.family, from_written(assembly.family, limit))
