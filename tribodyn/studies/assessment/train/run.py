"""From a case of an assessment of a train to its record: its runs, then the standards mesh by mesh."""

import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import GEARBOX, Findings, Request, Task, TaskResult
from tribodyn.gears.rating.bearings import bearing_part, bearing_remarks
from tribodyn.gears.rating.limits import SAFETIES, judged, not_judged, with_unlimited
from tribodyn.gears.rating.rating_text import factors_said, life_said, numbered, ring_said
from tribodyn.gears.rating.strength import metal_remarks
from tribodyn.post.verdict import outside
from tribodyn.record.reader import MESHES, Record
from tribodyn.record.trust import REASONS, TRUST
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair.assessment_text import extrapolated
from tribodyn.studies.assessment.pair.parts import Part
from tribodyn.studies.assessment.scatter import put_in
from tribodyn.studies.assessment.train.case import LAYOUT, SAMPLES, TrainAssessmentCase
from tribodyn.studies.assessment.train.meshes import (
    STAGES,
    Scatter,
    assessed_mesh,
    contact_of,
    samples_of_train,
    worst_margins,
)
from tribodyn.studies.assessment.train.pairs import MeshPair, pairs_of, parts_of
from tribodyn.studies.assessment.unknowns import Draw, described, drawn, ranges_of_gearbox
from tribodyn.studies.protocol import tasks
from tribodyn.studies.protocol.evaluated import scratch
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult, Study

DUTY = "duty"
#: Of the run at the duty, of the train.
_OF_TRAIN = (
    *("train_ratio", "power_in_mean", "power_friction_mean", "power_damping_mean", "efficiency"),
    *("dynamic_factor", "mesh_load_factor", "planet_load_factor_max", "normal_load_max"),
    *("contact_loss_fraction", "hertz_pressure_max", "film_min", "film_parameter_min"),
    *("flash_temperature_max", "contact_temperature_max", "bulk_temperature", "worst_mesh"),
)


def check(case: TrainAssessmentCase) -> CheckResult:
    """Check the train and what is asked of it; say what train it is."""
    checked = case.subject.study.check(case.subject.case, allow_large=True)
    every = tasks_of(case)
    tasks.require_cases(every)
    return checked._replace(data={**checked.data, "tasks": [task.name for _, task in every]})


def run(
    case: TrainAssessmentCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    The runs lie in a folder beside the record and are done again only if their scenarios or the code changed.
    """
    return tasks.recorded(case, output, LAYOUT, partial(assessed, case), force=force, progress=progress)


def quantities_of(case: TrainAssessmentCase) -> dict[str, Any]:
    """Quantities of a case without a record; see `scratch` for its runs."""
    with scratch() as folder:
        return assessed(case, folder)[1]


def motion_parts(case: TrainAssessmentCase, draws: Sequence[Draw]) -> tuple[Part, ...]:
    """The studies that are asked for the motion over the speed; none, where neither is asked for."""
    subject, whole, settings = case.subject.case, case.whole, case.settings
    if not settings.speeds and not draws:
        return ()
    scenario, speed = whole.at_torque(subject, tomllib.loads(subject.toml)), whole.speed(subject)
    samples = tuple(draw.keys(scenario.get("bearings", {})) for draw in draws)
    speeds, marched = parts.speeds_of(settings, speed), whole.marched(subject)
    request = Request(case.title, scenario, speed, 0.0, (), speeds, (), 0.0, samples, marched=marched)
    return parts.parts(request, (GEARBOX,))


class Asked(NamedTuple):
    """What is asked of the studies."""

    pairs: Mapping[str, MeshPair]
    draws: Sequence[Draw]
    varied: str  # what is not known, and how far
    motion: tuple[Part, ...]
    teeth: Mapping[str, tuple[Part, ...]]  # of every group of meshes
    tasks: Sequence[tuple[Study, Task]]  # the train's runs at the duty, and all of these


def asked_of(case: TrainAssessmentCase) -> Asked:
    """The train's run at the duty, those with other friction laws, its motion over the speed, its teeth."""
    study, scenario = case.subject.study, tomllib.loads(case.subject.case.toml)
    runs = [Task(DUTY, "motion at the duty", scenario)]
    for law in case.settings.friction_laws:
        about, other = f"motion with friction by {law}", {**scenario, "friction": {"law": law}}
        runs.append(Task(f"friction-{law}", about, other, needed=False))
    pairs, settings = pairs_of(case), case.settings
    meshes = [pair.mesh for pair in pairs.values()]  # of a bare model there are none
    ranges = ranges_of_gearbox(scenario, meshes, settings.unknowns) if meshes else None
    draws = drawn(ranges, settings.samples, settings.seed) if ranges else []
    motion, teeth = motion_parts(case, draws), parts_of(pairs, draws)
    every = parts.tasks_of([*motion, *(part for of_mesh in teeth.values() for part in of_mesh)])
    varied = described(ranges) if ranges else ""
    return Asked(pairs, draws, varied, motion, teeth, [*((study, task) for task in runs), *every])


def tasks_of(case: TrainAssessmentCase) -> Sequence[tuple[Study, Task]]:
    """Every task with its study."""
    return asked_of(case).tasks


def assessed(
    case: TrainAssessmentCase, folder: Path, progress: Progress | None = None, force: bool = False
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Run the tasks into a folder and put them together: values over the speed, and the summary.

    Raises InputError or SimulationError if the run at the duty fails; see also `tasks.results`.
    """
    begun = perf_counter()
    asked = asked_of(case)
    done = tasks.results(asked.tasks, folder, progress, force=force)
    duty_summary, subject, whole = done[DUTY].summary, case.subject.case, case.whole
    over_speed = [answer for answer in parts.answers(asked.motion, done) if answer]
    quantities = {name: value for found in over_speed for name, value in found.quantities.items()}
    rows = {name: values for found in over_speed for name, values in found.spread.items()}
    along = _over_speed(case, over_speed, duty_summary)
    duties = max((len(pair.rated.spectrum) for pair in asked.pairs.values()), default=0)
    scatter, meshes, scattered = Scatter(asked.draws, rows), {}, {}
    with Record(done[DUTY].path) as record:
        for mesh in whole.meshes(subject):
            group = mesh.alike or mesh.name
            contact = contact_of(group, asked.teeth.get(group, ()), done)
            meshes[mesh.name], samples = assessed_mesh(
                case, mesh, asked.pairs.get(mesh.name), duty_summary, contact, record, scatter
            )
            if samples is not None:
                scattered[mesh.name] = samples
    oil = whole.meshes(subject)[0].pair.lubricant
    application, count = case.settings.application_factor, len(asked.draws)
    scatter_said = f"; its scatter is over {count} samples of {asked.varied}" if scattered else ""
    summary: dict[str, Any] = {
        "input_speed": case.whole.speed(case.subject.case),
        **quantities,
        **{name: duty_summary[name] for name in _OF_TRAIN if duty_summary.get(name) is not None},
        **_mesh_load_factor_max(along),
        **_losses(case, done),
        **worst_margins(meshes),
        **bearing_part(whole.shafts(subject), oil),
        STAGES: duty_summary.get(STAGES, {}),
        MESHES: meshes,
        "limits": with_unlimited(
            judged(case.limits, _values(duty_summary, meshes, application)),
            worst_margins(meshes),
        ),
        "not_judged": _not_judged(case),
        "in_doubt": numbered(_in_doubt(duty_summary)),
        "assumed": numbered(list(_assumed(case, meshes, duties, scatter_said))),
        "extrapolated": numbered([*extrapolated(asked.tasks, done), *_outside(meshes)]),
        **{name: duty_summary[name] for name in (TRUST, REASONS) if duty_summary.get(name)},
        "wall_time": perf_counter() - begun,
    }
    if scattered:
        summary = put_in(summary, samples_of_train(scatter, meshes, scattered))
    return along, {name: value for name, value in summary.items() if value not in ({}, [], "")}


def _not_judged(case: TrainAssessmentCase) -> str:
    """Of all meshes, which have one oil."""
    first = case.whole.meshes(case.subject.case)[0]
    return not_judged(case.limits, first.pair.lubricant.fzg)


def _in_doubt(duty_summary: Mapping[str, Any]) -> list[str]:
    """Which meshes have film or friction that the solved contact puts in doubt, as the run says."""
    meshes_by_line: dict[str, list[str]] = {}
    for name, mesh in duty_summary[MESHES].items():
        for line in outside(mesh):
            if "in doubt" in line:
                meshes_by_line.setdefault(line, []).append(name)
    return [f"Mesh {', '.join(names)}: {line[0].lower()}{line[1:]}" for line, names in meshes_by_line.items()]


def _over_speed(
    case: TrainAssessmentCase, found: Sequence[Findings], duty_summary: Mapping[str, Any]
) -> dict[str, Any]:
    """The recorded quantities over the speed, those of the run at the duty where no others are."""
    if found:
        curves = dict(found[0].over_speed)
        return {"input_speed": curves["speed"], **{name: curves[name] for name in SAMPLES}}
    at_duty = {name: duty_summary.get(name) for name in SAMPLES}
    values = {name: math.nan if value is None else float(value) for name, value in at_duty.items()}
    values["input_speed"] = case.whole.speed(case.subject.case)
    return {name: np.array([value]) for name, value in values.items()}


def _mesh_load_factor_max(along: Mapping[str, np.ndarray]) -> dict[str, float]:
    known = along["mesh_load_factor"][np.isfinite(along["mesh_load_factor"])]
    return {"mesh_load_factor_max": float(np.max(known))} if known.size else {}


def _losses(case: TrainAssessmentCase, done: Mapping[str, TaskResult]) -> dict[str, Any]:
    """Losses by the train's own friction law and by the others that were asked for."""
    at_duty = done[DUTY].summary
    first = str(next(iter(at_duty[MESHES].values())).get("friction_law", "own"))
    runs = {first: at_duty} | {law: done[f"friction-{law}"].summary for law in case.settings.friction_laws}
    runs = {law: summary for law, summary in runs.items() if summary}
    if len(runs) < 2:
        return {}
    efficiencies = [float(summary["efficiency"]) for summary in runs.values()]
    return {
        "loss_by_law": {law: float(summary["power_friction_mean"]) for law, summary in runs.items()},
        "efficiency_lowest": min(efficiencies),
        "efficiency_highest": max(efficiencies),
    }


def _values(
    duty_summary: Mapping[str, Any], meshes: Mapping[str, Mapping[str, Any]], application: float
) -> dict[str, float]:
    """What the limits are compared with, pressures with K_A."""
    margins = worst_margins(meshes)
    names = SAFETIES | {"life": "life"}
    values = {limit: margins.get(name, math.nan) for limit, name in names.items()}
    of_run = {"hertz_pressure": "hertz_pressure_max"}
    for limit in ("dynamic_factor", "hertz_pressure", "mesh_load_factor"):
        value = duty_summary.get(of_run.get(limit, limit))
        values[limit] = math.nan if value is None else float(value)
    values["hertz_pressure"] *= math.sqrt(application)
    return values


def _assumed(
    case: TrainAssessmentCase, meshes: Mapping[str, Mapping[str, Any]], duties: int, scatter: str
) -> Iterator[str]:
    settings, subject, whole = case.settings, case.subject.case, case.whole
    pairs = [mesh.pair for mesh in whole.meshes(subject)]
    yield f"In every mesh {factors_said(settings)}"
    if settings.mesh_load_factor is None and any("alike" in mesh for mesh in meshes.values()):
        yield "K_γ of each planetary stage is that of the simulation."
    yield (
        "The efficiency is that of tooth friction alone: bearings, seals and churning are not in it. The "
        "motion runs without K_A; stresses, film, temperatures and safeties, simulated too, count with it "
        "and with K_γ of planetary stages."
    )
    yield f"Accurate teeth in the simulation but for modifications and pin errors of the scenario{scatter}."
    rated = [name for name, mesh in meshes.items() if "iso" in mesh]
    if len(rated) < len(meshes):
        yield (
            "Meshes without a tolerance class or of other teeth than involutes have the simulation's margins "
            "alone."
        )
    if rated:
        yield (
            "Standards: each mesh as a pair of its own, deviations by ISO 1328-1, K_v and K_Hα by "
            "method B, flanks without credited tip relief, case-hardened running-in, new oil; no integral "
            "temperature of a ring."
        )
    if rated:
        materials = {remark for pair in pairs for remark in metal_remarks(pair)}
        yield from sorted(materials)
        yield life_said(settings, duties)
        rings = {text: name for name in reversed(rated) for text in ring_said(meshes[name]["iso"])}
        yield from (f"Mesh {name}: {text}" for text, name in reversed(rings.items()))
    yield from bearing_remarks(whole.shafts(subject), pairs[0].lubricant)
    if any("S_B" not in mesh.get("simulated", {}) for mesh in meshes.values()):
        yield "Without an FZG load stage of the oil there is no safety against scuffing."


def _outside(meshes: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """What of the meshes lies outside the limits of the standards."""
    remarks = [(name, text) for name, mesh in meshes.items() for text in mesh.get("outside", {}).values()]
    return [f"Mesh {name}: {text}" for name, text in remarks]
