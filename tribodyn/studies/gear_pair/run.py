"""From a case of a gear pair's dynamics to its record."""

from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.dynamics.modes import natural_frequencies
from tribodyn.dynamics.outputs import UNRECORDED
from tribodyn.errors import SimulationError
from tribodyn.geometry.body import geometry_arrays
from tribodyn.mesh.by_compliance import compliance_remark
from tribodyn.mesh.cycle import as_arrays
from tribodyn.mesh.quasi_static import single_pair
from tribodyn.record.trust import judge_tribology
from tribodyn.solve.choice import choose
from tribodyn.solve.initial import initial_state
from tribodyn.solve.transient import Stop, TransientSettings, transient
from tribodyn.studies.gear_pair.case import Case, window_of
from tribodyn.studies.gear_pair.outputs import MESH, recorded
from tribodyn.studies.gear_pair.prepare import PreparedPair, prepare
from tribodyn.studies.gear_pair.summary import mesh_of_run, steady_quantities
from tribodyn.studies.gears.by_standard import rated
from tribodyn.studies.gears.case import LAYOUT
from tribodyn.studies.gears.check import check_gears, oil_data
from tribodyn.studies.gears.prepare import (
    MOST_MOTIONS,
    at_own_temperature,
    contact_quantities,
    thermal_quantities,
)
from tribodyn.studies.gears.recorded import scales_of
from tribodyn.studies.gears.running import RunStatistics, judge_balance
from tribodyn.studies.gears.sampled import sampled_with_extremes
from tribodyn.studies.gears.steady import warning_of
from tribodyn.studies.protocol.recording import target, writer
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult
from tribodyn.tribology.closure import exceeded_limits, law_quantities

#: What a record says of the contact at the pitch point, under `pitch_point` in its summary.
REGULAR = "regular"
AVERAGED = "radius and entrainment vanish; averaged over the contact's own half width"


def run(
    case: Case, output: str | Path | None = None, *, force: bool = False, progress: Progress | None = None
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    Where the case asks for a bulk temperature, it is run again until its own loss gives that temperature.
    """
    path = target(case, output, force)
    result = _run(case, path, force, progress)
    for _ in range(MOST_MOTIONS - 1):
        if result.status != "complete":
            break
        warm, lost = result.summary.get("bulk_temperature"), result.summary["power_friction_mean"]
        again = at_own_temperature(case, warm, lost)
        if again is None:
            break
        case = again
        result = _run(case, path, True, progress)
    return result


def check(case: Case) -> CheckResult:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    prepared = prepare(case)
    return check_gears(prepared, prepared.model.closure(MESH), prepared.masses)


def _run(case: Case, path: Path, force: bool, progress: Progress | None) -> RunResult:
    """Run a case once."""
    prepared = prepare(case)
    case = prepared.case
    model, cycle = prepared.model, prepared.cycle
    samples, cycles = case.output.samples_per_cycle, case.solver.cycles
    summary: dict[str, Any] = {
        "contact_ratio": float(cycle.contact_ratio),
        **({} if case.mesh.backlash is None else {"normal_backlash": case.mesh.backlash}),
        "stiffness_single_pair_at_pitch_point": single_pair(cycle, case.operating.gear_torque).stiffness,
        "pinion_mass": prepared.masses[0][0],
        "gear_mass": prepared.masses[1][0],
        "pinion_inertia": prepared.masses[0][1],
        "gear_inertia": prepared.masses[1][1],
        "mode_frequencies": natural_frequencies(model, [cycle]),
        "pitch_point": AVERAGED if model.options.averaged else REGULAR,
        "compliance_remark": compliance_remark(prepared.assembly, case.materials, case.mesh) or None,
        **_by_standard(prepared),
        **law_quantities(case),
        "lubricant": oil_data(case.lubricant),
    }
    more = {
        "groups": {"mesh_cycle": as_arrays(cycle), "geometry": geometry_arrays(prepared.assembly)},
        "scales": scales_of(cycle.side),
    }
    with writer(case, path, LAYOUT, cycles * samples + 1, force=force, **more) as record:
        begun = perf_counter()
        try:
            state = initial_state(model, case.solver.initial)
        except SimulationError as error:
            return RunResult(record.fail(str(error), summary), "failed", str(error), summary)
        choice = choose(case.solver.method, model, state)
        summary |= {"solver": choice.method, "solver_reason": choice.reason}
        window = window_of(cycles)
        settings = TransientSettings(
            choice.method, case.solver.rtol, cycles, case.solver.max_steps, samples, window, extremes=True
        )
        statistics = RunStatistics(window, cycles, [mesh_of_run(prepared)], model.layout)
        stop = Stop(state, 0.0, 0, 0, "", 0.0)
        for part in transient(model, state, settings):
            if isinstance(part, Stop):
                stop = part
            elif len(part.cycles):
                shares = statistics.averages(part.cycles)
                block, extreme = sampled_with_extremes(part.cycles, part.states, part.extremes, model, shares)
                record.write(statistics.written, recorded(block))
                statistics.add(part.states, block, extreme)
                if progress:
                    progress(min(1.0, statistics.written / (cycles * samples)))
        summary |= (
            statistics.of_mesh(MESH, complete=not stop.reason)
            | statistics.balance()
            | {
                "steps": stop.steps,
                "rhs_evaluations": stop.evaluations,
                "wall_time": perf_counter() - begun,
                "simulated_time": stop.time,
                "cycles_done": stop.reached,
            }
        )
        judge_balance(statistics.judge, summary, case.solver.rtol)
        if stop.reason:
            summary |= statistics.judge.summary()
            message = str(SimulationError(stop.reason, stop.time))
            return RunResult(record.fail(message, summary), "failed", message, summary)
        last, work, speed = (
            statistics.window_of_mesh(MESH),
            statistics.window_work(),
            case.operating.pinion_speed,
        )
        touching = last["normal_load"] > 0.0
        loss = np.abs(last["friction_force"] * last["sliding_speed"])[touching]
        film_shares, friction_shares = (last[name][touching] for name in UNRECORDED)
        summary |= exceeded_limits(case, film_shares, friction_shares, loss)
        summary |= steady_quantities(last, work, prepared, samples, speed, statistics.in_window[MESH])
        summary |= thermal_quantities(prepared.thermal, summary["power_in_mean"], summary["efficiency"])
        summary |= contact_quantities(case.lubricant, summary)
        summary["warning"] = warning_of(summary["friction_work_on_vibration"], case.friction.sliding)
        statistics.judge.take({"efficiency": summary["efficiency"]})
        judge_tribology(statistics.judge, summary)
        summary |= statistics.judge.summary()
        return RunResult(record.finish(summary), "complete", "", summary)


def _by_standard(prepared: PreparedPair) -> dict[str, float]:
    """K_v by ISO 6336-1 of a drive with a quality whose involute pinion drives; nothing of others."""
    case, operating = prepared.case, prepared.case.operating
    if case.quality is None or not prepared.assembly.family.involute or operating.gear_torque <= 0.0:
        return {}
    duty = operating.pinion_speed, operating.gear_torque
    found = rated(prepared.assembly, case.materials, prepared.masses, case.quality, duty)
    return {"dynamic_factor_iso": found.dynamic.factor, "resonance_ratio_iso": found.dynamic.resonance_ratio}
