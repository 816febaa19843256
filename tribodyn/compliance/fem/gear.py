"""Finite elements of a full gear: curved quadratic quadrilaterals, by the symmetries of its ring.

The model is half a sector with the loads on its flank and what is read of them.
"""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from scipy.spatial import KDTree
from skfem import Basis

from tribodyn.compliance.fem.cyclic_symmetry import HalfSector, half_sector, inertia_of, ring_response
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, ElasticGear, GearCompliance, LeadHarmonics
from tribodyn.compliance.fem.ring_mesh import SectorMesh, half_sector_cells, half_sector_mesh, signed_polar
from tribodyn.compliance.fem.strips import (
    COMPONENTS,
    curved_basis,
    edge_points,
    plane_stiffness,
    stress_rows,
    strip_stiffness,
)
from tribodyn.errors import InputError
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import Tooth, flank_point
from tribodyn.numerics.processes.work import steps
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


def gear_model(gear: ElasticGear) -> GearModel:
    """Mesh a gear; InputError if the cells do not fit into a thin rim."""
    tooth, bore_radius = gear.tooth, gear.bore_radius
    mesh = half_sector_mesh(tooth, gear.teeth, bore_radius, gear.level)
    basis = curved_basis(mesh.nodes, mesh.cells)
    mapping: Any = basis.mapping
    if not np.all(mapping.detDF(basis.X) > 0):
        size, key, change = (
            (bore_radius, "bore_radius", "make the bore smaller")
            if gear.teeth > 0
            else (-2.0 * bore_radius, "outer_diameter", "make the outside larger")
        )
        raise InputError(
            key,
            size,
            f"the rim under teeth with a root radius of {abs(tooth.root_radius):.4g} m is too thin for the "
            "finite elements' mesh",
            f"{change}, or the fillet rounder",
        )
    direction = _load_directions(tooth, gear.teeth, mesh)
    position, root = mesh.nodes[:, mesh.flank], mesh.nodes[:, mesh.root]
    numbers = KDTree(basis.doflocs.T)
    near = numbers.query(position.T)[1]
    loads = np.zeros((2 * basis.N, position.shape[1]))
    np.put_along_axis(loads, np.stack([2 * near, 2 * near + 1]), direction, axis=0)
    inwards = np.multiply.outer(direction, gear.depth * np.array([1.0, 2.0])).swapaxes(1, 2)
    below = (position[:, None] + inwards).reshape(2, -1)
    beyond = below[1] < 0.0
    reflected = np.where(beyond, [[1.0], [-1.0]], 1.0)
    inner = _probes(basis, below * reflected, np.tile(direction, 2) * reflected)
    half = half_sector(basis.doflocs, gear.teeth, bore_radius, gear.free_rim)
    along_root = np.asarray(numbers.query(root.T)[1])
    return GearModel(basis, half, position, loads, inner, beyond, root, along_root)


def _load_directions(tooth: Tooth, teeth: int, mesh: SectorMesh) -> Float[Array, "2 vertex"]:
    """Unit vectors (2, M) of the normal load on the flank's vertices, into the tooth."""
    reach, _ = signed_polar(mesh.nodes[:, mesh.flank], teeth)
    fine = np.linspace(tooth.form_distance, tooth.tip_distance, 2001)
    r = np.interp(reach, signed_polar(np.stack(flank_point(tooth, fine)), teeth)[0], fine)
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


# Entries of both triangular factors over n log2 n, largest of levels 2 to 8 with 2 and 3 components per node,
# bytes of each with SuperLU's own working space, and copies of the dense sides and readers held at once:
# together they meet the peaks measured (22 MB to 960 MB) within a fifth (test_mesh_memory).
_FILL = {2: 10.5, 3: 12.5}
_BYTES_PER_ENTRY = 24.0
_COPIES = 3.0
# The end faces of a gear, whose mesh is always the same; measured.
_ENDS = 80e6

_LIMITS = (Path("/sys/fs/cgroup/memory.max"), Path("/sys/fs/cgroup/memory.current"))


def memory_needed(level: int, components: int) -> float:
    """Bytes that solving a gear takes at its peak.

    Components of the displacement are 2 in plane strain, 3 for loads that vary along the teeth, with root
    stress, and for free end faces after them.
    """
    cells, flank, root, edge = half_sector_cells(level)
    unknowns = components * 4.0 * cells
    readers = 3.0 * (flank + 1) + (4.0 * root if components == 3 else 0.0)
    dense = 8.0 * _COPIES * unknowns * (components * 2.0 * edge + readers)
    whole = dense + _BYTES_PER_ENTRY * _FILL[components] * unknowns * np.log2(unknowns)
    return max(whole, _ENDS) if components == 3 else whole


def available_memory() -> float:
    """Bytes that this process can still take; infinite where the system does not say."""
    limits = [np.inf]
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        limits += [1024.0 * float(line.split()[1]) for line in lines if line.startswith("MemAvailable:")]
    except OSError:
        pass
    try:
        limit, used = (path.read_text(encoding="ascii").strip() for path in _LIMITS)
        if limit != "max":
            limits.append(float(limit) - float(used))
    except OSError:
        pass
    return min(limits)


def check_level(level: int, components: int) -> None:
    """Refuse a mesh that cannot be, or that would not fit into the memory.

    Raises InputError saying how much memory the level needs, and which one would fit.
    """
    if level < 1:
        raise InputError(
            "level", level, "the mesh has no cells", "use 1 or more; 2 is within 0.1 % of the limit"
        )
    needed, available = memory_needed(level, components), available_memory()
    if needed <= available:
        return
    fits = level
    while fits > 1 and memory_needed(fits, components) > 0.8 * available:
        fits = fits * 9 // 10 if fits > 20 else fits - 1
    raise InputError(
        "level",
        level,
        f"the finite elements would need {needed / 2**30:.3g} GiB of memory, and {available / 2**30:.3g} GiB "
        "are available",
        f"use at most {fits}; 2 is within 0.1 % of the limit",
    )


_SECTORS = np.arange(-NEIGHBOURS, NEIGHBOURS + 1)


def gear_compliance(gear: ElasticGear) -> GearCompliance:
    """Solve a gear in plane strain for unit loads at every vertex of a flank, held or free.

    Raises InputError if the cells do not fit into a thin rim, or the mesh not into the memory.
    """
    check_level(gear.level, 2)
    model = gear_model(gear)
    readers = np.concatenate([model.loads.T, model.inner])
    mirrored = np.concatenate([np.zeros(model.loads.shape[1], dtype=bool), model.beyond])
    stiffness = plane_stiffness(model.basis, gear.poisson_ratio)
    inertia = None if gear.held else inertia_of(model.basis)
    seen = ring_response(model.half, stiffness, model.loads, readers, mirrored, _SECTORS, inertia)
    inside, between = _parted(seen)
    return GearCompliance(signed_polar(model.position, gear.teeth)[0], inside, between, gear.depth)


def lead_harmonics(gear: ElasticGear, wave_number: Float[Array, " wave"]) -> LeadHarmonics:
    """Solve a gear for unit loads that run like cos kz along the teeth, k ≥ 0 in rad/m; errors likewise.

    Held at its bore, whether the gear is or not: loads of k > 0 sum up to nothing over the face.
    """
    check_level(gear.level, COMPONENTS)
    model = gear_model(gear)
    constant, linear, square = strip_stiffness(model.basis, gear.poisson_ratio)
    solved = [
        _harmonic(model, csr_matrix(constant + k * linear + k**2 * square), gear.poisson_ratio, float(k))
        for k in steps(np.asarray(wave_number).tolist())
    ]
    inside, between, stress = (np.stack(part) for part in zip(*solved, strict=True))
    return LeadHarmonics(np.asarray(wave_number), inside, between, edge_points(model.root_position), stress)


def _harmonic(
    model: GearModel, stiffness: Any, poisson_ratio: float, k: float
) -> tuple[
    Float[Array, "2 radius"], Float[Array, "sector radius radius"], Float[Array, "sector 2 point radius"]
]:
    """Displacements inside (2, M) and between (sector, M, M), root stress (sector, 2, P, M)."""
    loads, inner = _with_w(model.loads.T), _with_w(model.inner)
    root = stress_rows(model.root_position, model.root, stiffness.shape[0], poisson_ratio, k)
    readers = np.concatenate([loads, inner, root, root])
    none = np.zeros(len(root), dtype=bool)
    mirrored = np.concatenate([np.zeros(len(loads), dtype=bool), model.beyond, none, ~none])
    seen = ring_response(model.half, stiffness, loads.T, readers, mirrored, _SECTORS)
    displacements = len(loads) + len(inner)
    inside, between = _parted(seen[:, :displacements])
    return inside, between, seen[:, displacements:].reshape(len(_SECTORS), 2, len(root), len(loads))


def _with_w(rows: Float[Array, "row double"]) -> Float[Array, "row triple"]:
    """Rows over u and v as rows over u, v and w."""
    pairs = rows.reshape(len(rows), -1, 2)
    return np.pad(pairs, ((0, 0), (0, 0), (0, COMPONENTS - 2))).reshape(len(rows), -1)


def _parted(
    seen: Float[Array, "sector reader radius"],
) -> tuple[Float[Array, "2 radius"], Float[Array, "sector radius radius"]]:
    """Part readings (sector, M + 2 M, M) into those inside, (2, M), and between, (sector, M, M)."""
    count = seen.shape[2]
    inside = seen[NEIGHBOURS, count:].reshape(2, count, count)
    return np.einsum("dmm->dm", inside), seen[:, :count]
