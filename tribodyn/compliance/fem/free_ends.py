"""What free end faces add to the deflection of a gear's flanks and roots.

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

The openings of all teeth's end faces differ by a phase from tooth to tooth, like the loads
(`cyclic_symmetry`); the face of a sector is two halves that meet on the tooth's axis. By reciprocity the
stress that a load makes on a held face is also what an opening moves the flank by.
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.sparse import csr_matrix, kron
from scipy.spatial import KDTree
from skfem import Basis, BilinearForm, ElementQuad1

from tribodyn.compliance.fem.cyclic_symmetry import Ring, reduced_ring
from tribodyn.compliance.fem.gear import GearModel, gear_model
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, ElasticGear, FreeEnds, spline_weights
from tribodyn.compliance.fem.ring_mesh import signed_polar
from tribodyn.compliance.fem.strips import (
    COMPONENTS,
    edge_parameters,
    edge_values,
    moduli,
    stress_rows,
    strip_stiffness,
    value_and_gradient,
)
from tribodyn.numerics.processes.work import part, steps
from tribodyn.numerics.shapes import Array, Complex, Float

# Beyond the largest wave number the sum goes on by its power law to this many times that.
_TAIL = 8.0


class Openings(NamedTuple):
    """Openings of a section's end face, 1 at one corner of its cells each; unit Young's modulus."""

    place: Float[Array, "2 opening"]  # (2, J), m
    #: constant, linear: (dof, J); F = constant + k linear; u, v, w of a node of the section's basis follow
    #: each other
    constant: csr_matrix
    linear: csr_matrix
    stiffness: Float[Array, "opening opening"]  # (J, J), D

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

    The wave numbers (rad/m) are those of `gear_compliance.wave_numbers`, the width b is in m.
    """
    step, largest = np.pi / width, solved[-1]
    number = np.arange(int(_TAIL * largest / step) + 3)
    wave_number = number * step
    beyond = wave_number > largest
    weights = spline_weights(solved, np.minimum(wave_number, largest))
    weights = weights * np.where(beyond, (largest / np.maximum(wave_number, step)) ** 4, 1.0)[:, None]
    counted = weights * np.where(number > 0, 2.0, 1.0)[:, None] / width
    return np.stack([np.sum(counted[parity::2], axis=0) for parity in (0, 1)])


#: Refinement of the mesh. On a sector, twice as fine a one adds 2 % to what the ends are worth to the last of
#: ten slices, and 0.2 % elsewhere.
LEVEL = 1
_SECTORS = np.arange(-NEIGHBOURS, NEIGHBOURS + 1)


class EndFace(NamedTuple):
    """End face of a gear: how the openings of a sector's two halves hang together."""

    openings: Openings  # of the half y > 0
    #: upper, lower: (J, O); openings of both halves in terms of those that are free; the lower half's are
    #: mirror images
    upper: Float[Array, "half free"]
    lower: Float[Array, "half free"]
    #: (J, O), part of `lower` on the edge, to be taken times the conjugate phase
    ahead: Float[Array, "half free"]

    def joined(self, phase: complex) -> Complex[Array, "both free"]:
        """Openings (2 J, O) of both halves."""
        return np.concatenate([self.upper, self.lower + np.conjugate(phase) * self.ahead])


class Harmonic(NamedTuple):
    """Ring under openings and flank loads of one wave number.

    Its readers are the stress on the face of the upper half and of the lower half, then the stress along the
    root of the upper half and of the lower half.
    """

    ring: Ring
    stiffness: Float[Array, "opening opening"]  # (J, J): of the openings by themselves
    on_root: Float[Array, "point opening"]  # (P, J): stress along the root that is theirs alone


def free_ends(gear: ElasticGear, wave_number: Float[Array, " wave"], width: float) -> FreeEnds:
    """Solve a gear of the width b (m) for its end faces.

    `wave_number` (K,) of `gear_compliance.wave_numbers` up to `LARGEST_AT_ENDS`/module, rad/m. The gear's
    level is that of the root's points at which the stress is wanted; the elements are those of `LEVEL`.
    """
    model, poisson_ratio = gear_model(gear._replace(level=LEVEL)), gear.poisson_ratio
    opening = openings(model.basis, poisson_ratio)
    matrices = strip_stiffness(model.basis, poisson_ratio)
    weights = parity_weights(np.asarray(wave_number), width)
    count, flank = len(wave_number), model.loads.shape[1]
    roots = 2 * (len(model.root) // 2)
    flanks = np.zeros((2, len(_SECTORS), count * flank, count * flank))
    stress = np.zeros((2, len(_SECTORS), count * 2 * roots, count * flank))
    for support, ring_phases in model.half.supports():
        supported = model._replace(half=support)
        face = face_of(supported, opening)
        with part(0.0, 0.4):
            harmonics = [
                harmonic_of(supported, opening, matrices, poisson_ratio, k) for k in steps(wave_number)
            ]
        with part(0.4, 1.0):
            for phase, weight in steps(ring_phases):
                held, reached, seen = at_phase(harmonics, face, phase)
                turns = weight * phase ** _SECTORS[:, None, None]
                for parity in (0, 1):
                    stiffness = np.tensordot(weights[parity], held, 1)
                    opened = np.linalg.solve(stiffness, reached)
                    flanks[parity] += np.real(turns * (reached.conj().T @ opened))
                    stress[parity] += np.real(turns * (seen @ opened))
    flanks = flanks.reshape(2, -1, count, flank, count, flank).transpose(0, 2, 4, 1, 3, 5)
    stress = stress.reshape(2, -1, count, 2, roots, count, flank).transpose(0, 2, 5, 1, 3, 4, 6)
    edges = roots // (2 * LEVEL)
    between_points = CubicSpline(edge_parameters(edges, LEVEL), np.eye(roots))
    along = between_points(edge_parameters(edges, gear.level))
    return FreeEnds(
        wave_number=np.asarray(wave_number, dtype=float),
        radius=signed_polar(model.position, gear.teeth)[0],
        own=np.einsum("pklmm->pklm", flanks[:, :, :, NEIGHBOURS]).copy(),
        between=flanks,
        root_stress=np.einsum("qr,...rm->...qm", along, stress),
    )


def face_of(model: GearModel, opening: Openings) -> EndFace:
    """Openings vanish where the body is held, are one on the axis and follow each other on the edges."""
    half, nodes = model.half, KDTree(model.basis.doflocs.T)
    number = np.asarray(nodes.query(opening.place.T)[1])
    free = ~np.isin(number, half.held)
    axis, edge = np.isin(number, half.axis), np.isin(number, half.edge)
    unit = np.eye(len(number))
    antisymmetric, shared = unit[:, free], unit[:, free & ~axis & ~edge]
    none = np.zeros_like(shared)
    return EndFace(
        opening,
        np.hstack([antisymmetric, none]),
        np.hstack([antisymmetric * axis[:, None], shared]),
        np.hstack([antisymmetric * edge[:, None], none]),
    )


def harmonic_of(
    model: GearModel,
    opening: Openings,
    matrices: tuple[csr_matrix, csr_matrix, csr_matrix],
    poisson_ratio: float,
    wave_number: float,
) -> Harmonic:
    """Reduce the ring under a wave number, rad/m, with the three matrices of `strip_stiffness`."""
    k = float(wave_number)
    stiffness = csr_matrix(matrices[0] + k * matrices[1] + k**2 * matrices[2])
    forces = opening.forces(k)
    loads = np.zeros((len(forces), model.loads.shape[1]))
    for component in (0, 1):
        loads[component::COMPONENTS] = model.loads[component::2]
    root = stress_rows(model.root_position, model.root, len(forces), poisson_ratio, k)
    readers = np.concatenate([forces.T, forces.T, root, root])
    lower = np.repeat([False, True, False, True], [len(forces.T)] * 2 + [len(root)] * 2)
    ring = reduced_ring(model.half, stiffness, np.hstack([forces, loads]), readers, lower)
    corners = model.basis.doflocs[:, model.root[::2]]
    near = np.asarray(KDTree(opening.place.T).query(corners.T)[1])
    on_root = edge_values(near, opening.place.shape[1]) * poisson_ratio / (1.0 - poisson_ratio**2)
    return Harmonic(ring, opening.stiffness, on_root)


def at_phase(
    harmonics: list[Harmonic], face: EndFace, phase: complex
) -> tuple[Complex[Array, "wave free free"], Complex[Array, "free load"], Complex[Array, "reading free"]]:
    """S (K, O, O); stress on the held faces per flank load (O, K M); on the roots per opening (K 2 P, O)."""
    joined = csr_matrix(face.joined(phase))  # two entries per row at most
    gathered = joined.conj().T
    held, reached, seen = [], [], []
    for harmonic in harmonics:
        count, roots = len(harmonic.stiffness), len(harmonic.on_root)
        reading = harmonic.ring.at_phase(phase)
        reading, by_load = reading[:, :count], reading[: 2 * count, count:]
        conjugate = reading.conj()
        # what the lower half's openings do is the mirror image, with the conjugate phase, of the upper's
        strain = np.block(
            [
                [harmonic.stiffness - reading[:count], -conjugate[count : 2 * count]],
                [-reading[count : 2 * count], harmonic.stiffness - conjugate[:count]],
            ]
        )
        held.append(gathered @ (strain @ joined))
        reached.append(gathered @ by_load)
        upper, lower = reading[2 * count : 2 * count + roots], reading[2 * count + roots :]
        mirrored = conjugate[2 * count : 2 * count + roots], conjugate[2 * count + roots :]
        stress = np.block([[upper - harmonic.on_root, mirrored[1]], [lower, mirrored[0] - harmonic.on_root]])
        seen.append(stress @ joined)
    return np.stack(held), np.hstack(reached), np.concatenate(seen)
