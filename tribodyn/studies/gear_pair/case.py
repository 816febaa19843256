"""A case of the dynamics of a gear pair: everything one simulation needs to know, in SI units."""

from dataclasses import dataclass, field

from tribodyn.dynamics.data import BearingData
from tribodyn.sensing.data import HousingData, SensorData
from tribodyn.solve.methods import SolverData
from tribodyn.studies.gears.case import LAYOUT, LubricatedCase, OutputData
from tribodyn.studies.gears.taken import drivers, radians_of, table
from tribodyn.studies.protocol import cost

#: Mesh cycles at the end of a run that its means and its spectrum are of, at most: they are held in memory,
#: and an attribute of a record holds no longer spectrum.
WIDEST_WINDOW = 400
#: How often the window's samples are held; share of a record that its summary and pictures read at once.
_WINDOW_HELD, _READ = 2.0, 0.05


@dataclass(frozen=True, kw_only=True)
class Case(LubricatedCase):
    """One simulation, complete: gears, oil and laws, bearings of pinion and gear, solver, output."""

    bearings: tuple[BearingData, BearingData]
    solver: SolverData
    output: OutputData
    sensors: tuple[SensorData, ...] = ()
    housing: HousingData = field(default_factory=HousingData)  # that they sit on


def window_of(cycles: int, revolution: int = 0) -> int:
    """Mesh cycles at the end of a run that its means are of: a quarter of them, at most `WIDEST_WINDOW`.

    Of a run by revolutions of so many cycles whole ones, one at least if it has that.
    """
    window = max(1, min(cycles // 4, WIDEST_WINDOW))
    return max(window // revolution, 1) * revolution if 0 < revolution <= cycles else window


def estimate(case: Case) -> cost.Estimate:
    """What a run of a case takes."""
    samples, cycles = float(case.output.samples_per_cycle), float(case.solver.cycles)
    sides = 1 if case.mesh.backlash is None else 2
    kept = len(case.output.kept(case.solver.cycles))
    sizes = {"time": kept, "pair": cost.PAIRS * sides, "dof": 6}
    record = cost.recorded(LAYOUT, sizes, _READ)
    block, window = (
        min(max(cycles / 4.0, 1.0), 50.0) * samples,
        window_of(int(cycles), case.output.revolution) * samples,
    )
    return cost.total(
        drivers(case, case.mesh),
        record,
        table(case.mesh),
        cost.in_memory(block * sides, cost.SAMPLE_BYTES),
        cost.in_memory(_WINDOW_HELD * window, record.record / kept),
        _marching(case, cycles),
    )


def drivers_of(case: Case) -> tuple[cost.Driver, ...]:
    """Keys that make a case large."""
    return drivers(case, case.mesh)


def marching_of(case: Case, cycles: float) -> list[cost.Estimate]:
    """What its table and so many mesh cycles take, of many cases side by side."""
    return [table(case.mesh)._replace(record=0.0), _marching(case, cycles, together=True)]


def _marching(case: Case, cycles: float, *, together: bool = False) -> cost.Estimate:
    solver, samples = case.solver, case.output.samples_per_cycle
    bearings = [max(bearing.stiffness_x, bearing.stiffness_y) for bearing in case.bearings]
    return cost.marching(
        cycles, radians_of(case, bearings), solver.method, float(solver.max_steps), samples, together=together
    )
