"""A polygon as triangles, by cutting off its ears, the ones with the shortest third side first."""

import heapq

import numpy as np

from tribodyn.numerics.shapes import Array, Float, Int


def triangles_of(points: Float[Array, "point 2"]) -> Int[Array, "triangle 3"]:
    """Triangles of a simple polygon, counter-clockwise as it is itself, by the numbers of its points.

    No point is added. ValueError where it crosses itself.
    """
    count = len(points)
    before, after = np.roll(np.arange(count), 1), np.roll(np.arange(count), -1)
    reflex = _cross(points[before], points, points[after]) <= 0.0
    there = np.ones(count, bool)
    heap: list[tuple[float, int, int, int]] = []
    blocked: list[tuple[float, int, int, int]] = []
    found = np.empty((count - 2, 3), int)

    def offer(i: int) -> None:
        one, two = int(before[i]), int(after[i])
        if not reflex[i]:
            x, y = points[two] - points[one]
            heapq.heappush(heap, (float(x * x + y * y), i, one, two))

    for i in range(count):
        offer(i)
    for number in range(count - 2):
        while True:
            if not heap:
                raise ValueError("the polygon crosses itself")
            _, i, one, two = entry = heapq.heappop(heap)
            if not there[i] or before[i] != one or after[i] != two or reflex[i]:
                continue
            others = np.flatnonzero(there & reflex)
            others = others[(others != one) & (others != two)]
            corner = points[[one, i, two]]
            inside = np.all(
                [_cross(corner[k], corner[(k + 1) % 3], points[others]) >= 0.0 for k in range(3)], axis=0
            )
            if not inside.any() or number == count - 3:
                break
            blocked.append(entry)
        found[number] = one, i, two
        there[i] = False
        after[one], before[two] = two, one
        for k in (one, two):
            reflex[k] = _cross(points[before[k]], points[k], points[after[k]]) <= 0.0
            offer(k)
        if not heap:
            heap, blocked = blocked, []
            heapq.heapify(heap)
    return found


def _cross(
    one: Float[Array, "*point 2"], two: Float[Array, "*point 2"], three: Float[Array, "*point 2"]
) -> Float[Array, " *point"]:
    """Twice the area of triangles, positive counter-clockwise."""
    (ax, ay), (bx, by) = np.moveaxis(two - one, -1, 0), np.moveaxis(three - one, -1, 0)
    return ax * by - ay * bx
