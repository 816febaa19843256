"""What runs of gears take: keys that make them large, the table of a mesh, the fastest oscillation."""

import math
from collections.abc import Sequence
from typing import Any

from tribodyn.cases import cost
from tribodyn.gears.case import LubricatedCase
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.mesh.table import MeshData

#: Stiffness of a mesh over width and modulus of elasticity: 20 N/(mm µm) of steel, ISO 6336-1.
_MESH_STIFFNESS = 0.1


def drivers(case: Any, mesh: MeshData) -> tuple[cost.Driver, ...]:
    """Keys that make a case large."""
    return (
        cost.Driver("output.samples_per_cycle", case.output.samples_per_cycle, 200),
        cost.Driver("solver.cycles", case.solver.cycles, 20),
        cost.Driver("mesh.points", mesh.points, 65),
        cost.Driver("mesh.slices", mesh.slices, 21),
    )


def table(mesh: MeshData) -> cost.Estimate:
    """The table of a mesh."""
    return cost.mesh_table(
        float(mesh.points), 1 if mesh.backlash is None else 2, mesh.slices if mesh.at_load else None
    )


def radians_of(case: LubricatedCase, bearings: Sequence[float]) -> float:
    """Radians of about the fastest oscillation in a mesh cycle: of the mesh, or of a gear on its bearing.

    `bearings` are the stiffnesses of those of pinion and gear, N/m; 0 where there is none.
    """
    mesh, drive = case.mesh, case.drive
    bodies = [body_of(drive, side) for side in SIDES]
    modulus = min(material.youngs_modulus for material in case.materials)
    density = min(material.density for material in case.materials)
    width = min(body.face_width for body in bodies)
    stiffness = mesh.stiffness if mesh.stiffness is not None else _MESH_STIFFNESS * modulus * width
    areas = [math.pi * abs((drive.module * body.teeth / 2) ** 2 - body.bore_radius**2) for body in bodies]
    masses = [max(density * area * body.face_width, 1e-9) for area, body in zip(areas, bodies, strict=True)]
    of_mesh = stiffness * (2.0 / masses[0] + 2.0 / masses[1])
    fastest = math.sqrt(max(of_mesh, *(k / m for k, m in zip(bearings, masses, strict=True))))
    return 2.0 * math.pi / (drive.pinion.teeth * case.operating.pinion_speed) * fastest
