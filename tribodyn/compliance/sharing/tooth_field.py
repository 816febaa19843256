"""Von Mises stress all over a loaded tooth, of loads that vary along the face.

The gear of `fem.gear`, held at its bore between planes of symmetry at both ends of the face; loads act at
points of the flank, so that under the contact itself the stress is as coarse as the mesh, whose cells are
larger than the contact.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, csr_matrix
from scipy.spatial import KDTree
from skfem import Basis

from tribodyn.compliance.fem.cyclic_symmetry import reduced_ring
from tribodyn.compliance.fem.gear import GearModel, check_level, gear_model
from tribodyn.compliance.fem.gear_compliance import LARGEST, NEIGHBOURS, ElasticGear
from tribodyn.compliance.fem.strips import COMPONENTS, moduli, strip_stiffness
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, elastic_gear
from tribodyn.compliance.sharing.section import is_helical
from tribodyn.compliance.sharing.slices import modes, wave_numbers
from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import SIDES, Side
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.processes.work import steps
from tribodyn.numerics.shapes import Array, Float

#: Stresses of a point: σ_x, σ_y, σ_z, τ_xy (like cos kz), τ_xz, τ_yz (like sin kz).
_EVEN, _ODD = 4, 2
# Depth below the root circle, in modules, to which the body is kept.
_BELOW = 1.0


class ToothField(NamedTuple):
    """Von Mises stress of a tooth and the body under it."""

    #: (2, N), nodes of the half with the loaded flank, m in the tooth's frame: x along its axis from the
    #: gear's, y towards the loaded flank
    place: Float[Array, "2 node"]
    cells: NDArray[np.int64]  # (4, C), corners of its cells
    #: nodes of the profile, from the middle of the gap along fillet and flank to the middle of the tip
    profile: NDArray[np.int64]
    loaded: int  # the node of the profile nearest to the load
    depth: float  # around the load to which the contact's own stress reaches, m
    slice_position: Float[Array, " slice"]  # m from the middle of the face
    #: (2, N, S), Pa: of this half and of its mirror image, y < 0
    von_mises: Float[Array, "2 node slice"]
    #: (2, N, S), Pa: stress along the profile at its nodes, tension positive; elsewhere 0
    along: Float[Array, "2 node slice"]


@one_blas_thread()
def tooth_field(
    flanks: LoadedFlanks,
    side: Side,
    roll: Float[Array, " pair"],
    line_load: Float[Array, "pair slice"],
    pair: int,
) -> ToothField:
    """Field of a pair's tooth on one gear under line loads (N/m) of all pairs, its neighbours' included.

    `roll` are the pairs' pinion angles from the pitch point, rad, the one that entered first in front.
    Raises InputError for helical teeth.
    """
    flexible = flanks.flexible
    if is_helical(flexible.assembly):
        rule = "the stress over a tooth is that of spur gears"
        raise InputError(
            "drive.helix_angle", f"{float(flexible.assembly.drive.helix_angle):.4g} rad", rule, ""
        )
    body = SIDES.index(side)
    material = flexible.materials[body]
    gear = elastic_gear(flexible.assembly, side, material, held=False)
    check_level(gear.level, COMPONENTS)
    model = gear_model(gear)
    geometry = pair_geometry(flexible.assembly, roll[None])
    reach = np.asarray((geometry.pinion_radius, geometry.gear_radius)[body])[0]
    slices = line_load.shape[1]
    wave_number = wave_numbers(flexible.width, slices, True)
    wave_number = wave_number[wave_number <= LARGEST / float(flexible.assembly.drive.module)]
    basis = modes(slices, slices)
    amplitude = line_load @ basis.T / slices  # (pair, n)
    # on the pinion the earlier tooth stands on the loaded flank's side, on the gear on the other
    ahead = (1 if body == 0 else -1) * (np.arange(len(roll)) - pair)
    near = np.abs(ahead) <= NEIGHBOURS
    loads = _loads(model, reach[near])
    kept = _kept(model, gear, flexible.assembly.drive.module)
    constant, linear, square = strip_stiffness(model.basis, material.poisson_ratio)
    even = np.zeros((2, len(kept.nodes), _EVEN, slices))
    odd = np.zeros((2, len(kept.nodes), _ODD, slices))
    from_end = (np.arange(slices) + 0.5) / slices * np.pi
    for number, k in enumerate(steps(wave_number.tolist())):
        stiffness = csr_matrix(constant + k * linear + k**2 * square)
        moved = _displacement(model, stiffness, loads, kept, ahead[near], amplitude[near, number])
        stress = _stress(kept, moved, material.poisson_ratio, k)
        even += stress[:, :, :_EVEN, None] * basis[number]
        odd += stress[:, :, _EVEN:, None] * (np.sqrt(2.0) * np.sin(number * from_end))
    x, y, z, xy = np.moveaxis(even, 2, 0)
    xz, yz = np.moveaxis(odd, 2, 0)
    shear = xy**2 + xz**2 + yz**2
    von_mises = np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3.0 * shear)
    place = model.basis.doflocs[:, kept.nodes]
    along = np.zeros_like(von_mises)
    tangent = np.gradient(place[:, kept.profile], axis=1)
    cosine, sine = (tangent / np.hypot(tangent[0], tangent[1]))[:, :, None]
    of_x, of_y, of_xy = (part[:, kept.profile] for part in (x, y, xy))
    along[:, kept.profile] = cosine**2 * of_x + sine**2 * of_y + 2.0 * cosine * sine * of_xy
    flank = np.hypot(place[0], place[1])[kept.profile]
    node = int(kept.profile[int(np.argmin(np.abs(flank - reach[pair])))])
    return ToothField(place, kept.cells, kept.profile, node, gear.depth, flanks.face(), von_mises, along)


class _Shown(NamedTuple):
    """The part of the half sector that is shown."""

    nodes: NDArray[np.int64]  # of the basis
    cells: NDArray[np.int64]  # (4, C), numbers among these
    profile: NDArray[np.int64]
    slopes: tuple[csr_array, csr_array]  # (N, nodes of the basis): values to x- and y-derivatives


def _kept(model: GearModel, gear: ElasticGear, module: float) -> _Shown:
    basis = model.basis
    radius = np.hypot(*basis.doflocs)
    bottom = float(gear.tooth.root_radius) - _BELOW * float(module)
    whole = np.asarray(basis.element_dofs)
    inside = np.flatnonzero(np.all(radius[whole] > bottom, axis=0))
    nodes = np.unique(whole[:, inside])
    corners = whole[:4, inside]
    numbers = np.full(basis.N, -1)
    numbers[nodes] = np.arange(len(nodes))
    flank = np.asarray(KDTree(basis.doflocs.T).query(model.position.T)[1])
    tip = np.hypot(*model.position[:, -1])
    top = np.flatnonzero(np.abs(radius - tip) < 1e-6 * tip)
    top = top[np.argsort(-basis.doflocs[1, top])]
    profile = numbers[np.concatenate([model.root, flank[1:], top[1:]])]
    return _Shown(nodes, numbers[corners], profile, _slopes(basis, nodes, inside))


def _slopes(basis: Basis, nodes: NDArray[np.int64], cells: NDArray[np.int64]) -> tuple[csr_array, csr_array]:
    """Derivatives at nodes: those at 2 × 2 Gauss points of each cell, taken on to its nodes, and averaged."""
    gauss = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
    at = np.stack(np.meshgrid(gauss, gauss, indexing="ij")).reshape(2, 4)
    local = np.asarray(basis.elem.doflocs).T  # (2, 9)
    share = [(gauss[1] - local) / (gauss[1] - gauss[0]), (local - gauss[0]) / (gauss[1] - gauss[0])]
    outwards = np.stack([share[i][0] * share[j][1] for i in (0, 1) for j in (0, 1)])  # (4, 9)
    numbers = np.asarray(basis.element_dofs)[:, cells]
    count = np.bincount(numbers.ravel(), minlength=basis.N)
    rows, columns, values = [], [], ([], [])
    for shape in range(basis.Nbfun):
        values_of: Any = basis.elem.gbasis(basis.mapping, at, shape, tind=cells)[0]
        slope = np.asarray(values_of.grad)  # (2, cell, 4)
        nodal = np.einsum("dcg,gn->dnc", slope, outwards) / count[numbers]
        rows.append(numbers.ravel())
        columns.append(np.broadcast_to(numbers[shape], numbers.shape).ravel())
        for axis in (0, 1):
            values[axis].append(nodal[axis].ravel())
    where = np.concatenate(rows), np.concatenate(columns)
    shape = (basis.N, basis.N)
    x, y = (csr_array((np.concatenate(part), where), shape=shape)[nodes][:, nodes] for part in values)
    return x, y


def _loads(model: GearModel, reach: Float[Array, " load"]) -> Float[Array, "dof load"]:
    """Unit line loads at distances from the axis, shared by the two nearest vertices."""
    radius = np.hypot(*model.position)
    order = np.argsort(radius)
    shares = np.stack([np.interp(reach, radius[order], row[order]) for row in np.eye(len(radius))])
    plane = (model.loads @ shares).reshape(-1, 2, len(reach))
    return np.pad(plane, ((0, 0), (0, COMPONENTS - 2), (0, 0))).reshape(-1, len(reach))


def _displacement(
    model: GearModel,
    stiffness: csr_matrix,
    loads: Float[Array, "dof load"],
    kept: _Shown,
    ahead: NDArray[np.int64],
    amplitude: Float[Array, " load"],
) -> Float[Array, "2 node 3"]:
    """Displacement of the nodes of both halves, the other one's as its mirror image, m E."""
    dofs = (COMPONENTS * kept.nodes[:, None] + np.arange(COMPONENTS)).ravel()
    rows = np.arange(2 * len(dofs))
    picked = (np.ones(2 * len(dofs)), (rows, np.tile(dofs, 2)))
    readers = csr_array(picked, shape=(2 * len(dofs), loads.shape[0]))
    mirrored = rows >= len(dofs)
    total = np.zeros(2 * len(dofs))
    for support, harmonics in model.half.supports():
        ring = reduced_ring(support, stiffness, loads, readers, mirrored)  # pyright: ignore[reportArgumentType]
        for z, weight in harmonics:
            reading = ring.at_phase(z)
            total += weight * np.real(reading @ (z**ahead * amplitude))
    return total.reshape(2, len(kept.nodes), COMPONENTS)


def _stress(
    kept: _Shown, moved: Float[Array, "2 node 3"], poisson_ratio: float, k: float
) -> Float[Array, "2 node 6"]:
    """Amplitudes of σ_x, σ_y, σ_z, τ_xy, τ_xz, τ_yz at the nodes, Pa, of displacements m E."""
    shear, lame = moduli(poisson_ratio)
    components = []
    for u, v, w in np.moveaxis(moved, 2, 1):
        (u_x, v_x, w_x), (u_y, v_y, w_y) = ([slope @ part for part in (u, v, w)] for slope in kept.slopes)
        volume = lame * (u_x + v_y + k * w)
        normal = [volume + 2.0 * shear * part for part in (u_x, v_y, k * w)]
        components.append(
            np.stack([*normal, shear * (u_y + v_x), shear * (w_x - k * u), shear * (w_y - k * v)], axis=-1)
        )
    return np.stack(components)
