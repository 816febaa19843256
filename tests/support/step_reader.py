"""A reader of solids in STEP files (ISO 10303-21), from the standard, without a kernel of CAD."""

import re
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import BSpline

_TOKEN = re.compile(r"'(?:[^']|'')*'|#\d+|\.[A-Z_]+\.|[A-Z_0-9]*[A-Z_]+|[-+]?\d[\d.]*(?:E[-+]?\d+)?|[(),$*]")


def read(path: Path) -> dict[int, Any]:
    """Entities by number: (name, attributes); of several types a list of those. References are as "#1"."""
    text = path.read_text(encoding="ascii")
    assert text.startswith("ISO-10303-21;\nHEADER;")
    assert text.endswith("ENDSEC;\nEND-ISO-10303-21;\n")
    entities, used = {}, set[int]()
    for line in text.partition("\nDATA;\n")[2].splitlines()[:-2]:
        number, _, value = line.partition("=")
        assert value.endswith(";")
        tokens = _TOKEN.findall(value[:-1])
        assert "".join(tokens) == value[:-1]
        found, end = _parsed(tokens, 0)
        assert end == len(tokens)
        entities[int(number[1:])] = found
        used.update(int(token[1:]) for token in tokens if token[0] == "#")
    assert used <= entities.keys()
    return entities


def _parsed(tokens: list[str], at: int) -> tuple[Any, int]:
    token = tokens[at]
    if token[0].isalpha() or token == "(":
        values, at = [], at + (2 if token != "(" else 1)
        while tokens[at] != ")":
            value, at = _parsed(tokens, at)
            values.append(value)
            at += tokens[at] == ","
        return (values if token == "(" else (token, values)), at + 1
    if token[0] in "-+0123456789":
        return float(token), at + 1
    return (token[1:-1].replace("''", "'") if token[0] == "'" else token), at + 1


class Solids:
    """The solids of a file, and what is between them."""

    def __init__(self, path: Path) -> None:
        self._entities = read(path)

    def every(self, name: str) -> dict[int, list[Any]]:
        """Entities of a name: their attributes by number."""
        return {
            n: each[1] for n, each in self._entities.items() if isinstance(each, tuple) and each[0] == name
        }

    def __getitem__(self, reference: str) -> tuple[str, list[Any]]:
        return self._entities[int(reference[1:])]

    def point(self, reference: str) -> np.ndarray:
        """A point, m."""
        name, (_, place) = self[reference]
        assert name == "CARTESIAN_POINT"
        return 1e-3 * np.array(place)

    def faces(self) -> dict[str, list[tuple[str, bool, list[list[tuple[str, bool]]]]]]:
        """Of every solid by its name the faces: surface, whether its normal is outwards, loops of edges.

        They close it: loops go from vertex to vertex, and every edge is in two of them, in both directions.
        """
        found = {}
        for name, shell in self.every("MANIFOLD_SOLID_BREP").values():
            faces, ways = [], Counter()
            for face in self[shell][1][1]:
                _, bounds, surface, same = self[face][1]
                loops = []
                for bound in bounds:
                    _, loop, forward = self[bound][1]
                    assert forward == ".T."
                    edges = [(self[each][1][3], self[each][1][4] == ".T.") for each in self[loop][1][1]]
                    ends = [self[edge][1][1:3][:: 1 if way else -1] for edge, way in edges]
                    assert all(one[1] == two[0] for one, two in zip(ends, ends[1:] + ends[:1], strict=True))
                    ways.update(edges)
                    loops.append(edges)
                faces.append((surface, same == ".T.", loops))
            assert set(ways.values()) == {1}
            assert {edge for edge, way in ways if way} == {edge for edge, way in ways if not way}
            found[name] = faces
        return found

    def curve(self, edge: str) -> BSpline:
        """The spline of an edge, m over 0 … 1; its ends are the edge's vertices."""
        _, start, end, curve, _ = self[edge][1]
        _, degree, points, *_, many, knots, _ = self[curve][1]
        spline = _spline(degree, many, knots, np.array([self.point(each) for each in points]))
        for vertex, place in ((start, spline(0.0)), (end, spline(1.0))):
            assert np.allclose(self.point(self[vertex][1][1]), place, rtol=0, atol=1e-12)
        return spline

    def surface_at(self, surface: str, u: float, along: float) -> np.ndarray:
        """A point of a spline surface, m."""
        _, du, dv, rows, *_, many_u, many_v, knots_u, knots_v, _ = self[surface][1]
        grid = np.array([[self.point(each) for each in row] for row in rows])
        return _spline(dv, many_v, knots_v, _spline(du, many_u, knots_u, grid)(u))(along)


def _spline(degree: float, many: list[float], knots: list[float], points: np.ndarray) -> BSpline:
    return BSpline(np.repeat(knots, np.array(many, int)), points, int(degree))
