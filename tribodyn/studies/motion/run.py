"""From a gearbox to the record of its motion."""

from collections.abc import Mapping, Sequence
from functools import partial
from math import lcm
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.cases.results import target, writer
from tribodyn.dynamics.modes import modes
from tribodyn.errors import SimulationError
from tribodyn.gears.case import STAGES
from tribodyn.gears.check import oil_data
from tribodyn.gears.motion.march import record_motion, run_until_warm
from tribodyn.gears.motion.running import RunStatistics
from tribodyn.gears.motion.steady import (
    limits_in,
    on_engagement,
    on_settling,
    on_settling_of_meshes,
    warning_of,
)
from tribodyn.gears.sensing.signal_quantities import signal_quantities
from tribodyn.record.reader import MESHES
from tribodyn.record.sensors import write_sensed
from tribodyn.record.trust import judge_tribology
from tribodyn.record.withheld_efficiency import remarked
from tribodyn.studies.motion.assembly import PreparedGearbox, settles
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.mesh_groups import idle_meshes
from tribodyn.studies.motion.heat.settled import in_balance, prepare_settled, warmer
from tribodyn.studies.motion.heat.thermal_iteration import at_own_temperatures
from tribodyn.studies.motion.losses.of_case import losses_of_run
from tribodyn.studies.motion.planetary.jamming import jams
from tribodyn.studies.motion.planetary.results import stage_quantities, worst_stage
from tribodyn.studies.motion.record import record_of
from tribodyn.studies.motion.sensors import listener_of
from tribodyn.studies.motion.summary import (
    concluded,
    mesh_at_rest,
    meshes_of_run,
    steady_quantities,
    window_of,
    worst_of,
)
from tribodyn.studies.protocol.study import Progress, RunResult

#: What a record says of the contact at the pitch point, under `pitch_point` in its summary.
REGULAR = "regular"
AVERAGED = "radius and entrainment vanish; averaged over the contact's own half width"


def run(
    case: Gearbox,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    Where the case asks for bulk temperatures, it is run again until its own losses give them.
    """
    where, once = target(case, output, force), partial(_run, progress=progress)
    return run_until_warm(in_balance(case), where, force, once, _warmer)


def _warmer(case: Gearbox, summary: Mapping[str, Any]) -> Gearbox | None:
    each = [summary[MESHES][mesh.name] for mesh in case.meshes] if case.named else [summary]
    lost = [of_mesh["power_friction_mean"] for of_mesh in each]
    if case.heat is not None:
        return warmer(case, lost)
    return at_own_temperatures(case, [of_mesh.get("bulk_temperature") for of_mesh in each], lost)


def _run(case: Gearbox, path: Path, force: bool, *, progress: Progress | None) -> RunResult:
    """Run a case once."""
    prepared = prepare_settled(case)
    model, meshes = prepared.model, meshes_of_run(prepared)
    listener = listener_of(prepared)
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    rests = [mesh_at_rest(prepared, m) for m in range(len(meshes))]
    # of a train the oil that enters its meshes, which warms in each of them
    oil = case.meshes[0].pair.lubricant if case.named else prepared.warm_pairs[0].lubricant
    summary: dict[str, Any] = {
        **constants_of(prepared),
        "lubricant": oil_data(oil),
        **of_meshes(case, rests),
    }
    if prepared.case.heat is not None and prepared.case.heat.settled is not None:
        summary["part_temperatures"] = dict(prepared.case.heat.settled.parts)
    kept = record_of(prepared, meshes)
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
        summary |= motion.solver | motion.done | of_meshes(case, each)
        if motion.stopped:
            summary |= (worst_of(each) if case.named else {}) | statistics.judge.summary()
            failed = record.fail(motion.stopped, summary, partial(write_sensed, listener.sensed()))
            return RunResult(failed, "failed", motion.stopped, summary)
        sensed = listener.sensed()
        summary |= _concluded(prepared, statistics, each, samples) | signal_quantities(sensed)
        summary["engagement_remark"] = _engaged(case, summary, each) or None
        done = record.finish(summary, beside=partial(write_sensed, sensed))
        return RunResult(done, "complete", "", summary)


def _engaged(case: Gearbox, summary: Mapping[str, Any], each: Sequence[Mapping[str, Any]]) -> str:
    """Say what the engagement of pairs has to do with the largest dynamic factor; "" where loads vary."""
    if not settles(case) or any("course" in mesh for mesh in each):
        return ""
    idle = idle_meshes(dict(enumerate(each)))
    loaded = [(mesh, each[m]) for m, mesh in enumerate(case.meshes) if m not in idle]
    mesh, worst = max(loaded, key=lambda of: float(of[1]["dynamic_factor"]))
    fastest = max(float(one["mesh_frequency"]) for one in each)
    compliance = mesh.pair.mesh.compliance
    return on_engagement(compliance, worst["dynamic_factor"], fastest, summary["mode_frequencies"])


def _settled(case: Gearbox, errors: Sequence[np.ndarray], samples: int) -> str:
    """Say what keeps the last cycles from being the steady motion; "" where nothing is seen."""
    if case.period == 1 or len(errors[0]) >= 2 * case.period * samples:
        return on_settling(errors, samples * case.period)
    rims = [gearset.rim for gearset in case.sets if gearset.rim is not None]
    rates = [float(mesh.rate) for mesh in case.meshes]
    rates += [abs(float(rim.pin_rate)) for rim in rims if rim.pins_pass]
    return on_settling_of_meshes(errors, rates, samples, case.solver.cycles, case.period)


def of_meshes(case: Gearbox, each: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """What a summary has of the meshes: by their names where files name them, else of the only one."""
    if not case.named:
        return dict(each[0])
    return {MESHES: {mesh.name: dict(quantities) for mesh, quantities in zip(case.meshes, each, strict=True)}}


def constants_of(prepared: PreparedGearbox) -> dict[str, Any]:
    """What does not depend on the motion: ratio, period, masses, natural frequencies, shares in them."""
    case, model = prepared.case, prepared.model
    mode_set = modes(model, [one.cycle for one in prepared.tables])
    layout, ratio = model.layout, np.asarray(model.bodies.ratio)
    masses = np.full(layout.bodies, np.nan)
    masses[: layout.planar] = np.asarray(model.bodies.mass)
    of_modes = {"mode_frequencies": mode_set.frequency, "mode_shares": mode_set.share.ravel()}
    if not case.named:  # gears without what drives and what is driven
        (pinion, of_pinion), (gear, of_gear) = prepared.tables[0].masses
        return {
            "pinion_mass": pinion,
            "gear_mass": gear,
            "pinion_inertia": of_pinion,
            "gear_inertia": of_gear,
            "pitch_point": AVERAGED if model.options.averaged else REGULAR,
            **of_modes,
        }
    return {
        "train_ratio": float(ratio[layout.input] / ratio[layout.output]),
        "common_period": case.period,
        "body_mass": masses,
        "body_inertia": np.asarray(model.bodies.inertia),
        **of_modes,
    }


def _concluded(
    prepared: PreparedGearbox, statistics: RunStatistics, each: list[dict[str, Any]], samples: int
) -> dict[str, Any]:
    """Quantities of the last cycles, and what is to be said of them."""
    case, meshes = prepared.case, statistics.meshes
    windows = [statistics.window_of_mesh(m) for m in range(len(meshes))]
    work, changes = statistics.window_work(), any("course" in mesh for mesh in each)
    whole, steady = steady_quantities(
        windows, work, prepared, meshes, samples, statistics.in_window, changes=changes
    )
    for m, (window, quantities) in enumerate(zip(windows, steady, strict=True)):
        each[m] |= limits_in(window, prepared.warm_pairs[m]) | quantities
        judge_tribology(statistics.judge, each[m])
    whole = concluded(prepared, whole, each) | of_meshes(case, each if case.named else [{}])
    whole |= losses_of_run(prepared, [mesh["power_friction_mean"] for mesh in each], whole)
    if case.sets:
        whole[STAGES] = stages = stage_quantities(prepared, windows, each)
        whole |= worst_stage(stages)
    fed = warning_of(whole["friction_work_on_vibration"], case.meshes[0].pair.friction.sliding)
    if settles(case) and not changes:
        errors = [window["transmission_error_rotational"] for window in windows]
        idle = idle_meshes(dict(enumerate(each)))
        loaded = [error for m, error in enumerate(errors) if m not in idle]
        whole["settling_remark"] = _settled(case, loaded, samples) or None
    whole["warning"] = remarked(*jams(prepared), fed or "") or None
    statistics.judge.take({"efficiency": whole["efficiency"]})
    return whole | statistics.judge.summary()
