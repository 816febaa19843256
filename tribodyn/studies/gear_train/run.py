"""From a case of a train's dynamics to its record."""

from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import modes
from tribodyn.dynamics.outputs import UNRECORDED
from tribodyn.errors import SimulationError
from tribodyn.record.trust import judge_tribology
from tribodyn.solve.choice import choose
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Stop, TransientSettings, transient
from tribodyn.studies.gear_train.case import TrainCase
from tribodyn.studies.gear_train.prepare import PreparedTrain, geometry_of, prepare
from tribodyn.studies.gear_train.record import TrainRecord, record_of
from tribodyn.studies.gear_train.summary import (
    at_rest,
    meshes_of_run,
    steady_quantities,
    window_of,
    worst_of,
)
from tribodyn.studies.gear_train.warmth import at_own_temperatures
from tribodyn.studies.gears.check import oil_data
from tribodyn.studies.gears.prepare import MOST_MOTIONS
from tribodyn.studies.gears.running import RunStatistics, judge_balance
from tribodyn.studies.gears.sampled import sampled_with_extremes
from tribodyn.studies.gears.steady import warning_of
from tribodyn.studies.protocol.recording import target, writer
from tribodyn.studies.protocol.study import Progress, RunResult
from tribodyn.tribology.closure import exceeded_limits


def run(
    case: TrainCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    Where the case asks for bulk temperatures, it is run again until its own losses give them.
    """
    path = target(case, output, force)
    result = _run(case, path, force, progress)
    for _ in range(MOST_MOTIONS - 1):
        if result.status != "complete":
            break
        each = [result.summary["meshes"][mesh.name] for mesh in case.meshes]
        warm = [found.get("bulk_temperature") for found in each]
        again = at_own_temperatures(case, warm, [found["power_friction_mean"] for found in each])
        if again is None:
            break
        case = again
        result = _run(case, path, True, progress)
    return result


def _run(case: TrainCase, path: Path, force: bool, progress: Progress | None) -> RunResult:
    """Run a case once."""
    prepared = prepare(case)
    model, meshes = prepared.model, meshes_of_run(prepared)
    names = [mesh.name for mesh in case.meshes]
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    rests = [at_rest(prepared, m) for m in range(len(meshes))]
    summary: dict[str, Any] = {
        **constants_of(prepared),
        "lubricant": oil_data(case.meshes[0].pair.lubricant),
        "meshes": dict(zip(names, rests, strict=True)),
    }
    kept: TrainRecord = record_of(
        names,
        prepared.names,
        meshes,
        [made.assembly for made in prepared.made],
        [gear.name for gear in case.gears],
        geometry_of(prepared),
    )
    more = {"groups": kept.groups, "scales": kept.scales}
    with writer(case, path, kept.layout, cycles * samples + 1, force=force, **more) as record:
        begun = perf_counter()
        try:
            state = initial_state(model, case.solver.initial)
        except SimulationError as error:
            return RunResult(record.fail(str(error), summary), "failed", str(error), summary)
        choice = choose(case.solver.method, model, state)
        summary |= {"solver": choice.method, "solver_reason": choice.reason}
        window = window_of(cycles, case.period, max(mesh.rate for mesh in meshes))
        settings = TransientSettings(
            choice.method, case.solver.rtol, cycles, case.solver.max_steps, samples, window, extremes=True
        )
        statistics = RunStatistics(window, cycles, meshes, model.layout)
        stop = Stop(state, 0.0, 0, 0, "", 0.0)
        for part in transient(model, state, settings):
            if isinstance(part, Stop):
                stop = part
            elif len(part.cycles):
                shares = statistics.averages(part.cycles)
                block, extreme = sampled_with_extremes(part.cycles, part.states, part.extremes, model, shares)
                record.write(statistics.written, kept.block(block))
                statistics.add(part.states, block, extreme)
                if progress:
                    progress(min(1.0, statistics.written / (cycles * samples)))
        each = [rest | statistics.of_mesh(m, not stop.reason) for m, rest in enumerate(rests)]
        summary |= statistics.balance() | {
            "steps": stop.steps,
            "rhs_evaluations": stop.evaluations,
            "wall_time": perf_counter() - begun,
            "simulated_time": stop.time,
            "cycles_done": stop.reached,
            "meshes": dict(zip(names, each, strict=True)),
        }
        judge_balance(statistics.judge, summary, case.solver.rtol)
        if stop.reason:
            summary |= worst_of(each) | statistics.judge.summary()
            message = str(SimulationError(stop.reason, stop.time))
            return RunResult(record.fail(message, summary), "failed", message, summary)
        summary |= _concluded(prepared, statistics, each, samples)
        return RunResult(record.finish(summary), "complete", "", summary)


def constants_of(prepared: PreparedTrain) -> dict[str, Any]:
    """What does not depend on the motion: ratio, period, masses, natural frequencies, shares in them."""
    case, model = prepared.case, prepared.model
    found = modes(model, [made.cycle for made in prepared.made])
    layout, ratio = model.layout, np.asarray(model.bodies.ratio)
    masses = np.full(layout.bodies, np.nan)
    masses[: layout.planar] = np.asarray(model.bodies.mass)
    return {
        "train_ratio": float(ratio[layout.input] / ratio[layout.output]),
        "common_period": case.period,
        "body_mass": masses,
        "body_inertia": np.asarray(model.bodies.inertia),
        "mode_frequencies": found.frequency,
        "mode_shares": found.share.ravel(),
    }


def _concluded(
    prepared: PreparedTrain, statistics: RunStatistics, each: list[dict[str, Any]], samples: int
) -> dict[str, Any]:
    """Quantities of the last cycles, and what is to be said of them."""
    case, meshes = prepared.case, statistics.meshes
    windows = [statistics.window_of_mesh(m) for m in range(len(meshes))]
    whole, steady = steady_quantities(
        windows, statistics.window_work(), prepared, meshes, samples, statistics.in_window
    )
    for m, (window, quantities) in enumerate(zip(windows, steady, strict=True)):
        touching = window["normal_load"] > 0.0
        loss = np.abs(window["friction_force"] * window["sliding_speed"])[touching]
        film_shares, friction_shares = (window[name][touching] for name in UNRECORDED)
        each[m] |= exceeded_limits(prepared.pairs[m], film_shares, friction_shares, loss) | quantities
        judge_tribology(statistics.judge, each[m])
    names = [mesh.name for mesh in case.meshes]
    whole |= worst_of(each) | {"meshes": dict(zip(names, each, strict=True))}
    sliding = case.meshes[0].pair.friction.sliding
    whole["warning"] = warning_of(whole["friction_work_on_vibration"], sliding)
    statistics.judge.take({"efficiency": whole["efficiency"]})
    return whole | statistics.judge.summary()
