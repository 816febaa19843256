"""What a crack adds to the compliance of a tooth, by finite elements with the crack in their mesh.

The same triangles are solved sound and with the crack open; a point load's own deflection, infinite in truth,
is the same in both and cancels.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu
from skfem import Basis, ElementTriP2, MeshTri

from tribodyn.compliance.crack import Crack, thinning
from tribodyn.compliance.energy import LoadedTooth
from tribodyn.compliance.fem.crack_mesh import CrackedMesh, cracked_mesh
from tribodyn.compliance.fem.strips import plane_stiffness
from tribodyn.geometry.drive import MaterialData
from tribodyn.numerics.files.cache import arrays_kept_or_made, digest_of_numbers
from tribodyn.numerics.processes.blas_threads import one_blas_thread
from tribodyn.numerics.shapes import Array, Float

#: Places of the load along the flank, between which a spline interpolates.
_PLACES = 14


def solved_crack_compliance(
    loaded: LoadedTooth, material: MaterialData, width: float, r: Float[Array, " contact"], crack: Crack
) -> Float[Array, " contact"]:
    """Compliance (m/N) that a crack over the whole width adds, as `crack.crack_compliance` at its full depth.

    In plane strain, as `fem.gear`; of a helical tooth in the section normal to it. Raises InputError where
    the crack's tip leaves the body.
    """
    name = "crack-" + _digest(loaded, crack, material.poisson_ratio)

    def made() -> dict[str, Float[Array, "..."]]:
        with one_blas_thread():
            distance, added = added_compliance(loaded, cracked_mesh(loaded, crack), material.poisson_ratio)
        return {"distance": distance, "added": added}

    kept = arrays_kept_or_made("fem", name, made)
    distance, added = np.asarray(kept["distance"]), np.asarray(kept["added"])
    tooth_distance = np.asarray(r) if loaded.side == "pinion" else -np.asarray(r)
    order = np.argsort(distance)
    within = np.clip(tooth_distance, distance.min(), distance.max())
    return (
        CubicSpline(distance[order], added[order])(within)
        * thinning(loaded)
        / (material.youngs_modulus * width)
    )


def added_compliance(
    loaded: LoadedTooth, mesh: CrackedMesh, poisson_ratio: float
) -> tuple[Float[Array, " place"], Float[Array, " place"]]:
    """Distances r (the body's own, m) of loads on the flank, and what the crack adds, times E and width."""
    chosen = np.unique(np.linspace(0, len(mesh.flank) - 1, _PLACES).round().astype(int))
    points, distance = mesh.flank[chosen], mesh.distance[chosen]
    angle = loaded.contact(distance).load_angle
    loads = np.stack([-np.sin(angle), -np.cos(angle)])
    sound, cracked = (
        deflections(mesh, cells, points, loads, poisson_ratio) for cells in (mesh.sound, mesh.cracked)
    )
    return distance, cracked - sound


def deflections(
    mesh: CrackedMesh,
    cells: NDArray[np.int64],
    loaded: NDArray[np.int64],
    direction: Float[Array, "2 place"],
    poisson_ratio: float,
) -> Float[Array, " place"]:
    """Displacement of each of these points along a unit load there (2, place), by the triangles `cells`."""
    used, numbers = np.unique(cells, return_inverse=True)
    triangles = np.ascontiguousarray(numbers.reshape(cells.shape).T)
    basis = Basis(MeshTri(np.ascontiguousarray(mesh.points[used].T), triangles), ElementTriP2(), intorder=4)
    whole: Any = basis.mesh
    facets = whole.boundary_facets()
    on_bore = facets[np.all(np.isin(used[whole.facets[:, facets]], mesh.held), axis=0)]
    nodes = basis.get_dofs(facets=on_bore).all()
    free = np.setdiff1d(np.arange(2 * basis.N), np.concatenate([2 * nodes, 2 * nodes + 1]))
    of_vertices: Any = basis.nodal_dofs
    at = of_vertices[0, np.searchsorted(used, loaded)]
    forces = np.zeros((2 * basis.N, len(loaded)))
    np.put_along_axis(forces, np.stack([2 * at, 2 * at + 1]), direction, axis=0)
    stiffness = csc_matrix(plane_stiffness(basis, poisson_ratio))[free][:, free]
    solver = splu(
        stiffness, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True, "DiagPivotThresh": 0.0}
    )
    right = np.asfortranarray(forces[free])
    return np.sum(right * solver.solve(right), axis=0)


def _digest(loaded: LoadedTooth, crack: Crack, poisson_ratio: float) -> str:
    along = np.linspace(float(loaded.tooth.form_distance), float(loaded.tooth.tip_distance), 9)
    at = loaded.contact(along)
    numbers = [at.x, at.y, at.load_angle, loaded.tooth.root_radius, loaded.tooth.form_radius]
    numbers += [loaded.tooth.tip_radius, loaded.tooth.form_angle, loaded.tooth.corner_x]
    numbers += [loaded.tooth.corner_y, loaded.tooth.corner_radius, loaded.body.teeth]
    numbers += [loaded.body.bore_radius, thinning(loaded), *crack, poisson_ratio]
    return digest_of_numbers((__name__,), numbers)
