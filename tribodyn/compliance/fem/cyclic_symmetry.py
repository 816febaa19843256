"""A ring of equal mirror-symmetric sectors under loads on one of them, from half a sector.

A load on one tooth is the sum over the harmonics n = 0 … Z − 1 of loads on all teeth that differ by the
phase 2πn/Z from tooth to tooth; for each of these the displacement of a sector's one edge is that of the
other, turned by 2π/Z and multiplied by the phase, so that one sector stands for the ring (D. L. Thomas, Int.
J. Numer. Meth. Engng 14 (1979) 81). The sector itself is its half y ≥ 0 and the mirror image, and a
displacement the sum of one that is its own mirror image and one that is the negative of it: two problems of
half the size. Nothing is neglected: the result is that of the full ring.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm

from tribodyn.compliance.fem.ring_mesh import signed_polar
from tribodyn.numerics.processes.work import steps
from tribodyn.numerics.shapes import Array, Complex, Float

# A ring that nothing but its inertia holds: what its rotation and shift take off a deflection.
#
# Of a load f, f − M φ (φᴴ f)/(φᴴ M φ) excites no rigid motion φ, M the mass; the rest accelerates the ring. A
# reading counts from the mean motion, weighted by M, and loses the same. So with G the response of the ring
# held at its bore, where such loads leave no torque and no force, and b = M φ/(φᴴ M φ)
#
#     G_free = (1 − φ bᴴ) G (1 − b φᴴ).
#
# Of loads that differ by a phase from sector to sector (`cyclic_symmetry`) order 0 turns the ring and order 1
# shifts it, with φ = (1, i) in every sector's own frame; all other orders leave it at rest.


# What mirroring does to rotation and shift along x and y; how much of each moves in orders 0 and 1.
_MIRROR = np.array([-1.0, 1.0, -1.0])
_MOTION = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 1.0j]])


class Inertia(NamedTuple):
    """Rigid motions of half a sector, y ≥ 0, in plane: rotation (per rad), shift along x and y."""

    motion: Float[Array, "dof 3"]  # u and v of a node follow each other
    momentum: Float[Array, "dof 3"]  # mass times motion, for unit density


def inertia_of(basis: Basis) -> Inertia:
    """Inertia of a half sector, with the nodes of `strips.curved_basis`."""
    mass = csr_matrix(BilinearForm(lambda u, v, _: u * v).assemble(basis))
    x, y = basis.doflocs
    motion = np.zeros((basis.N, 2, 3))
    motion[:, 0, 0], motion[:, 1, 0] = -y, x
    motion[:, 0, 1] = motion[:, 1, 2] = 1.0
    momentum = np.stack([mass @ motion[:, component] for component in (0, 1)], axis=1)
    return Inertia(motion.reshape(-1, 3), momentum.reshape(-1, 3))


def relieved(
    order: int,
    reading: Complex[Array, "reader load"],
    opposite: Complex[Array, "reader load"],
    inertia: Inertia,
    loads: Float[Array, "dof load"],
    readers: Float[Array, "reader dof"],
    mirrored: NDArray[np.bool_],
) -> Complex[Array, "kept_reader kept_load"]:
    """Readings of the free ring, of those of the held one at the phase of an order.

    The last three loads, and readers, are the half's momentum; what is returned has them no more. `opposite`
    are the readings with all readers on the other half.
    """
    readings, across = np.s_[:-3], np.s_[-3:]
    if order >= len(_MOTION):
        return reading[readings, readings]
    motion = _MOTION[order]
    # a load on the other half does to a reader what the mirrored load does to the mirrored reader, with the
    # conjugate phase
    both = reading[:, across] + opposite[:, across].conj() * _MIRROR
    flipped = opposite[across, across] + reading[across, across].conj() * _MIRROR
    moved = reading[across, readings] + _MIRROR[:, None] * opposite[across, readings]
    inner = motion.conj() @ (both[across] + _MIRROR[:, None] * flipped) @ motion
    mass = 2.0 * np.einsum("dk,dk,k->", inertia.motion, inertia.momentum, np.abs(motion) ** 2)
    force = motion.conj() @ (inertia.motion.T @ loads[:, readings]) / mass
    side = np.where(mirrored[readings, None], _MIRROR, 1.0)
    shift = (readers[readings] @ inertia.motion * side) @ motion
    return (
        reading[readings, readings]
        - np.outer(both[readings] @ motion, force)
        - np.outer(shift, motion.conj() @ moved / mass - inner / mass * force)
    )


_SIDES = 4  # right-hand sides solved at a time


class HalfSector(NamedTuple):
    """Nodes of half a sector between its axis of symmetry (the x axis) and its edge at the angle π/Z."""

    teeth: int  # Z, number of sectors; negative of an internal gear, as its radii and angles
    nodes: int  # number of all nodes
    held: NDArray[np.int64]  # nodes that do not move
    axis: NDArray[np.int64]  # nodes on the axis of symmetry
    edge: NDArray[np.int64]  # nodes on the edge that are not held
    #: the same with nothing held, for all harmonics but those that move the ring as a whole (n = 0, 1); None:
    #: held in all of them
    free: "HalfSector | None" = None

    def supports(self) -> list[tuple["HalfSector", list[tuple[complex, float]]]]:
        """Half sectors as they are held, each with the `phases` of the harmonics for which it counts."""
        harmonics = phases(self.teeth)
        if self.free is None:
            return [(self, harmonics)]
        return [(self, harmonics[:2]), (self.free, harmonics[2:])]


class ReducedSector(NamedTuple):
    """Half a sector of one symmetry as seen from its edge: what loads and edge do to the readers."""

    stiffness: Float[Array, "edge edge"]  # (edge, edge)
    #: (edge, load): forces of the loads on the edge, those that the half passes on included
    passed_on: Float[Array, "edge load"]
    alone: Float[Array, "reader load"]  # (reader, load) with the edge held
    per_edge: Float[Array, "reader edge"]  # (reader, edge): reading is alone − per_edge @ edge


def half_sector(
    place: Float[Array, "2 node"], teeth: int, bore_radius: float, free: bool = False
) -> HalfSector:
    """Find the special nodes among the places (2, nodes); `free`: the bore is held as a whole only."""
    radius, angle = signed_polar(place, teeth)
    near = 1e-9 * abs(bore_radius)
    axis, edge = np.abs(place[1]) < near, np.abs(radius * (angle - np.pi / teeth)) < near

    def with_held(held: NDArray[np.bool_], other: HalfSector | None) -> HalfSector:
        on_axis, on_edge = np.flatnonzero(~held & axis), np.flatnonzero(~held & edge)
        return HalfSector(teeth, place.shape[1], np.flatnonzero(held), on_axis, on_edge, other)

    held = radius < bore_radius + near
    return with_held(held, with_held(np.zeros_like(held), None) if free else None)


class Ring(NamedTuple):
    """A ring under loads that differ by a phase from sector to sector, reduced to the sectors' edges.

    Of L loads on the half y > 0 of a sector, R readers, and E components on an edge.
    """

    alone: Float[Array, "reader load"]  # (R, L): readings with the edges held
    within: Float[Array, "edge edge"]  # (E, E): stiffness of an edge's two sides
    across: Float[Array, "edge edge"]  # (E, E): of one edge of a sector against the other
    #: (E, L): of the loads on the sector's edge at +π/Z, with what it passes on to it
    force_ahead: Float[Array, "edge load"]
    force_behind: Float[Array, "edge load"]  # (E, L): to that at −π/Z
    read_ahead: Float[Array, "reader edge"]  # (R, E): what the edges take off the readings
    read_behind: Float[Array, "reader edge"]

    def at_phase(self, phase: complex) -> Complex[Array, "reader load"]:
        """Readings (R, L), complex, in sector 0 of loads that are `phase` times those one sector before."""
        z, back = phase, np.conjugate(phase)
        edge = np.linalg.solve(
            self.within + z * self.across + back * self.across.T, back * self.force_ahead + self.force_behind
        )
        return self.alone - (z * self.read_ahead + self.read_behind) @ edge


def reduced_ring(
    half: HalfSector,
    stiffness: Any,
    loads: Float[Array, "dof load"],
    readers: Float[Array, "reader dof"],
    mirrored: NDArray[np.bool_],
) -> Ring:
    """Reduce a ring to its sectors' edges; of `reduced_rings` the first."""
    return reduced_rings(half, stiffness, loads, readers, mirrored)[0]


def reduced_rings(
    half: HalfSector,
    stiffness: Any,
    loads: Float[Array, "dof load"],
    readers: Float[Array, "reader dof"],
    mirrored: NDArray[np.bool_],
) -> tuple[Ring, Ring]:
    """Reduce a ring to its sectors' edges: with these readers, and with all of them on the other half.

    The stiffness (dof, dof) is the half sector's; 2 or 3 components of the displacement follow each other at
    a node: u, v[, w]. Loads (dof, load) are on the half y > 0 of sector 0; readers (reader, dof) take the
    half's displacements to what is read; those that are mirrored (reader,) look at the mirror image of the
    half: they read, at y < 0, what their row says of the reflected displacement.
    """
    components = stiffness.shape[0] // half.nodes
    even, odd = (_reduced(half, stiffness, loads, readers, components, symmetry) for symmetry in (1, -1))
    side = np.where(mirrored, -1.0, 1.0)[:, None]
    return _joined(half, even, odd, components, side), _joined(half, even, odd, components, -side)


def _joined(
    half: HalfSector, even: ReducedSector, odd: ReducedSector, components: int, side: Float[Array, "reader 1"]
) -> Ring:
    """Ring of a half's two symmetries, with readers on its side (1) or on the other (-1)."""
    # With x on the edge at −π/Z and z R x on that at +π/Z, z the phase and R the turn, the even and the odd
    # part of the edge at +π/Z are (z R ± M) x/2; M reflects.
    turn = 2.0 * np.pi / half.teeth
    cosine, sine = np.cos(turn), np.sin(turn)
    one_node = np.eye(components)
    one_node[:2, :2] = [[cosine, -sine], [sine, cosine]]
    rotation = np.kron(np.eye(len(half.edge)), one_node)
    mirror = np.tile([1.0, -1.0, 1.0][:components], len(half.edge))
    both = 0.5 * (even.stiffness + odd.stiffness)
    return Ring(
        alone=0.5 * (even.alone + side * odd.alone),
        within=rotation.T @ both @ rotation + mirror[:, None] * both * mirror,
        across=0.5 * mirror[:, None] * (even.stiffness - odd.stiffness) @ rotation,
        force_ahead=0.5 * rotation.T @ (even.passed_on + odd.passed_on),
        force_behind=0.5 * mirror[:, None] * (even.passed_on - odd.passed_on),
        read_ahead=0.5 * (even.per_edge + side * odd.per_edge) @ rotation,
        read_behind=0.5 * (even.per_edge - side * odd.per_edge) * mirror,
    )


def phases(teeth: int) -> list[tuple[complex, float]]:
    """Phases z of the harmonics, one of each pair n and Z − n of conjugates, and weights.

    The reading s sectors ahead of a load on one sector is the sum of weight · Re(zˢ reading at z).
    """
    count = abs(teeth)
    turn = 2.0 * np.pi / teeth
    return [
        (complex(np.exp(1j * turn * n)), (1.0 if n in (0, count / 2) else 2.0) / count)
        for n in range(count // 2 + 1)
    ]


def ring_response(
    half: HalfSector,
    stiffness: Any,
    loads: Float[Array, "dof load"],
    readers: Float[Array, "reader dof"],
    mirrored: NDArray[np.bool_],
    sectors: NDArray[np.int64],
    inertia: Inertia | None = None,
) -> Float[Array, "sector reader load"]:
    """Readings (sector, reader, load) of the ring under loads on one sector; else as `reduced_rings`.

    Sectors are counted in pitches from the loaded one, in the sense from x to y. With its `inertia` the ring
    is free in orders 0 and 1, else held.
    """
    seen = np.zeros((len(sectors), len(readers), loads.shape[1]))
    first = 0
    if inertia is not None:
        readers, loads = np.concatenate([readers, inertia.momentum.T]), np.hstack([loads, inertia.momentum])
        mirrored = np.concatenate([mirrored, np.zeros(3, dtype=bool)])
    for support, harmonics in half.supports():
        ring, opposite = reduced_rings(support, stiffness, loads, readers, mirrored)
        for order, (z, weight) in enumerate(steps(harmonics), first):
            reading = ring.at_phase(z)
            if inertia is not None:
                across = opposite.at_phase(z) if order < 2 else reading
                reading = relieved(order, reading, across, inertia, loads, readers, mirrored)
            seen += weight * np.real(z ** sectors[:, None, None] * reading)
        first += len(harmonics)
    return seen


def _reduced(
    half: HalfSector,
    stiffness: Any,
    loads: Float[Array, "dof load"],
    readers: Float[Array, "reader dof"],
    components: int,
    symmetry: int,
) -> ReducedSector:
    """Reduce the half with displacements that are (1) or are opposite to (-1) their mirror image."""
    unmoved = [1] if symmetry > 0 else [0, 2][: components - 1]  # components on the axis
    fixed = [_dofs(half.held, range(components), components), _dofs(half.axis, unmoved, components)]
    edges = _dofs(half.edge, range(components), components)
    rest = np.setdiff1d(np.arange(stiffness.shape[0]), np.concatenate([*fixed, edges]))
    inner = stiffness[rest]
    solver = splu(
        csc_matrix(inner[:, rest]),
        permc_spec="MMD_AT_PLUS_A",
        options={"SymmetricMode": True, "DiagPivotThresh": 0.0},
    )
    by_loads = _solved(solver, loads[rest])
    read = readers[:, rest]
    to_edge = inner[:, edges]
    by_edges = _solved(solver, to_edge.toarray())
    return ReducedSector(
        stiffness[edges][:, edges].toarray() - to_edge.T @ by_edges,
        loads[edges] - to_edge.T @ by_loads,
        read @ by_loads,
        read @ by_edges - readers[:, edges],
    )


def _dofs(nodes: NDArray[np.int64], which: Any, components: int) -> NDArray[np.int64]:
    return (components * nodes[:, None] + np.array(list(which))).ravel()


def _solved(solver: Any, right: Float[Array, "dof side"]) -> Float[Array, "dof side"]:
    # Few sides at a time: with many, SuperLU's calls of BLAS become large enough to be threaded, and ten
    # times slower where the cores are busy; one at a time takes twice as long as four.
    parts = range(0, right.shape[1], _SIDES)
    return np.concatenate(
        [solver.solve(np.asfortranarray(right[:, at : at + _SIDES])) for at in parts], axis=1
    )
