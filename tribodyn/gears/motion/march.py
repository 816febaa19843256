"""A case marched in time into its record, and again until it is as warm as its own losses make it."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.results import Progress, RunResult
from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.outputs import Sampled, evaluated_with_extremes
from tribodyn.errors import SimulationError
from tribodyn.gears.motion.course import ByRevolution, RunCourse
from tribodyn.gears.motion.running import MeshOfRun, RunStatistics, judge_balance
from tribodyn.gears.prepare import MOST_MOTIONS
from tribodyn.gears.sensing.listening import Listener
from tribodyn.record.writer import RecordWriter
from tribodyn.solve.choice import choose, choose_in_time
from tribodyn.solve.in_time import transient_in_time
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Stop, TransientSettings, transient


class RecordedMotion(NamedTuple):
    """A motion that was recorded."""

    statistics: RunStatistics
    solver: dict[str, str]  # by what method, and why
    done: dict[str, float]  # what it took and how far it came, balance of energy included
    stopped: str  # why it ended before its time; "": it did not


def record_motion(
    case: Any,
    model: Model,
    meshes: Sequence[MeshOfRun],
    window: int,
    record: RecordWriter,
    recorded: Callable[[Sampled], Mapping[str, np.ndarray]],
    progress: Progress | None,
    listener: Listener | None = None,
) -> RecordedMotion:
    """Integrate a case, its `solver` and `output`, from its start, and write it to a record as it comes.

    `window` are the cycles at the end that means are of, in a run by time those of nominal speed, `recorded`
    what the record takes of samples, `listener` the sensors, which take all of them. Raises SimulationError
    where there is no start.
    """
    begun, solver = perf_counter(), case.solver
    samples, cycles = case.output.samples_per_cycle, solver.cycles
    state = initial_state(model, solver.initial)
    by_time = solver.duration is not None
    choice = (choose_in_time if by_time else choose)(solver.method, model, state)
    settings = TransientSettings(
        choice.method, solver.rtol, cycles, solver.max_steps, samples, window, extremes=True
    )
    course = None
    if not by_time:
        course = RunCourse([mesh.rate for mesh in meshes], samples, float(model.operation.pitch_angle))
    statistics = RunStatistics(window * samples, cycles * samples, meshes, model.layout, course)
    kept, revolution = case.output.kept(cycles), case.output.revolution
    by_revolution = None
    if case.output.revolutions(cycles):
        by_revolution = ByRevolution(
            record, len(meshes), revolution, samples, of_train=meshes[0].number is not None
        )
    stop = Stop(state, 0.0, 0, 0, "", 0.0)
    for part in (transient_in_time if by_time else transient)(model, state, settings):
        if isinstance(part, Stop):
            stop = part
        elif len(part.cycles):
            shares = statistics.averages(len(part.cycles))
            states, block, extreme = evaluated_with_extremes(
                part.cycles, part.states, part.extremes, model, shares
            )
            if listener is not None:
                listener.add(states, block)
            inside = range(kept.start - statistics.written, kept.stop - statistics.written)
            if (piece := slice(max(inside.start, 0), max(inside.stop, 0))).start < min(
                piece.stop, len(part.cycles)
            ):
                record.write(record.written, recorded(block.part(piece)))
            if by_revolution is not None:
                by_revolution.add(block)
            statistics.add(part.states, block, extreme)
            if progress:
                progress(min(1.0, statistics.written / (cycles * samples)))
    done = statistics.balance() | {
        "steps": stop.steps,
        "rhs_evaluations": stop.evaluations,
        "wall_time": perf_counter() - begun,
        "simulated_time": stop.time,
        "cycles_done": stop.reached,
    }
    judge_balance(statistics.judge, done, solver.rtol)
    stopped = str(SimulationError(stop.reason, stop.time)) if stop.reason else ""
    return RecordedMotion(
        statistics, {"solver": choice.method, "solver_reason": choice.reason}, done, stopped
    )


def run_until_warm(
    case: Any,
    path: Path,
    force: bool,
    once: Callable[[Any, Path, bool], RunResult],
    warmer: Callable[[Any, Mapping[str, Any]], Any],
) -> RunResult:
    """Run a case `once`, and again until its own loss gives the temperature at which it was run.

    `warmer` gives the case at the temperature of a summary's losses; None: it was run there.
    """
    result = once(case, path, force)
    for _ in range(MOST_MOTIONS - 1):
        again = warmer(case, result.summary) if result.status == "complete" else None
        if again is None:
            break
        case = again
        result = once(case, path, True)
    return result
