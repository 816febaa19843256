"""Gears, shafts and trains as solids in a STEP file: AP214, boundary representation.

A product for every shape, and an assembly of its occurrences by their names. Flanks, fillets, root and tip
are B-splines of degree 3 through points on the exact curves; where a helix turns them, or modifications vary
along the face, splines of degree 5 along z go through their sections. Bores and shafts are cylinders.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from tribodyn import __version__
from tribodyn.drawing.shapes import GearShape, PlacedPart, ShaftShape
from tribodyn.drawing.surface import shaft_profile
from tribodyn.exchange.cad.chosen import CHOICES, chosen_parts, listed, tolerance_of
from tribodyn.exchange.cad.part21 import NOTHING, Edge, Entities, ref
from tribodyn.exchange.format import SCENARIO, Deviation, ExchangeFormat, Exported, Written, deviation
from tribodyn.numerics.shapes import Array

_SCHEMA = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"
#: Distance of splines from the exact outlines unless it is set, m.
_TOLERANCE = 1e-6
#: That of chords between the points that splines go through over theirs, at first; how many times smaller the
#: one is of points with which they are compared, and by how much it shrinks where splines are too far off.
_CHORDS, _FINER, _SHRINKS = 10.0, 16.0, 3.0
_Z, _X = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
#: Of splines along z, m: of a helix; where modifications bend flanks.
_HELIX_ERROR, _BEND_ERROR = 1e-9, 5e-8
#: Heights at which outlines with modifications are compared, over the width from its middle.
_HEIGHTS = (-0.5, -0.17, 0.29, 0.5)


def write(exported: Exported, name: str, choices: Mapping[str, Any]) -> Written:
    """The parts of a scenario, and how far the splines are from the exact outlines."""
    tolerance = tolerance_of(choices, _TOLERANCE)
    chords = _CHORDS * tolerance
    parts = chosen_parts(exported, choices, chords)
    while True:
        found = _deviation(parts, chosen_parts(exported, choices, chords / _FINER))
        if found.maximum <= tolerance:
            return Written({".step": _file(parts, name)}, (found,), (listed(parts),))
        chords /= _SHRINKS
        parts = chosen_parts(exported, choices, chords)


def _deviation(parts: Sequence[PlacedPart], finer: Sequence[PlacedPart]) -> Deviation:
    """How far the splines are from points of the exact outlines where they are to be as far along."""
    written, exact = [np.zeros((1, 2))], [np.zeros((1, 2))]
    for part, fine in zip(parts, finer, strict=True):
        if isinstance(part.shape, GearShape) and isinstance(fine.shape, GearShape):
            heights = part.shape.width * np.array(_HEIGHTS if part.shape.modified else [0.0])
            for own, other in zip(part.shape.section(heights), fine.shape.section(heights), strict=True):
                splines = map(_through, _pieces(part.shape, own))
                for spline, points in zip(splines, _pieces(fine.shape, other), strict=True):
                    written.append(spline(np.linspace(0.0, 1.0, len(points))))
                    exact.append(points)
    off = np.hypot(*(np.concatenate(written) - np.concatenate(exact)).T)
    largest = float(max(np.max(np.abs(points)) for points in exact))
    return deviation("outlines", "m", off, 0.0 * off, "their points")._replace(largest=largest or 1.0)


def _pieces(shape: GearShape, tooth: Array) -> list[Array]:
    """Points of the smooth pieces of one tooth (…, point, 2), the land to the next tooth last."""
    pitch = 2.0 * np.pi / shape.teeth
    turn = np.array([[np.cos(pitch), np.sin(pitch)], [-np.sin(pitch), np.cos(pitch)]])
    first, *_, last = ends = shape.ends
    pieces = [tooth[..., a : b + 1, :] for a, b in pairwise(ends)]
    return [*pieces, np.concatenate([tooth[..., last:, :], tooth[..., 1 : first + 1, :] @ turn], axis=-2)]


def _through(points: Array) -> BSpline:
    """A spline over 0 … 1 through the points of a piece (…, point, 2)."""
    count = points.shape[-2]
    return make_interp_spline(np.linspace(0.0, 1.0, count), points, k=min(3, count - 1), axis=-2)


def _along(shape: GearShape) -> BSpline:
    """The points of a tooth over 0 … 1 along the width."""
    fine = np.linspace(0.0, 1.0, 301)
    heights = shape.width * (fine - 0.5)
    if not shape.twist and not np.ptp(shape.thinned(heights), axis=0).any():
        return make_interp_spline([0.0, 1.0], shape.section(heights[[0, -1]]), k=1)
    count, allowed = 6, _BEND_ERROR if shape.modified else _HELIX_ERROR
    while True:
        along = np.linspace(0.0, 1.0, count)
        spline = make_interp_spline(along, shape.section(shape.width * (along - 0.5)), k=5)
        if np.max(np.abs(spline(fine) - shape.section(heights))) < allowed:
            return spline
        count += 2 + count // 4 * bool(shape.modified)


def _gear(out: Entities, shape: GearShape) -> list[int]:
    """Faces of a gear."""
    along = _along(shape)
    z = shape.width * (np.array([along.t[k + 1 : k + 1 + along.k].mean() for k in range(len(along.c))]) - 0.5)
    pieces = zip(_pieces(shape, along.c), _pieces(shape, shape.tooth), strict=True)
    splines = [_through(piece) for piece, points in pieces if np.hypot(*np.ptp(points, axis=0)) > 1e-9]
    corners, grids = [], []
    for tooth in range(shape.teeth):
        angle = 2.0 * np.pi / shape.teeth * tooth
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        for spline in splines:
            places = spline.c @ turn  # of points along the outline, and along the width
            grid = np.concatenate([places, np.broadcast_to(z, places.shape[:-1])[..., None]], axis=-1)
            grids.append((spline, grid))
            ends = [out.vertex(grid[0, end]) for end in (0, -1)]
            curve = out.spline(grid[0], int(along.k), along.t)
            corners.append(out.edge(curve, *ends))
    faces, loops = [], [list[Edge](), list[Edge]()]
    for (spline, grid), left, right in zip(grids, corners, [*corners[1:], corners[0]], strict=True):
        low, high = (
            out.edge(out.spline(grid[:, end], int(spline.k), spline.t), start, stop)
            for end, start, stop in ((0, left.start, right.start), (-1, left.end, right.end))
        )
        loops[0].append(low)
        loops[1].append(high)
        surface = out.spline_surface(grid, spline, along)
        faces.append(_side(out, surface, (low, right, high, left), outwards=not shape.internal))
    corners = shape.inside if shape.internal else shape.inside[::-1]
    circles = [_circle(out, r, z) if r else [] for r, z in corners]
    faces += _turned(out, corners, circles)
    ends = (circles[0], circles[-1])[:: 1 if shape.internal else -1]
    for height, outline, circle in zip((-0.5, 0.5), loops, ends, strict=True):
        outer, inner = (circle, outline) if shape.internal else (outline, circle)
        faces.append(_flat(out, height * shape.width, outer, inner, upwards=height > 0.0))
    return faces


def _shaft(out: Entities, shape: ShaftShape) -> list[int]:
    """Faces of a shaft."""
    profile = shaft_profile(shape)
    circles = [_circle(out, r, z) if r else [] for r, z in profile]
    return _turned(out, [*profile, profile[0]], [*circles, circles[0]])


def _turned(
    out: Entities, corners: Sequence[tuple[float, float]], circles: Sequence[Sequence[Edge]]
) -> list[int]:
    """Faces by corners of half a section, radius and z; along z outside, back inside; their circles."""
    faces = []
    for (r, z), (s, w), *both in zip(corners, corners[1:], circles, circles[1:], strict=False):
        if r == s and r:
            faces += _cylinder(out, r, *(both if w > z else both[::-1]), outwards=w > z)
        elif r != s:
            outer, inner = both if r > s else both[::-1]
            faces.append(_flat(out, z, outer, inner, upwards=r > s))
    return faces


def _circle(out: Entities, radius: float, height: float) -> list[Edge]:
    """Two halves of a circle about the axis, counter-clockwise."""
    curve = out.add("CIRCLE", "", ref(out.axes((0.0, 0.0, height), _Z, _X)), 1e3 * radius)
    one, two = (out.vertex((way * radius, 0.0, height)) for way in (1.0, -1.0))
    return [out.edge(curve, one, two), out.edge(curve, two, one)]


def _cylinder(
    out: Entities, radius: float, low: Sequence[Edge], high: Sequence[Edge], *, outwards: bool
) -> list[int]:
    """Two halves of a cylinder about the axis between circles."""
    axes = out.axes((0.0, 0.0, 0.0), _Z, _X)
    surface = out.add("CYLINDRICAL_SURFACE", "", ref(axes), 1e3 * radius)
    sides = []
    for number, way in ((0, 1.0), (1, -1.0)):
        place = np.array([way * radius, 0.0, 0.0])
        curve = out.line(place, place + np.array(_Z))
        sides.append(out.edge(curve, low[number].start, high[number].start))
    return [_side(out, surface, (low[k], sides[1 - k], high[k], sides[k]), outwards=outwards) for k in (0, 1)]


def _side(out: Entities, surface: int, edges: tuple[Edge, Edge, Edge, Edge], *, outwards: bool) -> int:
    """A face of four edges: low, right, high, left, low and high counter-clockwise about the axis."""
    loop = list(zip(edges, (True, True, False, False), strict=True))
    if not outwards:
        loop = [(edge, not way) for edge, way in reversed(loop)]
    return out.face(surface, outwards, loop)


def _flat(
    out: Entities, height: float, outer: Sequence[Edge], inner: Sequence[Edge], *, upwards: bool
) -> int:
    """A face across the axis between loops that are counter-clockwise about it."""
    surface = out.add("PLANE", "", ref(out.axes((0.0, 0.0, height), _Z, _X)))
    loops = [[(edge, upwards) for edge in outer][:: 1 if upwards else -1]]
    if inner:
        loops.append([(edge, not upwards) for edge in inner][:: -1 if upwards else 1])
    return out.face(surface, upwards, *loops)


def _file(parts: Sequence[PlacedPart], name: str) -> str:
    out = Entities()
    application = ref(out.add("APPLICATION_CONTEXT", "automotive design"))
    protocol = "international standard", "automotive_design", 2000, application
    out.add("APPLICATION_PROTOCOL_DEFINITION", *protocol)
    of_product = ref(out.add("PRODUCT_CONTEXT", "", application, "mechanical"))
    of_design = ref(out.add("PRODUCT_DEFINITION_CONTEXT", "part definition", application, "design"))
    length = out.whole("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
    angle = out.whole("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
    solid = out.whole("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
    fine = out.whole(
        f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),#{length},'distance_accuracy_value','')"
    )
    space = ref(
        out.whole(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
            f"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{fine}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{solid}))REPRESENTATION_CONTEXT('',''))"
        )
    )
    origin = ref(out.axes((0.0, 0.0, 0.0), _Z, _X))

    def product(title: str, kind: str, items: list[Any]) -> tuple[Any, Any]:
        made = ref(out.add("PRODUCT", title, title, "", [of_product]))
        out.add("PRODUCT_RELATED_PRODUCT_CATEGORY", "part", NOTHING, [made])
        formed = ref(out.add("PRODUCT_DEFINITION_FORMATION", "", "", made))
        defined = ref(out.add("PRODUCT_DEFINITION", "design", "", formed, of_design))
        shape = ref(out.add("PRODUCT_DEFINITION_SHAPE", "", "", defined))
        shown = ref(out.add(kind, title, items, space))
        out.add("SHAPE_DEFINITION_REPRESENTATION", shape, shown)
        return defined, shown

    places = [ref(out.axes(part.centre, _Z, (np.cos(part.angle), np.sin(part.angle), 0.0))) for part in parts]
    whole, shown = product(name, "SHAPE_REPRESENTATION", [origin, *places])
    products: dict[int, tuple[Any, Any]] = {}
    for part, place in zip(parts, places, strict=True):
        if id(part.shape) not in products:
            shape = part.shape
            faces = _gear(out, shape) if isinstance(shape, GearShape) else _shaft(out, shape)
            body = ref(out.solid(part.name, faces))
            kind = "ADVANCED_BREP_SHAPE_REPRESENTATION"
            products[id(part.shape)] = product(part.name, kind, [origin, body])
        defined, own = products[id(part.shape)]
        use = ref(
            out.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", part.name, part.name, "", whole, defined, NOTHING)
        )
        shape_of_use = ref(out.add("PRODUCT_DEFINITION_SHAPE", "", "", use))
        moved = out.add("ITEM_DEFINED_TRANSFORMATION", "", "", origin, place)
        related = out.whole(
            f"(REPRESENTATION_RELATIONSHIP('','',#{int(own)},#{int(shown)})"
            f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{moved})SHAPE_REPRESENTATION_RELATIONSHIP())"
        )
        out.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", ref(related), shape_of_use)
    head = Entities()
    made = f"written by tribodyn {__version__}"
    head.add("FILE_DESCRIPTION", [made], "2;1")
    head.add("FILE_NAME", name, "", [""], [""], made, made, "")
    head.add("FILE_SCHEMA", [_SCHEMA])
    top = "\n".join(line.partition("=")[2] for line in head.lines)
    data = "\n".join(out.lines)
    return f"ISO-10303-21;\nHEADER;\n{top}\nENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n"


FORMAT = ExchangeFormat(
    "step",
    "gears, shafts and trains as solids for CAD (STEP AP214, an assembly of parts)",
    (".step",),
    (SCENARIO,),
    write=write,
    choices=CHOICES,
)
