"""From a case of a train's dynamics to its record."""

from collections.abc import Mapping
from functools import partial
from math import lcm
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import modes
from tribodyn.dynamics.outputs import holding_links
from tribodyn.errors import SimulationError
from tribodyn.record.reader import MESHES
from tribodyn.record.sensors import write_sensed
from tribodyn.record.trust import judge_tribology
from tribodyn.record.withheld import remarked
from tribodyn.studies.gear_train.case import TrainCase
from tribodyn.studies.gear_train.planetary.jamming import jams
from tribodyn.studies.gear_train.planetary.results import STAGES, stage_quantities, worst_stage
from tribodyn.studies.gear_train.prepare import PreparedTrain, geometry_of, prepare
from tribodyn.studies.gear_train.record import TrainRecord, record_of
from tribodyn.studies.gear_train.sensed import listener_of
from tribodyn.studies.gear_train.summary import (
    mesh_at_rest,
    meshes_of_run,
    steady_quantities,
    window_of,
    worst_of,
)
from tribodyn.studies.gear_train.warmth import at_own_temperatures
from tribodyn.studies.gears.check import oil_data
from tribodyn.studies.gears.over_time.marched import record_motion, run_until_warm
from tribodyn.studies.gears.over_time.running import RunStatistics
from tribodyn.studies.gears.over_time.steady import limits_in, warning_of
from tribodyn.studies.gears.sensed.numbers import signal_quantities
from tribodyn.studies.protocol.recording import target, writer
from tribodyn.studies.protocol.study import Progress, RunResult


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
    return run_until_warm(case, target(case, output, force), force, partial(_run, progress=progress), _warmer)


def _warmer(case: TrainCase, summary: Mapping[str, Any]) -> TrainCase | None:
    each = [summary[MESHES][mesh.name] for mesh in case.meshes]
    warm = [found.get("bulk_temperature") for found in each]
    return at_own_temperatures(case, warm, [found["power_friction_mean"] for found in each])


def _run(case: TrainCase, path: Path, force: bool, *, progress: Progress | None) -> RunResult:
    """Run a case once."""
    prepared = prepare(case)
    model, meshes = prepared.model, meshes_of_run(prepared)
    listener = listener_of(prepared)
    names = [mesh.name for mesh in case.meshes]
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    rests = [mesh_at_rest(prepared, m) for m in range(len(meshes))]
    summary: dict[str, Any] = {
        **constants_of(prepared),
        "lubricant": oil_data(case.meshes[0].pair.lubricant),
        MESHES: dict(zip(names, rests, strict=True)),
    }
    kept: TrainRecord = record_of(
        names,
        prepared.names,
        meshes,
        [made.assembly for made in prepared.made],
        [gear.name for gear in case.gears],
        geometry_of(prepared),
        [case.links[k].name for k in holding_links(model)],
        case.output.revolutions(cycles),
    )
    more = {"groups": kept.groups, "scales": kept.scales}
    with writer(case, path, kept.layout, len(case.output.kept(cycles)), force=force, **more) as record:
        try:
            period = lcm(case.period, case.output.revolution or 1)
            if period > cycles:
                period = case.period
            window = window_of(cycles, period, max(mesh.rate for mesh in meshes))
            motion = record_motion(case, model, meshes, window, record, kept.block, progress, listener)
        except SimulationError as error:
            return RunResult(record.fail(str(error), summary), "failed", str(error), summary)
        statistics = motion.statistics
        each = [rest | statistics.of_mesh(m, not motion.stopped) for m, rest in enumerate(rests)]
        summary |= motion.solver | motion.done | {MESHES: dict(zip(names, each, strict=True))}
        if motion.stopped:
            summary |= worst_of(each) | statistics.judge.summary()
            failed = record.fail(motion.stopped, summary, partial(write_sensed, listener.sensed()))
            return RunResult(failed, "failed", motion.stopped, summary)
        sensed = listener.sensed()
        summary |= _concluded(prepared, statistics, each, samples) | signal_quantities(sensed)
        done = record.finish(summary, beside=partial(write_sensed, sensed))
        return RunResult(done, "complete", "", summary)


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
        each[m] |= limits_in(window, prepared.pairs[m]) | quantities
        judge_tribology(statistics.judge, each[m])
    names = [mesh.name for mesh in case.meshes]
    whole |= worst_of(each) | {MESHES: dict(zip(names, each, strict=True))}
    if case.sets:
        whole[STAGES] = stages = stage_quantities(prepared, windows, each)
        whole |= worst_stage(stages)
    fed = warning_of(whole["friction_work_on_vibration"], case.meshes[0].pair.friction.sliding)
    whole["warning"] = remarked(*jams(prepared), fed or "") or None
    statistics.judge.take({"efficiency": whole["efficiency"]})
    return whole | statistics.judge.summary()
