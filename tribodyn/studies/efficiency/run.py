"""From a case of the efficiency study to its record: one mesh cycle, quasi-static."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from types import MappingProxyType
from typing import Any

import numpy as np

from tribodyn.cases.results import target, writer
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, effective_contact_ratio
from tribodyn.errors import InputError
from tribodyn.gears.check import check_gears, oil_data
from tribodyn.gears.motion.recorded import gears_layout, scales_of
from tribodyn.gears.motion.steady import of_the_face
from tribodyn.gears.plausibility import checks_gears
from tribodyn.gears.prepare import (
    PreparedGears,
    assembled,
    at_tooth_temperature,
    contact_quantities,
    thermal_quantities,
)
from tribodyn.geometry.body import geometry_arrays
from tribodyn.geometry.modification import back_flanks
from tribodyn.geometry.path import Path as PathOfContact
from tribodyn.geometry.sheet import specific_sliding_max
from tribodyn.mesh.by_compliance import compliance_remark, loaded_flanks_of, mesh_cycle_of
from tribodyn.mesh.quasi_static import by_pairs, driving_gear, power_put_in
from tribodyn.mesh.record_arrays import as_arrays
from tribodyn.record.trust import Judge, heat_of, judge_tribology
from tribodyn.studies.efficiency.along_path import (
    CycleEfficiency,
    MeshDuty,
    PathState,
    Samples,
    cycle_efficiency,
    engage,
    record_arrays,
    samples,
)
from tribodyn.studies.efficiency.mesh_positions import SHARINGS, Places, Sharing, deflections, judged, places
from tribodyn.studies.efficiency.published import by_loss_factor, path_contact, rotations, torque_ratio
from tribodyn.studies.efficiency.scenario import EfficiencyCase
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult
from tribodyn.tribology.closure import closure_of, exceeded_limits, law_quantities
from tribodyn.tribology.friction.coulomb import constant
from tribodyn.tribology.surface_state import fraction_in_range

#: By how much of a pitch the mesh is looked at before and behind a jump.
_BESIDE = 1e-9
#: Quantities of every duty of a load spectrum that the summary has.
SPECTRUM = (
    *("efficiency", "power_in_mean", "power_friction_mean", "friction_coefficient_mean"),
    *("film_parameter_min", "hertz_pressure_max", "flash_temperature_max"),
)


@dataclass(frozen=True)
class PreparedEfficiency(PreparedGears[EfficiencyCase]):
    """A case made ready, with what the mesh has to do."""

    duty: MeshDuty
    #: of the load contact model that shares the load, where the scenario asks for it
    flanks: LoadedFlanks | None

    @property
    def path(self) -> PathOfContact:
        """The working path of contact."""
        return self.assembly.path

    def means(self, duty: MeshDuty) -> CycleEfficiency:
        """Means over a mesh cycle at a duty."""
        return cycle_efficiency(self.cycle, self.path, duty, flanks=self.flanks)

    def engaged(self, phase: np.ndarray) -> tuple[Places, PathState]:
        """The mesh, its loads and its friction at phases (K,)."""
        mesh = places(self.cycle, self.path, phase, self.duty.sharing, self.flanks)
        return mesh, engage(mesh, self.duty)


def prepare(case: EfficiencyCase) -> PreparedEfficiency:
    """Check the geometry and tabulate the mesh.

    Raises InputError where the teeth cannot be made or cannot run together, or the load sharing does not fit.
    """
    assembly, mesh = assembled(case), case.mesh
    if case.operating.gear_torque < 0.0:  # the gear drives: the back flanks carry
        behind = back_flanks(mesh.modifications, float(assembly.path.pressure_angle(0.0)))
        mesh = replace(mesh, modifications=behind)
    cycle = mesh_cycle_of(assembly, case.materials, mesh, case.operating.gear_torque)
    # slices share by their table, which holds what the finite elements make of them
    flanks = loaded_flanks_of(assembly, case.materials, mesh) if cycle.slices == 1 else None

    def duty_of(case: EfficiencyCase) -> MeshDuty:
        operating = case.operating
        torque, speed = operating.gear_torque, operating.pinion_speed
        return MeshDuty(torque, speed, closure_of(case), case.load_sharing, case.friction.lever_arms)

    def lost(case: EfficiencyCase) -> float:
        return cycle_efficiency(cycle, assembly.path, duty_of(case), flanks=flanks).power_friction

    case, thermal = at_tooth_temperature(case, assembly, lost)
    return PreparedEfficiency(case, assembly, cycle, thermal, duty_of(case), flanks)


@checks_gears
def check(case: EfficiencyCase) -> CheckResult:
    """Check a case, tabulate its mesh, and say what gears and oil it describes, how stiff the gears are."""
    study = prepare(case)
    return check_gears(study, study.duty.closure)


def run(
    case: EfficiencyCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record, which covers one mesh cycle; see `study.Study.run`."""
    path = target(case, output, force)
    begun = perf_counter()
    study = prepare(case)
    over, mesh, state = _sampled(study)
    summary = _quantities(study, over, mesh, state) | spectrum_quantities(case)
    summary["wall_time"] = perf_counter() - begun
    layout, scales = gears_layout(study.cycle.slices), scales_of(study.cycle)
    groups = {"mesh_cycle": as_arrays(study.cycle), "geometry": geometry_arrays(study.assembly)}
    with writer(case, path, layout, len(over.turned), force=force, groups=groups, scales=scales) as record:
        record.write(0, record_arrays(over, mesh, state, study.duty))
        if progress:
            progress(1.0)
        return RunResult(record.finish(summary), "complete", "", summary)


def quantities_of(case: EfficiencyCase) -> dict[str, Any]:
    """Quantities of a case without a record."""
    study = prepare(case)
    return _quantities(study, *_sampled(study)) | spectrum_quantities(case)


def spectrum_quantities(case: EfficiencyCase) -> dict[str, Any]:
    """Quantities of every duty of a load spectrum, by number, and their means over time; none without one.

    Efficiency over the spectrum is the energy put out over the energy put in.
    """
    if not case.spectrum:
        return {}
    shares = np.array([share for share, _ in case.spectrum])
    every = [quantities_of(duty) for _, duty in case.spectrum]
    each = {name: np.array([quantities[name] for quantities in every]) for name in SPECTRUM}
    means = {name: float(shares @ each[name]) for name in ("power_in_mean", "power_friction_mean")}
    return {
        "duty_share": shares,
        **{f"duty_{name}": values for name, values in each.items()},
        **{f"spectrum_{name}": mean for name, mean in means.items()},
        "spectrum_efficiency": float(shares @ (each["efficiency"] * each["power_in_mean"]))
        / means["power_in_mean"],
    }


def _at_jumps(study: PreparedEfficiency) -> tuple[Places, PathState]:
    """The mesh on both sides of where a pair enters, leaves or passes a corner of the path.

    Extremes lie there as a rule; over samples alone they would change by jumps with the numbers of a drive.
    """
    jumps = study.cycle.boundary[:, None] + np.array([-1.0, 1.0]) * _BESIDE
    return study.engaged(np.clip(jumps.ravel(), _BESIDE, 1.0 - _BESIDE))


def _sampled(study: PreparedEfficiency) -> tuple[Samples, Places, PathState]:
    over = samples(study.cycle, study.case.samples_per_cycle, study.duty.way)
    return over, *study.engaged(over.phase)


def efficiencies(
    study: PreparedEfficiency, done: Mapping[Sharing, CycleEfficiency] = MappingProxyType({})
) -> dict[str, float]:
    """Cycle efficiency under every load sharing, by the torque ratio, and of an involute by Höhn's formula.

    What is `done` by its load sharing is not computed again. A load sharing that does not fit the teeth, and
    Höhn's formula where friction is not one mean coefficient, are left out.
    """
    results = {}
    for sharing in SHARINGS:
        with suppress(InputError):
            means = done.get(sharing) or study.means(study.duty._replace(sharing=sharing))
            results[f"efficiency_{sharing.replace('-', '_')}"] = means.efficiency
    drive, duty, friction = study.case.drive, study.duty, study.duty.closure.friction
    start, end = map(float, study.assembly.roll_limits)
    # of some internal pairs no pair is about the pitch point
    if not drive.helix_angle and start < 0.0 < end:
        exact, teeth = not duty.lever_arms, drive.pinion.teeth
        over = rotations(teeth, limits=(start, end))
        single = torque_ratio(
            path_contact(study.path, teeth, over, exact_speeds=exact, averaged=exact),
            -duty.gear_torque if duty.way < 0.0 else duty.gear_torque * float(study.cycle.speed_ratio),
            duty.pinion_speed,
            float(study.cycle.face_width),
            duty.closure,
            gear_drives=duty.way < 0.0,
        )
        results["efficiency_torque_ratio"] = float(single.efficiency)
    if study.assembly.family.involute and friction.functions.coefficient is constant:
        results |= by_loss_factor(study.assembly.family, drive, friction.parameters.coefficient)
    return results


def _quantities(study: PreparedEfficiency, over: Samples, mesh: Places, state: PathState) -> dict[str, Any]:
    cycle, duty = study.cycle, study.duty
    means = study.means(duty)
    under_load = {}
    if mesh.flanks is not None:  # the load sharing knows corner contact
        roll, friction = mesh.roll[:-1], duty.way * state.friction_coefficient[:-1]
        shared = mesh.flanks.share(roll, abs(duty.gear_torque), friction)
        under_load["contact_ratio_effective"] = effective_contact_ratio(
            roll, shared, float(cycle.pitch_angle)
        )
    loaded = judged(mesh.cycle, state.normal_load)
    balance = means.power_in - means.power_out - means.power_friction
    put_in = float(power_put_in(means.power_in, means.power_out))
    near_jumps, jumps = _at_jumps(study)
    everywhere = np.concatenate([loaded, judged(near_jumps.cycle, jumps.normal_load)])

    def of_faces(values: np.ndarray) -> np.ndarray:
        return by_pairs(values, cycle.slices)

    def along(name: str) -> np.ndarray:
        return np.concatenate([getattr(state, name), getattr(jumps, name)])[everywhere]

    rubbing = over.by_pair(of_faces(np.abs(state.friction_force)))
    film = along("central_film_thickness")
    flash = float(np.max(along("flash_temperature_rise")))
    thermal = thermal_quantities(study.thermal, put_in, means.efficiency)
    summary = {
        "contact_ratio": float(cycle.contact_ratio),
        **of_the_face(cycle, study.assembly, study.slice_remark),
        "specific_sliding_max": specific_sliding_max(study.assembly),
        **under_load,
        "load_sharing": duty.sharing,
        "mesh_frequency": duty.pinion_speed / float(cycle.pitch_angle),
        "normal_load_max": float(max(np.max(of_faces(one.normal_load)) for one in (state, jumps))),
        "film_min": float(np.min(film)),
        "film_parameter_min": float(np.min(film)) / duty.closure.surfaces.roughness,
        "film_parameter_min_roll_angle": float(
            np.concatenate([mesh.roll, near_jumps.roll])[everywhere][np.argmin(film)]
        ),
        "hertz_pressure_max": float(np.max(along("hertz_pressure"))),
        "flash_temperature_max": flash,
        "friction_coefficient_mean": means.friction_coefficient,
        "friction_force_mean": rubbing[:-1].mean(axis=0),
        "compliance_remark": compliance_remark(study.assembly, study.case.materials, study.case.mesh) or None,
        **law_quantities(study.case),
        "lubricant": oil_data(study.case.lubricant),
        **exceeded_limits(
            study.case,
            state.closure_shares[loaded],
            state.friction_shares[loaded],
            np.abs(state.friction_force * state.sliding)[loaded],
        ),
        "closure_in_range_fraction": fraction_in_range(state.closure_in_range[loaded]),
        "friction_in_range_fraction": fraction_in_range(state.friction_in_range[loaded]),
        "driving_gear": driving_gear(means.power_in, means.power_out),
        "power_in_mean": put_in,
        "power_friction_mean": means.power_friction,
        "efficiency": means.efficiency,
        **thermal,
        **contact_quantities(study.case.lubricant, {"flash_temperature_max": flash, **thermal}),
        "energy_residual": balance / put_in,
        "averaging_cycles": 1,
        **efficiencies(study, {duty.sharing: means}),
    }
    return summary | _trust(study, mesh, state, summary)


def _trust(
    study: PreparedEfficiency, mesh: Places, state: PathState, summary: dict[str, Any]
) -> dict[str, Any]:
    """Whether the study lies within its model, see `record.trust`."""
    loaded, judge = judged(mesh.cycle, state.normal_load), Judge()
    quantities = {
        "deflection": deflections(mesh.cycle, state.normal_load) / study.case.drive.module,
        "friction_coefficient": state.friction_coefficient,
        "hertz_pressure": state.hertz_pressure,
        **heat_of(state.flash_temperature_rise, study.case.lubricant.temperature),
    }
    judge.take({name: np.where(loaded, values, np.nan) for name, values in quantities.items()})
    judge.take({"efficiency": summary["efficiency"]})
    judge.take(heat_of(summary["flash_temperature_max"], study.case.lubricant.temperature))
    judge_tribology(judge, summary)
    return judge.summary()
