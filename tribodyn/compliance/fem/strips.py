"""A prismatic body whose displacement runs like a cosine along it: finite strips, and stress at its surface.

With u, v = (U, V)(x, y) cos kz and w = W(x, y) sin kz the strains are

    ε_x = U_x, ε_y = V_y, γ_xy = U_y + V_x, ε_z = kW   (times cos kz)
    γ_xz = W_x − kU, γ_yz = W_y − kV                   (times sin kz)

and the energy per length, for k > 0 half of that at the crest, is a quadratic form in the section's U, V, W
(Y. K. Cheung, Finite Strip Method in Structural Analysis, Pergamon 1976; also E. L. Wilson, AIAA J. 3
(1965) 2269 for bodies of revolution). In powers of k it is K_0 + k K_1 + k² K_2, so that a mesh is assembled
once for all wave numbers. Planes z = 0 and z = nπ/k are planes of symmetry: free of shear, w = 0. At k = 0 U
and V are those of plane strain.

The root's surface is free, so the stress along the profile follows from the strains in the surface alone,

    σ = E/(1 − ν²) (ε_t + ν ε_z),   ε_t = t · ∂u/∂s,   ε_z = ∂w/∂z.

ε_t is taken at the two Gauss points of each quadratic edge, where the derivative of an interpolated
displacement is right to one order more than elsewhere (J. Barlow, Int. J. Numer. Meth. Engng 10 (1976) 243).
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix, kron
from skfem import Basis, BilinearForm, ElementQuad2, MeshQuad, MeshQuad2

from tribodyn.numerics.shapes import Array, Float

#: Components of the displacement per node: u, v, w.
COMPONENTS = 3


def curved_basis(nodes: Float[Array, "2 node"], cells: NDArray[np.int64]) -> Basis:
    """Basis of quadratic functions on curved quadrilaterals of nine nodes, in `SectorMesh`'s order.

    The nodes' numbers do not survive; `Basis.doflocs` says where every node of the basis is.
    """
    corners, numbers = np.unique(cells[:4], return_inverse=True)
    straight = MeshQuad(np.ascontiguousarray(nodes[:, corners]), np.ascontiguousarray(numbers.reshape(4, -1)))
    order = Basis(straight, ElementQuad2()).element_dofs
    place = np.empty((2, int(order.max()) + 1))
    place[:, order] = nodes[:, cells]
    return Basis(MeshQuad2(place, straight.t), ElementQuad2(), intorder=5)


def plane_stiffness(basis: Basis, poisson_ratio: float) -> csr_matrix:
    """Plane strain for unit Young's modulus; u and v of a node of `curved_basis` follow each other."""
    shear, lame = moduli(poisson_ratio)
    xx, xy, yy = (_assembled(basis, gradients(a, b)) for a, b in ((0, 0), (0, 1), (1, 1)))
    return csr_matrix(
        kron((lame + 2.0 * shear) * xx + shear * yy, _unit(2, 0, 0))
        + kron((lame + 2.0 * shear) * yy + shear * xx, _unit(2, 1, 1))
        + kron(lame * xy + shear * xy.T, _unit(2, 0, 1))
        + kron(lame * xy.T + shear * xy, _unit(2, 1, 0))
    )


def strip_stiffness(basis: Basis, poisson_ratio: float) -> tuple[csr_matrix, csr_matrix, csr_matrix]:
    """K_0, K_1 and K_2 for unit Young's modulus; u, v, w of a node of `curved_basis` follow each other.

    A load per length f cos kz at a node works on U and V with its amplitude f.
    """
    shear, lame = moduli(poisson_ratio)
    plane: Any = plane_stiffness(basis, poisson_ratio)
    nodes = plane.shape[0] // 2
    in_plane = csr_matrix((np.ones(2), ([0, 1], [0, 1])), shape=(2, COMPONENTS))
    widen = kron(csr_matrix((np.ones(nodes), (range(nodes), range(nodes)))), in_plane).tocsr()
    laplace = sum(_assembled(basis, gradients(a, a)) for a in (0, 1))
    constant = widen.T @ plane @ widen + shear * kron(laplace, _unit(COMPONENTS, 2, 2))

    linear: Any = 0
    for axis in (0, 1):
        mixed = _assembled(basis, value_and_gradient(axis))
        to_w = kron(lame * mixed - shear * mixed.T, _unit(COMPONENTS, 2, axis))
        linear = linear + to_w + to_w.T
    mass = _assembled(basis, BilinearForm(lambda u, v, _: u * v))
    square = kron(mass, np.diag([shear, shear, lame + 2.0 * shear]))
    return csr_matrix(constant), csr_matrix(linear), csr_matrix(square)


def gradients(first: int, second: int) -> BilinearForm:
    """∫ v_,first u_,second of test function v and trial function u."""
    return BilinearForm(lambda u, v, _: v.grad[first] * u.grad[second])


def value_and_gradient(axis: int) -> BilinearForm:
    """∫ v u_,axis of test function v and trial function u."""
    return BilinearForm(lambda u, v, _: v * u.grad[axis])


def _assembled(basis: Basis, form: BilinearForm) -> csr_matrix:
    return csr_matrix(form.assemble(basis))


def moduli(poisson_ratio: float) -> tuple[float, float]:
    """Shear modulus and Lamé's first constant for unit Young's modulus."""
    return (
        0.5 / (1.0 + poisson_ratio),
        poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
    )


def _unit(size: int, row: int, column: int) -> Float[Array, "size size"]:
    matrix = np.zeros((size, size))
    matrix[row, column] = 1.0
    return matrix


_GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)
# Shape functions of an edge's nodes at these points.
_SHAPE = np.stack([_GAUSS * (_GAUSS - 1) / 2, 1 - _GAUSS**2, _GAUSS * (_GAUSS + 1) / 2])


def edge_points(place: Float[Array, "2 node"]) -> Float[Array, "2 point"]:
    """Points (2, 2 R), m, at which `stress_rows` reads, of the boundary's nodes (2, 2 R + 1)."""
    return np.einsum("dne,ng->deg", _by_edge(place), _SHAPE).reshape(2, -1)


def stress_rows(
    place: Float[Array, "2 node"], nodes: NDArray[np.int64], size: int, poisson_ratio: float, k: float
) -> Float[Array, "point dof"]:
    """Rows (2 R, dof) that take amplitudes of the displacement to the stress's, for unit Young's modulus.

    `place` (m) and `nodes` are of the corner and middle nodes of R quadratic edges that follow each other;
    u, v and w of a node follow each other in the `size` degrees of freedom; k is in rad/m.
    """
    slope = np.stack([_GAUSS - 0.5, -2 * _GAUSS, _GAUSS + 0.5])
    tangent = np.einsum("dne,ng->deg", _by_edge(place), slope)
    stretch = slope[None, :, None] * (tangent / np.sum(tangent**2, axis=0))[:, None]  # (2, node, edge, point)
    along = np.broadcast_to(poisson_ratio * k * _SHAPE[:, None], stretch.shape[1:])
    values = np.stack([*stretch, along]) / (1.0 - poisson_ratio**2)
    edges = values.shape[2]
    rows = np.zeros((edges, 2, size))
    for node in range(3):
        for component in range(3):
            at = 3 * nodes[node : node + 2 * edges - 1 : 2] + component
            rows[np.arange(edges), :, at] += values[component, node]
    return rows.reshape(2 * edges, size)


def edge_parameters(edges: int, refined: int) -> Float[Array, " point"]:
    """Where the points stand, in edges from the first one's beginning, when each is cut into `refined`."""
    return (np.arange(edges * refined)[:, None] + (1.0 + _GAUSS) / 2.0).ravel() / refined


def edge_values(corners: NDArray[np.int64], size: int) -> Float[Array, "point size"]:
    """Rows (2 R, size) that take values at R + 1 corners to the same points, linearly on each edge."""
    rows = np.zeros((len(corners) - 1, 2, size))
    edges = np.arange(len(corners) - 1)
    rows[edges, :, corners[:-1]] = (1.0 - _GAUSS) / 2.0
    rows[edges, :, corners[1:]] = (1.0 + _GAUSS) / 2.0
    return rows.reshape(-1, size)


def _by_edge(place: Float[Array, "2 node"]) -> Float[Array, "2 3 edge"]:
    """Nodes (2, 3, R) of every edge."""
    return np.stack([place[:, :-2:2], place[:, 1::2], place[:, 2::2]], axis=1)
