"""Entities of ISO 10303-21, and what solids of gears and shafts need of AP214: points, curves, faces."""

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import BSpline

from tribodyn.numerics.shapes import Array, Float

_MILLIMETRES = 1e3


class Edge(NamedTuple):
    """An edge with its vertices, by the numbers of their entities."""

    edge: int
    start: int
    end: int


class Entities:
    """A growing list of entities; every method adds one and returns its number. Lengths are in m."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def add(self, name: str, *values: Any) -> int:
        """An entity by its name and its attributes."""
        return self.whole(f"{name}({','.join(map(_value, values))})")

    def whole(self, text: str) -> int:
        """An entity as it stands, of several types, say."""
        self.lines.append(f"#{len(self.lines) + 1}={text};")
        return len(self.lines)

    def point(self, place: Iterable[float]) -> int:
        """A point, m."""
        return self.add("CARTESIAN_POINT", "", [_MILLIMETRES * float(each) for each in place])

    def vertex(self, place: Iterable[float]) -> int:
        """A vertex, m."""
        return self.add("VERTEX_POINT", "", _Ref(self.point(place)))

    def axes(self, place: Iterable[float], z: Sequence[float], x: Sequence[float]) -> int:
        """A system of axes by its origin (m), z and x."""
        z_axis, x_axis = (self.add("DIRECTION", "", list(map(float, axis))) for axis in (z, x))
        return self.add("AXIS2_PLACEMENT_3D", "", _Ref(self.point(place)), _Ref(z_axis), _Ref(x_axis))

    def spline(self, points: Float[Array, "point 3"], degree: int, knots: Array) -> int:
        """A B-spline by its control points, m."""
        refs = [_Ref(self.point(point)) for point in points]
        curve = ("", degree, refs, _UNSPECIFIED, _FALSE, _FALSE, *_knots(knots), _UNSPECIFIED_KNOTS)
        return self.add("B_SPLINE_CURVE_WITH_KNOTS", *curve)

    def spline_surface(self, points: Float[Array, "u v 3"], u: BSpline, v: BSpline) -> int:
        """A B-spline surface by its control points (m), with degrees and knots of two splines."""
        refs = [[_Ref(self.point(point)) for point in row] for row in points]
        (many_u, knots_u), (many_v, knots_v) = _knots(u.t), _knots(v.t)
        flags = _UNSPECIFIED_SURFACE, _FALSE, _FALSE, _FALSE
        surface = ("", int(u.k), int(v.k), refs, *flags, many_u, many_v, knots_u, knots_v, _UNSPECIFIED_KNOTS)
        return self.add("B_SPLINE_SURFACE_WITH_KNOTS", *surface)

    def line(self, start: Float[Array, "3"], end: Float[Array, "3"]) -> int:
        """A straight line."""
        along = (end - start) / np.linalg.norm(end - start)
        vector = self.add("VECTOR", "", _Ref(self.add("DIRECTION", "", along.tolist())), 1.0)
        return self.add("LINE", "", _Ref(self.point(start)), _Ref(vector))

    def edge(self, curve: int, start: int, end: int) -> Edge:
        """An edge along a curve between vertices."""
        return Edge(self.add("EDGE_CURVE", "", _Ref(start), _Ref(end), _Ref(curve), _TRUE), start, end)

    def face(self, surface: int, same: bool, *loops: Sequence[tuple[Edge, bool]]) -> int:
        """A face by loops of edges, and whether each goes forward; the first loop is the outer one.

        `same`: whether its normal is the surface's; loops are counter-clockwise about it, inner ones not.
        """
        bounds = []
        for number, loop in enumerate(loops):
            edges = [
                _Ref(self.add("ORIENTED_EDGE", "", _STAR, _STAR, _Ref(each.edge), _TRUE if way else _FALSE))
                for each, way in loop
            ]
            name = "FACE_BOUND" if number else "FACE_OUTER_BOUND"
            bounds.append(_Ref(self.add(name, "", _Ref(self.add("EDGE_LOOP", "", edges)), _TRUE)))
        return self.add("ADVANCED_FACE", "", bounds, _Ref(surface), _TRUE if same else _FALSE)

    def solid(self, name: str, faces: Sequence[int]) -> int:
        """A solid within faces."""
        shell = self.add("CLOSED_SHELL", "", [_Ref(face) for face in faces])
        return self.add("MANIFOLD_SOLID_BREP", name, _Ref(shell))


class _Ref(int):
    """The number of an entity that another one names."""


class _Word(str):
    """What stands as it is, an enumeration, say."""

    __slots__ = ()


_TRUE, _FALSE, _STAR, NOTHING = _Word(".T."), _Word(".F."), _Word("*"), _Word("$")
_UNSPECIFIED = _UNSPECIFIED_SURFACE = _Word(".UNSPECIFIED.")
_UNSPECIFIED_KNOTS = _Word(".UNSPECIFIED.")
ref = _Ref


def _knots(knots: Array) -> tuple[list[int], list[float]]:
    distinct, many = np.unique(knots, return_counts=True)
    return many.tolist(), distinct.tolist()


def _value(value: Any) -> str:
    """An attribute as a file has it."""
    if isinstance(value, _Word):
        return value
    if isinstance(value, _Ref):
        return f"#{int(value)}"
    if isinstance(value, str):
        return f"'{''.join(map(_character, value))}'"
    if isinstance(value, list):
        return f"({','.join(map(_value, value))})"
    if isinstance(value, float):
        mantissa, _, exponent = f"{value + 0.0:.12g}".partition("e")
        mantissa += "" if "." in mantissa else "."
        return f"{mantissa}E{exponent}" if exponent else mantissa
    return str(value)


def _character(one: str) -> str:
    if one in "'\\":
        return 2 * one
    return one if " " <= one <= "~" else f"\\X4\\{ord(one):08X}\\X0\\"
