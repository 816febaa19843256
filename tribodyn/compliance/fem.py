"""Plane-strain finite elements of a full gear, by the rotational symmetry of its ring.

Quadratic quadrilaterals (scikit-fem's ElementQuad2) on one sector a tooth. A load on one tooth is the sum
over the harmonics n = 0 … Z − 1 of loads on all teeth that differ by the phase 2πn/Z from tooth to tooth; for
each of these the displacement of a sector's one edge is that of the other, turned by 2π/Z and multiplied by
the phase, so that one sector stands for the ring (D. L. Thomas, Int. J. Numer. Meth. Engng 14 (1979) 81).
Nothing is neglected: the result is that of the full ring of Z sectors, held at its bore.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from scipy.spatial import KDTree
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, MeshQuad, MeshQuad2
from skfem.helpers import ddot, eye, sym_grad, trace

from tribodyn.compliance.gear_compliance import NEIGHBOURS, GearCompliance
from tribodyn.compliance.ring_mesh import SectorMesh, sector_mesh
from tribodyn.errors import InputError
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import Tooth, flank_point

Array = Any

# Cells among which a point is sought, and Newton's steps in each: the cells are nearly parallelograms.
_NEAREST = 9
_NEWTON_STEPS = 8


def elasticity(poisson_ratio: float) -> BilinearForm:
    """Strain energy's bilinear form in plane strain for unit Young's modulus."""
    shear = 0.5 / (1.0 + poisson_ratio)
    lame = poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio))

    @BilinearForm
    def form(u: Any, v: Any, _: Any) -> Any:
        strain = sym_grad(u)
        stress = 2.0 * shear * strain + lame * eye(trace(strain), 2)
        return ddot(stress, sym_grad(v))

    return form


def curved_basis(nodes: Array, cells: NDArray[np.int64]) -> Basis:
    """Basis of quadratic displacements on curved quadrilaterals of nine nodes, in `SectorMesh`'s order.

    The nodes' numbers do not survive; `Basis.doflocs` says where every displacement is.
    """
    corners, numbers = np.unique(cells[:4], return_inverse=True)
    straight = MeshQuad(np.ascontiguousarray(nodes[:, corners]), np.ascontiguousarray(numbers.reshape(4, -1)))
    order = Basis(straight, ElementQuad2()).element_dofs
    place = np.empty((2, int(order.max()) + 1))
    place[:, order] = nodes[:, cells]
    return Basis(MeshQuad2(place, straight.t), ElementVector(ElementQuad2()), intorder=5)


def gear_compliance(
    tooth: Tooth, teeth: int, bore_radius: float, poisson_ratio: float, depth: float, level: int
) -> GearCompliance:
    """Solve a gear of plain numbers for unit loads at every vertex of a flank.

    Parameters
    ----------
    tooth : Tooth
        As cut.
    teeth : int
        Number of teeth.
    bore_radius : float
        Where the body is held, m.
    poisson_ratio : float
        ν < 0.5.
    depth : float
        Depth below the flank at which the loaded tooth's displacement is read, m, as it is at twice that; a
        cell or more, so that the mesh resolves it.
    level : int
        Multiplies the number of cells in both directions.

    Raises
    ------
    InputError
        If the cells do not fit into a thin rim.
    """
    mesh = sector_mesh(tooth, teeth, bore_radius, level)
    basis = curved_basis(mesh.nodes, mesh.cells)
    mapping: Any = basis.mapping
    if not np.all(mapping.detDF(basis.X) > 0):
        raise InputError(
            "bore_radius",
            bore_radius,
            f"the rim under teeth with a root radius of {tooth.root_radius:.4g} m is too thin for the "
            "finite elements' mesh",
            "make the bore smaller, or the fillet rounder",
        )
    direction = _load_directions(tooth, mesh)
    positions = mesh.nodes[:, mesh.flank]
    _, near = KDTree(basis.doflocs[:, ::2].T).query(positions.T)  # x and y of a node follow each other
    nodes = np.stack([2 * near, 2 * near + 1])
    loads = np.zeros((basis.N, len(mesh.flank)))
    np.put_along_axis(loads, nodes, direction, axis=0)
    depths = np.array([depth, 2.0 * depth])
    below = positions[:, None] + np.multiply.outer(direction, depths).swapaxes(1, 2)
    inner = _probes(basis, below.reshape(2, -1), np.tile(direction, len(depths)))
    sectors = np.arange(-NEIGHBOURS, NEIGHBOURS + 1)
    read, own = _cyclic_solution(
        basis, teeth, bore_radius, poisson_ratio, loads, inner.reshape(len(depths), -1, basis.N), sectors
    )
    return GearCompliance(np.hypot(*positions), own, read, depth)


def _load_directions(tooth: Tooth, mesh: SectorMesh) -> Array:
    """Unit vectors (2, M) of the normal load on the flank's vertices, into the tooth."""
    reach = np.hypot(*mesh.nodes[:, mesh.flank])
    fine = np.linspace(tooth.form_distance, tooth.tip_distance, 2001)
    r = np.interp(reach, np.hypot(*flank_point(tooth, fine)), fine)
    # the load stands at α − ψ + φ to the perpendicular of the tooth's axis
    angle = kinematics(tooth.path, r).pressure_angle - tooth.half_angle + tooth.path.rotation(r)
    return np.stack([-np.sin(angle), -np.cos(angle)])


def _probes(basis: Basis, points: Array, direction: Array) -> Array:
    """Rows that take a displacement to its components along the directions (2, P) at the points (2, P)."""
    cells, local = _locate(basis, points)
    rows = np.zeros((points.shape[1], basis.N))
    for shape in range(basis.Nbfun):
        value = np.asarray(basis.elem.gbasis(basis.mapping, local, shape, tind=cells)[0])[:, :, 0]
        rows[np.arange(points.shape[1]), basis.element_dofs[shape, cells]] += np.sum(
            value * direction, axis=0
        )
    return rows


def _locate(basis: Basis, points: Array) -> tuple[NDArray[np.int64], Array]:
    """Curved cell of every point (2, P), and its place (2, P, 1) in the unit square of the cell.

    Newton's method in the nearest cells; of these the one counts whose square holds the point best.
    """
    mapping: Any = basis.mapping
    centre = mapping.F(np.full((2, 1), 0.5))[:, :, 0]
    _, near = KDTree(centre.T).query(points.T, k=_NEAREST)
    cells, target = near.ravel(), np.repeat(points, _NEAREST, axis=1)[:, :, None]
    local = np.full((2, len(cells), 1), 0.5)
    for _ in range(_NEWTON_STEPS):
        miss = target - mapping.F(local, cells)
        step = np.einsum("ijpq,jpq->ipq", mapping.invDF(local, cells), miss)
        local = np.clip(local + step, -1.0, 2.0)
    best = np.argmin(np.max(np.abs(local - 0.5), axis=0).reshape(-1, _NEAREST), axis=1)
    chosen = np.arange(len(best)) * _NEAREST + best
    return cells[chosen], local[:, chosen]


def _cyclic_solution(
    basis: Basis,
    teeth: int,
    bore_radius: float,
    poisson_ratio: float,
    loads: Array,
    inner: Array,
    sectors: NDArray[np.int64],
) -> tuple[Array, Array]:
    """Displacements along the loads on some sectors, and at the inner points of the loaded one.

    The sector is reduced to its two edges once; every harmonic is then a small dense system.
    """
    held, behind, ahead = _edges(basis, teeth, bore_radius)
    edges = np.concatenate([behind, ahead])
    rest = np.setdiff1d(np.arange(basis.N), np.concatenate([held, edges]))
    stiffness = elasticity(poisson_ratio).assemble(basis).tocsc()
    columns, rows = stiffness[:, edges], stiffness[edges]
    solver = splu(
        csc_matrix(stiffness[rest][:, rest]),
        permc_spec="MMD_AT_PLUS_A",
        options={"SymmetricMode": True, "DiagPivotThresh": 0.0},
    )
    by_edges, by_loads = _solved(solver, columns[rest].toarray()), _solved(solver, loads[rest])
    reduced = columns[edges].toarray() - rows[:, rest] @ by_edges
    passed_on = -rows[:, rest] @ by_loads

    count, (depths, positions) = loads.shape[1], inner.shape[:2]
    readers = np.concatenate([loads.T[:, rest], inner.reshape(depths * positions, -1)[:, rest]])
    alone, per_edge = readers @ by_loads, readers @ by_edges

    turn = 2.0 * np.pi / teeth
    cosine, sine = np.cos(turn), np.sin(turn)
    rotation = np.kron(np.eye(len(behind) // 2), [[cosine, -sine], [sine, cosine]])
    seen = np.zeros((len(sectors), *alone.shape))
    for harmonic in range(teeth // 2 + 1):
        tie = np.concatenate([np.eye(len(behind)), np.exp(1j * turn * harmonic) * rotation])
        edge = tie @ np.linalg.solve(tie.conj().T @ reduced @ tie, tie.conj().T @ passed_on)
        # harmonics n and Z − n are each other's conjugates
        weight = (1.0 if harmonic in (0, teeth / 2) else 2.0) / teeth
        phase = np.exp(1j * turn * harmonic * sectors)[:, None, None]
        seen += weight * np.real(phase * (alone - per_edge @ edge))
    own = seen[list(sectors).index(0), count:].reshape(depths, positions, count)
    return seen[:, :count], np.einsum("dmm->dm", own)


def _solved(solver: Any, right: Array) -> Array:
    # One side at a time: with many, SuperLU calls threaded BLAS on tiny blocks, ten times slower where
    # the cores are busy.
    return np.stack([solver.solve(np.ascontiguousarray(column)) for column in right.T], axis=-1)


def _edges(
    basis: Basis, teeth: int, bore_radius: float
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Displacements held at the bore, and those of the edges at −π/Z and +π/Z, without the bore, in step."""
    place = basis.doflocs[:, ::2]  # x and y of a node follow each other
    radius, angle = np.hypot(*place), np.arctan2(place[1], place[0])
    near = 1e-9 * bore_radius
    held = radius < bore_radius + near
    found = []
    for direction in (-np.pi / teeth, np.pi / teeth):
        edge = np.flatnonzero(~held & (radius * np.abs(angle - direction) < near))
        found.append(edge[np.argsort(radius[edge])])
    if not np.allclose(radius[found[0]], radius[found[1]], rtol=0.0, atol=near):
        raise RuntimeError("the two edges of the sector do not match")  # a fault of the mesh
    nodes = np.flatnonzero(held), found[0], found[1]
    both = [np.stack([2 * one, 2 * one + 1], axis=-1).ravel() for one in nodes]
    return both[0], both[1], both[2]
