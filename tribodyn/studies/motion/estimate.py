"""What a run of a gearbox takes."""

import math
from collections.abc import Sequence
from typing import Any

from tribodyn.cases import cost
from tribodyn.gears.case import LubricatedCase
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.mesh.table import MeshData
from tribodyn.solve.methods import AUTO, IN_TIME
from tribodyn.studies.motion.case import HOUSING, Gearbox
from tribodyn.studies.motion.record import usual_layout

#: How often the samples of the last cycles are held; share of a pair's record that pictures read at once.
_WINDOW_HELD, _READ = 2.0, 0.05
#: Cycles of a common period that are usual; bytes and s of an interval of its layout, per mesh.
_USUAL_PERIOD, _INTERVAL_BYTES, _INTERVAL = 200.0, 120.0, 1e-6
#: Seconds of each further mesh for its equilibria, temperatures and extremes: two helical ones take 2.5 s.
_A_MESH = 1.2


def estimate(case: Gearbox) -> cost.Estimate:
    """What a run of a case takes; every mesh as much as that of a pair."""
    samples, cycles = float(case.output.samples_per_cycle), float(case.solver.cycles)
    meshes = len(case.meshes)
    sides = 1 if case.meshes[0].pair.mesh.backlash is None else 2
    kept = len(case.output.kept(case.solver.cycles))
    bodies = len(case.bodies)
    sizes = {"time": kept, "mesh": meshes, "pair": cost.PAIRS * sides, "dof": 3 * bodies, "body": bodies + 1}
    record = cost.recorded(usual_layout(case), sizes, 0.0 if case.named else _READ)
    block = min(max(cycles / 4.0, 1.0), 50.0) * samples
    window = max(cycles / 4.0, min(max(case.period, case.output.revolution), cycles)) * samples
    return cost.total(
        cost_keys(case),
        record,
        *marching_of(case, cycles, together=False),
        cost.in_memory(block * sides * meshes, cost.SAMPLE_BYTES),
        cost.in_memory(_WINDOW_HELD * window, record.record / kept),
        cost.Estimate(seconds=_A_MESH * (meshes - 1)),
    )


def cost_keys(case: Gearbox) -> tuple[cost.CostKey, ...]:
    """Keys that make a case large."""
    found = general_cost_keys(case, case.meshes[0].pair.mesh)
    if case.laid_out < case.period or case.period <= _USUAL_PERIOD:
        return found
    remedy = (
        f"the meshes are at their phases again after {case.period} cycles of the mesh {case.meshes[0].name}: "
        "give gears of one shaft numbers of teeth with a divisor, or lower it"
    )
    return *found, cost.CostKey("solver.max_period", case.period, _USUAL_PERIOD, remedy)


def marching_of(case: Gearbox, cycles: float, together: bool = True) -> list[cost.Estimate]:
    """What its tables and so many reference cycles take; `together`: of many cases side by side."""
    solver, samples = case.solver, case.output.samples_per_cycle
    meshes, rates = len(case.meshes), sum(float(mesh.rate) for mesh in case.meshes)
    intervals = 0.0 if meshes == 1 else float(case.laid_out) * cost.SEGMENTS * rates * meshes
    estimates = [cost.Estimate(_INTERVAL_BYTES * intervals, seconds=_INTERVAL * intervals)]
    for mesh in case.meshes:
        bearings = [_held(case, body) for body in (mesh.driver, mesh.driven)]
        radians = float(mesh.rate) * radians_of(mesh.pair, bearings)
        most = float(solver.max_steps)
        estimates.append(table(mesh.pair.mesh))
        method = IN_TIME if case.in_time and solver.method == AUTO else solver.method
        estimates.append(cost.marching(cycles, radians, method, most, samples, together=together))
    return [each._replace(record=0.0) for each in estimates] if together else estimates


def _held(case: Gearbox, body: int) -> float:
    """Stiffness of a body's bearings, N/m; 0 without any."""
    of_body = [link.stiffness[:2] for link in case.links if body in link.ends and HOUSING in link.ends]
    return max((stiffness for pair in of_body for stiffness in pair), default=0.0)


#: Stiffness of a mesh over width and modulus of elasticity: 20 N/(mm µm) of steel, ISO 6336-1.
_MESH_STIFFNESS = 0.1


def general_cost_keys(case: Any, mesh: MeshData) -> tuple[cost.CostKey, ...]:
    """Keys that make a case large."""
    return (
        cost.CostKey("output.samples_per_cycle", case.output.samples_per_cycle, 200),
        cost.CostKey("solver.cycles", case.solver.cycles, 20)
        if case.solver.duration is None
        else cost.CostKey("solver.duration", case.solver.duration, 0.1),
        cost.CostKey("mesh.points", mesh.points, 65),
        cost.CostKey("mesh.slices", mesh.slices, 21),
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
