"""What a run of a train takes."""

from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.gear_train.case import HOUSING, TrainCase
from tribodyn.studies.gear_train.record import SAMPLES
from tribodyn.studies.gears.taken import drivers, radians_of, table
from tribodyn.studies.protocol import cost

#: How often the samples of the last cycles are held.
_WINDOW_HELD = 2.0


def estimate(case: TrainCase) -> cost.Estimate:
    """What a run of a case takes; every mesh as much as that of a pair."""
    samples, cycles = float(case.output.samples_per_cycle), float(case.solver.cycles)
    meshes = len(case.meshes)
    sides = 1 if case.meshes[0].pair.mesh.backlash is None else 2
    kept = len(case.output.kept(case.solver.cycles))
    sizes = {
        "time": kept,
        "mesh": meshes,
        "pair": cost.PAIRS * sides,
        "body": len(case.bodies) + 1,
    }
    record = cost.recorded(Layout(TIME, SAMPLES), sizes)
    block, window = min(max(cycles / 4.0, 1.0), 50.0) * samples, max(cycles / 4.0, case.period) * samples
    return cost.total(
        drivers_of(case),
        record,
        *marching_of(case, cycles, together=False),
        cost.in_memory(block * sides * meshes, cost.SAMPLE_BYTES),
        cost.in_memory(_WINDOW_HELD * window, record.record / kept),
    )


def drivers_of(case: TrainCase) -> tuple[cost.Driver, ...]:
    """Keys that make a case large."""
    return drivers(case, case.meshes[0].pair.mesh)


def marching_of(case: TrainCase, cycles: float, together: bool = True) -> list[cost.Estimate]:
    """What its tables and so many reference cycles take; `together`: of many cases side by side."""
    solver, samples, found = case.solver, case.output.samples_per_cycle, []
    for mesh in case.meshes:
        bearings = [_held(case, body) for body in (mesh.driver, mesh.driven)]
        radians = float(mesh.rate) * radians_of(mesh.pair, bearings)
        most = float(solver.max_steps)
        found.append(table(mesh.pair.mesh))
        found.append(cost.marching(cycles, radians, solver.method, most, samples, together=together))
    return [each._replace(record=0.0) for each in found] if together else found


def _held(case: TrainCase, body: int) -> float:
    """Stiffness of a body's bearings, N/m; 0 without any."""
    of_body = [link.stiffness[:2] for link in case.links if body in link.ends and HOUSING in link.ends]
    return max((stiffness for pair in of_body for stiffness in pair), default=0.0)
