"""The studies that take part in the assessment of a pair of gears, and what it asks of them."""

import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import (
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
from tribodyn.geometry.drive import reference_radius
from tribodyn.geometry.families import family
from tribodyn.studies import STUDIES
from tribodyn.studies.assessment.pair.case import AssessmentCase
from tribodyn.studies.assessment.settings import AssessedTable
from tribodyn.studies.assessment.unknowns import Draw, drawn, ranges_of
from tribodyn.studies.protocol.study import Study
from tribodyn.tribology.law import AUTO


class Part(NamedTuple):
    """A study that takes part, its role and its tasks."""

    study: Study
    role: Contribution
    tasks: tuple[Task, ...]
    request: Request  # what it was asked


def request_of(case: AssessmentCase) -> Request:
    """What a case asks the studies."""
    data, settings = tomllib.loads(case.toml), case.settings
    names = ("drive", "lubricant", "bearings", "shaft", "mesh", "losses")
    tables = {name: data[name] for name in names if name in data}
    tables |= {
        "oil_temperature": data["operating"]["oil_temperature"],
        "temperature": data.get("temperature", {"model": "iso", "lubrication": settings.lubrication}),
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
        tuple(draw.keys(tables["bearings"]) for draw in draws_of(case)),
        () if settings.face_load_factor else other_torques(case),
    )


def speeds_of(settings: AssessedTable, duty: float) -> tuple[float, ...]:
    """Speeds of the steady states, rad/s, increasing; that of the duty is one of them."""
    speeds = np.linspace(*settings.speed_range, settings.speeds) * duty
    return tuple(sorted({*map(float, speeds), duty}))


def other_torques(case: AssessmentCase) -> tuple[float, ...]:
    """Torques of the load spectrum that press these flanks, other than that of the duty, N m, increasing."""
    duty_torque = case.operating.gear_torque
    return tuple(sorted({torque for _, _, torque in case.spectrum if torque > 0.0 and torque != duty_torque}))


def faces_of(case: AssessmentCase, quantities: Mapping[str, Any]) -> list[float]:
    """K_Hβ of every duty of the load spectrum; the contact analysis has them over that of the case's duty."""
    ratios = zip(other_torques(case), quantities.get("face_load_ratios", ()), strict=False)
    by_torque, nominal = dict(ratios), quantities["face_load_factor"]
    return [max(nominal * by_torque.get(torque, 1.0), 1.0) for _, _, torque in case.spectrum]


def draws_of(case: AssessmentCase) -> list[Draw]:
    """Samples of what is not known of a case."""
    settings = case.settings
    return drawn(ranges_of(case, settings.unknowns, settings.damping_ratio), settings.samples, settings.seed)


def parts(request: Request, of: Collection[str] = (TEETH, PAIR)) -> tuple[Part, ...]:
    """Studies of the registry that take part in what is assessed, in order, with their tasks."""
    roles = [(study, role) for _, study in STUDIES.items() if (role := study.role()) is not None]
    return tuple(
        Part(study, role, tuple(role.tasks(request)), request)
        for study, role in sorted(roles, key=lambda pair: pair[1].order)
        if role.of in of
    )


def tasks_of(all_parts: Sequence[Part]) -> list[tuple[Study, Task]]:
    """Every task of the parts with its study."""
    return [(part.study, task) for part in all_parts for task in part.tasks]


def answers(all_parts: tuple[Part, ...], done: Mapping[str, TaskResult]) -> Iterator[Findings]:
    """What every study says of its results."""
    for part in all_parts:
        yield part.role.answer(part.request, {task.name: done[task.name] for task in part.tasks})
