"""A box of plates with bearing bores, by finite elements, reduced to its bearing seats.

The box stands on y = 0 between 0 and its sizes; shafts run along z through bores in the two walls across it.
Twenty-node hexahedra, one through the thickness of a wall; about a bore the squares of the grid are drawn
onto circles.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, Literal, NamedTuple

import numpy as np
import scipy.sparse as sparse

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.craig_bampton import averaged, reduced, with_rigid_bores
from tribodyn.train.elastic.superelement import Radiation, SuperElement, modal_damping, sound

#: Half sides of the square about a bore, and of its hole, over the radius.
_AROUND, _HOLE = 1.6, 0.85
#: Thickest wall over the shortest side of the box: it is made of plates.
THICKEST = 0.25


class Bore(NamedTuple):
    """A bore with a bearing seat; m."""

    x: float
    y: float
    wall: Literal["front", "back"]  # at z = 0, or at the far end
    radius: float


class PlateMetal(NamedTuple):
    """What the walls are made of; by default grey cast iron EN-GJL-250 (EN 1561, annex A)."""

    youngs_modulus: float = 110e9  # Pa
    poisson_ratio: float = 0.26
    density: float = 7200.0  # kg/m³


class WholeBox(NamedTuple):
    """All of a box by finite elements: nodes with three displacements each, in their order."""

    places: Float[Array, "node 3"]
    stiffness: Any  # sparse
    mass: Any
    surface: Any  # ∫ n u n v dS over what is outside
    centres: Float[Array, "seat 3"]
    rings: list[Any]  # nodes of each bore
    bolted: Any  # nodes under the four corners, over a tenth of the sides


def whole_box(
    size: Sequence[float],
    thickness: float,
    bores: Mapping[str, Sequence[Any]],
    metal: PlateMetal = PlateMetal(),
    element_size: float | None = None,
) -> WholeBox:
    """The finite elements that `plate_housing` reduces; arguments and errors as there."""
    placed = {name: Bore(*bore) for name, bore in bores.items()}
    lengths = np.asarray(size, dtype=float)
    _check(lengths, thickness, placed)
    side = element_size or float(np.max(lengths)) / 6.0
    mesh = _box(lengths, thickness, list(placed.values()), side)
    places, stiffness, mass, surface = _assembled(mesh, metal)
    centres = np.array(
        [
            (bore.x, bore.y, thickness / 2.0 if bore.wall == "front" else lengths[2] - thickness / 2.0)
            for bore in placed.values()
        ]
    )
    rings = [
        _ring(places, bore, centre, thickness) for bore, centre in zip(placed.values(), centres, strict=True)
    ]
    corner = np.min([places[:, ::2], lengths[::2] - places[:, ::2]], axis=0) < 0.1 * lengths[::2]
    bolted = np.flatnonzero((places[:, 1] < 1e-9) & corner.all(axis=1))
    return WholeBox(places, stiffness, mass, surface, centres, rings, bolted)


def plate_housing(
    size: Sequence[float],
    thickness: float,
    bores: Mapping[str, Sequence[Any]],
    *,
    points: Mapping[str, Sequence[float]] | None = None,
    metal: PlateMetal = PlateMetal(),
    held: bool = True,
    rigid_bores: bool = False,
    highest: float = 3000.0,
    damping_ratio: float = 0.02,
    element_size: float | None = None,
) -> SuperElement:
    """Make the super-element of a box of plates.

    Parameters
    ----------
    size : of the box along x, y and z, m
    thickness : of all walls, m
    bores : seats by name: x, y (m), wall ("front" at z = 0, or "back") and radius (m); a seat's place is the
        middle of its wall
    points : names and places (m) of further points, each put on the nearest node: for sensors
    metal : elastic modulus, Poisson's ratio and density; by default grey cast iron's
    held : whether the bottom is bolted down at its four corners, over a tenth of the sides; else it is free
    rigid_bores : whether a bore stays round, as about a stiff bearing; else a seat moves as its mean
    highest : modes with fixed seats are kept up to this frequency, Hz
    damping_ratio : of all modes with free seats
    element_size : largest side of an element, m; by default a sixth of the longest side of the box

    Raises
    ------
    InputError
        For walls too thick for plates, bores outside their wall or too near to each other.
    """
    places, stiffness, mass, surface, centres, rings, bolted = whole_box(
        size, thickness, bores, metal, element_size
    )
    dofs = np.arange(3 * len(places)).reshape(-1, 3)
    count, fixed = stiffness.shape[0], dofs[bolted].ravel() if held else np.zeros(0, dtype=int)
    if rigid_bores:
        spread = with_rigid_bores(places, rings, dofs, centres)
        kept = np.setdiff1d(np.arange(count), np.concatenate([dofs[ring].ravel() for ring in rings]))
        spread = spread[:, np.concatenate([~np.isin(kept, fixed), np.ones(6 * len(rings), dtype=bool)])]
        seats = sparse.csr_matrix(sparse.eye(spread.shape[1]))[-6 * len(rings) :]
    else:
        free = np.setdiff1d(np.arange(count), fixed)
        spread = sparse.csc_matrix(sparse.eye(count))[:, free]
        rows = [averaged(places, ring, dofs, centre) for ring, centre in zip(rings, centres, strict=True)]
        seats = sparse.vstack(rows).tocsc()[:, free]
    left = reduced(spread.T @ stiffness @ spread, spread.T @ mass @ spread, seats, highest)
    basis_of_all = spread @ left.basis
    named = {name: np.asarray(place, dtype=float) for name, place in (points or {}).items()}
    nodes = [int(np.argmin(np.linalg.norm(places - place, axis=1))) for place in named.values()]
    recovery = basis_of_all[dofs[nodes]] if nodes else np.zeros((0, 3, basis_of_all.shape[1]))
    element = SuperElement(
        tuple(bores),
        centres,
        len(left.frequency),
        left.mass,
        left.stiffness,
        modal_damping(left.mass, left.stiffness, damping_ratio),
        tuple(named),
        recovery,
        Radiation(basis_of_all.T @ (surface @ basis_of_all)),
    )
    return sound(element)[0]


def _check(size: Float[Array, " 3"], thickness: float, bores: Mapping[str, Bore]) -> None:
    if not 0.0 < thickness <= THICKEST * float(np.min(size)):
        most = f"{THICKEST * float(np.min(size)):.4g} m"
        raise InputError(
            "thickness", thickness, "not a plate of such a box", f"use more than 0 and up to {most}"
        )
    for name, bore in bores.items():
        room = _AROUND * bore.radius + thickness
        if bore.wall not in ("front", "back"):
            raise InputError(f"bores.{name}.wall", bore.wall, "no such wall", 'use "front" or "back"')
        inside = all(room <= place <= length - room for place, length in zip(bore[:2], size[:2], strict=True))
        if not inside:
            rule = f"nearer to the edge of its wall than {room:.4g} m"
            raise InputError(f"bores.{name}", tuple(bore), rule, "move it, or make it smaller")
    for (one, a), (other, b) in (
        (i, j) for n, i in enumerate(bores.items()) for j in list(bores.items())[n + 1 :]
    ):
        apart = max(abs(a.x - b.x), abs(a.y - b.y))
        if a.wall == b.wall and apart < _AROUND * (a.radius + b.radius):
            least = _AROUND * (a.radius + b.radius)
            rule = f"{apart:.4g} m from {other}, and the mesh needs {least:.4g} m"
            raise InputError(f"bores.{one}", tuple(a), rule, "move it, or make it smaller")


def _lines(length: float, thickness: float, marks: Sequence[float], side: float) -> Float[Array, " line"]:
    """Lines of the grid along an axis: at the walls, at marks, and between them by the element's side."""
    ends = np.unique(np.round([0.0, thickness, length - thickness, length, *marks], 9))
    lines = [ends[:1]]
    for start, end in pairwise(ends):
        lines.append(np.linspace(start, end, max(1, int(np.ceil((end - start) / side))) + 1)[1:])
    return np.concatenate(lines)


def _box(size: Float[Array, " 3"], thickness: float, bores: Sequence[Bore], side: float) -> Any:
    from skfem import MeshHex

    marks = [
        [
            (bore.x, bore.y)[axis] + share * bore.radius
            for bore in bores
            for share in (-_AROUND, -_HOLE, 0.0, _HOLE, _AROUND)
        ]
        for axis in (0, 1)
    ]
    lines = [_lines(size[axis], thickness, marks[axis] if axis < 2 else (), side) for axis in range(3)]
    mesh = MeshHex.init_tensor(*lines)
    middle = mesh.p[:, mesh.t].mean(axis=1)
    inner = np.all((middle > thickness) & (middle < size[:, None] - thickness), axis=0)
    for bore in bores:
        at_wall = middle[2] < thickness if bore.wall == "front" else middle[2] > size[2] - thickness
        offset = np.abs(middle[:2] - np.array(bore[:2])[:, None]).max(axis=0)
        inner |= at_wall & (offset < _HOLE * bore.radius)
    mesh = mesh.remove_elements(np.flatnonzero(inner))
    places = mesh.p.copy()
    for bore in bores:
        wall = (
            places[2] <= thickness + 1e-9 if bore.wall == "front" else places[2] >= size[2] - thickness - 1e-9
        )
        away = places[:2] - np.array(bore[:2])[:, None]
        square = np.abs(away).max(axis=0)
        near = wall & (square < _AROUND * bore.radius) & (square > 1e-9)
        share = (square[near] / bore.radius - _HOLE) / (_AROUND - _HOLE)
        direction = away[:, near] / square[near]
        round_off = bore.radius / np.linalg.norm(direction, axis=0)
        scaled = (1.0 - share) * round_off + share * _AROUND * bore.radius
        places[:2, near] = np.array(bore[:2])[:, None] + direction * scaled
    return type(mesh)(places, mesh.t)


def _assembled(mesh: Any, metal: PlateMetal) -> tuple[Any, Any, Any, Any]:
    """Places of nodes, stiffness, mass, and ∫ n u n v dS over what is outside; three dofs to a node."""
    from skfem import Basis, ElementHexS2, FacetBasis
    from skfem.models.elasticity import lame_parameters

    basis = Basis(mesh, ElementHexS2(), intorder=4)
    value, weight = np.array([np.asarray(phi[0]) for phi in basis.basis]), basis.dx
    slope = np.array([phi[0].grad for phi in basis.basis])  # (function, direction, element, point)
    nodes, (functions, three, elements, _) = len(basis.doflocs.T), slope.shape
    lame, shear = lame_parameters(metal.youngs_modulus, metal.poisson_ratio)
    flat = np.moveaxis(slope, 2, 0).reshape(elements, functions * three, -1)
    both = (flat * weight[:, None]) @ flat.transpose(0, 2, 1)
    both = both.reshape(elements, functions, three, functions, three)
    along = np.einsum("eaibi->eab", both)[:, :, None, :, None] * np.eye(three)[None, None, :, None]
    stiffness = lame * both + shear * (both.transpose(0, 1, 4, 3, 2) + along)
    moved = np.einsum("aeq,beq,eq->eab", value, value, weight * metal.density)
    mass = moved[:, :, None, :, None] * np.eye(three)[None, None, :, None]
    ends = np.array([mesh.p.min(axis=1), mesh.p.max(axis=1)])
    facets = mesh.boundary_facets()
    middle = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    outside = facets[np.any(np.abs(middle - ends[:, :, None]) < 1e-9, axis=(0, 1))]
    shell = FacetBasis(mesh, ElementHexS2(), facets=outside, intorder=4)
    value = np.array([np.asarray(phi[0]) for phi in shell.basis])
    pushed = (value[:, None] * shell.normals[None]).transpose(2, 0, 1, 3)
    pushed = pushed.reshape(len(outside), functions * three, -1)
    surface = (pushed * shell.dx[:, None]) @ pushed.transpose(0, 2, 1)

    def whole(parts: Any, of: Any) -> Any:
        dofs = (three * of.element_dofs.T[:, :, None] + np.arange(three)).reshape(len(of.element_dofs.T), -1)
        size = dofs.shape[1]
        rows, columns = np.repeat(dofs, size, axis=1), np.tile(dofs, size)
        shape = (three * nodes, three * nodes)
        return sparse.csc_matrix((parts.ravel(), (rows.ravel(), columns.ravel())), shape)

    return basis.doflocs.T, whole(stiffness, basis), whole(mass, basis), whole(surface, shell)


def _ring(places: Any, bore: Bore, centre: Any, thickness: float) -> Any:
    """Nodes on the surface of a bore."""
    near = np.abs(places[:, 2] - centre[2]) < thickness / 2.0 + 1e-9
    distance = np.linalg.norm(places[:, :2] - centre[:2], axis=1)
    # middles of edges lie on the chords between nodes of the circle
    return np.flatnonzero(near & (distance < 1.001 * bore.radius))
