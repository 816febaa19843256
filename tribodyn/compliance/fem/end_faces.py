"""Free end faces of a prismatic body, from its displacements that run like cosines along it.

The harmonics of `strips` hold the end faces z = 0 and z = b: w = 0 there. A free face opens. Where w is d_0
at z = 0 and d_b at z = b, its derivative along z has the cosines k W_n + (c_n/b) d with d = ±d_b − d_0, + for
even and − for odd n, c_0 = 1, c_n = 2, k = nπ/b; all other strains are those of the harmonics. So an opening
d(x, y) loads each harmonic like an eigenstrain, with the same amplitude in all of one parity:

    K_n a_n = p q_n − (c_n/b) F_n d,   Fᵀ a = ∫ φ σ_z of the amplitudes a,

and the potential is a minimum where the faces carry nothing,

    Σ_n (c_n/b) S_n d = −Σ_n r_n q_n,   S_n = D − F_nᵀ K_n⁻¹ F_n,   r_n = F_nᵀ K_n⁻¹ p,

D the stiffness of the opening by itself, r_n the stress that a load q_n cos kz makes on the faces while they
are held. Even and odd harmonics, displacements alike and opposite in both halves of the width, have a d each.
The load's place then deflects by (c_m/b) r_mᵀ (Σ (c/b) S)⁻¹ r_n q_n more in every harmonic m of n's parity,
and the work of a load is never less. In the middle of a long body, and for a uniform load where Poisson's
ratio is 0, that is nothing. S_n falls like k⁻⁴ where the opening changes slowly against k along the section,
so that the sum is short. (This is the method of displacement discontinuities, S. L. Crouch, Int. J. Numer.
Meth. Engng 10 (1976) 301, on the body and its mirror images.)
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_matrix, kron
from skfem import Basis, BilinearForm, ElementQuad1

from tribodyn.compliance.fem.lead_harmonics import spline_weights
from tribodyn.compliance.fem.strips import COMPONENTS, moduli, value_and_gradient
from tribodyn.numerics.shapes import Array, Float

# Beyond the largest wave number the sum goes on by its power law to this many times that.
_TAIL = 8.0


class Openings(NamedTuple):
    """Openings of a section's end face, 1 at one corner of its cells each; unit Young's modulus.

    Attributes
    ----------
    place : (2, J), m
    constant, linear : sparse (dof, J)
        F = constant + k linear; u, v, w of a node of the section's basis follow each other.
    stiffness : (J, J), D
    """

    place: Float[Array, "2 opening"]
    constant: csr_matrix
    linear: csr_matrix
    stiffness: Float[Array, "opening opening"]

    def forces(self, wave_number: float) -> Float[Array, "dof opening"]:
        """F (dof, J) at the wave number k, rad/m."""
        return (self.constant + wave_number * self.linear).toarray()


def openings(basis: Basis, poisson_ratio: float) -> Openings:
    """Openings that are bilinear in the cells of `strips.curved_basis`."""
    shear, lame = moduli(poisson_ratio)
    face = Basis(basis.mesh, ElementQuad1(), mapping=basis.mapping, intorder=5)
    mass = BilinearForm(lambda u, v, _: u * v)
    # rows are the body's shape functions: ∫ φ ∂v is the transpose of ∫ v ∂φ with the roles exchanged
    across = [csr_matrix(value_and_gradient(axis).assemble(basis, face)).T for axis in (0, 1)]
    columns = [csr_matrix(([1.0], ([axis], [0])), shape=(COMPONENTS, 1)) for axis in range(COMPONENTS)]
    in_plane: Any = sum(kron(lame * part, column) for part, column in zip(across, columns[:2], strict=True))
    along = kron((lame + 2.0 * shear) * csr_matrix(mass.assemble(face, basis)), columns[2])
    stiffness = (lame + 2.0 * shear) * csr_matrix(mass.assemble(face)).toarray()
    return Openings(face.doflocs, csr_matrix(in_plane), csr_matrix(along), stiffness)


def parity_weights(solved: Float[Array, " wave"], width: float) -> Float[Array, "2 wave"]:
    """Weights (2, K) with which S at the wave numbers solved add up over the even and the odd harmonics.

    Parameters
    ----------
    solved : (K,), wave numbers of `lead_harmonics.wave_numbers`, rad/m
    width : b, m
    """
    step, largest = np.pi / width, solved[-1]
    number = np.arange(int(_TAIL * largest / step) + 3)
    wave_number = number * step
    beyond = wave_number > largest
    weights = spline_weights(solved, np.minimum(wave_number, largest))
    weights = weights * np.where(beyond, (largest / np.maximum(wave_number, step)) ** 4, 1.0)[:, None]
    counted = weights * np.where(number > 0, 2.0, 1.0)[:, None] / width
    return np.stack([np.sum(counted[parity::2], axis=0) for parity in (0, 1)])
