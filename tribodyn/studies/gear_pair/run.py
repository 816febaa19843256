"""From a case of a gear pair's dynamics to its record."""

from functools import partial
from pathlib import Path
from typing import Any

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.errors import SimulationError
from tribodyn.geometry.body import geometry_arrays
from tribodyn.mesh.record_arrays import as_arrays
from tribodyn.record.sensors import write_sensed
from tribodyn.record.trust import judge_tribology
from tribodyn.studies.gear_pair.case import Case, window_of
from tribodyn.studies.gear_pair.outputs import MESH, recorded
from tribodyn.studies.gear_pair.prepare import PreparedPair, prepare
from tribodyn.studies.gear_pair.sensed import listener_of
from tribodyn.studies.gear_pair.summary import mesh_of_run, steady_quantities
from tribodyn.studies.gears.by_standard import rated
from tribodyn.studies.gears.case import gears_layout
from tribodyn.studies.gears.check import check_gears, oil_data
from tribodyn.studies.gears.over_time import by_revolution
from tribodyn.studies.gears.over_time.marched import record_motion, run_until_warm
from tribodyn.studies.gears.over_time.recorded import scales_of
from tribodyn.studies.gears.over_time.steady import at_rest, limits_in, warning_of
from tribodyn.studies.gears.prepare import (
    at_own_temperature,
    contact_quantities,
    thermal_quantities,
)
from tribodyn.studies.gears.sensed.numbers import signal_quantities
from tribodyn.studies.protocol.recording import target, writer
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult

#: What a record says of the contact at the pitch point, under `pitch_point` in its summary.
REGULAR = "regular"
AVERAGED = "radius and entrainment vanish; averaged over the contact's own half width"


def run(
    case: Case, output: str | Path | None = None, *, force: bool = False, progress: Progress | None = None
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    Where the case asks for a bulk temperature, it is run again until its own loss gives that temperature.
    """
    return run_until_warm(
        case,
        target(case, output, force),
        force,
        partial(_run, progress=progress),
        lambda case, summary: at_own_temperature(
            case, summary.get("bulk_temperature"), summary["power_friction_mean"]
        ),
    )


def check(case: Case) -> CheckResult:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    prepared = prepare(case)
    listener_of(prepared)
    return check_gears(prepared, prepared.model.closure(MESH), prepared.masses)


def _run(case: Case, path: Path, force: bool, *, progress: Progress | None) -> RunResult:
    """Run a case once."""
    prepared = prepare(case)
    case = prepared.case
    model, cycle = prepared.model, prepared.cycle
    listener = listener_of(prepared)
    in_space = model.layout.spatial > 0
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    summary: dict[str, Any] = {
        **at_rest(case, prepared),
        "pinion_mass": prepared.masses[0][0],
        "gear_mass": prepared.masses[1][0],
        "pinion_inertia": prepared.masses[0][1],
        "gear_inertia": prepared.masses[1][1],
        "mode_frequencies": natural_frequencies(model, [cycle]),
        "pitch_point": AVERAGED if model.options.averaged else REGULAR,
        **_by_standard(prepared),
        "lubricant": oil_data(case.lubricant),
    }
    more = {
        "groups": {"mesh_cycle": as_arrays(cycle), "geometry": geometry_arrays(prepared.assembly)},
        "scales": scales_of(cycle, in_space=in_space) | by_revolution.scale(case.output.revolutions(cycles)),
    }
    layout = gears_layout(cycle.slices, in_space=in_space)
    with writer(case, path, layout, len(case.output.kept(cycles)), force=force, **more) as record:
        try:
            meshes = [mesh_of_run(prepared)]
            motion = record_motion(
                case,
                model,
                meshes,
                window_of(cycles, case.output.revolution),
                record,
                recorded,
                progress,
                listener,
            )
        except SimulationError as error:
            return RunResult(record.fail(str(error), summary), "failed", str(error), summary)
        statistics = motion.statistics
        summary |= motion.solver | statistics.of_mesh(MESH, complete=not motion.stopped) | motion.done
        if motion.stopped:
            summary |= statistics.judge.summary()
            kept = record.fail(motion.stopped, summary, partial(write_sensed, listener.sensed()))
            return RunResult(kept, "failed", motion.stopped, summary)
        last, work = statistics.window_of_mesh(MESH), statistics.window_work()
        summary |= limits_in(last, case)
        speed = case.operating.pinion_speed
        summary |= steady_quantities(
            *(last, work, prepared, samples, speed, statistics.in_window[MESH]), changes="course" in summary
        )
        summary |= thermal_quantities(prepared.thermal, summary["power_in_mean"], summary["efficiency"])
        summary |= contact_quantities(case.lubricant, summary)
        summary["warning"] = warning_of(summary["friction_work_on_vibration"], case.friction.sliding)
        statistics.judge.take({"efficiency": summary["efficiency"]})
        judge_tribology(statistics.judge, summary)
        sensed = listener.sensed()
        summary |= statistics.judge.summary() | signal_quantities(sensed)
        kept = record.finish(summary, beside=partial(write_sensed, sensed))
        return RunResult(kept, "complete", "", summary)


def _by_standard(prepared: PreparedPair) -> dict[str, float]:
    """K_v by ISO 6336-1 of a drive with a quality whose involute pinion drives; nothing of others."""
    case, operating = prepared.case, prepared.case.operating
    if case.quality is None or not prepared.assembly.family.involute or operating.gear_torque <= 0.0:
        return {}
    duty = operating.pinion_speed, operating.gear_torque
    found = rated(prepared.assembly, case.materials, prepared.masses, case.quality, duty)
    return {"dynamic_factor_iso": found.dynamic.factor, "resonance_ratio_iso": found.dynamic.resonance_ratio}
