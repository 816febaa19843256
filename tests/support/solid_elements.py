"""Rectangles in nine-node cells, and the strain energy of solid elements to compare strips with."""

import numpy as np
from skfem import BilinearForm
from skfem.helpers import ddot, eye, sym_grad, trace

from tribodyn.compliance.fem.strips import curved_basis

#: Of a body of unit modulus.
POISSON = 0.3
SHEAR, LAME = 0.5 / (1 + POISSON), POISSON / ((1 + POISSON) * (1 - 2 * POISSON))


def plate(columns, rows, length, height):
    """Basis of a rectangle 0 < x < length, |y| < height/2."""
    x, y = np.meshgrid(
        np.linspace(0, length, 2 * columns + 1),
        np.linspace(-height / 2, height / 2, 2 * rows + 1),
        indexing="ij",
    )
    number = np.arange(x.size).reshape(x.shape)
    around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]
    cells = [number[i : 2 * columns - 1 + i : 2, j : 2 * rows - 1 + j : 2].ravel() for i, j in around]
    return curved_basis(np.stack([x.ravel(), y.ravel()]), np.stack(cells))


def node_at(places, *point):
    return int(np.argmin(np.sum((places - np.array(point)[:, None]) ** 2, axis=0)))


@BilinearForm
def solid_energy(u, v, _):
    stress = 2 * SHEAR * sym_grad(u) + LAME * eye(trace(sym_grad(u)), 3)
    return ddot(stress, sym_grad(v))
