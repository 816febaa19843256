"""Free end faces, planes of symmetry, or slices apart: load along a misaligned tooth, by elements in 3D.

python -m tools.end_faces            # minutes; 10 slices
python -m tools.end_faces 6          # sooner

One sector of the pinion of Jia et al., its edges and bore held, of twenty-node bricks, and the same sector by
harmonics along the face and the openings of its ends; both gears are taken as alike. Loads stand on the flank
near the pitch circle, displacements are read below it, at a node a third of a module deep; Weber-Banaschek's
deflection at the mean load stands for what is above. The bodies are stiffer than the gears', but the same in
all columns.
"""

import sys
from typing import Any, cast

import numpy as np
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementHexS2, ElementVector, MeshHex
from skfem.helpers import ddot, div, sym_grad

from tests.support.twelve_teeth import sector_mesh
from tribodyn.compliance.fem.free_ends import openings
from tribodyn.compliance.fem.strips import curved_basis, strip_stiffness
from tribodyn.compliance.local import hertz_half_width, weber_banaschek
from tribodyn.geometry.path import kinematics
from tribodyn.validation.papers.jia import ARC_MINUTE, PINION_TORQUE, elastic

BORE, DEPTH = 8e-3, 0.33
# Half waves over the face.
WAVES = 48
# Within a slice a line load that is even goes to its two ends and its middle like this.
EVEN = ((0.0, 1 / 6), (0.5, 4 / 6), (1.0, 1 / 6))


class Sector:
    """Elements of one sector over the face width, in slices."""

    def __init__(self, slices: int) -> None:
        flexible = elastic("involute")
        drive, self.path = flexible.assembly.drive, flexible.assembly.path
        self.material, self.width = flexible.materials[0], flexible.width
        self.teeth, self.module = drive.pinion.teeth, drive.module
        plane = sector_mesh(flexible.assembly.pinion, round(self.teeth), BORE, 1)
        self.section = curved_basis(plane.nodes, plane.cells)
        used, corners = np.unique(plane.cells[:4], return_inverse=True)
        quads = corners.reshape(4, -1)
        self.nodes, count = plane.nodes[:, used], len(used)
        self.flank = np.searchsorted(used, plane.flank)
        self.z = np.linspace(0.0, self.width, slices + 1)
        points = np.vstack([np.tile(self.nodes, slices + 1), np.repeat(self.z, count)])
        # of scikit-fem: (0,0,0) (0,0,1) (0,1,0) (1,0,0) (0,1,1) (1,0,1) (1,1,0) (1,1,1)
        order = [(0, 0), (0, 1), (3, 0), (1, 0), (3, 1), (1, 1), (2, 0), (2, 1)]
        bricks = [
            np.stack([quads[corner] + (layer + above) * count for corner, above in order])
            for layer in range(slices)
        ]
        self.basis = Basis(MeshHex(points, np.hstack(bricks)), ElementVector(ElementHexS2()), intorder=4)
        self.axis = np.zeros(self.basis.N, dtype=int)
        corners, edges = cast(Any, self.basis.nodal_dofs), cast(Any, self.basis.edge_dofs)
        for axis in range(3):
            self.axis[corners[axis]] = axis
            self.axis[edges[axis]] = axis

    def compliances(self) -> tuple[np.ndarray, np.ndarray, float]:
        """Displacement of slices per load (N) on slices, with free and with symmetric ends; depth, m."""
        nu = self.material.poisson_ratio
        first, shear = nu / ((1 + nu) * (1 - 2 * nu)), 1 / (2 * (1 + nu))

        @BilinearForm
        def work(u, v, _):
            return first * div(u) * div(v) + 2 * shear * ddot(sym_grad(u), sym_grad(v))

        stiffness = work.assemble(self.basis)
        x, y, z = self.basis.doflocs
        held = self._held(x, y)
        ends = (self.axis == 2) & ((z < 1e-9) | (z > self.width - 1e-9))
        surface, inner, into, depth = self._places()
        loads, reads = (self._lines(node, into) for node in (surface, inner))
        displacements = []
        for fixed in (held, held | ends):
            free = np.flatnonzero(~fixed)
            factors = splu(
                stiffness[free][:, free].tocsc(),
                permc_spec="MMD_AT_PLUS_A",
                options={"SymmetricMode": True},
            )
            displacements.append(reads[free].T @ factors.solve(loads[free]) / self.material.youngs_modulus)
        return displacements[0], displacements[1], depth

    def by_harmonics(self) -> tuple[np.ndarray, np.ndarray]:
        """The same by harmonics along the face, and the openings of its ends."""
        nu, slices = self.material.poisson_ratio, len(self.z) - 1
        opening, matrices = openings(self.section, nu), strip_stiffness(self.section, nu)
        free, faces = (~self._held(*place) for place in (self.section.doflocs, opening.place))
        free = np.flatnonzero(np.repeat(free, 3))
        surface, inner, into, _ = self._places()
        lines = np.zeros((3 * self.section.N, 2))
        for column, node in enumerate((surface, inner)):
            away = np.hypot(*(self.section.doflocs - self.nodes[:, [node]]))
            lines[3 * int(np.argmin(away)) + np.arange(2), column] = into
        number = np.arange(WAVES)
        count = np.where(number > 0, 2.0, 1.0) / self.width
        middle = (np.arange(slices) + 0.5) / slices
        wave = np.cos(np.pi * number * middle[:, None]) * np.sinc(number / (2.0 * slices))
        own, reached, stiffness = np.zeros(WAVES), [], []
        for n in number:
            k = n * np.pi / self.width
            matrix = (matrices[0] + k * matrices[1] + k**2 * matrices[2]).tocsc()[free][:, free]
            forces = opening.forces(k)[np.ix_(free, faces)]
            solved = splu(matrix).solve(np.hstack([lines[free], forces]))
            own[n] = lines[free, 1] @ solved[:, 0]
            reached.append(forces.T @ solved[:, :2])
            stiffness.append(count[n] * (opening.stiffness[np.ix_(faces, faces)] - forces.T @ solved[:, 2:]))
        symmetric = wave * own * count @ wave.T
        more = np.zeros_like(symmetric)
        for part in (slice(0, None, 2), slice(1, None, 2)):
            load, read = (
                np.stack([moved[:, column] for moved in reached[part]]).T @ (count[part] * wave[:, part]).T
                for column in (0, 1)
            )
            more += read.T @ np.linalg.solve(np.sum(stiffness[part], axis=0), load)
        return (symmetric + more) / self.material.youngs_modulus, symmetric / self.material.youngs_modulus

    def _held(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return (np.hypot(x, y) < 1.0005 * BORE) | (np.abs(np.arctan2(y, x)) > 0.9995 * np.pi / self.teeth)

    def _places(self) -> tuple[int, int, np.ndarray, float]:
        """Node of the flank next to the pitch circle, the one below it, the way into the tooth, the depth."""
        radii = np.hypot(*self.nodes[:, self.flank])
        at = int(np.argmin(np.abs(radii - self.teeth * self.module / 2)))
        along = self.nodes[:, self.flank[at + 1]] - self.nodes[:, self.flank[at - 1]]
        into = np.array([along[1], -along[0]]) / np.hypot(*along)
        into *= -np.sign(into[1])
        surface = int(self.flank[at])
        wanted = self.nodes[:, surface] + DEPTH * self.module * into
        inner = int(np.argmin(np.hypot(*(self.nodes - wanted[:, None]))))
        return surface, inner, into, float((self.nodes[:, inner] - self.nodes[:, surface]) @ into)

    def _lines(self, node: int, into: np.ndarray) -> np.ndarray:
        """Even lines (dof, slice) over a node of the plane."""
        x, y, z = self.basis.doflocs
        lines = np.zeros((self.basis.N, len(self.z) - 1))
        over = np.hypot(x - self.nodes[0, node], y - self.nodes[1, node]) < 1e-9
        for part in range(lines.shape[1]):
            for place, weight in EVEN:
                height = self.z[part] + place * (self.z[part + 1] - self.z[part])
                for axis in (0, 1):
                    here = over & (np.abs(z - height) < 1e-9) & (self.axis == axis)
                    lines[here, part] += weight * into[axis]
        return lines


def main() -> None:
    slices = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    sector = Sector(slices)
    free, symmetric, depth = sector.compliances()
    apart = np.eye(slices) * np.mean(np.sum(symmetric, axis=1))
    at = kinematics(sector.path, 0.0)
    load, material = PINION_TORQUE / float(at.pinion_normal_arm), sector.material
    curvature = float(at.relative_curvature)
    half = hertz_half_width(load / sector.width, curvature, material, material)
    above = weber_banaschek(load / sector.width, half, depth, material)[1] * slices / sector.width
    place = (np.arange(slices) + 0.5) * sector.width / slices - sector.width / 2
    print("maximum over mean line load: ends free, symmetric; slices apart; by harmonics as the first two")
    columns = free, symmetric, apart, *sector.by_harmonics()
    for minutes in (0, 1, 2, 3):
        maximum = []
        for compliance in columns:
            system = np.block(
                [
                    [2 * (compliance + above * np.eye(slices)), -np.ones((slices, 1))],
                    [np.ones((1, slices)), np.zeros((1, 1))],
                ]
            )
            right = np.append(-minutes * ARC_MINUTE * place, load)
            maximum.append(np.max(np.linalg.solve(system, right)[:slices]) * slices / load)
        print(f"{minutes}'", *(f"{value:.3f}" for value in maximum))


if __name__ == "__main__":
    main()
