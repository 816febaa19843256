"""What an assessment asks of the studies: the motion of its gearbox, and the teeth of every mesh."""

import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import (
    GEARBOX,
    PAIR,
    TEETH,
    Contribution,
    Findings,
    Request,
    Task,
    TaskResult,
)
from tribodyn.gears.by_standard import base_pitch_deviation, running_in_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, internal_side, reference_radius
from tribodyn.geometry.families import family
from tribodyn.studies import STUDIES
from tribodyn.studies.assessment.case import AssessmentCase, RatedMesh, RatedPair
from tribodyn.studies.assessment.settings import AssessedTable
from tribodyn.studies.assessment.unknowns import Draw, Ranges, described, drawn, ranges_of
from tribodyn.studies.protocol.study import Study
from tribodyn.tribology.law import AUTO

#: Name of the run of a gearbox at its duty.
DUTY = "duty"


class Part(NamedTuple):
    """A study that takes part, its role and its tasks."""

    study: Study
    role: Contribution
    tasks: tuple[Task, ...]
    request: Request  # what it was asked
    group: str = ""  # of meshes whose teeth it looks at, where they have names


def request_of(case: RatedPair, draws: Sequence[Draw] = ()) -> Request:
    """What is asked of the studies for a pair of gears, and for samples of it."""
    data, settings = tomllib.loads(case.toml), case.settings
    names = ("drive", "lubricant", "bearings", "shaft", "mesh", "losses")
    tables = {name: data[name] for name in names if name in data}
    iso = {"model": "iso", "lubrication": settings.lubrication}  # of external gears
    temperature = iso if internal_side(case.drive) is None else {"model": "oil"}
    tables |= {
        "oil_temperature": data["operating"]["oil_temperature"],
        "temperature": data.get("temperature", temperature),
        "damping_ratio": settings.damping_ratio,
    }
    lawful = case.with_laws()
    first = str(lawful.friction.law)
    if lawful.film.law is not None:
        tables["film"] = {"law": lawful.film.law}
    assembly = Assembly(family(case.family), case.drive)
    speed = case.operating.pinion_speed * abs(float(reference_radius(case.drive, "pinion")))
    gears = running_in_of(case.materials, speed)
    pitch_deviation = 0.0
    if case.quality is not None:
        _, pitch_deviation = base_pitch_deviation(assembly, case.quality, gears)
    return Request(
        case.title,
        tables,
        case.operating.pinion_speed,
        case.operating.gear_torque,
        tuple(case.operating.gear_torque * share for share in settings.torque_shares),
        speeds_of(settings, case.operating.pinion_speed),
        tuple(dict.fromkeys((first, *(name for name in settings.friction_laws[1:] if name != AUTO)))),
        pitch_deviation,
        tuple(draw.keys(tables.get("bearings", {})) for draw in draws),
        () if settings.face_load_factor else other_torques(case),
    )


def speeds_of(settings: AssessedTable, duty: float) -> tuple[float, ...]:
    """Speeds of the steady states, rad/s, increasing; that of the duty is one of them."""
    speeds = np.linspace(*settings.speed_range, settings.speeds) * duty
    return tuple(sorted({*map(float, speeds), duty}))


def other_torques(case: RatedPair) -> tuple[float, ...]:
    """Torques of the load spectrum that press these flanks, other than that of the duty, N m, increasing."""
    duty_torque = case.operating.gear_torque
    return tuple(sorted({torque for _, _, torque in case.spectrum if torque > 0.0 and torque != duty_torque}))


def faces_of(case: RatedPair, quantities: Mapping[str, Any]) -> list[float]:
    """K_Hβ of every duty of the load spectrum; the contact analysis has them over that of the case's duty."""
    ratios = zip(other_torques(case), quantities.get("face_load_ratios", ()), strict=False)
    by_torque, nominal = dict(ratios), quantities["face_load_factor"]
    return [max(nominal * by_torque.get(torque, 1.0), 1.0) for _, _, torque in case.spectrum]


def parts(request: Request, of: Collection[str], group: str = "") -> tuple[Part, ...]:
    """Studies of the registry that take part in what is assessed, in order, with their tasks.

    Names of the tasks of a `group` of meshes begin with its own, and none of them is needed.
    """
    roles = [(study, role) for _, study in STUDIES.items() if (role := study.role()) is not None]
    return tuple(
        Part(study, role, tuple(_of_group(task, group) for task in role.tasks(request)), request, group)
        for study, role in sorted(roles, key=lambda pair: pair[1].order)
        if role.of in of
    )


def _of_group(task: Task, group: str) -> Task:
    if not group:
        return task
    about = f"mesh {group}, {task.about}"
    return task._replace(name=f"{group}-{task.name}", about=about, needed=False)


def answers(all_parts: Sequence[Part], done: Mapping[str, TaskResult]) -> Iterator[Findings]:
    """What every study says of its results; nothing where its first task failed."""
    for part in all_parts:
        named = f"{part.group}-" if part.group else ""
        results = {task.name.removeprefix(named): done[task.name] for task in part.tasks}
        first = results[next(iter(results))]
        if not part.group or first.summary:
            yield part.role.answer(part.request, results)


class AssessmentParts(NamedTuple):
    """What is asked of the studies."""

    draws: Sequence[Draw]
    varied: str  # what is not known, and how far
    runs: Sequence[Task]  # of the scenario of the gearbox, that at the duty first; none of a pair
    motion: tuple[Part, ...]
    teeth: Mapping[str, tuple[Part, ...]]  # of every group of meshes
    tasks: Sequence[tuple[Study, Task]]  # all of these


def assessment_parts(case: AssessmentCase) -> AssessmentParts:
    """The motion at the duty, with other friction laws and over the speed, and the teeth of every mesh."""
    settings, ranges, runs = case.settings, ranges_of_case(case), list[Task]()
    draws = drawn(ranges, settings.samples, settings.seed) if ranges else []
    first_of: dict[str, RatedMesh] = {}
    for mesh in case.meshes.values():
        first_of.setdefault(mesh.group, mesh)
    teeth = {
        group: parts(request_of(mesh.pressed, _of_teeth(mesh, draws)), (TEETH,), group)
        for group, mesh in first_of.items()
    }
    if case.own is not None:
        motion = parts(request_of(case.own, draws), (PAIR,))
    else:
        scenario = tomllib.loads(case.gearbox.case.toml)
        runs.append(Task(DUTY, "motion at the duty", scenario))
        for law in settings.friction_laws:
            about, other = f"motion with friction by {law}", {**scenario, "friction": {"law": law}}
            runs.append(Task(f"friction-{law}", about, other, needed=False))
        motion = _over_speed(case, draws)
    every = [*motion, *(part for of_group in teeth.values() for part in of_group)]
    ordered = sorted(every, key=lambda part: part.role.order) if case.own else every
    of_parts = [(part.study, task) for part in ordered for task in part.tasks]
    tasks = [*((case.gearbox.study, task) for task in runs), *of_parts]
    return AssessmentParts(draws, described(ranges) if ranges else "", runs, motion, teeth, tasks)


def ranges_of_case(case: AssessmentCase) -> Ranges | None:
    """What is not known of a case; None of a bare model. Drawn shafts and matrices are known."""
    meshes, table = [each.mesh for each in case.meshes.values()], case.settings.unknowns
    if case.own is not None:
        held = zip(SIDES, case.own.supports[:2], strict=True)
        bearings = {side: table.bearings if support is None else 1.0 for side, support in held}
        return ranges_of(meshes, table, bearings, case.own.settings.damping_ratio)
    if not meshes:
        return None
    scenario = tomllib.loads(case.gearbox.case.toml)
    bearings = {
        name: table.bearings
        for name, each in scenario.get("bearings", {}).items()
        if isinstance(each, Mapping) and "matrix" not in each
    }
    damping = float(meshes[0].pair.mesh.damping_ratio)
    return ranges_of(meshes, table, bearings, damping, scenario.get("stage", ()))


def _of_teeth(mesh: RatedMesh, draws: Sequence[Draw]) -> Sequence[Draw]:
    """Draws as they concern the teeth of a mesh, whose file has the key of a pair for its centre distance."""
    return [draw.of_mesh(mesh.mesh.distance) for draw in draws]


def _over_speed(case: AssessmentCase, draws: Sequence[Draw]) -> tuple[Part, ...]:
    """What is asked for the motion over the speed; nothing, where neither speeds nor samples are."""
    subject, settings = case.gearbox.case, case.settings
    if not settings.speeds and not draws:
        return ()
    scenario = case.whole.at_torque(subject, tomllib.loads(subject.toml))
    samples = tuple(draw.keys(scenario.get("bearings", {})) for draw in draws)
    speeds, marched = speeds_of(settings, case.speed), case.whole.marched(subject)
    request = Request(case.title, scenario, case.speed, 0.0, (), speeds, (), 0.0, samples, marched=marched)
    return parts(request, (GEARBOX,))
