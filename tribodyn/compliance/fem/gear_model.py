"""Finite-element model of a gear: half a sector with the loads on its flank and what is read of them."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree
from skfem import Basis

from tribodyn.compliance.fem.cyclic_symmetry import HalfSector, half_sector
from tribodyn.compliance.fem.ring_mesh import SectorMesh, half_sector_mesh
from tribodyn.compliance.fem.strips import curved_basis
from tribodyn.errors import InputError
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth.tooth import Tooth, flank_point
from tribodyn.numerics.shapes import Array, Float

# Cells among which a point is sought, and Newton's steps in each: the cells are nearly parallelograms.
_NEAREST = 9
_NEWTON_STEPS = 8


class GearModel(NamedTuple):
    """Half a sector of the gear, y ≥ 0, in its tooth's frame."""

    basis: Basis  # of one component of the displacement
    half: HalfSector
    position: Float[Array, "2 vertex"]  # (2, M), vertices of the loaded flank, m
    #: (2 N, M), unit normal load on each of them; u and v of a node follow each other
    loads: Float[Array, "dof vertex"]
    #: (2 M, 2 N); rows that read the displacement along the load at the depth, then at twice the depth, below
    #: each
    inner: Float[Array, "reader dof"]
    #: (2 M,), whether these points lie on the other half, y < 0; their rows then read the mirror image
    beyond: NDArray[np.bool_]
    root_position: Float[Array, "2 root"]  # (2, 2 R + 1)
    #: (2 R + 1,), nodes along the root and where they are, in the order of `SectorMesh.root`
    root: NDArray[np.int64]


def gear_model(tooth: Tooth, teeth: int, bore_radius: float, depth: float, level: int) -> GearModel:
    """Mesh a gear; arguments and errors as those of `fem.gear_compliance`."""
    mesh = half_sector_mesh(tooth, teeth, bore_radius, level)
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
    position, root = mesh.nodes[:, mesh.flank], mesh.nodes[:, mesh.root]
    numbers = KDTree(basis.doflocs.T)
    near = numbers.query(position.T)[1]
    loads = np.zeros((2 * basis.N, position.shape[1]))
    np.put_along_axis(loads, np.stack([2 * near, 2 * near + 1]), direction, axis=0)
    below = position[:, None] + np.multiply.outer(direction, np.array([depth, 2.0 * depth])).swapaxes(1, 2)
    below = below.reshape(2, -1)
    beyond = below[1] < 0.0
    reflected = np.where(beyond, [[1.0], [-1.0]], 1.0)
    inner = _probes(basis, below * reflected, np.tile(direction, 2) * reflected)
    half = half_sector(basis.doflocs, teeth, bore_radius)
    along_root = np.asarray(numbers.query(root.T)[1])
    return GearModel(basis, half, position, loads, inner, beyond, root, along_root)


def _load_directions(tooth: Tooth, mesh: SectorMesh) -> Float[Array, "2 vertex"]:
    """Unit vectors (2, M) of the normal load on the flank's vertices, into the tooth."""
    reach = np.hypot(*mesh.nodes[:, mesh.flank])
    fine = np.linspace(tooth.form_distance, tooth.tip_distance, 2001)
    r = np.interp(reach, np.hypot(*flank_point(tooth, fine)), fine)
    # the load stands at α − ψ + φ to the perpendicular of the tooth's axis
    angle = kinematics(tooth.path, r).pressure_angle - tooth.half_angle + tooth.path.rotation(r)
    return np.stack([-np.sin(angle), -np.cos(angle)])


def _probes(
    basis: Basis, points: Float[Array, "2 point"], direction: Float[Array, "2 point"]
) -> Float[Array, "point dof"]:
    """Rows that take u and v to the components along the directions (2, P) at the points (2, P)."""
    cells, local = _locate(basis, points)
    rows = np.zeros((points.shape[1], basis.N, 2))
    for shape in range(basis.Nbfun):
        value = np.asarray(basis.elem.gbasis(basis.mapping, local, shape, tind=cells)[0])[:, 0]
        rows[np.arange(points.shape[1]), basis.element_dofs[shape, cells]] += (value * direction).T
    return rows.reshape(points.shape[1], -1)


def _locate(
    basis: Basis, points: Float[Array, "2 point"]
) -> tuple[NDArray[np.int64], Float[Array, "2 point 1"]]:
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
