"""From a case of the load contact study to its record: teeth in slow rotation at one torque or several."""

from collections.abc import Mapping
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.results import target, writer
from tribodyn.compliance.sharing.flank_gap import check_modifications
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import (
    LoadedContact,
    loaded_error,
    roll_through,
    single_pair_stiffness,
)
from tribodyn.compliance.sharing.section import is_helical
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.errors import SimulationError
from tribodyn.gears.check import check_on_elements
from tribodyn.gears.plausibility import checks_gears
from tribodyn.gears.rating.bearings import bearing_part, opening_part, shafts_of_pair
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import geometry_arrays
from tribodyn.geometry.drive import Drive, MaterialData
from tribodyn.geometry.families import family
from tribodyn.geometry.helix import overlap_ratio, pitch_slope, speed_share
from tribodyn.geometry.limits.checks import check as check_pair
from tribodyn.geometry.path import pitch_point
from tribodyn.mesh.record_arrays import untabulated
from tribodyn.numerics.remembered import remembered
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.record.trust import Judge, judge_tribology
from tribodyn.standards.load_factors import shared_load
from tribodyn.studies.load_contact.scenario import BODIES, LAYOUT, OILED, LoadContactCase
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult
from tribodyn.tribology.closure import closure_of, exceeded_limits, law_quantities
from tribodyn.tribology.surface_state import contact_friction, fraction_in_range, range_shares


class PreparedTeeth(NamedTuple):
    """A case made ready: its teeth put together, and their elasticity."""

    case: LoadContactCase
    flexible: PairFlexibility

    @property
    def assembly(self) -> Assembly:
        """The teeth put together."""
        return self.flexible.assembly

    @property
    def flanks(self) -> LoadedFlanks:
        """The flanks as they are modified and cut into slices."""
        mesh = self.case.mesh
        return LoadedFlanks(self.flexible, mesh.modifications, mesh.slices, mesh.slice_coupling)

    def contact(self, gear_torque: float) -> tuple[Any, ...]:
        """Arguments of `roll_through` and `loaded_error` at a torque."""
        case = self.case
        return self.flanks, gear_torque, case.positions_per_cycle, case.cycles, case.friction_coefficient


def prepare(case: LoadContactCase) -> PreparedTeeth:
    """Check geometry and modifications, and find the elasticity of both gears.

    Raises InputError where the teeth cannot be made, or cannot run together as they are modified.
    """
    flexible = _flexible(case.family, case.drive, case.materials, case.mesh.held)
    check_modifications(flexible.assembly, case.mesh.modifications)
    return PreparedTeeth(case, flexible)


@remembered(2)
def _flexible(
    name: str, drive: Drive, materials: tuple[MaterialData, MaterialData], held: bool
) -> PairFlexibility:
    """The pair as it is without modifications: cases that differ in those, or in their load, share it."""
    return flexibility(check_pair(family(name), drive), materials, lead=True, held=held)


def film_over_face(
    study: PreparedTeeth, loaded: LoadedContact
) -> tuple[dict[str, Float[Array, "position pair slice"]], dict[str, Any]]:
    """Datasets and summary of the film law at the load of every slice, the oil as it enters the mesh.

    NaN where a slice carries nothing; empty without a lubricant. Each slice is a line contact of its own line
    load, with radii and speeds across its line of contact: no flow along it. Beyond the path of contact the
    flanks have the curvature of the path's end.
    """
    assembly, case = study.assembly, study.case.lubricated
    if case is None:
        return {}, {}
    closure = closure_of(case)
    seen = study.flanks.contacts(loaded.roll)
    motion, speed = seen.geometry.motion, case.operating.pinion_speed
    carries = loaded.line_load > 0.0
    position, pair, _ = np.nonzero(carries)
    vanishing, whole = pitch_point(assembly.path), np.ones(carries.shape)
    share = speed_share(pitch_slope(assembly), assembly.path, motion.signed_distance)
    contact = contact_friction(
        closure,
        loaded.line_load[carries],
        1.0 / (seen.curvature * whole)[carries],
        speed * (motion.pinion_speed * share * whole)[carries],
        speed * (motion.gear_speed * share * whole)[carries],
        float(vanishing.length),
        speed * float(vanishing.speed_per_radius),
    )
    film, inside = contact.surface.central_film_thickness, contact.surface.closure_in_range
    thickness, in_range = (np.full(carries.shape, np.nan) for _ in range(2))
    thickness[carries], in_range[carries] = film, inside
    least = int(np.argmin(film))
    laws = {name: value for name, value in law_quantities(case).items() if name.startswith("film")}
    outside = exceeded_limits(case, *range_shares(contact.contact, closure))
    arrays = {"central_film_thickness": thickness, "closure_in_range": in_range}
    return arrays, {
        "film_min": float(film[least]),
        "film_parameter_min": float(film[least] / closure.surfaces.roughness),
        "film_parameter_min_roll_angle": float(loaded.roll[position[least], pair[least]]),
        "closure_in_range_fraction": fraction_in_range(inside),
        **{name: value for name, value in outside.items() if name in ("closure_exceeded", "film_outside")},
        **laws,
    }


def run(
    case: LoadContactCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`."""
    path = target(case, output, force)
    begun = perf_counter()
    study = prepare(case)
    report = progress or (lambda _share: None)
    steps = 1 + len(case.gear_torques)
    try:
        loaded, failure = roll_through(*study.contact(case.operating.gear_torque)), ""
    except SimulationError as error:
        loaded, failure = None, error.reason
    numbers = untabulated(study.assembly, study.flexible.width)
    groups = {"mesh_cycle": numbers, "geometry": geometry_arrays(study.assembly)}
    scales: dict[str, Any] = {"pair": np.zeros(0, dtype=int), "slice": np.zeros(0), "body": np.array(BODIES)}
    if loaded is not None:
        scales |= {"pair": pair_numbers(study, loaded), "slice": np.asarray(loaded.slice_position)}
    if case.gear_torques:
        scales["torque"] = np.array(case.gear_torques)
    samples = 0 if loaded is None else len(loaded.phase)
    layout = LAYOUT if case.lubricated is None else OILED
    with writer(case, path, layout, samples, groups=groups, scales=scales, force=force) as record:
        if loaded is None:
            summary = _ratios(study.assembly)
            return RunResult(record.fail(failure, summary), "failed", failure, summary)
        arrays, film = film_over_face(study, loaded)
        summary = _summary(study, loaded, film)
        record.write(0, record_arrays(study, loaded) | arrays)
        report(1 / steps)
        spread = []
        for row, torque in enumerate(case.gear_torques):
            try:
                error_at = loaded_error(*study.contact(torque))
            except SimulationError as error:
                failure = f"at operating.gear_torques.{row} = {torque:g} N*m: {error.reason}"
                return RunResult(record.fail(failure, summary), "failed", failure, summary)
            spread.append(float(np.ptp(error_at)))
            record.put(row, {"map_transmission_error": error_at, "map_peak_to_peak": spread[-1]})
            report((row + 2) / steps)
        if spread:
            summary["least_peak_to_peak"] = min(spread)
            summary["least_peak_to_peak_torque"] = case.gear_torques[int(np.argmin(spread))]
        summary["wall_time"] = perf_counter() - begun
        return RunResult(record.finish(summary), "complete", "", summary)


@checks_gears
def check(case: LoadContactCase) -> CheckResult:
    """Check a case, and say what gears it describes and how stiff they are."""
    return check_on_elements(case, prepare(case).flexible)


def quantities_of(case: LoadContactCase) -> dict[str, Any]:
    """Quantities of a case at its own torque, without a record, and arrays along the path of contact."""
    study = prepare(case)
    loaded = roll_through(*study.contact(case.operating.gear_torque))
    along = of_one_cycle(study.assembly, loaded) if case.cycles == 1 else {}
    return _summary(study, loaded, film_over_face(study, loaded)[1]) | along


def _ratios(assembly: Assembly) -> dict[str, Any]:
    """Contact ratio, of helical teeth with overlap."""
    contact = {"contact_ratio": float(assembly.contact_ratio)}
    if not is_helical(assembly):
        return contact
    overlap = float(overlap_ratio(assembly))
    return contact | {"overlap_ratio": overlap, "total_contact_ratio": contact["contact_ratio"] + overlap}


def record_arrays(study: PreparedTeeth, loaded: LoadedContact) -> dict[str, Float[Array, "position ..."]]:
    """Datasets of the record, over the phase first."""
    teeth = float(study.case.drive.pinion.teeth)
    return {
        "phase": loaded.phase - loaded.phase[0],
        "pinion_angle": (loaded.phase - loaded.phase[0]) * 2.0 * np.pi / teeth,
        "roll_angle": loaded.roll,
        "loaded_transmission_error": loaded.deflection,
        "unloaded_transmission_error": loaded.unloaded,
        "normal_load": loaded.normal_load,
        "line_load": loaded.line_load,
        "hertz_pressure": loaded.pressure,
        "half_width": loaded.half_width,
        "face_load_factor": loaded.face_load_factor,
        "root_tension": np.moveaxis(loaded.root_tension, 0, 1),
        "root_compression": np.moveaxis(loaded.root_compression, 0, 1),
        "mesh_stiffness": loaded.mesh_stiffness,
        "torque_residual": torque_residual(study, loaded),
    }


def torque_residual(study: PreparedTeeth, loaded: LoadedContact) -> Float[Array, " position"]:
    """Torque of the pairs' loads, friction included, over the gear's torque, less 1, at every position."""
    flanks = study.flanks
    seen = flanks.contacts(loaded.roll, study.case.friction_coefficient)
    if seen.lever.shape[-1] == 1:
        torque = np.sum(loaded.normal_load * seen.lever[..., 0], axis=1)
    else:
        load = loaded.line_load * seen.length * study.flexible.width / flanks.slices
        torque = np.sum(load * seen.lever, axis=(1, 2))
    return torque / study.case.operating.gear_torque - 1.0


def _summary(study: PreparedTeeth, loaded: LoadedContact, film: Mapping[str, Any]) -> dict[str, Any]:
    """Quantities of a torque, those of the film among them, and whether the contact lies within its model."""
    torque = study.case.operating.gear_torque
    worst = np.unravel_index(np.argmax(loaded.line_load), loaded.line_load.shape)
    position, pair = np.unravel_index(np.argmin(np.abs(loaded.roll)), loaded.roll.shape)
    tension, compression = loaded.root_tension, loaded.root_compression
    # of a pair beside another; none where pairs never share the load
    shared = shared_load(loaded.normal_load, loaded.roll, study.assembly.roll_limits)
    return {
        **_ratios(study.assembly),
        "contact_ratio_effective": float(loaded.contact_ratio),
        "stiffness_single_pair_at_pitch_point": single_pair_stiffness(study.flexible, torque),
        "mesh_stiffness_mean": float(np.mean(loaded.mesh_stiffness)),
        "mesh_stiffness_peak_to_peak": float(np.ptp(loaded.mesh_stiffness)),
        "loaded_transmission_error_mean": float(np.mean(loaded.deflection)),
        "loaded_transmission_error_peak_to_peak": float(np.ptp(loaded.deflection)),
        "unloaded_transmission_error_peak_to_peak": float(np.ptp(loaded.unloaded)),
        "normal_load_max": float(np.max(loaded.normal_load)),
        **({"shared_load_max": shared} if np.isfinite(shared) else {}),
        "line_load_max": float(loaded.line_load[worst]),
        "face_load_factor": _face_load_factor(study, loaded),
        "face_load_factor_pitch_point": float(loaded.face_load_factor[position, pair]),
        "hertz_pressure_max": float(np.max(loaded.pressure)),
        "pinion_root_tension_max": float(np.max(tension[0])),
        "gear_root_tension_max": float(np.max(tension[1])),
        "pinion_root_compression_max": float(np.min(compression[0])),
        "gear_root_compression_max": float(np.min(compression[1])),
        "torque_residual": float(np.max(np.abs(torque_residual(study, loaded)))),
        "gear_torque": torque,
        "slices": study.case.mesh.slices,
        **opening_part(study.case, study.flexible.width),
        **bearing_part(shafts_of_pair(study.case)),
        **film,
        **_judged(study, loaded, film),
    }


def _face_load_factor(study: PreparedTeeth, loaded: LoadedContact) -> float:
    """K_Hβ: of the pair with the maximum line load; of helical pairs of the loads' means over the mesh cycle.

    At an instant the line of contact of a helical pair covers a part of the face, and the line load varies
    along it as the stiffness does along the path, whatever the axes: the face is evenly loaded all the same.
    """
    if is_helical(study.assembly):
        mean = np.mean(np.sum(loaded.line_load, axis=1), axis=0)
        return float(np.max(mean) / np.mean(mean))
    worst = np.unravel_index(np.argmax(loaded.line_load), loaded.line_load.shape)
    return float(loaded.face_load_factor[worst[0], worst[1]])


def _judged(study: PreparedTeeth, loaded: LoadedContact, film: Mapping[str, Any]) -> dict[str, Any]:
    """Whether the contact lies within its model, see `record.trust`; the load deflects all pairs alike."""
    judge = Judge()
    places, pairs = {"phase": loaded.phase - loaded.phase[0]}, pair_numbers(study, loaded).tolist()
    bent = np.abs(loaded.deflection - loaded.unloaded) / study.case.drive.module
    judge.take({"deflection": bent, "hertz_pressure": loaded.pressure}, places, pairs)
    judge_tribology(judge, film)
    return judge.summary()


def pair_numbers(study: PreparedTeeth, loaded: LoadedContact) -> Int[Array, " pair"]:
    """Numbers of the pairs: 1 passed the beginning of the path last, 2 is the next to do so."""
    start, _ = study.assembly.roll_limits
    pitch = 2.0 * np.pi / float(study.case.drive.pinion.teeth)
    ages = (loaded.roll[0] - start) / pitch - (loaded.phase[0] - np.floor(loaded.phase[0]))
    return 1 - np.round(ages).astype(int)


#: Names of the arrays of `of_one_cycle`, and what an assessment calls them.
ALONG = {
    "pair_roll_angle": "roll_angle",
    "pair_normal_load": "normal_load",
    "pair_hertz_pressure": "hertz_pressure",
}


def highest_over_face(
    roll: Float[Array, " position"],
    pressure: Float[Array, "position slice"],
    behind: Float[Array, " slice"],
) -> Float[Array, " position"]:
    """Largest pressure, Pa, of all sections while they pass a place of the path of contact, 0 without load.

    `roll` (rad) increases; each section passes a place by `behind` (rad) later than the middle of the face.
    """
    sections = (np.interp(roll + lag, roll, at) for lag, at in zip(behind, pressure.T, strict=True))
    return np.max(np.nan_to_num(list(sections)), axis=0)


def of_one_cycle(assembly: Assembly, loaded: LoadedContact) -> dict[str, Float[Array, " position"]]:
    """Roll angle (rad, increasing), normal load (N) and `highest_over_face` of a pair, by names of `ALONG`.

    Of teeth that are all alike: the pairs of one mesh cycle are then one pair at successive times.
    """
    order = np.argsort(loaded.roll.T.ravel(), kind="stable")
    roll = loaded.roll.T.ravel()[order]
    load = loaded.normal_load.T.ravel()[order]
    over_face = np.swapaxes(loaded.pressure, 0, 1).reshape(len(roll), -1)[order]
    late = float(pitch_slope(assembly)) / float(assembly.path.pinion_pitch_radius)
    pressure = highest_over_face(roll, over_face, late * np.asarray(loaded.slice_position))
    return dict(zip(ALONG, (roll, load, pressure), strict=True))
