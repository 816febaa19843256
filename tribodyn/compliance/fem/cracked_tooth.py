"""What a crack adds to the compliance of a tooth, by finite elements with the crack in their mesh.

The same triangles are solved sound and with the crack open; a point load's own deflection, infinite in truth,
is the same in both and cancels.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, KDTree
from skfem import Basis, ElementTriP2, MeshTri

from tribodyn.compliance.crack import Crack, half_outline, mouth, thinning
from tribodyn.compliance.energy import LoadedTooth
from tribodyn.compliance.fem.strips import plane_stiffness
from tribodyn.errors import InputError
from tribodyn.geometry.drive import MaterialData
from tribodyn.numerics.files.cache import arrays_kept_or_made, digest_of_numbers
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array, Float

# Triangles over a ring with one tooth, along a crack and finer and finer towards its tip.
#
# Delaunay triangles of points that stand on the outline, on the crack and, as a quadtree places them,
# between; a wished size of the cells, small at the crack's tip, says how close. The ring's other teeth are
# left out: they change what a crack adds to the compliance of this one by less than 0.1 %.


#: Wished sizes of cells: on the tooth in modules, along the crack in its depths, at its tip likewise; how
#: they grow with the distance from crack and tip; coarsest in modules.
_ON_TOOTH, _ALONG, _AT_TIP = 0.12, 0.25, 1.0 / 60.0
_FROM_CRACK, _FROM_TIP, _COARSEST = 0.3, 0.25, 2.0
# Modules about the middle of the tooth's foot that are the tooth.
_TOOTH = 3.0
# A point no nearer than this many sizes to outline or crack, so that their edges are edges of triangles.
_CLEAR = 0.6
_FINEST = 20  # halvings of the quadtree

Points = Float[Array, "point 2"]
Size = Callable[[Points], Float[Array, " point"]]


class CrackedMesh(NamedTuple):
    """Triangles, sound and with the crack open; both have the same points but for its other face."""

    points: Points  # m, in the tooth's frame; beyond the sound mesh's those of the crack's second face
    sound: NDArray[np.int64]  # (triangle, 3)
    cracked: NDArray[np.int64]
    held: NDArray[np.int64]  # points on the bore
    flank: NDArray[np.int64]  # points on the loaded flank, from the fillet to the tip
    distance: Float[Array, " vertex"]  # the body's own r of these, m


def cracked_mesh(loaded: LoadedTooth, crack: Crack, refined: float = 1.0) -> CrackedMesh:
    """Mesh a cracked tooth, `refined` times as fine; InputError where the crack's tip leaves the body."""
    fillet, flank, flank_distance = half_outline(loaded)
    start = mouth(loaded, crack.tangent).place
    tip = start + crack.depth * np.array([-np.cos(crack.angle), -np.sin(crack.angle)])
    shape = _Domain(loaded, fillet, flank)
    if not np.all(shape.holds(np.linspace(start, tip, 50)[1:])) or not shape.far_from_bore(tip, crack.depth):
        rule = "the crack leaves the body: its tip lies in the bore or the other flank"
        raise InputError("depth", f"{1e3 * crack.depth:.3g} mm", rule, "make it shallower")
    size = _size(loaded, start, tip, refined)
    before, after = _cut_at(fillet, start)
    upper = [_spread(before, size), _spread(after, size), _spread(flank, size)]
    outline = _outline(loaded, upper, _spread(fillet, size), size)
    bore = _circle(float(loaded.body.bore_radius), 0.0, 2.0 * np.pi, size)[1:]
    line = _spread(np.linspace(start, tip, 400), size)[1:]
    fixed = np.concatenate([outline, bore, line])
    inside = _quadtree(loaded, size)
    inside = inside[shape.holds(inside)]
    inside = inside[KDTree(fixed).query(inside)[0] > _CLEAR * size(inside)]
    points = np.concatenate([fixed, inside])
    sound = _triangles(points, shape)

    count = len(outline) + len(bore)
    first = int(np.argmin(np.linalg.norm(outline - start, axis=1)))
    path = np.concatenate([[first], count + np.arange(len(line))])
    points, cracked = _opened(points, sound, path)
    on_flank = np.asarray(KDTree(outline).query(upper[2][1:-1])[1])
    reach = np.hypot(*flank.T)
    order = np.argsort(reach)
    distance = np.interp(np.hypot(*points[on_flank].T), reach[order], flank_distance[order])
    held = np.arange(len(outline), count)
    return CrackedMesh(points, sound, cracked, held, on_flank, distance)


class _Domain:
    """Which places lie in the ring or the tooth."""

    def __init__(self, loaded: LoadedTooth, fillet: Points, flank: Points) -> None:
        self._sign = np.sign(float(loaded.tooth.root_radius))
        profile = np.concatenate([fillet, flank[1:]])
        self._reach, self._half = self._polar(profile)
        self._bore, self._root = float(loaded.body.bore_radius), float(loaded.tooth.root_radius)

    def _polar(self, place: Points) -> tuple[Float[Array, " point"], Float[Array, " point"]]:
        turned = self._sign * place
        return self._sign * np.hypot(*place.T), np.abs(np.arctan2(turned[:, 1], turned[:, 0]))

    def holds(self, place: Points) -> NDArray[np.bool_]:
        """Whether places (point, 2) lie inside."""
        reach, angle = self._polar(place)
        ring = (reach > self._bore) & (reach < self._root)
        half = np.abs(np.interp(reach, self._reach, self._half))
        return ring | ((reach >= self._root) & (reach < self._reach[-1]) & (angle < half))

    def far_from_bore(self, place: Float[Array, " 2"], depth: float) -> bool:
        """Whether a place is as far from the bore as a few of the cells at the tip of a crack."""
        return float(self._polar(place[None])[0][0]) > self._bore + 5.0 * _AT_TIP * depth


def _size(loaded: LoadedTooth, start: Float[Array, " 2"], tip: Float[Array, " 2"], refined: float) -> Size:
    module = 2.0 * abs(float(loaded.tooth.path.pinion_pitch_radius)) / abs(float(loaded.body.teeth))
    along = tip - start
    depth, root = float(np.hypot(*along)), float(loaded.tooth.root_radius)
    coarsest = min(_COARSEST * module, 0.25 * (root - float(loaded.body.bore_radius)))

    def size(place: Points) -> Float[Array, " point"]:
        on_line = np.clip((place - start) @ along / depth**2, 0.0, 1.0)
        from_crack = np.linalg.norm(place - (start + on_line[:, None] * along), axis=1)
        from_tip = np.linalg.norm(place - tip, axis=1)
        from_tooth = np.maximum(np.hypot(place[:, 0] - root, place[:, 1]) - _TOOTH * module, 0.0)
        sizes = (
            depth * _AT_TIP + _FROM_TIP * from_tip,
            min(_ALONG * depth, _ON_TOOTH * module) + _FROM_CRACK * from_crack,
            _ON_TOOTH * module + _FROM_TIP * from_tooth,
        )
        return np.minimum(np.minimum.reduce(sizes), coarsest) / refined

    return size


def _outline(loaded: LoadedTooth, upper: list[Points], fillet: Points, size: Size) -> Points:
    """Points of tooth and root circle, none of them twice; the fillet of the sound side by itself."""
    mirrored, sign = np.array([1.0, -1.0]), np.sign(float(loaded.tooth.root_radius))
    foot, tip = (abs(float(np.arctan2(sign * y, sign * x))) for x, y in (upper[0][0], upper[2][-1]))
    parts = [
        *(part[:-1] for part in upper),
        fillet[:-1] * mirrored,
        upper[2][:-1] * mirrored,
        _circle(sign * np.hypot(*upper[2][-1]), -tip, tip, size),
        _circle(sign * np.hypot(*upper[0][0]), foot, 2.0 * np.pi - foot, size)[1:-1],
    ]
    return np.concatenate(parts)


def _circle(radius: float, start: float, end: float, size: Size) -> Points:
    angle = np.linspace(start, end, 2000)
    return _spread(radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1), size)


def _cut_at(curve: Points, place: Float[Array, " 2"]) -> tuple[Points, Points]:
    """Both parts of a curve that passes through a place."""
    ahead = int(np.searchsorted(curve[:, 0], place[0]))
    return np.vstack([curve[:ahead], place]), np.vstack([place, curve[ahead:]])


def _spread(curve: Points, size: Size) -> Points:
    """Points along a curve, both ends included, as far from each other as the wished size."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    density = 1.0 / size(curve)
    number = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(length))])
    at = np.interp(np.linspace(0.0, number[-1], max(1, int(np.ceil(number[-1]))) + 1), number, length)
    return np.stack([np.interp(at, length, curve[:, k]) for k in range(2)], axis=-1)


def _quadtree(loaded: LoadedTooth, size: Size) -> Points:
    """Middles of squares that are as small as wished where they are."""
    reach = 1.1 * max(abs(float(loaded.tooth.tip_radius)), abs(float(loaded.body.bore_radius)))
    corners, width, middles = np.array([[-reach, -reach]]), 2.0 * reach, []
    for _ in range(_FINEST):
        middle = corners + width / 2.0
        small = size(middle) >= width
        middles.append(middle[small])
        width /= 2.0
        quarters = width * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
        corners = (corners[~small][:, None] + quarters).reshape(-1, 2)
    return np.concatenate(middles)


def _triangles(points: Points, shape: _Domain) -> NDArray[np.int64]:
    cells = Delaunay(points).simplices.astype(np.int64)
    a, b, c = (points[cells[:, k]] for k in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    longest = np.max([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return cells[shape.holds((a + b + c) / 3.0) & (np.abs(area) > 1e-9 * longest**2)]


def _opened(
    points: Points, cells: NDArray[np.int64], path: NDArray[np.int64]
) -> tuple[Points, NDArray[np.int64]]:
    """Give the triangles on one side of a straight path points of their own, but for its last one."""
    along = points[path[-1]] - points[path[0]]
    middle = points[cells].mean(axis=1) - points[path[0]]
    beyond = along[0] * middle[:, 1] - along[1] * middle[:, 0] > 0.0
    number = np.arange(len(points))
    number[path[:-1]] = len(points) + np.arange(len(path) - 1)
    both = np.concatenate([points, points[path[:-1]]])
    return both, np.where(beyond[:, None], number[cells], cells)


#: Places of the load along the flank, between which a spline interpolates.
_PLACES = 14


def solved_crack_compliance(
    loaded: LoadedTooth, material: MaterialData, width: float, r: Float[Array, " contact"], crack: Crack
) -> Float[Array, " contact"]:
    """Compliance (m/N) that a crack over the whole width adds, as `crack.crack_compliance` at its full depth.

    In plane strain, as `fem.gear`; of a helical tooth in the section normal to it. Raises InputError where
    the crack's tip leaves the body.
    """
    name = "crack-" + _digest(loaded, crack, material.poisson_ratio)

    def made() -> dict[str, Float[Array, "..."]]:
        with one_blas_thread():
            distance, added = added_compliance(loaded, cracked_mesh(loaded, crack), material.poisson_ratio)
        return {"distance": distance, "added": added}

    kept = arrays_kept_or_made("fem", name, made)
    distance, added = np.asarray(kept["distance"]), np.asarray(kept["added"])
    tooth_distance = np.asarray(r) if loaded.side == "pinion" else -np.asarray(r)
    order = np.argsort(distance)
    within = np.clip(tooth_distance, distance.min(), distance.max())
    return (
        CubicSpline(distance[order], added[order])(within)
        * thinning(loaded)
        / (material.youngs_modulus * width)
    )


def added_compliance(
    loaded: LoadedTooth, mesh: CrackedMesh, poisson_ratio: float
) -> tuple[Float[Array, " place"], Float[Array, " place"]]:
    """Distances r (the body's own, m) of loads on the flank, and what the crack adds, times E and width."""
    chosen = np.unique(np.linspace(0, len(mesh.flank) - 1, _PLACES).round().astype(int))
    points, distance = mesh.flank[chosen], mesh.distance[chosen]
    angle = loaded.contact(distance).load_angle
    loads = np.stack([-np.sin(angle), -np.cos(angle)])
    sound, cracked = (
        deflections(mesh, cells, points, loads, poisson_ratio) for cells in (mesh.sound, mesh.cracked)
    )
    return distance, cracked - sound


def deflections(
    mesh: CrackedMesh,
    cells: NDArray[np.int64],
    loaded: NDArray[np.int64],
    direction: Float[Array, "2 place"],
    poisson_ratio: float,
) -> Float[Array, " place"]:
    """Displacement of each of these points along a unit load there (2, place), by the triangles `cells`."""
    used, numbers = np.unique(cells, return_inverse=True)
    triangles = np.ascontiguousarray(numbers.reshape(cells.shape).T)
    basis = Basis(MeshTri(np.ascontiguousarray(mesh.points[used].T), triangles), ElementTriP2(), intorder=4)
    whole: Any = basis.mesh
    facets = whole.boundary_facets()
    on_bore = facets[np.all(np.isin(used[whole.facets[:, facets]], mesh.held), axis=0)]
    nodes = basis.get_dofs(facets=on_bore).all()
    free = np.setdiff1d(np.arange(2 * basis.N), np.concatenate([2 * nodes, 2 * nodes + 1]))
    of_vertices: Any = basis.nodal_dofs
    at = of_vertices[0, np.searchsorted(used, loaded)]
    forces = np.zeros((2 * basis.N, len(loaded)))
    np.put_along_axis(forces, np.stack([2 * at, 2 * at + 1]), direction, axis=0)
    stiffness = csc_matrix(plane_stiffness(basis, poisson_ratio))[free][:, free]
    solver = splu(
        stiffness, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True, "DiagPivotThresh": 0.0}
    )
    right = np.asfortranarray(forces[free])
    return np.sum(right * solver.solve(right), axis=0)


def _digest(loaded: LoadedTooth, crack: Crack, poisson_ratio: float) -> str:
    along = np.linspace(float(loaded.tooth.form_distance), float(loaded.tooth.tip_distance), 9)
    at = loaded.contact(along)
    numbers = [at.x, at.y, at.load_angle, loaded.tooth.root_radius, loaded.tooth.form_radius]
    numbers += [loaded.tooth.tip_radius, loaded.tooth.form_angle, loaded.tooth.corner_x]
    numbers += [loaded.tooth.corner_y, loaded.tooth.corner_radius, loaded.body.teeth]
    numbers += [loaded.body.bore_radius, thinning(loaded), *crack, poisson_ratio]
    return digest_of_numbers((__name__,), numbers)
