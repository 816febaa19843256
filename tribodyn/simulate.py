"""From a case to a record: the one place where scenario, geometry, dynamics and record meet."""

from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from tribodyn.case import Case
from tribodyn.dynamics.outputs import outputs
from tribodyn.errors import SimulationError
from tribodyn.mesh_cycle import as_arrays
from tribodyn.prepare import Prepared, geometry_arrays, prepare
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Settings, Stop, choose, transient

__all__ = ["Prepared", "RunResult", "prepare", "run"]


class RunResult(NamedTuple):
    """How a run ended: the record's path, "complete" or "failed", why, and its figures."""

    path: Path
    status: str
    message: str
    summary: dict[str, Any]


def run(
    case: Case,
    output: str | Path | None = None,
    force: bool = False,
    progress: Callable[[float], None] | None = None,
) -> RunResult:
    """Run a case and write its record.

    Parameters
    ----------
    case : Case
    output : path, optional
        Name of the record; default ``<case name>.h5`` in the current folder.
    force : bool
        Replace an existing record.
    progress : callable, optional
        Called with the share done, 0 … 1.

    Returns
    -------
    RunResult
        `status` is "failed" where the simulation could not go on: the path then is the partial record's.

    Raises
    ------
    InputError
        Before anything is written.
    """
    from tribodyn.record.writer import RecordWriter, check_target
    from tribodyn.summary import RunningExtremes, energy_residual, single_pair_stiffness, steady_figures

    path = Path(output) if output is not None else Path(f"{case.name}.h5")
    check_target(path, force)
    prepared = prepare(case)
    model, cycle = prepared.model, prepared.cycle
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    static_load = abs(case.operating.gear_torque) / float(cycle.gear_pitch_radius)
    summary: dict[str, Any] = {
        "contact_ratio": float(cycle.contact_ratio),
        "stiffness_single_pair_at_pitch_point": single_pair_stiffness(cycle, static_load),
        "pinion_mass": prepared.masses[0][0],
        "gear_mass": prepared.masses[1][0],
        "pinion_inertia": prepared.masses[0][1],
        "gear_inertia": prepared.masses[1][1],
    }
    with RecordWriter(
        path,
        scenario_toml=case.toml,
        sha256=case.sha256,
        samples=cycles * samples + 1,
        mesh_cycle=as_arrays(cycle),
        geometry=geometry_arrays(case, cycle),
        force=force,
    ) as record:
        begun = perf_counter()
        try:
            state = initial_state(model, case.solver.initial)
        except SimulationError as error:
            return RunResult(record.fail(str(error), summary), "failed", str(error), summary)
        choice = choose(case.solver.method, model, state)
        summary |= {"solver": choice.method, "solver_reason": choice.reason}
        settings = Settings(choice.method, case.solver.rtol, cycles, case.solver.max_steps, samples)
        extremes = RunningExtremes()
        window = _Window(max(1, cycles // 4), samples, cycles)
        first_stored = last_stored = 0.0
        written = 0
        for part in transient(model, state, settings, choice.method):
            if isinstance(part, Stop):
                break
            if len(part.cycles) == 0:
                continue
            block = outputs(part.cycles, part.states, model)
            record.write(written, block)
            if written == 0:
                first_stored, first_state = block["stored_energy"][0], part.states[0]
            last_stored, last_state = block["stored_energy"][-1], part.states[-1]
            written += len(part.cycles)
            extremes.add(block)
            window.add(part.cycles, block)
            if progress:
                progress(min(1.0, written / (cycles * samples)))
        assert isinstance(part, Stop)
        summary |= extremes.values
        if written:
            summary["energy_residual"] = energy_residual(first_state, last_state, last_stored - first_stored)
        summary |= {
            "steps": part.steps,
            "rhs_evaluations": part.evaluations,
            "wall_time": perf_counter() - begun,
            "simulated_time": part.time,
            "cycles_done": part.reached,
        }
        if part.reason:
            message = str(SimulationError(part.reason, part.time))
            return RunResult(record.fail(message, summary), "failed", message, summary)
        summary |= steady_figures(
            window.arrays(), cycle, samples, case.operating.gear_torque, case.operating.pinion_speed
        )
        return RunResult(record.finish(summary), "complete", "", summary)


class _Window:
    """Keeps the last whole mesh cycles of a run that arrives in blocks."""

    def __init__(self, cycles: int, samples: int, total: int):
        self.start = total - cycles
        self.stop = total
        self.blocks: list[dict[str, np.ndarray]] = []

    def add(self, cycles: np.ndarray, block: dict[str, np.ndarray]) -> None:
        inside = (cycles >= self.start - 1e-9) & (cycles < self.stop - 1e-9)
        if inside.any():
            self.blocks.append({name: values[inside] for name, values in block.items()})

    def arrays(self) -> dict[str, np.ndarray]:
        return {name: np.concatenate([b[name] for b in self.blocks]) for name in self.blocks[0]}
