"""What the studies found of a gearbox and of each of its meshes, whichever of them runs its motion."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import Findings, MeshAtDuty, TaskResult
from tribodyn.gears.case import STAGES
from tribodyn.gears.prepare import assembled
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.case import OVER_SPEED, AssessmentCase, RatedMesh
from tribodyn.studies.assessment.parts import DUTY, AssessmentParts, answers

#: Of the run at the duty, of each mesh.
_OF_MESH = (
    *("dynamic_factor", "power_in_mean", "power_friction_mean", "efficiency", "friction_coefficient_mean"),
    *("hertz_pressure_max", "film_min", "film_parameter_min", "contact_temperature_max", "bulk_temperature"),
    *("contact_loss_fraction",),
)
#: Of the run at the duty, of the gearbox.
_OF_GEARBOX = (
    *("train_ratio", "power_in_mean", "power_friction_mean", "power_damping_mean", "efficiency"),
    *("dynamic_factor", "mesh_load_factor", "planet_load_factor_max", "normal_load_max"),
    *("contact_loss_fraction", "hertz_pressure_max", "film_min", "film_parameter_min"),
    *("flash_temperature_max", "contact_temperature_max", "bulk_temperature", "worst_mesh"),
)
#: How names end of what the motion has of every mesh.
OF_MESH = "_of_mesh"


#: Of a mesh: its load along the face in static equilibrium of the gearbox, and what makes it even.
IN_EQUILIBRIUM = "equilibrium"


class MeshFindings(NamedTuple):
    """What was found of a mesh."""

    at_duty: MeshAtDuty
    rated: RatedMesh | None  # None: of a bare model, or its driver is driven
    names: tuple[str, str]  # of driver and driven gear; empty ones of a pair of gears
    quantities: Mapping[str, Any]  # of its motion and of its teeth
    margins: Mapping[str, float]  # safeties that its run has without its teeth pressed
    along: Mapping[str, Any]  # arrays along the path of contact; empty: nothing is known
    loads: Mapping[str, Any]  # of its teeth in motion, see `Findings.motion`
    share: float  # K_γ
    #: values of samples by name, with those along the path; empty: there are none
    rows: Mapping[str, np.ndarray]
    over_speed: Mapping[str, np.ndarray]  # values by name over the speed


class GearboxFindings(NamedTuple):
    """What was found of a gearbox."""

    quantities: Mapping[str, Any]
    meshes: Mapping[str, MeshFindings]
    rows: Mapping[str, np.ndarray]  # values of samples by name
    over_speed: Mapping[str, np.ndarray]  # ``input_speed`` and `OVER_SPEED`, as far as they are known
    run: Mapping[str, Any]  # summary of the run at the duty; empty: there is none


def findings_of(
    case: AssessmentCase, requested: AssessmentParts, done: Mapping[str, TaskResult]
) -> GearboxFindings:
    """Put together what the studies say of their results."""
    motion = _together([*answers(requested.motion, done)])
    teeth = {group: _together([*answers(parts, done)]) for group, parts in requested.teeth.items()}
    curves = dict(motion.over_speed)
    if case.own is not None:
        (mesh,) = case.meshes.values()
        own = teeth[""]
        quantities, rows = {**own.quantities, **motion.quantities}, {**own.spread, **motion.spread}
        for part in requested.motion:
            if part.role.face is not None and (stands := part.role.face(part.request)):
                quantities[IN_EQUILIBRIUM] = stands
        share = mesh.rated.settings.mesh_load_factor or 1.0
        only = MeshFindings(
            mesh.mesh, mesh, ("", ""), quantities, {}, own.along, motion.motion, share, rows, curves
        )
        return GearboxFindings(quantities, {"": only}, rows, _over_speed(curves, {}, case.speed), {})
    run, meshes = done[DUTY].summary, dict[str, MeshFindings]()
    faces = case.whole.faces(case.gearbox.case)
    with Record(done[DUTY].path) as record:
        for mesh in case.whole.meshes(case.gearbox.case):
            of_teeth = teeth.get(mesh.alike or mesh.name, Findings({}))
            stands = faces.get(mesh.name, {})
            meshes[mesh.name] = _of_mesh(case, mesh, run, of_teeth, motion, record, stands)
    at_duty = {name: run[name] for name in _OF_GEARBOX if run.get(name) is not None}
    over_speed = _over_speed(curves, run, case.speed)
    of_input = {"input_speed": case.speed, **motion.quantities, **at_duty, STAGES: run.get(STAGES, {})}
    rows = {name: values for name, values in motion.spread.items() if not name.endswith(OF_MESH)}
    return GearboxFindings(of_input, meshes, rows, over_speed, run)


def _of_mesh(
    case: AssessmentCase,
    mesh: MeshAtDuty,
    run: Mapping[str, Any],
    teeth: Findings,
    motion: Findings,
    record: Record,
    stands: Mapping[str, Any],
) -> MeshFindings:
    """A mesh by the run at the duty, whose loads are those of its teeth.

    Where these cannot be pressed together its K_Hβ is that in equilibrium, where it `stands`.
    """
    of_run, rated = run[MESHES][mesh.name], case.meshes.get(mesh.name)
    stage, number = run.get(STAGES, {}).get(mesh.stage, {}), record.meshes.index(mesh.name)
    given = case.settings.mesh_load_factor if mesh.stage else None
    share = float(stage.get("mesh_load_factor", 1.0)) if given is None else given
    quantities = {"face_load_factor": stands.get("face_load_factor", 1.0), **teeth.quantities}
    if stands:
        quantities[IN_EQUILIBRIUM] = stands
    quantities |= {name: of_run[name] for name in _OF_MESH if of_run.get(name) is not None}

    def of_this(every: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {
            name.removesuffix(OF_MESH): values[:, number]
            for name, values in every.items()
            if name.endswith(OF_MESH) and np.any(np.isfinite(values[:, number]))
        }

    rows = of_this(motion.spread) if teeth.spread else {}
    if rows and mesh.stage:
        factor = rows.get("mesh_load_factor", share)
        rows["mesh_load_factor"] = np.full(len(rows["dynamic_factor"]), factor if given is None else given)
        quantities["mesh_load_factor"] = share
    loads = dict[str, Any]()
    if teeth.along and rated is not None:
        loads = _loads(case, rated, quantities, teeth.along, record)
    return MeshFindings(
        mesh,
        rated,
        (of_run["driver"], of_run["driven"]),
        quantities,
        {name: of_run[name] for name in ("S_B", "S_lambda") if of_run.get(name) is not None},
        teeth.along,
        loads,
        share,
        {**teeth.spread, **rows} if rows else {},
        of_this(motion.over_speed),
    )


def _loads(
    case: AssessmentCase,
    rated: RatedMesh,
    quantities: Mapping[str, Any],
    along: Mapping[str, Any],
    record: Record,
) -> dict[str, Any]:
    """Loads of a mesh's teeth as it is pressed; those of a planet at the mean load that K_γ multiplies."""
    loads = case.whole.loads(record, case.gearbox.case, rated.mesh.name)
    if loads is None:
        return {}
    drive = rated.rated.drive
    if rated.turned:
        loads = loads.seen_from_driven(float(drive.pinion.teeth / drive.gear.teeth))
    places = along["roll_angle"]
    positions = round(float(assembled(rated.pressed).pitch_angle) / float(places[1] - places[0]))
    mean = float(np.sum(along["normal_load"])) / positions if rated.mesh.stage else loads.mean_load
    return loads.of_load(mean, quantities["dynamic_factor"])._asdict()


def _together(found: Sequence[Findings]) -> Findings:
    """Findings of several studies as of one."""
    quantities, along, spread, motion, over_speed = ({} for _ in range(5))
    for one in found:
        quantities |= one.quantities
        along |= one.along
        spread |= one.spread
        motion |= one.motion
        over_speed |= one.over_speed
    return Findings(quantities, along, (), spread, motion, over_speed)


def _over_speed(
    curves: Mapping[str, np.ndarray], run: Mapping[str, Any], speed: float
) -> dict[str, np.ndarray]:
    """Recorded quantities over the speed; without other speeds those of the run at the duty."""
    if curves:
        speeds = np.asarray(curves["speed"])
        unknown = np.full(len(speeds), math.nan)
        return {"input_speed": speeds, **{name: curves.get(name, unknown) for name in OVER_SPEED}}
    at_duty = {name: run.get(name) for name in OVER_SPEED} | {"input_speed": speed}
    return {name: np.array([math.nan if one is None else float(one)]) for name, one in at_duty.items()}
