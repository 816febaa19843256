"""The surface of a gear or a shaft as triangles: closed, every edge in two of them, normals outwards.

Points lie on the exact surfaces; where two faces meet in an edge there is one for each, in the same place.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tribodyn.drawing.ears import triangles_of
from tribodyn.drawing.shapes import GearShape, ShaftShape, pieces_of_arc, turned_about
from tribodyn.numerics.shapes import Array, Float, Int


class Surface(NamedTuple):
    """Triangles, counter-clockwise seen from outside."""

    point: Float[Array, "point 3"]  # m
    normal: Float[Array, "point 3"]
    triangle: Int[Array, "triangle 3"]  # numbers of points


def surface_of(shape: GearShape | ShaftShape) -> Surface:
    """The surface of a part in its own frame."""
    return _of_gear(shape, shape.teeth) if isinstance(shape, GearShape) else _of_shaft(shape)


def one_tooth(shape: GearShape) -> Surface:
    """What a gear repeats about its axis: its surface between the middles of two gaps, open to the others."""
    whole = _of_gear(shape, 1)
    kept, numbers = np.unique(whole.triangle, return_inverse=True)
    return Surface(whole.point[kept], whole.normal[kept], numbers.reshape(whole.triangle.shape))


def volume(surface: Surface) -> float:
    """What a closed surface holds, m³."""
    one, two, three = (surface.point[surface.triangle[:, k]] for k in range(3))
    return float(np.sum(one * np.cross(two, three)) / 6.0)


def _of_gear(shape: GearShape, teeth: int) -> Surface:
    """All points, and the triangles of so many teeth."""
    pitch, count = 2.0 * np.pi / shape.teeth, len(shape.tooth) - 1
    end = shape.inside[0][0]
    pieces = pieces_of_arc(pitch, end, shape.tolerance / 2) if end else 1
    arc = np.linspace(-0.5, 0.5, pieces + 1) * pitch
    unit = np.stack([np.cos(arc), np.sin(arc)], axis=-1) if end else np.zeros((1, 2))
    before, after = _normals(shape, pitch)
    heights = np.linspace(-0.5, 0.5, _layers(shape) + 1) * shape.width
    thinned = shape.thinned(heights)
    way = -1.0 if shape.internal else 1.0
    around = _swept(shape, teeth, shape.tooth[:-1], way * before, way * after, heights, thinned[:, :-1], way)
    parts, edges = [around[0]], [[around[0].point[around[1][end]]] for end in (0, 1)]
    if end:
        inside, rims = _inside(shape, teeth, unit[:-1], len(heights) - 1)
        parts += inside
        for edge, rim in zip(edges, rims, strict=True):
            edge.append(rim)
    numbers = np.append(np.arange(count + 1), np.arange(count + 1, count + 1 + len(unit))[::-1])
    sector = numbers[::-1] if shape.internal else numbers
    # of every tooth: the last points of both lines are the first ones of the next tooth
    tooth = np.arange(shape.teeth)[:, None]
    outline = (np.arange(count + 1) + count * tooth) % (count * shape.teeth)
    inner = (np.arange(len(unit)) + (len(unit) - 1) * tooth) % max(1, (len(unit) - 1) * shape.teeth)
    every = np.concatenate([outline, count * shape.teeth + inner], axis=1)[:teeth]
    for upper, way in ((0, -1.0), (1, 1.0)):
        points = np.concatenate([turned_about(shape.tooth, thinned[[-upper]])[0], end * unit])
        flat = every[:, sector[triangles_of(points[sector])]].reshape(-1, 3)
        place = np.concatenate(edges[upper] if end else [*edges[upper], [[0.0, 0.0, heights[-upper]]]])
        parts.append(Surface(place, np.tile([0.0, 0.0, way], (len(place), 1)), flat[:, :: int(way)]))
    return _joined(parts)


def _inside(
    shape: GearShape, teeth: int, unit: Float[Array, "point 2"], layers: int
) -> tuple[list[Surface], tuple[Float[Array, "point 3"], Float[Array, "point 3"]]]:
    """The side of the bore, by a tooth's part of a circle of radius 1; and its points at both ends."""
    way, found, ends = -1.0 if shape.internal else 1.0, [], []

    def swept(radius: float, *heights: float) -> tuple[Surface, Int[Array, "end point"]]:
        even = np.zeros((len(heights), len(unit)))
        return _swept(shape, teeth, radius * unit, -way * unit, -way * unit, np.array(heights), even, -way)

    for (r, z), (s, y) in pairwise(shape.inside):
        if r == s:
            if r:
                steps = max(1, int(np.ceil(layers * (y - z) / shape.width)))
                surface, edges = swept(r, *np.linspace(z, y, steps + 1))
                found.append(surface)
                ends += [surface.point[edge] for edge in edges]
            continue
        # a face of the web: below it goes in, above out
        (outer, _), (inner, _) = swept(max(r, s), z), swept(min(r, s), z)
        points, count = np.concatenate([outer.point, inner.point]), len(outer.point)
        a = np.arange(teeth * len(unit))
        b = (a + 1) % count
        corners = ((a, b, a + count),) if min(r, s) == 0.0 else ((a, b, b + count), (a, b + count, a + count))
        triangles = np.concatenate([np.stack(corner, axis=-1) for corner in corners])
        up = 1.0 if s > r else -1.0
        normals = np.tile([0.0, 0.0, up], (len(points), 1))
        found.append(Surface(points, normals, triangles[:, :: int(up)]))
    return found, (ends[0], ends[-1])


def _layers(shape: GearShape) -> int:
    """Layers along z by which chords leave the twisted outline by half the tolerance at most."""
    radius = max(float(np.hypot(*shape.tooth.T).max()), shape.radius)
    step = float(np.hypot(*np.diff(shape.tooth, axis=0).T).max())
    # κ² R h²/8 + κ h s/4 of triangles h high and s wide
    twist = abs(shape.twist)
    high = 2.0 * shape.tolerance / (step + np.sqrt(step**2 + 4.0 * radius * shape.tolerance))
    steps = [each.steps(radius, shape.tolerance / 4.0) for each in shape.modified]
    return max(1, int(np.ceil(twist * shape.width / (2.0 * high))), *steps)


def _normals(shape: GearShape, pitch: float) -> tuple[Float[Array, "point 2"], Float[Array, "point 2"]]:
    """Of every point but the last one the normals to the right of the outline: before it and after."""
    count = len(shape.tooth) - 1
    turn = np.array([[np.cos(pitch), np.sin(pitch)], [-np.sin(pitch), np.cos(pitch)]])
    line = np.concatenate([shape.tooth[-2:-1] @ turn.T, shape.tooth, shape.tooth[1:2] @ turn])
    ends = sorted({0, *(corner + 1 for corner in shape.corners), count + 2})
    before, after = np.empty((count + 3, 2)), np.empty((count + 3, 2))
    for start, end in pairwise(ends):
        run = line[start : end + 1]
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(run, axis=0).T)))
        tangent = np.gradient(run, along, axis=0, edge_order=2 if len(run) > 2 else 1)
        tangent /= np.hypot(*tangent.T)[:, None]
        right = np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)
        before[start + 1 : end + 1], after[start:end] = right[1:], right[:-1]
    return before[1 : count + 1], after[1 : count + 1]


def _swept(
    shape: GearShape,
    teeth: int,
    line: Float[Array, "point 2"],
    before: Float[Array, "point 2"],
    after: Float[Array, "point 2"],
    heights: Float[Array, " layer"],
    thinned: Float[Array, "layer point"],
    way: float,
) -> tuple[Surface, Int[Array, "end point"]]:
    """A line of a tooth about the whole circumference and along z; `way` < 0: its inside is to the right.

    `thinned`: by how much its points are turned, rad. With the vertices of its points at both ends.
    """
    edge = np.any(before != after, axis=1)
    # of every point its vertex where the line goes on, behind those of the edges where it comes
    own = np.append(0, np.cumsum(1 + edge)[:-1]) + edge
    which = np.repeat(np.arange(len(line)), 1 + edge)
    normal = after[which]
    normal[own[edge] - 1] = before[edge]
    per_tooth, angles = len(which), 2.0 * np.pi / shape.teeth * np.arange(shape.teeth)
    line, normal = (_turned(each, angles).reshape(-1, 2) for each in (line[which], normal))
    around = len(line)
    turn = shape.twist * heights[:, None] + np.tile(thinned[:, which], shape.teeth)
    along = turned_about(line, turn), turned_about(normal, turn)
    # across z, and along the helix: (n, −κ n·(z × p))
    lean = -shape.twist * (normal[:, 1] * line[:, 0] - normal[:, 0] * line[:, 1])
    z = np.broadcast_to(heights[:, None, None], (*along[0].shape[:2], 1))
    points = np.concatenate([along[0], z], axis=-1).reshape(-1, 3)
    lean = np.broadcast_to(lean[None, :, None], z.shape)
    normals = np.concatenate([along[1], lean], axis=-1).reshape(-1, 3)
    normals = normals / np.linalg.norm(normals, axis=1)[:, None]
    goes = (own + per_tooth * np.arange(shape.teeth)[:, None]).ravel()
    comes = np.roll((own - edge + per_tooth * np.arange(shape.teeth)[:, None]).ravel(), -1)
    layers = around * np.arange(len(heights) - 1)[:, None]
    built = slice(teeth * len(own))
    sides = goes, comes, comes + around, goes + around
    a, b, c, d = ((each[built] + layers).ravel() for each in sides)
    triangles = np.concatenate([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)])
    surface = Surface(points, normals, triangles if way > 0.0 else triangles[:, ::-1])
    return surface, np.stack([goes, goes + around * (len(heights) - 1)])


def _turned(points: Float[Array, "point 2"], angles: Float[Array, " angle"]) -> Float[Array, "angle point 2"]:
    return turned_about(points, np.broadcast_to(angles[:, None], (len(angles), len(points))))


def shaft_profile(shape: ShaftShape) -> list[tuple[float, float]]:
    """Corners of half a section along the axis, radius and z, m: out, along z, in and back; closed."""
    ends = np.append(0.0, np.cumsum(shape.length))
    outside = [(r, z) for r, *both in zip(shape.radius, ends[:-1], ends[1:], strict=True) for z in both]
    inside = [(b, z) for b, *both in zip(shape.bore, ends[:-1], ends[1:], strict=True) for z in both]
    profile = [*outside, *inside[::-1]]
    return [point for point, last in zip(profile, [profile[-1], *profile[:-1]], strict=True) if point != last]


def _of_shaft(shape: ShaftShape) -> Surface:
    kept = shaft_profile(shape)
    pieces = max(12, pieces_of_arc(2.0 * np.pi, max(shape.radius), shape.tolerance))
    angle = 2.0 * np.pi / pieces * np.arange(pieces)
    around = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    parts = []
    for (r, z), (s, w) in zip(kept, [*kept[1:], kept[0]], strict=True):
        if r == s == 0.0:
            continue
        points = np.concatenate(
            [np.column_stack([e * around, np.full(pieces, h)]) for e, h in ((r, z), (s, w))]
        )
        across = np.array([w - z, r - s]) / np.hypot(w - z, r - s)
        normal = np.tile(np.column_stack([across[0] * around, np.full(pieces, across[1])]), (2, 1))
        a = np.arange(pieces)
        b = np.roll(a, -1)
        triangles = [
            np.stack(corner, axis=-1) for corner in ((a, b, b + pieces), (a, b + pieces, a + pieces))
        ]
        parts.append(
            Surface(points, normal, np.concatenate([t for t, e in zip(triangles, (r, s), strict=True) if e]))
        )
    return _joined(parts)


def _joined(parts: list[Surface]) -> Surface:
    starts = np.append(0, np.cumsum([len(part.point) for part in parts])[:-1])
    triangles = [part.triangle + start for part, start in zip(parts, starts, strict=True)]
    return Surface(
        np.concatenate([part.point for part in parts]),
        np.concatenate([part.normal for part in parts]),
        np.concatenate(triangles),
    )
