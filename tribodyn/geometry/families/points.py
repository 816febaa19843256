"""A path of contact of the user's own, given by points.

The pressure angle is a not-a-knot cubic spline over the signed distance r through the points, one spline on
either side of the pitch point, which is one of the points: the path is C1 as a curve, with the drive's
pressure angle at P, and free to have a corner of α(r) there. Beyond its ends it goes on straight, where no
tooth may reach.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, reference_radii
from tribodyn.geometry.families import Family, unshifted
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.geometry.path import PerContact, inverted_rotation
from tribodyn.numerics.elementary import cos, namespace, within
from tribodyn.numerics.parameter import Parameter
from tribodyn.numerics.shapes import Array, Float, Int

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_NODES, _WEIGHTS = (1 + _NODES) / 2, _WEIGHTS / 2
_MINIMUM_POINTS = 3
# As near to P (in modules) as the point that stands for it must be.
_AT_PITCH_POINT = 1e-6
# How far (rad) the pressure angle at P may be from the one that the other points imply.
_ANGLE_TOLERANCE = np.radians(2.0)


class PointsPath(NamedTuple):
    """Piecewise cubic pressure angle."""

    #: pinion_pitch_radius, gear_pitch_radius: pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    #: knots, angles: (n,), signed distances (m), ascending, 0 among them, and pressure angles (rad) there
    knots: Any
    angles: Any
    #: left_slopes, right_slopes: (n − 1,), dα/dr at either end of each interval, rad/m
    left_slopes: Any
    right_slopes: Any
    rotations: Any  # (n,), pinion angle φ at the knots, rad

    def _interval(self, r: PerContact) -> Int[Array, "*contact"]:
        xp = namespace(self, r)
        interval = xp.searchsorted(self.knots, r, side="right") - 1
        return xp.clip(interval, 0, self.knots.shape[0] - 2)

    def _at(self, interval: Int[Array, "..."]) -> PerContact:
        """Start, length, angle, rise, and the slopes at both ends of the intervals, along a new last axis."""
        xp = namespace(self, interval)
        table = xp.stack(
            [
                self.knots[:-1],
                self.knots[1:] - self.knots[:-1],
                self.angles[:-1],
                self.angles[1:] - self.angles[:-1],
                self.left_slopes,
                self.right_slopes,
                self.rotations[:-1],
            ],
            axis=-1,
        )
        if xp is np:
            return table[interval]
        # a product and no selection: its derivative in reverse is a product again, not a loop
        return (interval[..., None] == np.arange(table.shape[0])) @ table

    def _cubic(self, r: PerContact, interval: Int[Array, "..."]) -> tuple[PerContact, PerContact]:
        """Angle and slope; held at the ends."""
        at = self._at(interval)
        start, length, a, rise = at[..., 0], at[..., 1], at[..., 2], at[..., 3]
        u = within((r - start) / length, 0.0, 1.0)
        m, n = length * at[..., 4], length * at[..., 5]
        square, cube = 3 * rise - 2 * m - n, m + n - 2 * rise
        inside = 1.0 * ((r >= self.knots[0]) & (r <= self.knots[-1]))
        slope = inside * (m + u * (2 * square + 3 * u * cube)) / length
        return a + u * (m + u * (square + u * cube)), slope

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle, rad."""
        r = namespace(self, r).asarray(r, dtype=float)
        return self._cubic(r, self._interval(r))[0]

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr, rad/m; at P itself the recess's."""
        r = namespace(self, r).asarray(r, dtype=float)
        return self._cubic(r, self._interval(r))[1]

    def rotation(self, r: PerContact) -> PerContact:
        """Pinion angle φ, rad: the knot's, and the integral of dr/(r_p cos α) from there."""
        r = namespace(self, r).asarray(r, dtype=float)
        interval = self._interval(r)
        at = self._at(interval)
        start = at[..., 0]
        between = start[..., None] + (r - start)[..., None] * _NODES
        angle, _ = self._cubic(between, interval[..., None])
        return at[..., 6] + (r - start) / self.pinion_pitch_radius * ((1 / cos(angle)) @ _WEIGHTS)

    signed_distance = inverted_rotation


def spline_slopes(x: Float[Array, " knot"], y: Float[Array, " knot"]) -> Float[Array, " knot"]:
    """Slopes at n ≥ 4 knots of the not-a-knot cubic spline through (x, y)."""
    xp = namespace(x, y)
    h, secant = xp.diff(x), xp.diff(y) / xp.diff(x)
    zero = xp.zeros_like(h[:1])
    below = xp.concatenate([h[1:], zero])
    above = xp.concatenate([zero, h[:-1]])
    middle = xp.concatenate([zero, 2 * (h[1:] + h[:-1]), zero])
    matrix = xp.diag(middle) + xp.diag(below, -1) + xp.diag(above, 1)
    right = 3 * (h[1:] * secant[:-1] + h[:-1] * secant[1:])
    # Third derivatives agree at the second knot and at the last but one.
    ends = []
    for first, second, near, far in (
        (h[0], h[1], secant[0], secant[1]),
        (h[-1], h[-2], secant[-1], secant[-2]),
    ):
        row = xp.stack([second**2, second**2 - first**2, -(first**2)])
        ends.append((row, 2 * (second**2 * near - first**2 * far)))
    pad = xp.zeros(x.shape[0] - 3)
    first_row = xp.concatenate([ends[0][0], pad])[None]
    last_row = xp.concatenate([pad, ends[1][0][::-1]])[None]
    matrix = xp.concatenate([first_row, matrix[1:-1], last_row])
    return xp.linalg.solve(matrix, xp.concatenate([ends[0][1][None], right, ends[1][1][None]]))


class PointsShape(NamedTuple):
    """Points (n, 2) of the path, x and y from the pitch point in m, x ascending, (0, 0) among them."""

    points: Any


def polar(points: Float[Array, "*point 2"]) -> tuple[Float[Array, "*point"], Float[Array, "*point"]]:
    """Signed distances (m) and pressure angles (rad) of points x, y; the angle at P itself means nothing."""
    xp = namespace(points)
    x, y = points[..., 0], points[..., 1]
    sign = xp.where(x < 0, -1.0, 1.0)
    return sign * xp.hypot(x, y), xp.arctan2(sign * y, sign * x)


def working_path(drive: Drive) -> PointsPath:
    """Spline through the drive's points. Which of them is P must be plain numbers."""
    points = drive.shape.points
    xp = namespace(drive)
    r_p, r_g = reference_radii(drive)
    knots, angles = polar(points)
    at = int(np.argmin(np.abs(np.asarray(knots))))
    knots = xp.concatenate([knots[:at], 0.0 * knots[:1], knots[at + 1 :]])
    angles = xp.concatenate([angles[:at], xp.stack([drive.pressure_angle + 0.0 * r_p]), angles[at + 1 :]])
    before = spline_slopes(knots[: at + 1], angles[: at + 1])
    after = spline_slopes(knots[at:], angles[at:])
    left, right = xp.concatenate([before[:-1], after[:-1]]), xp.concatenate([before[1:], after[1:]])
    return turned_from(PointsPath(r_p, r_g, knots, angles, left, right, 0.0 * knots), at)


def turned_from(path: PointsPath, at: int) -> PointsPath:
    """The path with its rotations filled in, counted from the knot `at`, which is P."""
    xp = namespace(*path)
    interval = np.arange(path.knots.shape[0] - 1)
    length = path.knots[1:] - path.knots[:-1]
    angle, _ = path._cubic(path.knots[:-1, None] + length[:, None] * _NODES, interval[:, None])
    steps = length / path.pinion_pitch_radius * ((1 / cos(angle)) @ _WEIGHTS)
    turned = xp.concatenate([0.0 * path.knots[:1], xp.cumsum(steps)])
    return path._replace(rotations=turned - turned[at])


def check(drive: Drive) -> None:
    """Refuse points that double back, miss P, are too few, leave the quadrants or end before the teeth do."""
    refuse_shift(drive)
    points, key = np.asarray(drive.shape.points), "drive.shape.points"

    def refuse(number: int, rule: str, remedy: str) -> None:
        x, y = 1e3 * points[number]
        raise InputError(key, f"({x:.4g}, {y:.4g}) mm", f"point {number + 1}: {rule}", remedy)

    back = np.flatnonzero(np.diff(points[:, 0]) <= 0)
    if back.size:
        refuse(int(back[0]) + 1, "the path doubles back: x does not increase", "sort or correct the points")
    at = int(np.argmin(np.hypot(*points.T)))
    if np.hypot(*points[at]) > _AT_PITCH_POINT * drive.module:
        refuse(at, "the path misses the pitch point: this is the nearest", "make the point 0,0 one of them")
    for count, name in ((at, "before"), (len(points) - 1 - at, "after")):
        if count < _MINIMUM_POINTS:
            rule = f"fewer than {_MINIMUM_POINTS} {name} the pitch point"
            raise InputError(key, f"{count} points", rule, "give more")
    r, angle = polar(points)
    for i in np.flatnonzero(np.arange(len(r)) != at):
        if not 0 < angle[i] < np.radians(85):
            rule = f"the pressure angle atan(y/x) is {np.degrees(angle[i]):.3g}°"
            refuse(int(i), rule, "y must have the sign of x, and |y| must not exceed 10 |x|")
    back = np.flatnonzero(np.diff(r) <= 0)
    if back.size:
        refuse(int(back[0]) + 1, "the path turns back towards the pitch point", "correct the points")
    for half in (slice(0, at), slice(at + 1, None)):
        near = np.argsort(np.abs(r[half]))[:3]
        fitted = np.polyval(np.polyfit(r[half][near], angle[half][near], 2), 0.0)
        if abs(fitted - drive.pressure_angle) > _ANGLE_TOLERANCE:
            shown, rule = f"{np.degrees(drive.pressure_angle):.4g}°", "does not go on from the path's points"
            raise InputError("drive.pressure_angle", shown, rule, f'use about "{np.degrees(fitted):.4g} deg"')
    require_reach(drive, working_path(drive), float(r[0]), float(r[-1]), _advice)


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    x, y = 1e3 * np.asarray(drive.shape.points)[0 if half < 0 else -1]
    return "shape.points", f"ends at ({x:.4g}, {y:.4g}) mm", "give points further out, or use lower teeth"


FAMILY = Family(
    "points",
    working_path,
    unshifted(working_path),
    shiftable=False,
    check=check,
    shape=PointsShape,
    parameters=(Parameter("points", "path", "points x, y of the path of contact from the pitch point"),),
    corner=True,
    about="a path of contact of your own; pressure_angle at the pitch point, shape.points: CSV with x, y",
)
